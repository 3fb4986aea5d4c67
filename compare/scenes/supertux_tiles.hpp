/// What the tile numbers of SuperTux mean: the part of `images/tiles.strf` that collisions need.
#pragma once

#include <paperproof/types.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

struct SuperTuxTile {
  std::uint32_t attributes = 0;
  std::uint32_t data = 0;

  enum class Kind : std::uint8_t { nothing, solid, slope, one_way };
  /// A slope must be solid too; one-way is written together with solid, and a slope is never one-way.
  [[nodiscard]] Kind kind() const noexcept;

  /// Slopes: the solid part within the unit square, x right, y **down**; convex, vertices in order.
  [[nodiscard]] std::vector<Vec2d> solid_part() const;

  /// One-way tiles: the side that blocks.
  enum class Direction : std::uint8_t { north, south, west, east };
  [[nodiscard]] Direction direction() const noexcept { return static_cast<Direction>(data & 3U); }
};

/// By tile number. Tile 0 is empty and not in it.
using SuperTuxTiles = std::map<std::uint32_t, SuperTuxTile>;

/// @throws InputError "file:line: ..."
[[nodiscard]] SuperTuxTiles read_supertux_tiles(const std::string& path, const std::string& given);

/// The data root that a level belongs to: the nearest folder above it that holds images/tiles.strf, else where Debian's
/// package supertux-data puts it; none where neither exists.
[[nodiscard]] std::optional<std::string> supertux_root(const std::string& level_path);

}  // namespace paperproof::compare
