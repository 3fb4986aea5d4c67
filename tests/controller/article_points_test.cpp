/// The techniques that search along the article's points: what each does that no other does, and its knobs.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::article_tests {
namespace {

using Response = ArticleKnobs::Response;

TEST(WindBack, goes_back_along_the_movement_by_units_until_free_as_a_mask_that_shortens_does) {
  // Feet start 4 pixels above the floor and would end 6 below, 10 pixels along: 2-norm sqrt(200) pixels. Free where
  // 4 - 10 (1 - k / sqrt(200)) >= 0, that is k >= 0.6 sqrt(200) = 8.49: nine units.
  const double fraction = 1 - std::ceil(0.6 * std::sqrt(200.0)) / std::sqrt(200.0);
  for (const std::string_view kind : {"wind_back", "mask"}) {
    SCOPED_TRACE(kind);
    Rig<double> rig(kind, {rectangle(-2, -2, 2, 0)}, {.response = Response::shorten});
    const MoveResult<double>& result = rig.move({0, half_height + 4 * px}, {10 * px, -10 * px});
    EXPECT_NEAR(result.position.x(), 10 * px * fraction, 1e-15);
    EXPECT_NEAR(result.position.y(), half_height + 4 * px - 10 * px * fraction, 1e-15);
    EXPECT_EQ(result.velocity.y(), 0);
    ASSERT_EQ(result.contacts.size(), 1U);
    EXPECT_EQ(result.contacts[0].side, Side::bottom);
    EXPECT_NEAR(result.contacts[0].fraction, fraction, 1e-15);
  }
}

TEST(StartInside, is_stuck_where_the_search_goes_back_and_free_once_an_end_is) {
  struct Case {
    std::string_view kind;
    Response response = Response::component;
  };
  for (const Case& each : {Case{"wind_back"}, Case{"mask"}, Case{"mask", Response::shorten}}) {
    Rig<double> rig(each.kind, {rectangle(-9, -2, 9, 0)}, {.response = each.response});
    EXPECT_EQ(rig.move({0, 10 * px}, {px, -3 * px}).position, Vec2d(0, 10 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, MoveStatus::stuck) << each.kind;
    EXPECT_EQ(rig.move({0, 10 * px}, {0, 30 * px}).position, Vec2d(0, 40 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, MoveStatus::moved) << each.kind;
  }
}

TEST(StartInside, gives_the_march_nothing_to_go_back_and_penetration_resolution_takes_one_unit) {
  Rig<double> rig("speculative_march", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, half_height - px / 2}, {0, -3 * px});
  EXPECT_EQ(result.contacts[0].fraction, 0);
  EXPECT_EQ(result.position.y(), half_height + px / 2);
}

TEST(PenetrationResolution, is_pushed_out_by_whole_units) {
  // The end is 6.25 pixels in the floor: seven units, which is 0.75 above it.
  Rig<double> rig("penetration_resolution", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, half_height + 4 * px}, {10 * px, -10.25 * px});
  EXPECT_EQ(result.position, Vec2d(10 * px, half_height + 0.75 * px));
  EXPECT_EQ(result.velocity, Vec2d(10 * px, 0));
}

TEST(SpeculativeMarch, does_not_look_beyond_the_end) {
  // 3.5 px down to 0.25 px above the hill, where the right foot is: the last step is half a unit.
  Rig<double> rig("speculative_march", {{.points = {{-2, -2}, {2, -2}, {2, 2}}}});
  const MoveResult<double>& result = rig.move({0, 28.75 * px}, {0, -3.5 * px});
  EXPECT_EQ(result.position.y(), 25.25 * px);
  EXPECT_TRUE(result.contacts.empty());
}

TEST(FlushTiles, a_point_does_not_fall_down_the_seam_between_two) {
  for (const std::string_view kind : article_kinds) {
    SCOPED_TRACE(kind);
    for (const auto objects : {ArticleKnobs::Objects::each, ArticleKnobs::Objects::all}) {
      Rig<double> rig(kind, {rectangle(-1, -1, 0, 0), rectangle(0, -1, 1, 0)}, {.objects = objects}, diamond());
      const MoveResult<double>& result = rig.move({0, 1}, {0, -1});
      EXPECT_NEAR(result.position.y(), 0.5, px);
      EXPECT_EQ(result.contacts.size(), 1U);
    }
  }
}

TEST(FlushTiles, a_computed_contact_is_found_on_the_seam_between_two_thin_ones) {
  // The end is far below: only the time of impact can stop it. One tile ends lower: the seam begins where both are.
  for (const double step_down : {0.0, 0.125}) {
    const std::vector<ColliderDef> tiles{rectangle(-1, -0.25, 0, 0), rectangle(0, -0.25, 1, -step_down)};
    Rig<double> rig("speculative", tiles, {}, diamond());
    EXPECT_NEAR(rig.move({0, 1}, {0, -3}).position.y(), 0.5 - step_down, 1e-15);
  }
  // Tiles that do not share a piece of the seam leave it open: a point without width passes between them.
  Rig<double> rig("speculative", {rectangle(-1, -0.25, 0, 0), rectangle(0, -0.75, 1, -0.5)}, {}, diamond());
  EXPECT_TRUE(rig.move({0, 1}, {0, -3}).contacts.empty());
}

TEST(Speculative, ends_a_fall_for_a_frame_where_the_feet_reach_a_wall) {
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

TEST(Speculative, keeps_rising_at_a_wall_and_reports_the_true_normal_of_an_overhang) {
  for (const std::string_view kind : speculative_kinds) {
    SCOPED_TRACE(kind);
    Rig<double> wall(kind, {rectangle(1, -9, 2, 9)});
    wall.move({0, 0}, {25 * px, 8 * px});
    ASSERT_EQ(wall.result.contacts.size(), 1U);
    EXPECT_EQ(wall.result.contacts[0].side, Side::right);
    EXPECT_EQ(wall.result.velocity, Vec2d(0, 8 * px)) << "ending the rise is a rule of the controller";

    Rig<double> overhang(kind, {{.points = {{-2, 2}, {2, 1}, {2, 3}}}});
    overhang.move({0, 0}, {0, 2});
    ASSERT_FALSE(overhang.result.contacts.empty());
    EXPECT_EQ(overhang.result.contacts[0].side, Side::top);
    const Vec2d normal = Vec2d{-1, -4} / std::sqrt(17.0);  // of the face from (2, 1) to (-2, 2)
    EXPECT_LE((overhang.result.contacts[0].normal - normal).norm(), 1e-14);
    EXPECT_EQ(overhang.result.velocity.y(), 0);
    EXPECT_FALSE(overhang.result.grounded);
  }
}

TEST(AllPairs, hold_back_a_character_that_moves_away_from_what_it_is_in) {
  // Half a pixel inside the floor, jumping: the feet do not face the movement. Tested all the same, they end it.
  for (const std::string_view kind : speculative_kinds) {
    SCOPED_TRACE(kind);
    for (const auto pairs : {ArticleKnobs::Pairs::direction, ArticleKnobs::Pairs::all}) {
      // One unit of penetration resolution, or the jump.
      const bool stuck = pairs == ArticleKnobs::Pairs::all;
      const double way = stuck ? px : 12 * px;
      Rig<double> jump(kind, {rectangle(-3, -1, 3, 0)}, {.pairs = pairs});
      EXPECT_EQ(jump.move({0, half_height - px / 2}, {0, 12 * px}).position.y(), half_height - px / 2 + way);
      EXPECT_EQ(jump.result.velocity.y(), stuck ? 0 : 12 * px);
      Rig<double> walk(kind, {rectangle(-3, -3, 0, 3)}, {.pairs = pairs});
      EXPECT_EQ(walk.move({half_width - px / 2, 0}, {12 * px, 0}).position.x(), half_width - px / 2 + way);
      EXPECT_EQ(walk.result.velocity.x(), stuck ? 0 : 12 * px);
    }
  }
}

TEST(ShortenedVector, sticks_to_the_floor_where_the_component_rule_walks) {
  for (const std::string_view kind : {"mask", "speculative_march", "speculative"}) {
    SCOPED_TRACE(kind);
    for (const Response response : {Response::component, Response::shorten}) {
      Rig<double> rig(kind, {rectangle(-3, -1, 30, 0)}, {.response = response});
      Vec2d position{0, half_height};
      for (int step = 1; step <= 50; ++step) {
        position = rig.move(position, {4 * px, -px / 4}).position;
        ASSERT_EQ(position, Vec2d(response == Response::component ? step * 4 * px : 0, half_height));
      }
    }
  }
}

TEST(Objects, are_left_one_by_one_and_a_later_one_may_push_into_an_earlier_one) {
  // The feet are 2 px deep in a floor whose top, at 1 px, is inside of a plate that comes first and reaches to 4 px.
  const std::vector<ColliderDef> colliders{rectangle(-3, px / 2, 3, 4 * px), rectangle(-3, -3, 3, px)};
  struct Case {
    ArticleKnobs::Objects objects;
    int iterations;
    double feet;  ///< Where they end [px].
  };
  for (const Case& each : {Case{ArticleKnobs::Objects::each, 1, 1}, Case{ArticleKnobs::Objects::each, 2, 4},
                           Case{ArticleKnobs::Objects::all, 1, 4}}) {
    Rig<double> rig("penetration_resolution", colliders, {.iterations = each.iterations, .objects = each.objects});
    const MoveResult<double>& result = rig.move({0, half_height + 8 * px}, {0, -9 * px});
    EXPECT_EQ(result.position.y(), half_height + each.feet * px) << each.iterations;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
