/// The article's "Pixel Colour": the level is a picture in indexed colours, one of which is the background; before each
/// pixel of movement the colours next to the character are tested.
///
/// The outline of the sprite is tested on the side that moves, so nothing is passed at any speed; a step costs as many
/// tests as the sprite has rows (columns) for every pixel of the way. A solid that lies within the character from the
/// start is not seen. Decoration in the colour of a platform stops it as a platform does (`TechniqueDef::decoration`):
/// the article names this as the price of the technique. No contact names it, as it is no collider. The knobs `unit`,
/// `iterations`, `points`, `pairs` and `response` have no meaning here: the unit is the pixel, and the response that of
/// the article (see raster/pixel_walk.hpp).
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
/// @throws NotExpressible for a one-way chain, a picture that is too large, a character without a pixel.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_pixel_colour(const TechniqueDef& def,
                                                                   const Scenery<Scalar>& scenery,
                                                                   const CharacterDef& character);

}  // namespace paperproof
