/// How a collider goes that turns.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace paperproof::compare {

/// In one step: each vertex goes evenly on a straight line from its place at one instant to that at the next. That is
/// the motion, and no approximation of one: so everything about it is a fraction.
struct VertexWay {
  ColliderIndex collider = 0;
  std::vector<double> instants;  ///< Fractions of the step, ascending, from 0 to 1.
  /// At each instant, in the world [m]: the points of the collider in the order of its definition, then those of its
  /// holes.
  std::vector<std::vector<Vec2d>> vertices;
};

/// That of a collider; null if there is none.
[[nodiscard]] inline const VertexWay* find_way(std::span<const VertexWay> ways, ColliderIndex collider) {
  const auto found =
      std::find_if(ways.begin(), ways.end(), [&](const VertexWay& way) { return way.collider == collider; });
  return found == ways.end() ? nullptr : &*found;
}

}  // namespace paperproof::compare
