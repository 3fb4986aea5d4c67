/// Small levels, and what the tests of the Box2D twin ask of them.
#pragma once

#include "box2d_adapter/worlds.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <optional>
#include <vector>

namespace paperproof::box2d::test {

inline ColliderDef polygon(std::vector<Vec2d> points, std::vector<std::vector<Vec2d>> holes = {}) {
  return {.shape = ColliderDef::Shape::polygon, .points = std::move(points), .holes = std::move(holes)};
}
inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}
inline std::vector<Vec2d> rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}
inline ColliderDef box(double left, double bottom, double right, double top) {
  return polygon(rectangle(left, bottom, right, top));
}
inline Scenery<double> level(std::vector<ColliderDef> colliders) {
  return Scenery<double>(SceneryDef{std::move(colliders)});
}

/// Steps `world` under gravity, the horizontal velocity kept, until `steps` are done; the velocity that was left
/// carries over as in a run.
template <class EachStep>
void run(ReferenceWorld& world, Vec2d velocity, const Vec2d& gravity, int steps, const EachStep& each_step) {
  for (int i = 0; i < steps; ++i) {
    velocity += gravity * frame;
    const TwinStep& step = world.step(velocity, frame);
    velocity = step.velocity;
    each_step(step);
  }
}
inline void run(ReferenceWorld& world, const Vec2d& velocity, const Vec2d& gravity, int steps) {
  run(world, velocity, gravity, steps, [](const TwinStep&) {});
}

}  // namespace paperproof::box2d::test
