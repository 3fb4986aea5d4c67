/// What is one-way: from behind it is not there, from the front it holds.
#include "levels.hpp"

#include <cmath>

namespace paperproof::box2d::test {
namespace {

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

TEST_P(OneWay, rising_from_below_and_passing_its_side_lose_no_speed) {
  ReferenceWorld below = GetParam().world({0.3, -2});
  while (below.position().y() < 1) {
    const TwinStep& step = below.step({1, 9}, frame);
    ASSERT_EQ(step.velocity, Vec2d(1, 9));
    ASSERT_TRUE(step.contacts.empty());
    ASSERT_FALSE(step.grounded);
  }
  ReferenceWorld beside = GetParam().world({-6, 0});
  for (int k = 0; k < 120; ++k) ASSERT_EQ(beside.step({6, 0}, frame).velocity, Vec2d(6, 0));
}

TEST_P(OneWay, falling_from_above_is_held_at_any_speed) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(0.1, 110);
    const double x = random.between(-3, 3);
    ReferenceWorld world = GetParam().world({x, random.between(1, 3)});
    run(world, {0, -speed}, 120);
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

TEST(OneWayDirections, a_wall_blocks_from_the_side_that_it_faces_only_and_along_it_nothing_blocks) {
  struct Case {
    Vec2d front;
    double start;
    bool blocks;
  };
  for (const Case& one : {Case{{-1, 0.3}, -2, true}, {{-1, 0.3}, 2, false}, {up, -2, false}}) {
    ReferenceWorld world(level({one_way(chain({{0, -4}, {0, 4}}), one.front)}), {}, {one.start, 0});
    for (int k = 0; k < 60; ++k) world.step({-5 * one.start, 0}, frame);
    if (one.blocks)
      EXPECT_LT(world.position().x(), 0);
    else
      EXPECT_NEAR(world.position().x(), -4 * one.start, 1e-4);
    EXPECT_EQ(world.size().fixtures == 0, one.front == up);
  }
}

}  // namespace
}  // namespace paperproof::box2d::test
