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

}  // namespace paperproof::box2d::test
