/// Planks that turn beside a character, for the tests of the judge.
#pragma once

#include "compare/judge_steps.hpp"

#include <Eigen/Geometry>

namespace paperproof::compare::test {

/// A plank beside a character, and how it goes in one step.
struct Beside {
  TraceHeader header;
  TraceStep step;

  [[nodiscard]] PathPoint start() const { return step.path.front(); }
  [[nodiscard]] const VertexWay& way() const { return step.vertex_ways.front(); }
};

inline Vec2d turned(const Vec2d& v, double angle) { return Eigen::Rotation2D<double>(angle) * v; }

/// Points that turn about their origin, which is somewhere.
inline std::vector<Vec2d> placed(const std::vector<Vec2d>& points, const Vec2d& at, double angle) {
  std::vector<Vec2d> all;
  for (const Vec2d& v : points) all.emplace_back(at + turned(v, angle));
  return all;
}

/// A turn that is even but for its chords, about an origin that goes straight.
inline VertexWay on_chords(const std::vector<Vec2d>& points, const Vec2d& at, const Vec2d& moved, double from,
                           double turn, int chords) {
  VertexWay way{.collider = 0, .instants = {}, .vertices = {}};
  for (int k = 0; k <= chords; ++k) {
    const double share = static_cast<double>(k) / chords;
    way.instants.push_back(share);
    way.vertices.push_back(placed(points, at + share * moved, from + share * turn));
  }
  return way;
}

/// Of a contender that is excused nothing.
/// @param at where the plank's own origin, about which it turns, is at first. @param moved how far that goes.
inline Beside beside(const std::vector<Vec2d>& plank, const Vec2d& position, double from, double turn, const Vec2d& at,
                     const Vec2d& moved) {
  Beside made{promising({polygon(plank, 0)}), test::step({position, position})};
  made.header.turning = {true};
  made.step.movers = {{at, at + moved}};
  made.step.vertex_ways = {on_chords(plank, at, moved, from, turn, 16)};
  return made;
}

/// Around the origin.
inline std::vector<Vec2d> plank(double half, double thin) { return box(-half, -thin, half, thin).points; }

}  // namespace paperproof::compare::test
