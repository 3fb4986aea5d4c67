/// A SuperTux level as it is written, and what its tile numbers mean: what collisions need of it.
#pragma once

#include "scenes/scene.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// A tile, as `images/tiles.strf` has it.
struct SuperTuxTile {
  std::uint32_t attributes = 0;
  std::uint32_t data = 0;

  enum class Kind : std::uint8_t { nothing, solid, slope, one_way };
  /// A slope must be solid too; one-way is written together with solid, and a slope is never one-way.
  [[nodiscard]] Kind kind() const noexcept;

  /// Solid tiles and slopes: the part within the unit square, x right, y **down**; convex, vertices in order.
  [[nodiscard]] std::vector<Vec2d> solid_part() const;

  /// One-way tiles: the side that blocks.
  struct Side {
    Vec2d from, to;  ///< Within the unit square, y **down**.
    Vec2d outwards;  ///< y up.
  };
  [[nodiscard]] const Side& side() const noexcept;
};

/// By tile number. Tile 0 is empty and not in it.
using SuperTuxTiles = std::map<std::uint32_t, SuperTuxTile>;

struct SuperTuxPath {
  std::vector<MoverDef::Waypoint> waypoints;  ///< [m, y up]; none: what has this path stands.
  MoverDef::Loop loop = MoverDef::Loop::loop;
  bool is_clear = false;  ///< What it does: not of curves, of no order, or where it would have to jump.
};

struct SuperTuxTilemap {
  bool solid = false;
  int width = 0, height = 0;         ///< [tiles]
  std::vector<std::uint32_t> tiles;  ///< Row by row.
  std::optional<SuperTuxPath> path;
};

struct SuperTuxPlatform {
  std::string sprite;
  bool running = true;  ///< Otherwise it waits for a script where its path begins.
  bool hurts = false;   ///< These are not solid.
  std::optional<SuperTuxPath> path;
};

struct SuperTuxSpawn {
  std::string name;
  Vec2d at{Vec2d::Zero()};  ///< [px], y down
};

struct SuperTuxSector {
  std::string name;
  std::vector<SuperTuxTilemap> tilemaps;
  std::vector<SuperTuxPlatform> platforms;
  std::vector<SuperTuxSpawn> spawns;
  std::string where;
};

struct SuperTuxLevel {
  std::string root;  ///< Folder with images/.
  SuperTuxTiles tiles;
  std::vector<SuperTuxSector> sectors;
};

/// @throws InputError
[[nodiscard]] SuperTuxLevel read_supertux_level(const std::string& path, const std::string& given);

/// Width and height of the picture of a sprite [px]; none where it cannot be read.
/// @param root the folder with images/. @param sprite as the level names it.
[[nodiscard]] std::optional<Vec2d> sprite_size(const std::string& root, const std::string& sprite);

}  // namespace paperproof::compare
