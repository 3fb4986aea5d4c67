/// One-way chains: from behind they are not there, from the front they hold.
#include "levels.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::test {
namespace {

const Vec2d gravity{0, -10};
const Vec2d up{0, 1};

/// A ledge at y = 0 that blocks from above, either way round, and ground far below.
Scenery<double> ledge(bool reversed) {
  std::vector<Vec2d> points{{-4, 0}, {0, 0}, {4, 0}};
  if (reversed) std::reverse(points.begin(), points.end());
  return level({box(-10, -11, 10, -10), chain(points, up)});
}

class OneWay : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(EitherDirectionOfTheChain, OneWay, testing::Bool());

TEST_P(OneWay, rising_from_below_passes_without_losing_speed) {
  ReferenceWorld world(ledge(GetParam()), {}, {0.3, -2});
  Vec2d velocity{1, 9};
  while (world.position().y() < 1) {
    const TwinStep& step = world.step(velocity, frame);
    ASSERT_EQ(step.velocity, velocity);
    ASSERT_TRUE(step.contacts.empty());
    ASSERT_FALSE(step.grounded);
  }
}

TEST_P(OneWay, falling_from_above_is_held_at_any_speed) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(0.1, 110);
    ReferenceWorld world(ledge(GetParam()), {}, {random.between(-3, 3), random.between(1, 3)});
    bool touched = false;
    run(world, {0, -speed}, gravity, 120, [&](const TwinStep& step) { touched = touched || !step.contacts.empty(); });
    EXPECT_TRUE(touched);
    EXPECT_NEAR(world.position().y(), half_height() + rest_gap, 0.006) << "seed 6, " << i;
  }
}

TEST_P(OneWay, who_jumps_up_through_it_lands_on_it) {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    // High enough for the feet to clear the ledge by 1 mm to 1 m: the lowest clear it inside of Box2D's skin.
    const double clearance = std::pow(10, random.between(-3, 0));
    const double rise = 2 * half_height() + 0.2 + clearance;
    // Semi-implicit Euler falls short of v²/2g by v·dt/2.
    const double speed = std::sqrt(2 * 10 * rise) + 10 * frame / 2;
    ReferenceWorld world(ledge(GetParam()), {}, {0, -half_height() - 0.2});
    Vec2d velocity{0, speed};
    double highest = world.position().y();
    for (int k = 0; k < 180; ++k) {
      velocity += gravity * frame;
      velocity = world.step(velocity, frame).velocity;
      highest = std::max(highest, world.position().y());
    }
    if (highest < half_height()) continue;  // Sampled below the top of the parabola: it must fall back.
    EXPECT_NEAR(world.position().y(), half_height() + rest_gap, 0.007)
        << "seed 8, " << i << ", clearance " << clearance;
  }
}

TEST_P(OneWay, who_does_not_clear_it_falls_back) {
  ReferenceWorld world(ledge(GetParam()), {}, {0, -2});
  // Rises 1.5 m: the feet stay half a metre and more below the ledge, the head goes through.
  run(world, {0, std::sqrt(2 * 10 * 1.5)}, gravity, 240);
  EXPECT_LT(world.position().y(), -8);
}

TEST_P(OneWay, walking_on_it_and_over_its_joint_keeps_the_speed) {
  ReferenceWorld world(ledge(GetParam()), {}, {-2, half_height() + rest_gap});
  run(world, {3, 0}, gravity, 60, [](const TwinStep& step) {
    ASSERT_TRUE(step.grounded);
    ASSERT_FLOAT_EQ(static_cast<float>(step.velocity.x()), 3.0F);
  });
  EXPECT_NEAR(world.position().x(), -2 + 3 * 60 * frame, 1e-4);
}

TEST_P(OneWay, walking_past_its_end_at_its_own_height_is_not_stopped) {
  ReferenceWorld world(ledge(GetParam()), {}, {-6, 0});
  for (int k = 0; k < 120; ++k) ASSERT_EQ(world.step({6, 0}, frame).velocity, Vec2d(6, 0));
}

TEST_P(OneWay, who_drops_goes_through_it_and_says_so) {
  ReferenceWorld world(ledge(GetParam()), {}, {0.3, half_height() + rest_gap});
  run(world, {0, 0}, gravity, 30);
  std::vector<ColliderIndex> passed;
  Vec2d velocity{0, 0};
  for (int k = 0; k < 60; ++k) {
    velocity += gravity * frame;
    const TwinStep& step = world.step(velocity, frame, {}, k < 8);
    velocity = step.velocity;
    passed.insert(passed.end(), step.dropped_through.begin(), step.dropped_through.end());
  }
  EXPECT_EQ(passed, std::vector<ColliderIndex>{1});
  EXPECT_NEAR(world.position().y(), half_height() + rest_gap - 10 * frame * frame * 60 * 61 / 2, 0.01);
}

/// A platform with its top at y = 0, and ground far below.
Scenery<double> slab() {
  ColliderDef solid = box(-4, -0.5, 4, 0);
  solid.one_way = up;
  return level({box(-10, -11, 10, -10), solid});
}

TEST(OneWaySolid, is_jumped_through_stood_on_and_dropped_through) {
  for (const SceneryMode mode : {SceneryMode::chain_loops, SceneryMode::pieces}) {
    ReferenceWorld world(slab(), {}, {0.3, -half_height() - 0.7}, {.mode = mode});
    Vec2d velocity{0, std::sqrt(2 * 10 * 3.0)};
    const auto step = [&](bool drop) -> const TwinStep& {
      velocity += gravity * frame;
      const TwinStep& done = world.step(velocity, frame, {}, drop);
      velocity = done.velocity;
      return done;
    };
    for (int k = 0; k < 180; ++k) {
      const bool rises = velocity.y() > 0.5;
      const TwinStep& done = step(false);
      if (rises) {
        ASSERT_TRUE(done.contacts.empty()) << k;
      }
    }
    EXPECT_NEAR(world.position().y(), half_height() + rest_gap, 0.007);
    EXPECT_EQ(step(false).contacts.at(0).collider, 1U);
    std::vector<ColliderIndex> passed;
    for (int k = 0; k < 180; ++k) {
      const TwinStep& done = step(k < 8);
      passed.insert(passed.end(), done.dropped_through.begin(), done.dropped_through.end());
    }
    EXPECT_EQ(passed, std::vector<ColliderIndex>{1});
    EXPECT_NEAR(world.position().y(), -10 + half_height() + rest_gap, 0.007) << "on the ground";
  }
}

TEST(OneWaySolid, is_passed_through_its_side) {
  ReferenceWorld world(slab(), {}, {-6, 0});
  for (int k = 0; k < 120; ++k) ASSERT_EQ(world.step({6, 0}, frame).velocity, Vec2d(6, 0));
}

TEST(OneWayDirections, a_segment_that_runs_along_one_way_blocks_nothing) {
  ReferenceWorld world(level({chain({{0, -4}, {0, 4}}, up)}), {}, {-2, 0});
  for (int k = 0; k < 60; ++k) world.step({10, 0}, frame);
  EXPECT_NEAR(world.position().x(), -2 + 10 * 60 * frame, 1e-4);
  EXPECT_EQ(world.size().fixtures, 0U);
}

TEST(OneWayDirections, a_wall_blocks_from_the_side_that_it_faces_only) {
  const Scenery<double> scenery = level({chain({{0, -4}, {0, 4}}, Vec2d(-1, 0.3))});
  ReferenceWorld from_left(scenery, {}, {-2, 0});
  ReferenceWorld from_right(scenery, {}, {2, 0});
  for (int k = 0; k < 60; ++k) {
    from_left.step({10, 0}, frame);
    from_right.step({-10, 0}, frame);
  }
  EXPECT_LT(from_left.position().x(), 0);
  EXPECT_NEAR(from_right.position().x(), 2 - 10 * 60 * frame, 1e-4);
}

}  // namespace
}  // namespace paperproof::box2d::test
