/// Nothing fast passes through a solid of the twin, of any thickness. tests/situations/box2d.json has one-way solids.
#include "levels.hpp"

#include <cmath>

namespace paperproof::box2d::test {
namespace {

/// Paper across the way at `angle`, 8 m long.
ColliderDef paper(double thickness, double angle) {
  const Vec2d along = 4 * towards(angle);
  const Vec2d half = Vec2d(-along.y(), along.x()) * (thickness / 8);
  if (thickness == 0) return chain({-along, along});
  return polygon({-along - half, along - half, along + half, half - along});
}

/// Shots at 100 m/s (1.67 m per step) at paper of any angle, from both sides, with the article's character.
TEST(Blocking, paper_of_any_thickness_stops_characters_at_100_metres_per_second) {
  for (const double thickness : {0.1, 0.02, 0.006, 0.005, 0.004, 0.001, 1e-4, 1e-6, 1e-9, 0.0}) {
    for (const SceneryMode mode : modes) {
      Random random(3);
      for (int i = 0; i < 200; ++i) {
        const double angle = random.angle();
        const Vec2d along = towards(angle);
        const Vec2d normal(-along.y(), along.x());
        const double height = random.between(1, 3);
        const Vec2d start = normal * height + along * random.between(-2, 2);
        ReferenceWorld world(level({paper(thickness, angle)}), {}, start, {.mode = mode});
        for (int k = 0; k < 20; ++k) {
          world.step(-100 * normal, frame);
          ASSERT_GE(world.position().dot(normal), 0) << thickness << " m, seed 3, shot " << i;
        }
      }
    }
  }
}

/// A solid whose parts are near Box2D's limits: blocks with teeth, steps, slivers and specks.
TEST(Blocking, small_features_on_a_floor_leave_no_hole_in_it) {
  Random random(4);
  for (int i = 0; i < 800; ++i) {
    std::vector<Vec2d> floor{{-6, -1}, {6, -1}, {6, 0}};
    for (double x = 6; x > -5.5;) {
      x -= random.between(1e-4, random.below(3) == 0 ? 1.0 : 0.01);
      floor.emplace_back(x, random.between(0, random.below(2) == 0 ? 0.004 : 0.1));
    }
    floor.emplace_back(-6, 0);
    Vec2d at{random.between(-4.5, 4.5), 0};
    at.y() = random.between(2, 3);
    ReferenceWorld world(level({polygon(floor), box(-1, 0.4, 1, 0.401), box(2, 0.3, 2.003, 0.303)}), {}, at);
    const Vec2d velocity{random.between(-20, 20), -random.between(5, 100)};
    for (int k = 0; k < 30 && std::abs(world.position().x()) <= 5; ++k) {
      world.step(velocity, frame);
      ASSERT_TRUE(world.position().y() > 0 || std::abs(world.position().x()) > 5) << "seed 4, " << i << ", step " << k;
    }
  }
}

}  // namespace
}  // namespace paperproof::box2d::test
