/// The article's "Mask": level and sprite in black and white; when the character attempts to move, each white pixel of
/// the sprite is compared with the level's at the corresponding position, 64 at a time.
///
/// Only the attempted position is compared, nothing between: paper is passed. Where it collides, the character is wound
/// back one pixel at a time until it is free, as in the article's primitive: with the knob `response=component` first
/// the vertical movement alone, in the order of the article's pairs, then the horizontal one from there, so that a
/// walker is not held by the floor; with `shorten` the whole movement, so that it is.
///
/// The picture of the character is that of its hull, or `TechniqueDef::sprite`: then only its white pixels collide, and
/// what stands under the arch of its legs does not. The knobs `unit`, `iterations`, `points` and `pairs` have no
/// meaning here: the unit is the pixel.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
/// @throws NotExpressible for a one-way chain, a picture that is too large, a character without a pixel.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_mask(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                           const CharacterDef& character);

}  // namespace paperproof
