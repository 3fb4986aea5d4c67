/// How a collider goes that turns.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
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
  /// Of a disc, whose vertex is its centre: how far it turns in the step, counter-clockwise, as the scene has it [rad].
  /// Not in a trace.
  double turn = std::numeric_limits<double>::infinity();
};

/// That of a collider; null if there is none.
[[nodiscard]] inline const VertexWay* find_way(std::span<const VertexWay> ways, ColliderIndex collider) {
  const auto found = std::ranges::find(ways, collider, &VertexWay::collider);
  return found == ways.end() ? nullptr : &*found;
}

/// Whether the stretch that ends at an instant is a turn at once: it takes less than 1e-5 of the time of the next one.
[[nodiscard]] inline bool turns_at_once(const VertexWay& way, std::size_t k) {
  constexpr double share_at_once = 1e-5;
  return k > 0 && k + 1 < way.instants.size() &&
         way.instants[k] - way.instants[k - 1] < share_at_once * (way.instants[k + 1] - way.instants[k]);
}

/// Into how many shorter steps a step among what turns is divided: they are equally long, and each begins with a turn
/// at once. The first one tells: after a crush the rest is not divided.
[[nodiscard]] inline int parts_of(std::span<const VertexWay> ways) {
  constexpr double absurd = 1e3;  // whoever says so is told by `mover_way`
  int most = 1;
  for (const VertexWay& way : ways)
    if (turns_at_once(way, 1))
      most = std::max(most, static_cast<int>(std::lround(std::min(absurd, 1 / way.instants[2]))));
  return most;
}

/// How far a collider takes what stands on it [m]. Where it turns at once and then goes straight, time and again, that
/// is the way of what goes straight: it turns under the foot.
[[nodiscard]] inline Vec2d carried_along(const VertexWay& way) {
  Vec2d carried = Vec2d::Zero();
  for (std::size_t k = 1; k < way.instants.size(); ++k)
    if (!turns_at_once(way, k)) carried += way.vertices[k][0] - way.vertices[k - 1][0];
  return carried;
}

}  // namespace paperproof::compare
