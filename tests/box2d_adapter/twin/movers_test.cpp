/// What moves in the twin's world: kinematic bodies that go by velocity, sensors, other characters.
#include "levels.hpp"

#include <cmath>

namespace paperproof::box2d::test {
namespace {

/// At constant speed, in one step after the other.
std::vector<MoverMotion<double>> steady(const Vec2d& velocity, int step) {
  return {{velocity * (step * frame), velocity * ((step + 1) * frame)}};
}

TEST(TwinMovers, are_where_their_motion_ends_however_long_they_move) {
  ReferenceWorld world(level({box(-9, -9, 9, -8), box(0, 0, 1, 1, 0)}), {}, {20, 20});
  const auto at = [](int step) { return Vec2d(std::sin(step * 0.01), 100 + std::cos(step * 0.013)); };
  Vec2d before = Vec2d::Zero();
  for (int step = 0; step < 10000; ++step) {
    const std::vector<MoverMotion<double>> motion{{at(step), at(step + 1)}};
    const TwinStep& twin = world.step({0, 0}, frame, motion);
    ASSERT_EQ(twin.movers.size(), 1U);
    ASSERT_TRUE(step == 0 || twin.movers[0].from == before) << step;
    // A float near 100 has steps of 7.6e-6; from, velocity and sum are rounded once each.
    ASSERT_LE((twin.movers[0].to - motion[0].to).norm(), 3e-5) << step;
    before = twin.movers[0].to;
  }
}

TEST(TwinMovers, push_a_resting_character_and_name_the_collider_that_does) {
  // Three boxes of one mover, one outline: the middle one is at the character's height.
  const Scenery<double> scenery = level({box(0, 5, 1, 9, 0), box(0, -1, 1, 5, 0), box(0, -3, 1, -1, 0)});
  for (const SceneryMode mode : modes) {
    ReferenceWorld world(scenery, {}, {10, 2}, {.mode = mode});
    Vec2d velocity = Vec2d::Zero();
    std::size_t contacts = 0;
    for (int step = 0; step < 240; ++step) {
      const TwinStep& twin = world.step(velocity, frame, steady({5, 0}, step));
      velocity = twin.velocity;
      contacts += twin.contacts.size();
      for (const Contact<double>& contact : twin.contacts) {
        EXPECT_EQ(contact.collider, 1U);
        EXPECT_EQ(contact.side, Side::left);
      }
      EXPECT_GE(world.position().x() - half_width, 1 + twin.movers[0].to.x()) << "pushed, never passed";
    }
    EXPECT_GT(contacts, 0U);
    EXPECT_NEAR(velocity.x(), 5, 1e-4);
    EXPECT_NEAR(world.position().x(), 1 + 5.0 * 240 * frame + half_width, touch_gap);
  }
}

TEST(TwinMovers, begin_anew_where_the_story_does) {
  ReferenceWorld world(level({box(-5, -1, 5, 0), box(-3, 0, -2, 2, 0)}), {}, {0, 1});
  std::vector<Vec2d> places;
  for (int round = 0; round < 2; ++round) {
    world.place({0, 1}, {0, 0});
    for (int step = 0; step < 120; ++step) {
      const TwinStep& twin = world.step({0, -1}, frame, steady({2, 0}, step));
      places.push_back(world.position());
      EXPECT_TRUE(step > 0 || twin.movers[0].from == Vec2d(0, 0)) << round;
    }
  }
  EXPECT_TRUE(std::equal(places.begin(), places.begin() + 120, places.begin() + 120));
}

TEST(TwinMovers, are_refused_where_they_are_not_one_for_each_or_not_finite_and_flagged_beyond_the_cap) {
  ReferenceWorld world(level({box(0, 0, 1, 1, 0)}), {}, {50, 50});
  const std::vector<MoverMotion<double>> nan{{{0, 0}, {0, std::nan("")}}};
  for (const auto& bad : {std::vector<MoverMotion<double>>(0), std::vector<MoverMotion<double>>(2), nan})
    EXPECT_THROW((void)world.step({0, 0}, frame, bad), InvalidDefinition);
  EXPECT_EQ(world.position(), Vec2d(50, 50));
  const double cap_speed = max_travel_per_step / frame;
  EXPECT_FALSE(world.step({0, 0}, frame, steady({0.99 * cap_speed, 0}, 0)).capped);
  EXPECT_TRUE(world.step({0, 0}, frame, steady({1.01 * cap_speed, 0}, 1)).capped);
  const std::vector<MoverMotion<double>> still(1);
  const TwinWish rest{};
  const auto turned = [&](const std::vector<MoverTurn>& turns) {
    return world.step_all(std::span(&rest, 1), frame, still, turns).front().capped;
  };
  EXPECT_FALSE(turned({{0, 1.5}}));
  EXPECT_TRUE(turned({{0, 1.6}})) << "a quarter of a circle";
  EXPECT_THROW(turned(std::vector<MoverTurn>(2)), InvalidDefinition);
}

ReferenceWorld characters_at(const std::vector<Vec2d>& positions) {
  return {level({box(-20, -1, 20, 0)}), CharacterDef{}, positions};
}

TEST(Characters, two_bullets_do_not_pass_each_other_and_both_name_the_other) {
  // 110 m/s is below the travel cap: 1.83 m in a step, and half of the 3.375 m between them is less.
  ReferenceWorld world = characters_at({{-2, 5}, {2, 5}});
  const std::vector<TwinWish> wishes{{.velocity = {110, 0}}, {.velocity = {-110, 0}}};
  const std::span<const TwinStep> steps = world.step_all(wishes, frame);
  EXPECT_GE(world.position(1).x() - world.position(0).x(), 2 * half_width);
  for (const std::size_t k : {0U, 1U}) {
    ASSERT_EQ(steps[k].met.size(), 1U);
    EXPECT_EQ(steps[k].met[0].other, 1 - k);
    EXPECT_EQ(steps[k].met[0].side, k == 0 ? Side::right : Side::left);
    EXPECT_NEAR(steps[k].met[0].fraction, (4 - 2 * half_width) / (220 * frame), touch_gap / (220 * frame));
    EXPECT_TRUE(steps[k].contacts.empty());
  }
  EXPECT_EQ(steps[0].met[0].normal, -steps[1].met[0].normal);
}

TEST(Characters, another_number_of_velocities_is_refused_and_one_is_placed) {
  ReferenceWorld world = characters_at({{0, 3}, {9, 3}});
  EXPECT_THROW(world.step({1, 0}, frame), InvalidDefinition);
  world.place({5, 5}, {0, 0}, 1);
  EXPECT_EQ(world.position(1), Vec2d(5, 5));
  EXPECT_EQ(world.position(0), Vec2d(0, 3));
}

}  // namespace
}  // namespace paperproof::box2d::test
