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

#include <array>
#include <string>
#include <vector>

namespace paperproof::compare {

/// One scene per sector that has solids and a spawn point, named `<level>`, or `<level>/<sector>` where the level has
/// several sectors.
/// @throws InputError "file:line: what was expected", also where no sector gives a scene.
[[nodiscard]] std::vector<Scene> read_supertux(const std::string& path, const std::string& given);

/// What is in a level, for those who want to compare with another reader.
struct SuperTuxCounts {
  long levels = 0;
  long sectors = 0;
  long solid = 0;  ///< Tiles of solid tilemaps, moving ones included.
  long slopes = 0;
  std::array<long, 3> slopes_by_steepness{};  ///< Rise in run: 1 in 2, 1 in 1, 2 in 1.
  long one_way = 0;
  std::array<long, 4> one_way_by_direction{};  ///< North, south, west, east.
  long unknown = 0;                            ///< Placed tiles that tiles.strf does not have.
  long moving_tilemaps = 0;                    ///< Solid ones with a path.
  long platforms = 0;
  long path_nodes = 0;

  SuperTuxCounts& operator+=(const SuperTuxCounts& other);
};

/// @throws InputError as `read_supertux`; a level without solids is counted, not refused.
[[nodiscard]] SuperTuxCounts count_supertux(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
