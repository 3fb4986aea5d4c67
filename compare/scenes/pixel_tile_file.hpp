/// Reads levels of tiles whose pixels say what a collision does.
///
/// Such a file is written by hand, with a character for each pixel and each tile, like the tile editors of the time of
/// Deluxe Paint, only in JSON. A hill with a slope of 45 degrees, tiles of 4 pixels:
///
///     {
///       "paperproof_pixel_tiles": 1,
///       "pixels_per_tile": 4,
///       "tiles": {
///         "#": ["####", "####", "####", "####"],
///         "/": [".l.R", "l.R#", ".R##", "R###"],
///         "a": ["....", "....", "...l", "...."],
///         "b": ["....", "....", "....", "..l."]
///       },
///       "map": ["..b..",
///               ".a/##",
///               "#####"]
///     }
///
/// The article's own tile has 32 × 32 pixels and slopes down from its upper left corner; the built-in scenes
/// `pixel_hill` and `pixel_hill_up` have it. Each of its columns is one pixel lower than the one on its left. There,
/// "up" is written into the highest solid pixel of a column (`L`): a foot that moves left enters it, and is put one
/// pixel up. "Down" is written into the second free pixel above a column (`r`): a foot that moves right stood on the
/// higher column on its left, enters that pixel, and is put one pixel down onto this column.
///
/// A pixel is `.` (nothing) or `#` (blocks), a capital where it is solid and takes a foot one pixel up, or a small
/// letter where it is free and takes a foot one pixel down: `L`, `l` when it moves left, `R`, `r` when it moves right,
/// `B`, `b` both (what that is to a foot: `PixelAction`). A tile is named by any one character but `.`, which in the
/// map is no tile at all. The map's upper left corner is at the origin, as a picture's, or by `"at": [column, row]`
/// that many tiles to the right and up. Pixels are the scene's, `pixels_per_metre`.
///
/// The solid pixels are the scenery of all contenders, as those of a picture are. Otherwise a level would have to be
/// written twice, once for `pixel_tile` and once in polygons for all others, and where the two differ the judge would
/// call `pixel_tile` wrong for what is only a mistake in a file. So everybody is judged against the pixels that are
/// drawn. A contender that draws lies on whole pixels, and the octagon up to one beside that: no deeper in these pixels
/// than one of them counts as `drawn` and not as inside (oracle/exemptions.hpp). What a tile says beyond that, up and
/// down, is for `pixel_tile` alone: the others see steps of one pixel.
#pragma once

#include "scenes/pixel_rectangles.hpp"

#include <paperproof/pixel_tiles.hpp>

#include <string>

namespace paperproof::compare {

/// @param given the file as the user named it.
/// @throws InputError "given: /pointer: what was expected": no file, no JSON, unknown keys, rows that are too long or
/// too
///   short, characters that mean nothing, more than 2^26 pixels, not one solid pixel.
[[nodiscard]] PixelTileSet read_pixel_tiles(const std::string& path, const std::string& given);

/// The solid pixels of a level that `read_pixel_tiles` has read.
/// @throws InputError for too many rectangles of them.
[[nodiscard]] PixelScenery scenery_of(const PixelTileSet& tiles, double pixels_per_metre, const std::string& given);

}  // namespace paperproof::compare
