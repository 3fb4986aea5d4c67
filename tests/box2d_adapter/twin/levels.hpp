/// Small levels, and what the tests of the Box2D twin ask of them.
#pragma once

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace paperproof::box2d::test {

using namespace compare;

inline constexpr double frame = 1.0 / 60;
inline constexpr std::array modes{SceneryMode::chain_loops, SceneryMode::pieces};
inline const Vec2d gravity{0, -10};

inline ColliderDef with_hole(ColliderDef solid, const ColliderDef& hole) {
  solid.holes.push_back(hole.points);
  return solid;
}
inline Scenery level(std::vector<ColliderDef> colliders) { return Scenery(SceneryDef{std::move(colliders)}); }

/// Steps `world` under gravity until `steps` are done; the velocity that was left carries over as in a run.
template <class EachStep>
void run(ReferenceWorld& world, Vec2d velocity, int steps, const EachStep& each_step) {
  for (int i = 0; i < steps; ++i) {
    const TwinStep& step = world.step(velocity + gravity * frame, frame);
    velocity = step.velocity;
    each_step(step);
  }
}

}  // namespace paperproof::box2d::test
