#include "levels.hpp"

#include <box2d/b2_body.h>
#include <box2d/b2_world.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace paperproof::box2d::test {
namespace {

const Vec2d gravity{0, -10};

CharacterDef one_pixel_character() {
  const std::array<Vec2d, 4> corners{Vec2d{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CharacterDef character;
  character.shape = CharacterShape::from_pixels(corners, 32);
  return character;
}

TEST(ReferenceWorld, cites_the_package_and_not_what_the_library_calls_itself) { EXPECT_EQ(box2d_version(), "2.4.1"); }

TEST(ReferenceWorld, says_truly_whether_the_asserts_of_box2d_are_on) {
  EXPECT_NE(box2d_build(), "");
  const auto ask_for_nonsense = [] {
    b2World world({0, 0});
    b2BodyDef body;
    body.position.x = std::numeric_limits<float>::quiet_NaN();
    world.CreateBody(&body);
    std::exit(0);
  };
  if (box2d_asserts() == "on") {
    EXPECT_DEATH(ask_for_nonsense(), "Assert");
  } else if (box2d_asserts() == "off") {
    EXPECT_EXIT(ask_for_nonsense(), testing::ExitedWithCode(0), "");
  } else {
    EXPECT_EQ(box2d_asserts(), "unknown");
  }
}

TEST(ReferenceWorld, free_flight_follows_the_wanted_velocity_to_rounding) {
  ReferenceWorld world(level({box(-5, -200, 5, -199)}), {}, {0, 0});
  Vec2d expected = Vec2d::Zero();
  Vec2d velocity{3, 5};
  for (int i = 0; i < 120; ++i) {
    velocity += gravity * frame;
    expected += velocity * frame;
    world.step(velocity, frame);
    // Each step rounds a coordinate of up to 8 m (ulp 9.5e-7) a few times.
    const double rounding = (i + 1) * 2e-6;
    ASSERT_NEAR(world.position().x(), expected.x(), rounding);
    ASSERT_NEAR(world.position().y(), expected.y(), rounding);
  }
}

TEST(ReferenceWorld, rests_at_the_gap_that_we_cite) {
  for (const SceneryMode mode : {SceneryMode::chain_loops, SceneryMode::pieces}) {
    ReferenceWorld world(level({box(-5, -1, 5, 0)}), {}, {0, 1}, {.mode = mode});
    bool grounded = false;
    run(world, {0, 0}, gravity, 300, [&](const TwinStep& step) { grounded = step.grounded; });
    const double gap = world.position().y() - half_height();
    EXPECT_GE(gap, rest_gap - 0.001);
    EXPECT_LE(gap, touch_gap + 0.001);
    EXPECT_TRUE(grounded);
  }
}

TEST(ReferenceWorld, placed_at_the_rest_gap_it_touches_in_the_next_step_and_stays) {
  ReferenceWorld world(level({box(-5, -1, 5, 0)}), {}, {0, 3});
  world.place({1, half_height() + rest_gap}, {0, 0});
  const Vec2d before = world.position();
  const TwinStep& step = world.step(gravity * frame, frame);
  EXPECT_TRUE(step.grounded);
  ASSERT_EQ(step.contacts.size(), 1U);
  EXPECT_EQ(step.contacts[0].side, Side::bottom);
  EXPECT_EQ(step.contacts[0].fraction, 0);
  EXPECT_NEAR(step.contacts[0].separation, rest_gap, 1e-4);
  EXPECT_NEAR(world.position().y(), before.y(), 1e-4);
}

TEST(ReferenceWorld, a_place_is_a_fresh_start_with_the_same_bits) {
  const Scenery<double> scenery = level({box(-5, -1, 5, 0), box(2, 0, 3, 4)});
  ReferenceWorld used(scenery, {}, {0, 3});
  run(used, {4, 0}, gravity, 90);
  ReferenceWorld fresh(scenery, {}, {0, 3});
  used.place({0.5, 0.75}, {6, -2});
  fresh.place({0.5, 0.75}, {6, -2});
  for (int i = 0; i < 60; ++i) {
    const Vec2d velocity = used.step({6, -2}, frame).velocity;
    ASSERT_EQ(velocity, fresh.step({6, -2}, frame).velocity);
    ASSERT_EQ(used.position(), fresh.position());
  }
}

TEST(ReferenceWorld, two_worlds_give_the_same_bits) {
  std::vector<ColliderDef> colliders{box(-20, -1, 20, 0), polygon({{4, 0}, {9, 0}, {9, 3}}), chain({{-6, 0}, {-8, 4}})};
  const Scenery<double> scenery = level(colliders);
  ReferenceWorld first(scenery, {}, {0, 3});
  ReferenceWorld second(scenery, {}, {0, 3});
  Random random(5);
  Vec2d velocity = Vec2d::Zero();
  for (int i = 0; i < 1000; ++i) {
    velocity += gravity * frame;
    if (random.below(20) == 0) velocity = Vec2d{random.between(-8, 8), random.between(0, 8)};
    const TwinStep& a = first.step(velocity, frame);
    const TwinStep& b = second.step(velocity, frame);
    ASSERT_EQ(first.position(), second.position()) << "seed 5, step " << i;
    ASSERT_EQ(a.velocity, b.velocity);
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    velocity = a.velocity;
  }
}

TEST(ReferenceWorld, box2d_moves_two_metres_per_step_and_no_more_and_says_so) {
  ReferenceWorld world(level({box(-5, -1000, 5, -999)}), {}, {0, 0});
  const double allowed = 0.999 * max_travel_per_step / frame;
  EXPECT_FALSE(world.step({allowed, 0}, frame).capped);
  EXPECT_NEAR(world.position().x(), allowed * frame, 1e-5);
  world.place({0, 0}, {0, 0});
  EXPECT_TRUE(world.step({3 * allowed, 0}, frame).capped);
  EXPECT_NEAR(world.position().x(), max_travel_per_step, 1e-5);
}

TEST(ReferenceWorld, stops_the_one_pixel_character_of_the_article_short_of_the_platform) {
  // 50 px per frame down, a platform of 5 px, 30 px below; Box2D stops at its time-of-impact target, slop above the
  // skin.
  const double px = 1.0 / 32;
  const double half = px / 2;
  ReferenceWorld world(level({box(-4, -30 * px - half - 5 * px, 4, -30 * px - half)}), one_pixel_character(), {0, 0});
  const TwinStep& step = world.step({0, -50 * px / frame}, frame);
  EXPECT_FALSE(step.capped);
  const double fallen_px = -world.position().y() / px;
  EXPECT_GT(fallen_px, 29);
  EXPECT_LT(fallen_px, 30);
  ASSERT_EQ(step.contacts.size(), 1U);
  // Exactly it is 30 px of 50; the skin of at most 20 mm leads.
  EXPECT_LE(step.contacts[0].fraction, 0.6);
  EXPECT_GE(step.contacts[0].fraction, 0.6 - touch_gap / (50 * px));
  EXPECT_EQ(step.contacts[0].side, Side::bottom);
  RecordProperty("fallen_px", std::to_string(fallen_px));
}

TEST(ReferenceWorld, the_scenery_as_run_is_the_original_rounded_to_float) {
  const std::vector<Vec2d> ring{{0.1, 0.2}, {7.3, 0.1}, {3.7, 9.9}};
  const ReferenceWorld world(level({polygon(ring)}), {}, {20, 20});
  ASSERT_EQ(world.as_run().colliders.size(), 1U);
  const std::vector<Vec2d>& run_points = world.as_run().colliders[0].points;
  ASSERT_EQ(run_points.size(), ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    EXPECT_EQ(run_points[i].x(), static_cast<double>(static_cast<float>(ring[i].x())));
    EXPECT_EQ(run_points[i].y(), static_cast<double>(static_cast<float>(ring[i].y())));
  }
  EXPECT_EQ(world.points_as_run().size(), CharacterDef{}.shape.hull().size());
}

TEST(ReferenceWorld, says_how_many_fixtures_it_made) {
  const Scenery<double> tiles = level({box(0, 0, 1, 1), box(1, 0, 2, 1), chain({{5, 0}, {6, 0}, {7, 1}})});
  const ReferenceWorld loops(tiles, {}, {0, 5});
  EXPECT_EQ(loops.size().loops, 1U);
  EXPECT_EQ(loops.size().fixtures, 1U + 2U);
  const ReferenceWorld pieces(tiles, {}, {0, 5}, {.mode = SceneryMode::pieces});
  EXPECT_EQ(pieces.size().loops, 0U);
  EXPECT_EQ(pieces.size().fixtures, 2U + 2U);
}

}  // namespace
}  // namespace paperproof::box2d::test
