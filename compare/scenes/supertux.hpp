/// Reads levels of the game SuperTux (`.stl`, S-expressions; 32 px tiles, y down).
///
/// Each tile of a solid tilemap becomes a collider of its own: a square, a slope (the tile cut by a line), or for a
/// one-way tile a chain at the side that blocks. Nothing is merged. 32 px are 1 m; y is negated, so a level lies below
/// 0.
///
/// Solid tilemaps and platforms that follow a path become movers, each with all its tiles, where their shape and path
/// are clear; those that stand still (a path of one node, a platform that waits for a script) are scenery. What is left
/// out is counted in the scene's notes: curved paths, platforms whose picture is missing, tile numbers that
/// `images/tiles.strf` does not know.
///
/// The character is 20 x 40 px with its upper left corner at the spawn point `main`, else at the first one; where that
/// is inside a solid (the game's own character is lower) it begins at the nearest free place above, and a note says so.
/// It walks 7 m/s, jumps with 14 m/s and falls at most 25 m/s under 30 m/s²: near enough to the game's figures to get
/// about.
#pragma once

#include "scenes/scene.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One scene per sector that has solids and a spawn point, named `<level>`, or `<level>/<sector>` where the level has
/// several sectors.
/// @throws InputError "file:line: what was expected", also where no sector gives a scene.
[[nodiscard]] std::vector<Scene> read_supertux(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
