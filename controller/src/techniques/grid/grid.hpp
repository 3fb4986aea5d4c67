/// The article's grid, as in the games of 1983: the level is a two-dimensional array of squares, and the character is
/// in exactly one of them.
///
/// In each step the square that the wanted motion leads to is looked up, for either component; where it is solid the
/// motion that way is prevented before it begins. Of what is left the larger component moves the character into the
/// next square, in one of the four directions and by exactly one square, once half a square has been wanted. Until then
/// the motion is kept in the state's `remainder`: a game draws its character at position + remainder, and nothing
/// collides there. Where no motion is wanted along a component what is drawn glides to the middle of the square, at the
/// character's walking speed (or a square per second, if that is more): a move ends exactly in a square, for the eye
/// too. More than one square in a step cannot be made; what is over is dropped.
///
/// `position` puts the feet of the character on the lower edge of its square, and its box in the middle between left
/// and right (for a character as large as its square: the centre). What sticks out of the square is drawn and not
/// tested: a character that is taller than its square has its head in what is above. The first step moves it from
/// wherever it starts into the square that holds its middle and whose lower edge is nearest to its feet.
///
/// The knob is `square`, the side of the squares; the others have no meaning here. A contact's fraction is 0, its point
/// the middle of the square's edge.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
/// @throws NotExpressible for scenery that is not made of whole squares.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_grid(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                           const CharacterDef& character);

}  // namespace paperproof
