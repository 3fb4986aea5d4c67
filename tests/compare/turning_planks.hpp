/// Planks that turn beside a character, for the tests of the judge.
#pragma once

#include "compare/judge_steps.hpp"

#include <cmath>

namespace paperproof::compare::test {

/// A plank beside a character, and how it goes in one step.
struct Beside {
  TraceHeader header;
  TraceStep step;

  [[nodiscard]] PathPoint<double> start() const { return step.path.front(); }
  [[nodiscard]] const VertexWay& way() const { return step.vertex_ways.front(); }
};

inline Vec2d turned(const Vec2d& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

/// Of a contender that is excused nothing.
/// @param at where the plank's own origin, about which it turns, is at first. @param moved how far that goes.
/// @param chords of the way: a turn that is even but for the chords.
inline Beside beside(const std::vector<Vec2d>& plank, const Vec2d& position, double from, double turn, const Vec2d& at,
                     const Vec2d& moved, int chords = 16) {
  ColliderDef def = polygon(plank);
  def.mover = 0;
  Beside made{promising({def}), test::step({position, position})};
  made.header.turning = {true};
  made.step.movers = {{at, at + moved}};
  VertexWay way{.collider = 0, .instants = {}, .vertices = {}};
  for (int k = 0; k <= chords; ++k) {
    const double share = static_cast<double>(k) / chords;
    way.instants.push_back(share);
    way.vertices.emplace_back();
    for (const Vec2d& v : plank) way.vertices.back().emplace_back(at + share * moved + turned(v, from + share * turn));
  }
  made.step.vertex_ways = {way};
  return made;
}

/// Around the origin.
inline std::vector<Vec2d> plank(double half, double thin) {
  return {{-half, -thin}, {half, -thin}, {half, thin}, {-half, thin}};
}

}  // namespace paperproof::compare::test
