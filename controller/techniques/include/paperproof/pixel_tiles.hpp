/// Square tiles whose pixels say what a collision does: the level of the technique `pixel_tile`.
#pragma once

#include <paperproof/scenery.hpp>

#include <cstdint>
#include <vector>

namespace paperproof {

/// What happens when a foot is about to enter a pixel.
enum class PixelAction : std::uint8_t {
  nothing,  ///< It enters.
  block,    ///< It stays where it is.
  up,       ///< It enters one pixel higher: the surface of a slope, met uphill.
  down,     ///< It enters one pixel lower where that is free and the character is not rising: just above the surface of
            ///< a slope, met downhill.
};

/// By the direction of the movement. A pixel is solid or not from all directions: both actions are one of `block` and
/// `up`, or none is.
struct PixelCollision {
  PixelAction moving_left = PixelAction::nothing;
  PixelAction moving_right = PixelAction::nothing;

  [[nodiscard]] bool is_solid() const noexcept {
    return moving_left == PixelAction::block || moving_left == PixelAction::up;
  }
  friend bool operator==(const PixelCollision&, const PixelCollision&) = default;
};

/// A level made of a few types of tiles; outside of it is nothing. Fill it by hand or with
/// `make_pixel_tiles`. Reading is thread-safe.
struct PixelTileSet {
  using Tile = std::vector<PixelCollision>;  ///< Row by row from the lowest, left to right.

  int pixels_per_tile = 32;        ///< Along one side.
  std::vector<Tile> types;         ///< `pixels_per_tile`² pixels each.
  std::int64_t first_column = 0;   ///< Tile (0, 0) has its lower left corner at the origin of the world.
  std::int64_t first_row = 0;      ///< The lowest.
  std::int64_t columns = 0;        ///< In the map.
  std::vector<std::uint32_t> map;  ///< Index into `types`: row by row from the lowest, `columns` each.

  /// What pixel (x, y) does, counted from the origin of the world, y up.
  [[nodiscard]] PixelCollision at(std::int64_t x, std::int64_t y) const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// @throws std::invalid_argument naming what does not fit: sizes, an index without a type, a pixel that is solid from
  ///   one direction only.
  void validate() const;
};

/// The tiles of a scenery, drawn at `pixels_per_metre`: a pixel is solid when its centre is in a polygon, and where a
/// chain's line is. The top pixel of a column of solid ones is marked `up` for the movement that comes from a column
/// whose top is one pixel lower, and the pixel above the lower one's free place `down` for the way back: a slope of up
/// to 45 degrees, and a step of one pixel. Every other solid pixel blocks. Tiles with the same content share a type.
/// Sensors, and what moves, are not drawn.
/// @param pixels_per_tile along one side, at least 1.
/// @throws NotExpressible for a one-way chain, or where the level would take more than 256 MiB.
[[nodiscard]] PixelTileSet make_pixel_tiles(const SceneryDef& scenery, double pixels_per_metre, int pixels_per_tile);

}  // namespace paperproof
