/// The article's "Pixel Tile": the level is made of square tiles of a few types, each with an array that says per pixel
/// what a collision there does; the collision points of the character are looked up in it.
///
/// All of the character's points are tested before each pixel of movement, so none of them enters a solid; what is
/// narrower than the gaps between them passes. On a slope of up to 45 degrees the array takes a foot that walks into it
/// one pixel up, and one that walks away from it one pixel down (see pixel_tiles.hpp). The knobs `unit`, `iterations`,
/// `points`, `pairs` and `response` have no meaning here.
#pragma once

#include <paperproof/pixel_tiles.hpp>
#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
/// @throws NotExpressible for a one-way chain, a picture that is too large, a character without a pixel.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_pixel_tile(const TechniqueDef& def,
                                                                 const Scenery<Scalar>& scenery,
                                                                 const CharacterDef& character);

}  // namespace paperproof
