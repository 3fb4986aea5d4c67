/// What moves in the twin's world: kinematic bodies that go by velocity, sensors, ground that carries.
#include "float_geometry.hpp"
#include "levels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::box2d::test {
namespace {

const Vec2d gravity{0, -10};

ColliderDef moving(ColliderDef collider, MoverIndex mover = 0) {
  collider.mover = mover;
  return collider;
}

ColliderDef sensor(ColliderDef collider) {
  collider.sensor = true;
  return collider;
}

/// From one place to another, step by step, at constant speed.
std::vector<MoverMotion<double>> steady(const Vec2d& start, const Vec2d& velocity, int step) {
  return {{start + velocity * (step * frame), start + velocity * ((step + 1) * frame)}};
}

constexpr double half_width = 10.0 / 32;  // of the article's character at 32 pixels per metre

TEST(TwinMovers, are_where_their_motion_ends_however_long_they_move) {
  ReferenceWorld world(level({box(-9, -9, 9, -8), moving(box(0, 0, 1, 1))}), {}, {20, 20});
  const auto at = [](int step) { return Vec2d(std::sin(step * 0.01), 100 + std::cos(step * 0.013)); };
  MoverMotion<double> before{at(0), at(0)};
  for (int step = 0; step < 10000; ++step) {
    const std::vector<MoverMotion<double>> motion{{at(step), at(step + 1)}};
    const TwinStep& twin = world.step({0, 0}, frame, motion);
    ASSERT_EQ(twin.movers.size(), 1U);
    if (step > 0) {
      EXPECT_EQ(twin.movers[0].from, before.to) << step;
    }
    // A float near 100 has steps of 7.6e-6; from, velocity and sum are rounded once each.
    EXPECT_LE((twin.movers[0].to - motion[0].to).norm(), 3e-5) << step;
    before = twin.movers[0];
  }
}

TEST(TwinMovers, carry_a_character_up_without_a_step_off_the_ground) {
  ReferenceWorld world(level({moving(box(-5, -1, 5, 0))}), {}, {0, half_height() + rest_gap});
  Vec2d velocity = Vec2d::Zero();
  for (int step = 0; step < 300; ++step) {
    velocity += gravity * frame;
    const TwinStep& twin = world.step(velocity, frame, steady({0, 0}, {0, 2}, step));
    velocity = twin.velocity;
    if (step < 2) continue;  // Box2D touches one step late
    EXPECT_TRUE(twin.grounded) << step;
    ASSERT_TRUE(twin.ground.has_value()) << step;
    EXPECT_EQ(twin.ground->collider, 0U);
    EXPECT_NEAR(twin.ground->normal.y(), 1, 1e-6);
    const double gap = world.position().y() - half_height() - twin.movers[0].to.y();
    EXPECT_GE(gap, 0.005) << step;
    EXPECT_LE(gap, touch_gap + 0.005) << step;
  }
  EXPECT_NEAR(velocity.y(), 2, 1e-4);
}

TEST(TwinMovers, push_a_resting_character_and_name_the_collider_that_does) {
  // Three boxes of one mover, one outline: the middle one is at the character's height.
  const Scenery<double> scenery = level({moving(box(0, 5, 1, 9)), moving(box(0, -1, 1, 5)), moving(box(0, -3, 1, -1))});
  for (const SceneryMode mode : {SceneryMode::chain_loops, SceneryMode::pieces}) {
    ReferenceWorld world(scenery, {}, {10, 2}, {.mode = mode});
    Vec2d velocity = Vec2d::Zero();
    int contacts = 0;
    for (int step = 0; step < 240; ++step) {
      const TwinStep& twin = world.step(velocity, frame, steady({0, 0}, {5, 0}, step));
      velocity = twin.velocity;
      for (const Contact<double>& contact : twin.contacts) {
        ++contacts;
        EXPECT_EQ(contact.collider, 1U);
        EXPECT_EQ(contact.side, Side::left);
      }
      EXPECT_GE(world.position().x() - half_width, 1 + twin.movers[0].to.x()) << "pushed, never passed";
    }
    // The wall's face, at 1, meets the character's left side, at 10 - half_width, at 5 m/s.
    EXPECT_GT(contacts, 0);
    EXPECT_NEAR(velocity.x(), 5, 1e-4);
    EXPECT_NEAR(world.position().x(), 1 + 5.0 * 240 * frame + half_width, touch_gap);
  }
}

TEST(TwinMovers, that_move_away_with_the_character_are_no_contact) {
  ReferenceWorld world(level({moving(box(-5, -1, 5, 0))}), {}, {0, half_height() + rest_gap});
  for (int step = 0; step < 60; ++step) {
    const TwinStep& twin = world.step({0, -3}, frame, steady({0, 0}, {0, -3}, step));
    EXPECT_TRUE(twin.contacts.empty()) << step;
  }
}

TEST(TwinMovers, faster_than_the_cap_are_flagged) {
  ReferenceWorld world(level({moving(box(0, 0, 1, 1))}), {}, {50, 50});
  const double cap_speed = max_travel_per_step / frame;
  EXPECT_FALSE(world.step({0, 0}, frame, steady({0, 0}, {0.99 * cap_speed, 0}, 0)).capped);
  EXPECT_TRUE(world.step({0, 0}, frame, steady({0, 0}, {1.01 * cap_speed, 0}, 1)).capped);
}

TEST(TwinMovers, begin_anew_where_the_story_does) {
  const Scenery<double> scenery = level({box(-5, -1, 5, 0), moving(box(-3, 0, -2, 2))});
  ReferenceWorld world(scenery, {}, {0, 1});
  std::vector<Vec2d> first;
  for (int round = 0; round < 2; ++round) {
    world.place({0, 1}, {0, 0});
    for (int step = 0; step < 120; ++step) {
      const TwinStep& twin = world.step({0, -1}, frame, steady({0, 0}, {2, 0}, step));
      if (round == 0) first.push_back(twin.path.back().position);
      EXPECT_EQ(twin.path.back().position, first[static_cast<std::size_t>(step)]) << round << ", " << step;
      EXPECT_TRUE(step > 0 || twin.movers[0].from == Vec2d(0, 0)) << round;
    }
  }
}

TEST(TwinMovers, let_through_from_below_what_lands_on_their_one_way_chain) {
  // 8 t - 5 t² = 2 + t: the feet pass the platform after 0.4 s and land on it after 1 s.
  ReferenceWorld world(level({moving(chain({{-5, 2}, {5, 2}}, Vec2d{0, 1}))}), {}, {0, half_height()});
  Vec2d velocity{0, 8};
  double highest = 0;
  for (int step = 0; step < 240; ++step) {
    velocity += gravity * frame;
    const TwinStep& twin = world.step(velocity, frame, steady({0, 0}, {0, 1}, step));
    velocity = twin.velocity;
    highest = std::max(highest, world.position().y() - half_height());
  }
  EXPECT_NEAR(highest - 0, 2 + 240 * frame, 0.03) << "it ends as high as it ever was, on the platform";
  EXPECT_NEAR(world.position().y() - half_height(), 2 + 240 * frame, 0.03);
}

TEST(TwinMovers, are_refused_where_they_are_not_one_for_each_or_not_finite) {
  ReferenceWorld world(level({moving(box(0, 0, 1, 1))}), {}, {5, 5});
  EXPECT_THROW((void)world.step({0, 0}, frame), InvalidDefinition);
  EXPECT_THROW((void)world.step({0, 0}, frame, std::vector<MoverMotion<double>>(2)), InvalidDefinition);
  const std::vector<MoverMotion<double>> nan{{{0, 0}, {0, std::nan("")}}};
  EXPECT_THROW((void)world.step({1, 0}, frame, nan), InvalidDefinition);
  EXPECT_EQ(world.position(), Vec2d(5, 5));
}

TEST(TwinSensors, are_entered_and_left_once_piece_or_chain_standing_or_moving) {
  // An L of two pieces, and a line that comes to meet the character.
  const ColliderDef corner = polygon({{2, -2}, {6, -2}, {6, 0}, {4, 0}, {4, 2}, {2, 2}});
  ReferenceWorld world(level({sensor(corner), sensor(moving(chain({{12, -3}, {12, 3}})))}), {}, {0, 0});
  struct Seen {
    ColliderIndex sensor;
    bool enters;
    double x;
  };
  std::vector<Seen> seen;
  for (int step = 0; step < 240; ++step) {
    const TwinStep& twin = world.step({3, 0}, frame, steady({0, 0}, {-1, 0}, step));
    EXPECT_TRUE(twin.contacts.empty());
    for (const SensorEvent<double>& event : twin.sensors)
      seen.push_back({event.sensor, event.change == SensorEvent<double>::Change::enter, world.position().x()});
  }
  ASSERT_EQ(seen.size(), 4U);
  // Seen when the step after the touch begins: a step's way (and that of what moves) later at the most, 20 mm earlier.
  const double late = 2 * 4 * frame;
  EXPECT_TRUE(seen[0].sensor == 0 && seen[0].enters);
  EXPECT_NEAR(seen[0].x, 2 - half_width, late);
  EXPECT_TRUE(seen[1].sensor == 0 && !seen[1].enters);
  EXPECT_NEAR(seen[1].x, 6 + half_width, late);
  // 3 t + half_width = 12 - t: they meet when t is a quarter of the way that is between them.
  EXPECT_TRUE(seen[2].sensor == 1 && seen[2].enters);
  EXPECT_NEAR(seen[2].x, 3 * (12 - half_width) / 4, late);
  EXPECT_TRUE(seen[3].sensor == 1 && !seen[3].enters);
  EXPECT_NEAR(seen[3].x, 3 * (12 + half_width) / 4, late);
}

TEST(TwinSensors, are_not_seen_where_they_are_crossed_within_a_step) {
  ReferenceWorld world(level({sensor(box(1, -2, 1.05, 2))}), {}, {0, 0});
  std::size_t events = 0;
  for (int step = 0; step < 20; ++step) events += world.step({100, 0}, frame).sensors.size();
  EXPECT_EQ(events, 0U) << "Box2D sweeps no sensors";
}

TEST(TurningMovers, go_as_far_as_asked_and_meet_what_floats_above_them_where_the_collider_says) {
  ColliderDef arm = chain({{0, 0}, {1, 0}});
  arm.mover = 0;
  ReferenceWorld world(level({arm}), {}, {0.6, 0.8 + half_height()});
  const std::vector<MoverMotion<double>> still(1);
  const TwinWish rest{};
  bool met = false;
  for (int k = 0; k < 60 && !met; ++k) {
    const MoverTurn turn{k * frame, (k + 1) * frame};
    const TwinStep& step = world.step_all(std::span(&rest, 1), frame, still, std::span(&turn, 1)).front();
    ASSERT_NEAR(step.turns[0].from, turn.from, 1e-5);
    ASSERT_NEAR(step.turns[0].to, turn.to, 1e-5);
    met = !step.contacts.empty();
    if (!met) continue;
    // The tip is under the feet at asin 0.8; the skin of 20 mm is met 20 mm lower, by a step that looks when it begins.
    EXPECT_NEAR(turn.from, std::asin(0.8 - touch_gap), 1.5 * frame);
    EXPECT_EQ(step.contacts[0].collider, 0U);
    EXPECT_EQ(step.contacts[0].side, Side::bottom);
  }
  EXPECT_TRUE(met);
}

TEST(TurningMovers, beyond_a_quarter_of_a_circle_are_capped_and_another_number_of_turns_is_refused) {
  ColliderDef arm = chain({{0, 0}, {1, 0}});
  arm.mover = 0;
  ReferenceWorld world(level({arm}), {}, {9, 9});
  const std::vector<MoverMotion<double>> still(1);
  const TwinWish rest{};
  const auto capped = [&](double angle) {
    const MoverTurn turn{0, angle};
    return world.step_all(std::span(&rest, 1), frame, still, std::span(&turn, 1)).front().capped;
  };
  EXPECT_FALSE(capped(1.5));
  EXPECT_TRUE(capped(1.6));
  EXPECT_THROW(world.step_all(std::span(&rest, 1), frame, still, std::vector<MoverTurn>(2)), InvalidDefinition);
}

}  // namespace
}  // namespace paperproof::box2d::test
