/// Whole pixels of a level: which they are, and which of them a piece of scenery covers.
///
/// Pixel (x, y) is the square from (x, y) to (x + 1, y + 1) in units of one pixel, y up; pixel (0, 0) has its lower
/// left corner at the origin of the world.
#pragma once

#include "techniques/side_points.hpp"

#include <paperproof/types.hpp>

#include <cmath>
#include <cstdint>

namespace paperproof::raster {

/// 64 bits: 2e6 m at the finest resolution leave room to add to.
struct Pixel {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend bool operator==(const Pixel&, const Pixel&) = default;
  friend Pixel operator+(const Pixel& a, const Pixel& b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend Pixel operator-(const Pixel& a, const Pixel& b) noexcept { return {a.x - b.x, a.y - b.y}; }
};

/// Half open: from `lower` to, but not including, `lower + (width, height)`.
struct PixelBox {
  Pixel lower;
  std::int64_t width = 0;
  std::int64_t height = 0;

  [[nodiscard]] bool contains(const Pixel& pixel) const noexcept {
    const Pixel at = pixel - lower;
    return at.x >= 0 && at.x < width && at.y >= 0 && at.y < height;
  }
};

/// One pixel out of the character through that side.
[[nodiscard]] constexpr Pixel towards(Side side) noexcept {
  const int out = article::outwards(side);
  return article::component_of(side) == 0 ? Pixel{out, 0} : Pixel{0, out};
}

[[nodiscard]] inline std::int64_t floor_to_pixel(double coordinate) noexcept {
  return static_cast<std::int64_t>(std::floor(coordinate));
}
[[nodiscard]] inline std::int64_t ceil_to_pixel(double coordinate) noexcept {
  return static_cast<std::int64_t>(std::ceil(coordinate));
}

}  // namespace paperproof::raster
