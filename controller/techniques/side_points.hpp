/// The sides of a character, and which of its points are on a side.
#pragma once

#include <paperproof/character.hpp>

#include <array>
#include <span>

namespace paperproof::article {

inline constexpr std::array all_sides{Side::top, Side::bottom, Side::left, Side::right};

/// The component of a vector that belongs to a side: 0 for left and right, 1 for top and bottom.
[[nodiscard]] constexpr Eigen::Index component_of(Side side) noexcept {
  return side == Side::left || side == Side::right ? 0 : 1;
}

/// Out of the character through that side: -1 for left and bottom, 1 for right and top.
[[nodiscard]] constexpr int outwards(Side side) noexcept { return side == Side::left || side == Side::bottom ? -1 : 1; }

/// The side of the character that meets something when it moves along a component.
[[nodiscard]] constexpr Side side_ahead(Eigen::Index component, bool forwards) noexcept {
  if (component == 0) return forwards ? Side::right : Side::left;
  return forwards ? Side::top : Side::bottom;
}

}  // namespace paperproof::article

namespace paperproof {

/// Indices of the two points of a side: top and bottom from left to right, left and right from bottom to top. A side
/// that is a corner has the same index twice.
using PointPair = std::array<std::size_t, 2>;

/// The points of one side: those at the extreme of that direction. For the article's character these are its pairs.
[[nodiscard]] inline PointPair points_of_side(std::span<const Vec2d> points, Side side) noexcept {
  const Eigen::Index across = article::component_of(side);
  const auto reach = [&](std::size_t i) { return article::outwards(side) * points[i][across]; };
  const auto along = [&](std::size_t i) { return points[i][1 - across]; };
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
