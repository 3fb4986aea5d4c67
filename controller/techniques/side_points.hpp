/// Which points of a character are on a side of it.
#pragma once

#include <paperproof/character.hpp>

#include <array>
#include <span>

namespace paperproof {

/// Indices of the two points of a side: top and bottom from left to right, left and right from bottom to top. A side
/// that is a corner has the same index twice.
using PointPair = std::array<std::size_t, 2>;

/// The points of one side: those at the extreme of that direction. For the article's character these are its pairs.
[[nodiscard]] inline PointPair points_of_side(std::span<const Vec2d> points, Side side) noexcept {
  const bool is_level = side == Side::top || side == Side::bottom;
  const double sign = side == Side::top || side == Side::right ? 1 : -1;
  const auto reach = [&](std::size_t i) { return sign * (is_level ? points[i].y() : points[i].x()); };
  const auto along = [&](std::size_t i) { return is_level ? points[i].x() : points[i].y(); };
  PointPair pair{0, 0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (reach(i) > reach(pair[0]))
      pair = {i, i};
    else if (reach(i) == reach(pair[0]))
      pair[along(i) < along(pair[0]) ? 0 : 1] = i;
  }
  return pair;
}

}  // namespace paperproof
