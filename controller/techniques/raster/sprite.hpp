/// The character in pixels.
#pragma once

#include "techniques/raster/bitmap.hpp"

#include <paperproof/character.hpp>

namespace paperproof::raster {

/// The character's hull, rasterised with the lower left corner of its bounding box on the corner of a pixel: pixel
/// (0, 0) of the sprite. Immutable; shareable between threads.
class Sprite {
 public:
  /// @throws NotExpressible where the character is too small to have a pixel, or too large for a picture.
  Sprite(const CharacterShape& shape, double pixels_per_metre);

  /// Its white pixels are the solid ones.
  [[nodiscard]] const Bitmap& mask() const noexcept { return mask_; }
  /// The outermost solid pixels of one side: one for each row (left, right) or column (bottom, top), in order.
  [[nodiscard]] std::span<const Pixel> edge(Side side) const noexcept { return edges_[static_cast<std::size_t>(side)]; }
  /// The pixels of the collision points, in the character's order. A point on the border between two pixels belongs to
  /// the one that is nearer to the middle of the sprite: a foot at the sprite's lower edge is in its lowest row.
  [[nodiscard]] std::span<const Pixel> points() const noexcept { return points_; }
  /// Those of the bottom pair; twice the same where the character stands on one point.
  [[nodiscard]] const std::array<Pixel, 2>& feet() const noexcept { return feet_; }

 private:
  Bitmap mask_;
  std::array<std::vector<Pixel>, 4> edges_;
  std::vector<Pixel> points_;
  std::array<Pixel, 2> feet_;
};

}  // namespace paperproof::raster
