/// What each of the article's techniques does with the article's own situations.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace paperproof::article_tests {
namespace {

/// The article's scene: a character of one pixel falls 50 pixels per frame; a platform `thickness` pixels thick is
/// `distance` pixels below its lower edge.
template <class Scalar>
MoveResult<Scalar> fall_of_the_bullet(std::string_view kind, double distance = 30, double thickness = 5) {
  const double top = -px / 2 - distance * px;
  Rig<Scalar> rig(kind, {rectangle(-2, top - thickness * px, 2, top)}, {}, single_pixel());
  return rig.move({0, 0}, {0, -50 * px});
}

template <class Scalar>
class BulletThroughPaper : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BulletThroughPaper, Scalars);

TYPED_TEST(BulletThroughPaper, techniques_that_look_only_at_the_end_pass_the_platform) {
  for (const std::string_view kind : {"wind_back", "penetration_resolution"}) {
    const MoveResult<TypeParam> result = fall_of_the_bullet<TypeParam>(kind);
    EXPECT_EQ(result.position.y(), static_cast<TypeParam>(-50 * px)) << kind;
    EXPECT_EQ(result.velocity.y(), static_cast<TypeParam>(-50 * px)) << kind;
    EXPECT_TRUE(result.contacts.empty()) << kind;
    EXPECT_FALSE(result.grounded) << kind;
  }
}

TYPED_TEST(BulletThroughPaper, speculative_contacts_stop_on_the_platform) {
  for (const std::string_view kind : speculative_kinds) {
    const MoveResult<TypeParam> result = fall_of_the_bullet<TypeParam>(kind);
    // Whole pixels are exact, also for the march: its 30th step lands on the edge, where nothing is inside yet.
    const TypeParam rounding = 4 * std::numeric_limits<TypeParam>::epsilon();
    EXPECT_NEAR(result.position.y(), static_cast<TypeParam>(-30 * px), rounding) << kind;
    EXPECT_GE(result.position.y(), static_cast<TypeParam>(-30 * px)) << kind;
    EXPECT_EQ(result.velocity.y(), 0) << kind;
    EXPECT_TRUE(result.grounded) << kind;
    ASSERT_EQ(result.contacts.size(), 1U) << kind;
    const Contact<TypeParam>& contact = result.contacts[0];
    EXPECT_EQ(contact.side, Side::bottom);
    EXPECT_EQ(contact.normal, Vec2<TypeParam>(0, 1));
    EXPECT_NEAR(contact.fraction, TypeParam(30) / TypeParam(50), rounding);
    EXPECT_NEAR(contact.point.y(), static_cast<TypeParam>(-30.5 * px), rounding);
    EXPECT_NEAR(contact.separation, TypeParam(0), rounding);
  }
}

TEST(SpeculativeMarch, ends_less_than_a_unit_above_what_it_hits) {
  for (int sixteenths = 1; sixteenths < 16; ++sixteenths) {
    const double distance = 30 + sixteenths / 16.0;
    const MoveResult<double> result = fall_of_the_bullet<double>("speculative_march", distance);
    EXPECT_DOUBLE_EQ(result.position.y(), -30 * px) << "the last whole unit above " << distance;
    ASSERT_EQ(result.contacts.size(), 1U);
    EXPECT_NEAR(result.contacts[0].separation, (distance - 30) * px, 1e-15);
  }
}

TEST(SpeculativeMarch, lands_exactly_on_the_end_when_nothing_is_in_the_way) {
  Rig<double> rig("speculative_march", {rectangle(-9, -9, 9, -5)});
  const Vec2d displacement{1.3, -0.7};
  EXPECT_EQ(rig.move({0, 0}, displacement).position, displacement);
  EXPECT_TRUE(rig.result.contacts.empty());
}

TEST(SpeculativeMarch, has_nothing_to_go_back_where_it_collides_at_the_start) {
  // Feet half a pixel in the floor, falling: no advance, no way back; penetration resolution then takes one unit.
  Rig<double> rig("speculative_march", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, 19.5 * px}, {0, -3 * px});
  EXPECT_EQ(result.contacts[0].fraction, 0);
  EXPECT_EQ(result.position.y(), 19.5 * px + px);
}

TEST(WindBack, goes_back_along_the_movement_by_units_until_free) {
  // Feet start 4 pixels above the floor and would end 6 below, 10 pixels along: 2-norm sqrt(200) pixels. Free where
  // 4 - 10 (1 - k / sqrt(200)) >= 0, that is k >= 0.6 sqrt(200) = 8.49: nine units.
  Rig<double> rig("wind_back", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, 24 * px}, {10 * px, -10 * px});
  const double fraction = 1 - std::ceil(0.6 * std::sqrt(200.0)) / std::sqrt(200.0);
  EXPECT_NEAR(result.position.x(), 10 * px * fraction, 1e-15);
  EXPECT_NEAR(result.position.y(), 24 * px - 10 * px * fraction, 1e-15);
  EXPECT_EQ(result.velocity, Vec2d(10 * px, 0));
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts[0].side, Side::bottom);
  EXPECT_NEAR(result.contacts[0].fraction, fraction, 1e-15);
  EXPECT_NEAR(result.contacts[0].separation, 4 * px - 10 * px * fraction, 1e-15);
}

TEST(WindBack, ends_where_it_began_when_nothing_on_the_way_is_free) {
  Rig<double> rig("wind_back", {rectangle(-2, -2, 2, 0)});
  EXPECT_EQ(rig.move({0, 10 * px}, {0, -3 * px}).position, Vec2d(0, 10 * px));
  EXPECT_EQ(rig.result.status, MoveStatus::stuck);
}

TEST(PenetrationResolution, is_pushed_out_by_whole_units) {
  // The end is 6.25 pixels in the floor: seven units, which is 0.75 above it.
  Rig<double> rig("penetration_resolution", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, 24 * px}, {10 * px, -10.25 * px});
  EXPECT_DOUBLE_EQ(result.position.y(), 20.75 * px);
  EXPECT_EQ(result.position.x(), 10 * px) << "the component along the floor is retained";
  EXPECT_EQ(result.velocity, Vec2d(10 * px, 0));
  EXPECT_EQ(result.contacts[0].fraction, 1);
}

TEST(PenetrationResolution, jitters_between_two_positions_at_rest_where_speculative_contacts_do_not) {
  for (const std::string_view kind : article_kinds) {
    Rig<double> rig(kind, {rectangle(-2, -2, 2, 0)});
    Walker walker{.position = {0, 20 * px}};
    double highest = walker.position.y();
    for (int step = 0; step < 200; ++step) highest = std::max(highest, walker.step(rig).position.y());
    const double hop = highest - 20 * px;
    if (kind == "penetration_resolution") {
      EXPECT_GT(hop, px / 2);
      EXPECT_LE(hop, px);
    } else {
      EXPECT_EQ(hop, 0) << kind;
      EXPECT_EQ(walker.position, Vec2d(0, 20 * px)) << kind;
      EXPECT_TRUE(rig.result.grounded) << kind;
    }
  }
}

TEST(Speculative, rests_without_moving_a_bit_wherever_it_landed) {
  Random random(7);
  for (int drop = 0; drop < 200; ++drop) {
    const double floor = random.between(-30, 30);
    Rig<double> rig("speculative", {rectangle(-40, floor - 3, 40, floor)});
    Walker walker{.position = {random.between(-20, 20), floor + random.between(0.7, 2)}};
    for (int step = 0; step < 100 && !rig.result.grounded; ++step) walker.step(rig);
    ASSERT_TRUE(rig.result.grounded) << "seed 7, drop " << drop;
    const Vec2d landed = walker.position;
    for (int step = 0; step < 20; ++step) walker.step(rig);
    EXPECT_EQ(walker.position, landed) << "seed 7, drop " << drop;
    const double gap = landed.y() - 20 * px - floor;
    EXPECT_NEAR(gap, 0, 1e-13) << "a few ulp at 30 m";
  }
}

std::vector<ColliderDef> flush_tiles(int count) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < count; ++i) tiles.push_back(rectangle(i, -1, i + 1, 0));
  return tiles;
}

TEST(FlushTiles, walking_over_them_keeps_speed_and_height) {
  for (const std::string_view kind : speculative_kinds) {
    for (int speed = 1; speed <= 100; ++speed) {
      Rig<double> rig(kind, flush_tiles(40));
      Walker walker{.position = {1, 20 * px}, .velocity = {0.25 * speed, 0}};
      const int steps = std::min(200, 37 * 64 * 4 / speed);
      for (int step = 0; step < steps; ++step) {
        walker.step(rig);
        ASSERT_EQ(walker.velocity.x(), 0.25 * speed) << kind << " at step " << step;
        ASSERT_EQ(walker.position.y(), 20 * px) << kind << " at step " << step;
      }
      // Speed and dt are multiples of powers of two: the sum is exact.
      EXPECT_EQ(walker.position.x(), 1 + steps * 0.25 * speed / 64) << kind;
    }
  }
}

TEST(FlushTiles, a_point_does_not_fall_down_the_seam_between_two) {
  const std::array diamond{Vec2d{0, -0.5}, Vec2d{0.5, 0}, Vec2d{0, 0.5}, Vec2d{-0.5, 0}};
  for (const std::string_view kind : article_kinds) {
    Rig<double> rig(kind, {rectangle(-1, -1, 0, 0), rectangle(0, -1, 1, 0)}, {}, CharacterShape(diamond));
    const MoveResult<double>& result = rig.move({0, 1}, {0, -1});
    EXPECT_NEAR(result.position.y(), 0.5, px) << kind;
    EXPECT_EQ(result.contacts.size(), 1U) << kind;
  }
}

TEST(FlushTiles, a_computed_contact_is_found_on_the_seam_between_two_thin_ones) {
  // The end is far below: only the time of impact can stop it. One tile ends lower: the seam begins where both are.
  const std::array diamond{Vec2d{0, -0.5}, Vec2d{0.5, 0}, Vec2d{0, 0.5}, Vec2d{-0.5, 0}};
  for (const double step_down : {0.0, 0.125}) {
    const std::vector<ColliderDef> tiles{rectangle(-1, -0.25, 0, 0), rectangle(0, -0.25, 1, -step_down)};
    Rig<double> rig("speculative", tiles, {}, CharacterShape(diamond));
    EXPECT_NEAR(rig.move({0, 1}, {0, -3}).position.y(), 0.5 - step_down, 1e-15);
  }
  // Tiles that do not share a piece of the seam leave it open: a point without width passes between them.
  const std::vector<ColliderDef> apart{rectangle(-1, -0.25, 0, 0), rectangle(0, -0.75, 1, -0.5)};
  Rig<double> rig("speculative", apart, {}, CharacterShape(diamond));
  EXPECT_TRUE(rig.move({0, 1}, {0, -3}).contacts.empty());
}

TEST(SpeculativeContacts, name_what_each_foot_touches) {
  for (const double step_down : {0.0, px / 4}) {
    Rig<double> rig("speculative", {rectangle(-3, -1, 0, -step_down), rectangle(0, -1, 3, 0)});
    const MoveResult<double>& result = rig.move({0, 25 * px}, {0, -10 * px});
    const bool both = step_down == 0;
    ASSERT_EQ(result.contacts.size(), both ? 2U : 1U);
    EXPECT_EQ(result.contacts[0].collider, both ? 0U : 1U);
    EXPECT_EQ(result.contacts.back().collider, 1U);
    EXPECT_NEAR(result.position.y(), 20 * px, 1e-15);
  }
}

TEST(SpeculativeMarch, does_not_look_beyond_the_end) {
  // 3.5 px down to 0.25 px above the hill, where the right foot is: the last step is half a unit.
  Rig<double> rig("speculative_march", {{.points = {{-2, -2}, {2, -2}, {2, 2}}}});
  const MoveResult<double>& result = rig.move({0, 28.75 * px}, {0, -3.5 * px});
  EXPECT_EQ(result.position.y(), 25.25 * px);
  EXPECT_TRUE(result.contacts.empty());
}

TEST(WindBack, a_walker_sticks_to_the_floor) {
  Rig<double> rig("wind_back", flush_tiles(10));
  Walker walker{.position = {1, 20 * px}, .velocity = {6, 0}};
  for (int step = 0; step < 60; ++step) walker.step(rig);
  EXPECT_EQ(walker.position, Vec2d(1, 20 * px));
}

TEST(SpeculativeWay, has_a_corner_where_the_fall_ends_and_the_walk_goes_on) {
  Rig<double> rig("speculative", {rectangle(-9, -2, 9, 0)});
  const MoveResult<double>& result = rig.move({0, 24 * px}, {10 * px, -10 * px});
  ASSERT_EQ(result.path.size(), 3U);
  EXPECT_EQ(result.path[0].position, Vec2d(0, 24 * px));
  EXPECT_EQ(result.path[0].fraction, 0);
  EXPECT_NEAR(result.path[1].fraction, 0.4, 1e-15);
  EXPECT_NEAR(result.path[1].position.x(), 4 * px, 1e-15);
  EXPECT_NEAR(result.path[1].position.y(), 20 * px, 1e-15);
  EXPECT_EQ(result.path[2].position, result.position);
  EXPECT_EQ(result.path[2].fraction, 1);
  EXPECT_EQ(result.position.x(), 10 * px);
}

TEST(SpeculativeWay, stops_in_a_corner_of_floor_and_wall) {
  for (const std::string_view kind : speculative_kinds) {
    // The wall is 22 px from the arm. The movement takes the arm 3 px into it, and the foot, 5 px behind, not.
    Rig<double> rig(kind, {rectangle(-9, -2, 9, 0), rectangle(1, 0, 3, 5)});
    const MoveResult<double>& result = rig.move({0, 36 * px}, {25 * px, -20 * px});
    EXPECT_EQ(result.velocity, Vec2d(0, 0)) << kind;
    EXPECT_LE(result.position.x(), 22 * px) << kind;
    EXPECT_GT(result.position.x(), 21 * px) << kind;
    EXPECT_GE(result.position.y(), 20 * px) << kind;
    EXPECT_LT(result.position.y(), 21 * px) << kind;
    ASSERT_EQ(result.contacts.size(), 2U) << kind;
    EXPECT_EQ(result.contacts[0].side, Side::bottom);
    EXPECT_EQ(result.contacts[0].collider, 0U);
    EXPECT_EQ(result.contacts[1].side, Side::right);
    EXPECT_EQ(result.contacts[1].collider, 1U);
    EXPECT_EQ(result.contacts[1].normal, Vec2d(-1, 0));
  }
}

TEST(SpeculativeWay, a_fall_ends_for_a_frame_where_the_feet_reach_a_wall) {
  // The pairs are tested in the article's order, each along the whole vector: a foot that is taken into a wall counts
  // as a hit of the bottom pair, although nothing is below it.
  Rig<double> rig("speculative", {rectangle(1, -9, 3, 9)});
  const MoveResult<double>& result = rig.move({0, 0}, {54 * px, -54 * px});
  EXPECT_NEAR(result.position.y(), -27 * px, 1e-15) << "where the foot, 27 px away, met the wall";
  EXPECT_NEAR(result.position.x(), 22 * px, 1e-15) << "where the arm did";
  EXPECT_TRUE(result.grounded);
  EXPECT_EQ(result.contacts[0].side, Side::bottom);
  EXPECT_EQ(result.contacts[0].normal, Vec2d(-1, 0));
}

TEST(ArticleJump, hitting_a_wall_or_an_overhang_is_reported_on_the_side_of_the_pair) {
  for (const std::string_view kind : speculative_kinds) {
    Rig<double> wall(kind, {rectangle(1, -9, 2, 9)});
    wall.move({0, 0}, {25 * px, 8 * px});
    ASSERT_EQ(wall.result.contacts.size(), 1U) << kind;
    EXPECT_EQ(wall.result.contacts[0].side, Side::right);
    EXPECT_EQ(wall.result.velocity, Vec2d(0, 8 * px)) << "ending the rise is a rule of the controller";

    Rig<double> overhang(kind, {{.points = {{-2, 2}, {2, 1}, {2, 3}}}});
    overhang.move({0, 0}, {0, 2});
    ASSERT_FALSE(overhang.result.contacts.empty()) << kind;
    EXPECT_EQ(overhang.result.contacts[0].side, Side::top);
    EXPECT_NEAR(overhang.result.contacts[0].normal.x() / overhang.result.contacts[0].normal.y(), 0.25, 1e-14)
        << "the true normal of the face from (2, 1) to (-2, 2)";
    EXPECT_LT(overhang.result.contacts[0].normal.y(), 0);
    EXPECT_EQ(overhang.result.velocity.y(), 0);
    EXPECT_FALSE(overhang.result.grounded);
  }
}

TEST(ArticleRefusals, a_step_out_of_range_or_with_too_many_units_moves_nothing) {
  for (const std::string_view kind : article_kinds) {
    Rig<double> rig(kind, {rectangle(-2, -2, 2, 0)});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Vec2d& displacement : {Vec2d{3e6, 0}, Vec2d{nan, 0}, Vec2d{0, nan}}) {
      EXPECT_EQ(rig.move({1, 1}, displacement).status, MoveStatus::out_of_range) << kind;
      EXPECT_EQ(rig.result.position, Vec2d(1, 1));
      EXPECT_EQ(rig.result.path.size(), 2U);
    }
    const bool searches = kind != "speculative";
    const MoveStatus far = searches ? MoveStatus::refused : MoveStatus::moved;
    EXPECT_EQ(rig.move({0, 5}, {1e6, 0}).status, far) << kind;
    if (searches) {
      EXPECT_EQ(rig.result.position, Vec2d(0, 5)) << kind;
    }
  }
}

TEST(ArticleContacts, of_what_is_held_are_at_fraction_zero_without_a_sign) {
  constexpr double half_height = 20 * px;
  constexpr double half_width = 10 * px;
  const std::vector<ColliderDef> corner{rectangle(-4, -1, 4, 0), rectangle(-4, 0, -1, 4), rectangle(1, 0, 4, 4)};
  for (const std::string_view kind : technique_names()) {
    if (kind == "grid") continue;  // stands in the middle of its square, beside nothing
    Rig<double> rig(kind, corner);
    for (const double wall : {-1.0, 1.0}) {
      rig.move({wall * (1 - half_width), half_height}, {wall * px, -px});
      EXPECT_FALSE(rig.result.contacts.empty()) << kind;
      for (const Contact<double>& contact : rig.result.contacts) {
        EXPECT_GE(contact.fraction, 0) << kind;
        EXPECT_FALSE(std::signbit(contact.fraction)) << kind;
      }
    }
  }
}

TEST(ArticleKnobsCheck, a_knob_out_of_range_is_named) {
  const Scenery<double> scenery(SceneryDef{{rectangle(0, 0, 1, 1)}});
  const auto message = [&](const ArticleKnobs& knobs) -> std::string {
    try {
      (void)make_technique<double>({.name = "speculative", .article = knobs}, scenery, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({}), "accepted");
  EXPECT_EQ(message({.unit = 0}).substr(0, 5), "unit:");
  EXPECT_EQ(message({.unit = std::numeric_limits<double>::infinity()}).substr(0, 5), "unit:");
  EXPECT_EQ(message({.unit = std::numeric_limits<double>::quiet_NaN()}).substr(0, 5), "unit:");
  EXPECT_EQ(message({.iterations = 0}).substr(0, 11), "iterations:");
  EXPECT_EQ(message({.points = 6}).substr(0, 7), "points:");
}

TEST(ArticleNames, are_those_the_command_takes) {
  for (const std::string_view kind : article_kinds) {
    Rig<double> rig(kind, {rectangle(0, 0, 1, 1)});
    EXPECT_EQ(rig.technique->name(), kind);
  }
}

}  // namespace
}  // namespace paperproof::article_tests
