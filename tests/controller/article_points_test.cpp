/// What eight points can and cannot see, and what the article says happens with fewer, with all, or shortened.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace paperproof::article_tests {
namespace {

// The article's character about its centre: feet at (+-5, -20) px, head at (+-5, 20) px, arms at (+-10, +-10) px.
constexpr double foot = 5 * px;
constexpr double half_height = 20 * px;
constexpr double half_width = 10 * px;

bool touched(const MoveResult<double>& result, ColliderIndex collider) {
  return std::any_of(result.contacts.begin(), result.contacts.end(),
                     [&](const Contact<double>& contact) { return contact.collider == collider; });
}

TEST(EightPoints, a_spike_between_the_feet_is_missed_by_every_technique) {
  // 8 px high and 6 px wide, between feet 10 px apart.
  const ColliderDef spike{.points = {{-3 * px, 0}, {3 * px, 0}, {0, 8 * px}}};
  for (const std::string_view kind : article_kinds) {
    Rig<double> rig(kind, {rectangle(-2, -2, 2, 0), spike});
    const MoveResult<double>& result = rig.move({0, half_height + 20 * px}, {0, -21 * px});
    EXPECT_TRUE(touched(result, 0)) << kind;
    EXPECT_FALSE(touched(result, 1)) << kind;
    EXPECT_LT(result.position.y() - half_height, 2 * px) << kind << ": the tip, at 8 px, is in the body";
  }
}

TEST(EightPoints, sloped_paper_is_passed_sideways_by_the_component_rule) {
  // A ramp of 45 degrees without thickness begins just beyond the right foot. The foot meets it at once, the fall ends,
  // and the walk goes on below it; the arms, 10 px higher and 5 px further, are not there yet.
  const double start = foot + px;
  const ColliderDef ramp = chain({{start, -half_height}, {start + 2, 2 - half_height}});
  for (const std::string_view kind : speculative_kinds) {
    Rig<double> rig(kind, {ramp});
    const MoveResult<double>& result = rig.move({0, 0.25 * px}, {4 * px, -px / 2});
    EXPECT_TRUE(touched(result, 0)) << kind;
    EXPECT_EQ(result.position.x(), 4 * px) << kind;
    const double below_ramp = (result.position.x() + foot - start) - (result.position.y());
    EXPECT_GT(below_ramp, 2 * px) << kind << ": the foot has passed the paper it touched";
  }
}

TEST(FourCorners, hang_off_an_edge_where_eight_points_fall) {
  // The centre is 7 px beyond the edge: the left foot 2 px off it, the corner of the bounding box 3 px on it.
  for (const std::string_view kind : article_kinds) {
    const std::vector<ColliderDef> platform{rectangle(-3, -1, -7 * px, 0)};
    Rig<double> four(kind, platform, {.points = 4});
    four.move({0, half_height}, {0, -px / 4});
    EXPECT_TRUE(four.result.grounded) << kind;
    EXPECT_GE(four.result.position.y(), half_height) << kind;

    Rig<double> eight(kind, platform, {.points = 8});
    eight.move({0, half_height}, {0, -px / 4});
    EXPECT_FALSE(eight.result.grounded) << kind;
    EXPECT_EQ(eight.result.position.y(), half_height - px / 4) << kind;
  }
}

TEST(FourCorners, hit_a_ceiling_where_eight_points_find_none) {
  for (const std::string_view kind : article_kinds) {
    // Above the left shoulder only, and higher than the arm.
    const std::vector<ColliderDef> ceiling{rectangle(-3, half_height, -7 * px, 2)};
    Rig<double> four(kind, ceiling, {.points = 4});
    four.move({0, 0}, {0, 4 * px});
    EXPECT_EQ(four.result.velocity.y(), 0) << kind;
    EXPECT_LE(four.result.position.y(), 0) << kind;

    Rig<double> eight(kind, ceiling, {.points = 8});
    eight.move({0, 0}, {0, 4 * px});
    EXPECT_EQ(eight.result.position.y(), 4 * px) << kind;
    EXPECT_TRUE(eight.result.contacts.empty()) << kind;
  }
}

TEST(AllPairs, hold_back_a_character_that_moves_away_from_what_it_is_in) {
  // Half a pixel inside the floor, jumping: the feet do not face the movement. Tested all the same, they end it.
  for (const std::string_view kind : speculative_kinds) {
    for (const auto pairs : {ArticleKnobs::Pairs::direction, ArticleKnobs::Pairs::all}) {
      Rig<double> jump(kind, {rectangle(-3, -1, 3, 0)}, {.pairs = pairs});
      jump.move({0, half_height - px / 2}, {0, 12 * px});
      const double risen = jump.result.position.y() - (half_height - px / 2);
      Rig<double> walk(kind, {rectangle(-3, -3, 0, 3)}, {.pairs = pairs});
      walk.move({half_width - px / 2, 0}, {12 * px, 0});
      const double walked = walk.result.position.x() - (half_width - px / 2);
      const bool stuck = pairs == ArticleKnobs::Pairs::all;
      EXPECT_EQ(risen, stuck ? px : 12 * px) << kind << ": one unit of penetration resolution, or the jump";
      EXPECT_EQ(walked, stuck ? px : 12 * px) << kind;
      EXPECT_EQ(jump.result.velocity.y(), stuck ? 0 : 12 * px) << kind;
      EXPECT_EQ(walk.result.velocity.x(), stuck ? 0 : 12 * px) << kind;
    }
  }
}

TEST(AllPairs, a_jump_up_a_hill_never_leaves_it) {
  // 45 degrees uphill; the jump rises less than the hill. By direction the feet are not tested on the way up.
  const ColliderDef hill{.points = {{-9, -9}, {30, -9}, {30, 30}}};
  for (const std::string_view kind : speculative_kinds) {
    for (const auto pairs : {ArticleKnobs::Pairs::direction, ArticleKnobs::Pairs::all}) {
      Rig<double> rig(kind, {hill}, {.pairs = pairs});
      const Vec2d on_the_hill{0, half_height + foot};
      const MoveResult<double>& result = rig.move(on_the_hill, {6 * px, 4 * px});
      const bool stuck = pairs == ArticleKnobs::Pairs::all;
      EXPECT_EQ(result.grounded, stuck) << kind;
      EXPECT_EQ(result.velocity.y() == 0, stuck) << kind;
    }
  }
}

TEST(ShortenedVector, sticks_to_the_floor_where_the_component_rule_walks) {
  for (const std::string_view kind : speculative_kinds) {
    for (const auto response : {ArticleKnobs::Response::component, ArticleKnobs::Response::shorten}) {
      Rig<double> rig(kind, {rectangle(-3, -1, 30, 0)}, {.response = response});
      Vec2d position{0, half_height};
      for (int step = 1; step <= 50; ++step) {
        position = rig.move(position, {4 * px, -px / 4}).position;
        const bool walks = response == ArticleKnobs::Response::component;
        ASSERT_EQ(position, Vec2d(walks ? step * 4 * px : 0, half_height)) << kind;
      }
    }
  }
}

/// A valley: the ground falls 45 degrees to the right, along y = -x, to the foot of a wall at x = 1. The wall pushes a
/// walker back into the slope, where the next iteration, if there is one, finds the feet inside.
struct Valley {
  int frames = 0;        ///< At the foot of the wall.
  int ended_inside = 0;  ///< Of these.

  explicit Valley(int iterations) {
    const ColliderDef slope{.points = {{-8, 8}, {-8, -8}, {8, -8}}};
    for (int sixteenths = -14; sixteenths < 2; ++sixteenths) {
      Rig<double> rig("penetration_resolution", {slope, rectangle(1, -8, 3, 8)}, {.iterations = iterations});
      walk_down(rig, sixteenths / 16.0);
    }
  }

 private:
  void walk_down(Rig<double>& rig, double start) {
    Walker walker{.position = {start, 2}};
    for (int step = 0; step < 600; ++step) {
      walker.velocity.x() = 6;
      const Vec2d& at = walker.step(rig).position;
      if (step < 200) continue;  // on its way
      const bool in_slope = (at.x() - foot) + (at.y() - half_height) < 0;
      const bool in_wall = at.x() + half_width > 1;
      ++frames;
      ended_inside += in_slope || in_wall ? 1 : 0;
    }
  }
};

TEST(Iterations, a_second_one_takes_a_character_out_of_what_the_first_pushed_it_into) {
  const Valley once(1);
  EXPECT_EQ(once.ended_inside, once.frames);
  for (const int iterations : {2, 4, 8, 32}) EXPECT_EQ(Valley(iterations).ended_inside, 0) << iterations;
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

TEST(Objects, that_abut_leave_no_seam_to_fall_through) {
  const std::array diamond{Vec2d{0, -0.5}, Vec2d{0.5, 0}, Vec2d{0, 0.5}, Vec2d{-0.5, 0}};
  for (const auto objects : {ArticleKnobs::Objects::each, ArticleKnobs::Objects::all}) {
    Rig<double> rig("penetration_resolution", {rectangle(-1, -1, 0, 0), rectangle(0, -1, 1, 0)}, {.objects = objects},
                    CharacterShape(diamond));
    const MoveResult<double>& result = rig.move({0, 0.5}, {0, -2 * px});
    EXPECT_TRUE(result.grounded);
    EXPECT_EQ(result.position.y(), 0.5);
  }
}

struct OneWayCase {
  const char* what;
  double start;   ///< Height of the feet above the ledge [px].
  double motion;  ///< [px]
  double end;     ///< Where the feet end [px].
};

class OneWayLedge : public testing::TestWithParam<std::string_view> {};

TEST_P(OneWayLedge, blocks_only_movement_against_its_normal_from_the_side_of_its_normal) {
  const std::array cases{
      OneWayCase{"falls onto it", 6, -10, 0},
      OneWayCase{"stands on its line and is pulled down", 0, -2, 0},
      OneWayCase{"jumps from it", 0, 9, 9},
      OneWayCase{"rises through it from below", -50, 60, 10},
      OneWayCase{"has its head through it and falls back", -10, -8, -18},
      OneWayCase{"has its feet a hair below it and falls", -0.25, -8, -8.25},
      OneWayCase{"is below it and falls", -50, -8, -58},
  };
  for (const OneWayCase& each : cases) {
    Rig<double> rig(GetParam(), {chain({{3, 0}, {-3, 0}}, Vec2d{0, 1})});
    rig.move({0, half_height + each.start * px}, {0, each.motion * px});
    const double feet = rig.result.position.y() - half_height;
    EXPECT_NEAR(feet, each.end * px, 1e-15) << each.what;
    const bool blocked = each.end != each.start + each.motion;
    EXPECT_EQ(rig.result.contacts.size(), blocked ? 1U : 0U) << each.what;
    EXPECT_EQ(rig.result.grounded, blocked) << each.what;
    for (const Contact<double>& contact : rig.result.contacts) EXPECT_EQ(contact.normal, Vec2d(0, 1)) << each.what;
  }
}

TEST_P(OneWayLedge, is_walked_on_without_a_change_of_speed) {
  Rig<double> rig(GetParam(), {chain({{-3, 0}, {0, 0}, {30, 0}}, Vec2d{0, 1})});
  Walker walker{.position = {0, half_height}, .velocity = {6, 0}};
  for (int step = 1; step <= 64; ++step) {
    walker.step(rig);
    ASSERT_EQ(walker.position, Vec2d(step * 6.0 / 64, half_height));
  }
}

INSTANTIATE_TEST_SUITE_P(Speculative, OneWayLedge, testing::ValuesIn(speculative_kinds),
                         [](const auto& each) { return std::string(each.param); });

TEST(TwoSidedChain, stops_from_both_sides_and_has_no_inside) {
  for (const std::string_view kind : speculative_kinds) {
    Rig<double> rig(kind, {chain({{-3, 0}, {3, 0}})});
    rig.move({0, half_height + 6.5 * px}, {0, -50 * px});
    EXPECT_TRUE(rig.result.grounded) << kind;
    EXPECT_GT(rig.result.position.y(), half_height);
    EXPECT_LE(rig.result.position.y(), half_height + px);
    rig.move({0, -half_height - 6.5 * px}, {0, 50 * px});
    EXPECT_EQ(rig.result.velocity.y(), 0) << kind;
    EXPECT_LT(rig.result.position.y(), -half_height);
    EXPECT_GE(rig.result.position.y(), -half_height - px);
    EXPECT_EQ(rig.result.contacts[0].normal, Vec2d(0, -1));
    EXPECT_EQ(rig.move({0, 0}, {0, -px}).position, Vec2d(0, -px)) << "around the chain: its feet meet nothing";
  }
  for (const std::string_view kind : {"wind_back", "penetration_resolution"}) {
    Rig<double> rig(kind, {chain({{-3, 0}, {3, 0}})});
    EXPECT_EQ(rig.move({0, half_height + px}, {0, -8 * px}).position, Vec2d(0, half_height - 7 * px)) << kind;
  }
}

TEST(TwoSidedChain, has_no_gap_where_its_segments_join) {
  Random random(11);
  for (const std::string_view kind : speculative_kinds) {
    for (int i = 0; i < 1000; ++i) {
      const Vec2d joint{random.between(-4, 4), random.between(-4, 4)};
      const std::vector<Vec2d> points{{-9, random.between(-5, 5)}, joint, {9, random.between(-5, 5)}};
      const std::array diamond{Vec2d{0, -0.5}, Vec2d{0.5, 0}, Vec2d{0, 0.5}, Vec2d{-0.5, 0}};
      Rig<double> rig(kind, {chain(points)}, {}, CharacterShape(diamond));
      const MoveResult<double>& result = rig.move({joint.x(), joint.y() + 1}, {0, -2});
      ASSERT_TRUE(result.grounded) << kind << ", seed 11, drop " << i;
      ASSERT_GE(result.position.y() - 0.5, joint.y());
    }
  }
}

}  // namespace
}  // namespace paperproof::article_tests
