#include "step/certificate.hpp"

#include "geometry/exact.hpp"
#include "step/narrow_phase.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {
namespace {

/// Of a sum that is not rounded.
using Terms = FixedVector<Vec2d, geometry::most_terms>;

/// A position as a piece sees it that has not moved: six terms at most, so that there is room for two more.
Terms exact_position(const ConfigurationSpace& space, PieceIndex piece, std::span<const MoverMotion> movers,
                     const Vec2& in_world, Real time) {
  Terms position;
  const auto add = [&](const Vec2d& term) {
    position.push_back({geometry::without_traces(term.x()), geometry::without_traces(term.y())});
  };
  add(in_world.cast<double>());
  const MoverIndex mover = space.info(piece).source.mover;
  if (mover == no_mover) return position;
  const MoverMotion& motion = movers[mover];
  add(time < 1 ? -motion.from : -motion.to);
  if (time > 0 && time < 1)
    for (const Vec2d& part : geometry::part_of_way(motion.from, motion.to, static_cast<double>(time))) add(-part);
  return position;
}

/// The terms of a sum with a position, or without it where the sign is -1.
template <std::size_t capacity = geometry::most_terms>
FixedVector<Vec2d, capacity> sum_of(std::span<const Vec2d> first, const Terms& p, double sign = 1) {
  FixedVector<Vec2d, capacity> terms;
  for (const Vec2d& term : first) terms.push_back(term);
  for (const Vec2d& term : p) terms.push_back(term * sign);
  return terms;
}

/// The octagon beside a circle.
class BesideCircle {
 public:
  BesideCircle(const ConfigurationSpace& space, PieceIndex piece)
      : circle_(space.circle(piece)), octagon_(space.hull()) {}

  /// Whether a motion is proved to be clear. The distance is convex in time: a motion that does not come nearer from
  /// one end is clear if that end is. Else an edge, or a tangent of the circle that is nearest at one of the ends,
  /// separates them at both.
  [[nodiscard]] bool are_clear(const Terms& from, const Terms& to) const {
    for (std::size_t k = 0; k < octagon_.size(); ++k)
      if ((is_edge_apart(k, from) && is_edge_apart(k, to)) || goes_away(k, from, to) || goes_away(k, to, from))
        return true;
    for (const Vec2d& normal : {near(from).normal, near(to).normal})
      if (is_tangent_apart(normal, from) && is_tangent_apart(normal, to)) return true;
    return false;
  }

 private:
  [[nodiscard]] const Vec2d& corner(std::size_t k) const { return octagon_[k % octagon_.size()]; }
  [[nodiscard]] geometry::NearCircle near(const Terms& p) const {
    Vec2d rounded = Vec2d::Zero();
    for (const Vec2d& term : p) rounded += term;
    return geometry::near_circle(octagon_, rounded, circle_);
  }
  /// From the circle's centre to a corner of the octagon.
  [[nodiscard]] Terms arm_to(const Vec2d& o, const Terms& p) const {
    return sum_of(std::array{o, Vec2d(-circle_.centre)}, p);
  }
  [[nodiscard]] bool is_edge_apart(std::size_t k, const Terms& p) const {
    const Terms back = sum_of(std::array{circle_.centre, Vec2d(-corner(k))}, p, -1);  // from the corner to the centre
    return geometry::is_sum_as_far_right(corner(k), corner(k + 1), back, circle_.radius);
  }
  /// Whether a corner is the nearest place of the octagon, and is outside of the circle or on it.
  [[nodiscard]] bool is_corner_apart(std::size_t k, const Terms& p) const {
    const Terms arm = arm_to(corner(k), p);
    const std::array after{corner(k + 1), Vec2d(-corner(k))};
    const std::array before{corner(k), Vec2d(-corner(k + octagon_.size() - 1))};
    return geometry::dot_sign_of_sums(arm, after) >= 0 && geometry::dot_sign_of_sums(arm, before) <= 0 &&
           geometry::is_sum_as_long_as(arm, circle_.radius);
  }
  /// Whether a motion begins clear with a corner that is nearest, and this does not come nearer.
  [[nodiscard]] bool goes_away(std::size_t k, const Terms& from, const Terms& to) const {
    return is_corner_apart(k, from) &&
           geometry::dot_sign_of_sums(arm_to(corner(k), from), sum_of<2 * geometry::most_terms>(to, from, -1)) >= 0;
  }
  [[nodiscard]] bool is_tangent_apart(const Vec2d& normal, const Terms& p) const {
    const double length = geometry::length_rounded_up(normal);
    return std::ranges::all_of(octagon_, [&](const Vec2d& o) {
      return geometry::height_sign_of_sum(normal, arm_to(o, p), circle_.radius, length) >= 0;
    });
  }

  Circle circle_;
  std::span<const Vec2d> octagon_;
};

/// Whether the line of an edge has all points on its right or on it, moved by `from`, and by `to`. The ring is
/// counter-clockwise: its outside is on the right.
/// @param sign -1: the edges are moved, and not the points.
bool some_edge_separates(std::span<const Vec2d> ring, std::span<const Vec2d> points, const Terms& from, const Terms& to,
                         double sign) {
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const auto all_right = [&](const Terms& p) {
      return std::ranges::all_of(points, [&](const Vec2d& point) {
        const Terms terms = sum_of({&point, 1}, p, sign);
        return geometry::orientation_sign_of_sum(ring[j], ring[(j + 1) % ring.size()], terms) <= 0;
      });
    };
    if (all_right(from) && all_right(to)) return true;
  }
  return false;
}

}  // namespace

bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece, std::span<const MoverMotion> movers,
                      const Vec2& position, Real time) {
  const MoverIndex mover = space.info(piece).source.mover;
  const Vec2 seen = mover == no_mover ? position : Vec2(position - Vec2(movers[mover].at(time)));
  const Real separation = best_axis(space, piece, seen).separation;
  if (std::abs(separation) >= tolerances.certain) return separation < 0;
  return !clear_of_exactly(space, piece, movers, position, time, position, time);
}

/// The separating axis theorem with signs of exact determinants.
bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece, std::span<const MoverMotion> movers,
                      const Vec2& from, Real begin, const Vec2& to, Real end) {
  const Terms p = exact_position(space, piece, movers, from, begin);
  const Terms q = exact_position(space, piece, movers, to, end);
  if (space.is_circle(piece)) return BesideCircle(space, piece).are_clear(p, q);
  const PieceVertices vertices = space.vertices_of(piece);
  return some_edge_separates(vertices, space.hull(), p, q, 1) || some_edge_separates(space.hull(), vertices, p, q, -1);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
