/// Several characters in one world.
#include "levels.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d {
namespace {

using namespace test;

constexpr double width = 0.625;  // of the article's character

ReferenceWorld world_of(const std::vector<Vec2d>& positions) {
  return ReferenceWorld(level({box(-20, -1, 20, 0)}), CharacterDef{}, positions);
}

TEST(Characters, two_bullets_do_not_pass_each_other_and_both_name_the_other) {
  // 110 m/s is below the travel cap: 1.83 m in a step, and half of the 3.375 m between them is less.
  ReferenceWorld world = world_of({{-2, 5}, {2, 5}});
  const std::vector<TwinWish> wishes{{.velocity = {110, 0}}, {.velocity = {-110, 0}}};
  const std::span<const TwinStep> steps = world.step_all(wishes, frame);
  EXPECT_GE(world.position(1).x() - world.position(0).x(), width);
  ASSERT_EQ(steps[0].met.size(), 1U);
  ASSERT_EQ(steps[1].met.size(), 1U);
  EXPECT_EQ(steps[0].met[0].other, 1U);
  EXPECT_EQ(steps[1].met[0].other, 0U);
  EXPECT_EQ(steps[0].met[0].side, Side::right);
  EXPECT_EQ(steps[1].met[0].side, Side::left);
  EXPECT_EQ(steps[0].met[0].normal, -steps[1].met[0].normal);
  const double fraction = (4 - width) / (220 * frame);
  for (const TwinStep& step : steps) EXPECT_NEAR(step.met[0].fraction, fraction, touch_gap / (220 * frame));
  EXPECT_TRUE(steps[0].contacts.empty());
}

TEST(Characters, who_stands_on_another_is_grounded_and_nothing_carries_it) {
  ReferenceWorld world = world_of({{0, half_height() + rest_gap}, {0, 3 * half_height() + 2 * rest_gap}});
  const std::vector<TwinWish> fall(2, TwinWish{.velocity = {0, -0.5}});
  for (int i = 0; i < 60; ++i) world.step_all(fall, frame);
  const std::span<const TwinStep> steps = world.step_all(fall, frame);
  EXPECT_TRUE(steps[0].grounded);
  EXPECT_TRUE(steps[1].grounded);
  EXPECT_FALSE(steps[1].ground);
  EXPECT_TRUE(steps[1].contacts.empty());
  ASSERT_EQ(steps[1].met.size(), 1U);
  EXPECT_EQ(steps[1].met[0].side, Side::bottom);
  EXPECT_NEAR(world.position(1).y(), 3 * half_height() + 2 * rest_gap, 0.006);
}

TEST(Characters, of_the_same_mass_share_the_speed_that_one_has) {
  ReferenceWorld world = world_of({{0, 5}, {width + 0.05, 5}});
  std::vector<TwinWish> wishes{{.velocity = {6, 0}}, {}};
  for (int i = 0; i < 4; ++i) {
    const std::span<const TwinStep> steps = world.step_all(wishes, frame);
    for (std::size_t k = 0; k < 2; ++k) wishes[k].velocity = steps[k].velocity;
  }
  EXPECT_NEAR(wishes[0].velocity.x(), 3, 1e-4);
  EXPECT_NEAR(wishes[1].velocity.x(), 3, 1e-4);
}

TEST(Characters, one_alone_moves_as_in_a_world_of_its_own_bit_for_bit) {
  ReferenceWorld two = world_of({{0, 3}, {9, 3}});
  ReferenceWorld alone = world_of({{0, 3}});
  Vec2d velocity(3, 0);
  for (int i = 0; i < 120; ++i) {
    velocity += Vec2d(0, -10) * frame;
    const std::vector<TwinWish> wishes{{.velocity = velocity}, {}};
    const TwinStep one = two.step_all(wishes, frame)[0];
    velocity = alone.step(velocity, frame).velocity;
    ASSERT_EQ(one.velocity, velocity) << i;
    ASSERT_EQ(two.position(0), alone.position()) << i;
    ASSERT_EQ(one.met.size(), 0U) << i;
  }
}

TEST(Characters, another_number_of_velocities_is_refused) {
  ReferenceWorld world = world_of({{0, 3}, {9, 3}});
  EXPECT_THROW(world.step({1, 0}, frame), InvalidDefinition);
  world.place({5, 5}, {0, 0}, 1);
  EXPECT_EQ(world.position(1), Vec2d(5, 5));
  EXPECT_EQ(world.position(0), Vec2d(0, 3));
}

}  // namespace
}  // namespace paperproof::box2d
