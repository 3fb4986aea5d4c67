/// Nothing fast gets through what the twin was given, whatever its thickness. What is one-way is not there from behind,
/// and holds from the front.
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

const Vec2d up{0, 1};

ColliderDef one_way(ColliderDef def, const Vec2d& front) {
  def.one_way = front;
  return def;
}

/// What blocks from above at y = 0, and ground far below.
struct Ledge {
  const char* name;
  ColliderDef ledge;
  SceneryMode mode;
  [[nodiscard]] ReferenceWorld world(const Vec2d& start) const {
    return {level({box(-10, -11, 10, -10), one_way(ledge, up)}), {}, start, {.mode = mode}};
  }
};

class OneWay : public testing::TestWithParam<Ledge> {};
INSTANTIATE_TEST_SUITE_P(Ledges, OneWay,
                         testing::Values(Ledge{"chain", chain({{-4, 0}, {0, 0}, {4, 0}}), SceneryMode::chain_loops},
                                         Ledge{"back", chain({{4, 0}, {0, 0}, {-4, 0}}), SceneryMode::chain_loops},
                                         Ledge{"solid", box(-4, -0.5, 4, 0), SceneryMode::chain_loops},
                                         Ledge{"piece", box(-4, -0.5, 4, 0), SceneryMode::pieces}),
                         [](const auto& ledge) { return std::string(ledge.param.name); });

TEST_P(OneWay, falling_from_above_is_held_at_any_speed) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(0.1, 110);
    const double x = random.between(-3, 3);
    ReferenceWorld world = GetParam().world({x, random.between(1, 3)});
    run(world, {0, -speed}, 120, [](const TwinStep&) {});
    EXPECT_NEAR(world.position().y(), half_height + rest_gap, 0.006) << "seed 6, " << i;
  }
}

TEST_P(OneWay, who_jumps_up_through_it_lands_on_it_and_drops_through_it_and_says_so) {
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    // High enough for the feet to clear the ledge by 1 mm to 1 m: the lowest clear it inside of Box2D's skin.
    const double rise = 2 * half_height + 0.7 + random.log_between(1e-3, 1);
    ReferenceWorld world = GetParam().world({0, -half_height - 0.7});
    double highest = 0;
    // Semi-implicit Euler falls short of v²/2g by v·dt/2.
    run(world, {0, std::sqrt(2 * 10 * rise) + 10 * frame / 2}, 180,
        [&](const TwinStep&) { highest = std::max(highest, world.position().y()); });
    EXPECT_GE(highest, rise - half_height - 0.7 - 1e-3) << "the ledge slowed its rise";
    if (highest < half_height) continue;  // Sampled below the top of the parabola: it must fall back.
    ASSERT_NEAR(world.position().y(), half_height + rest_gap, 0.007) << "seed 8, " << i << ", rise " << rise;
    if (i > 5) continue;
    std::vector<ColliderIndex> passed;
    Vec2d velocity{0, 0};
    for (int k = 0; k < 60; ++k) {
      const TwinStep& step = world.step(velocity + gravity * frame, frame, {}, k < 8);
      velocity = step.velocity;
      passed.insert(passed.end(), step.dropped_through.begin(), step.dropped_through.end());
    }
    EXPECT_EQ(passed, std::vector<ColliderIndex>{1});
    EXPECT_NEAR(world.position().y(), half_height + rest_gap - 10 * frame * frame * 60 * 61 / 2, 0.02);
  }
}

}  // namespace
}  // namespace paperproof::box2d::test
