/// What turns, as the judge sees it: an arm whose tip comes up to the feet on a straight line.
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;

/// An arm about (0, 0) whose tip, at x = 1, comes up by 0.1 m in a step. The feet are 0.8 m up.
class TurningArm : public testing::Test {
 protected:
  static TraceHeader with_arm(bool path_exact) {
    ColliderDef arm = chain({{0, 0}, {1, 0}});
    arm.mover = 0;
    TraceHeader made = path_exact ? promising({arm}) : header({arm}, false);
    made.turning = {true};
    return made;
  }
  static TraceStep from(double height, const std::vector<Vec2d>& path, double up = 0.1) {
    TraceStep made = step(path);
    made.movers = {{}};
    made.vertex_ways = {
        {.collider = 0, .instants = {0, 1}, .vertices = {{{0, 0}, {1, height}}, {{0, 0}, {1, height + up}}}}};
    return made;
  }
  static Contact<double> contact(double fraction) {
    return {.collider = 0, .point = {1, 0.8}, .normal = {0, 1}, .fraction = fraction};
  }

  TraceHeader header_ = with_arm(false);
  const Vec2d above_{1, 0.8 + 0.625};
};

TEST_F(TurningArm, that_comes_into_the_feet_is_an_exact_contact_at_the_root) {
  Judge judge(header_);
  EXPECT_TRUE(judge.judge(from(0.6, {above_, above_})).contacts.empty());
  TraceStep gives_way = from(0.75, {above_, above_ + Vec2d(0, 0.2)});
  gives_way.requested = {0, 0};
  const StepJudgement met = judge.judge(gives_way);
  ASSERT_EQ(met.contacts.size(), 1U) << "the wanted motion, none, is met; that it moved away is its answer";
  EXPECT_EQ(met.contacts[0].side, Side::bottom);
  EXPECT_NEAR(met.contacts[0].fraction, 0.5, 1e-9);
}

TEST_F(TurningArm, has_a_time_of_impact_error_where_its_contact_begins) {
  Judge judge(header_);
  // What turns goes on by the same rigid motion: in the second step the tip is turned on, from (1, 0.75) to about
  // (1 - 0.005, 0.845).
  TraceStep before = from(0.65, {above_, above_});
  before.contacts = {contact(0.25)};
  const StepJudgement early = judge.judge(before);
  ASSERT_TRUE(early.turning_toi_error);
  EXPECT_NEAR(*early.turning_toi_error, 1.5 - 0.25, 0.05);
  TraceStep on = from(0.75, {above_, above_});
  on.contacts = {contact(0)};
  EXPECT_FALSE(judge.judge(on).turning_toi_error) << "it goes on touching";
}

TEST_F(TurningArm, of_who_is_excused_nothing_the_first_contact_is_held_against_the_root) {
  Judge judge(with_arm(true));
  // It falls by 0.1 m in a step, the tip comes up by as much: 0.1 m are between them.
  TraceStep met = from(0.7, {{1, 0.8 + 0.625}, {1, 0.75 + 0.625 + 1e-7}, {1, 0.8 + 0.625 + 1e-7}});
  met.requested = {0, -0.1};
  met.contacts = {contact(0.5)};
  const StepJudgement judged = judge.judge(met);
  EXPECT_FALSE(judged.broke());
  EXPECT_TRUE(judged.undecided.empty());
  ASSERT_TRUE(judged.turning_toi_error);
  EXPECT_EQ(*judged.turning_toi_error, 0) << "1e-7 m are left, where 0.2 m in a step come closer";
  EXPECT_LE(judged.max_contact_gap, 1e-6);
  ASSERT_TRUE(judged.first_impact);
  EXPECT_NEAR(*judged.first_impact, 0.5, 1e-9);
  met.path = {{above_, 0}, {{1, 0.775 + 0.625}, 0.25}, {{1, 0.85 + 0.625}, 1}};
  met.contacts = {contact(0.25)};
  EXPECT_NEAR(Judge(with_arm(true)).judge(met).turning_toi_error.value_or(0), 0.25, 1e-9) << "said too early";
}

TEST_F(TurningArm, that_ends_in_the_octagon_counts_as_inside_with_its_depth) {
  for (const bool promises : {false, true}) {
    Judge judge(with_arm(promises));
    const StepJudgement entered = judge.judge(from(0.75, {above_, above_}));
    EXPECT_EQ(entered.end_overlap, Colliders{0});
    EXPECT_EQ(entered.entered, Colliders{0});
    EXPECT_NEAR(entered.max_penetration, 0.05, 1e-9) << "the tip is that far above the feet";
    const StepJudgement stays = judge.judge(from(0.85, {above_, above_}));
    EXPECT_EQ(stays.end_overlap, Colliders{0});
    EXPECT_TRUE(stays.entered.empty());
    EXPECT_FALSE(judge.judge(from(0.75, {above_, above_ + Vec2d(0, 1)})).broke()) << "it got out of the way";
    EXPECT_EQ(judge.judge(from(0.7 + 1e-12, {above_, above_})).entered, Colliders{0});
    EXPECT_FALSE(judge.judge(from(0.7 - 1e-12, {above_, above_})).broke());
  }
}

TEST_F(TurningArm, that_goes_through_the_octagon_in_one_step_is_a_passage) {
  for (const bool promises : {false, true}) {
    Judge judge(with_arm(promises));
    EXPECT_EQ(judge.judge(from(0, {above_, above_}, 3)).tunnelled, Colliders{0});
    EXPECT_TRUE(judge.judge(from(0, {above_, above_}, -3)).tunnelled.empty()) << "the other way there is nobody";
    const StepJudgement back = judge.judge(from(3, {above_, above_}, -3));
    EXPECT_EQ(back.tunnelled, Colliders{0});
    EXPECT_TRUE(back.entered.empty());
  }
}

TEST_F(TurningArm, whose_rim_alone_is_passed_is_a_cut_corner_only_for_who_is_excused_one) {
  // Its tip passes under the left foot and is 2 mm into it half-way.
  const auto cut = [&](bool promises) {
    Judge judge(with_arm(promises));
    TraceStep dip = from(0.8, {above_, above_}, 0);
    dip.vertex_ways[0].instants = {0, 0.5, 1};
    dip.vertex_ways[0].vertices = {{{0, 0}, {1, 0.7}}, {{0, 0}, {1, 0.802}}, {{0, 0}, {1, 0.7}}};
    return judge.judge(dip);
  };
  EXPECT_EQ(cut(true).tunnelled, Colliders{0});
  EXPECT_EQ(cut(false).corner_cut, Colliders{0});
}

TEST_F(TurningArm, that_is_said_to_crush_is_excused_only_where_there_is_no_room) {
  TraceStep pressed = from(0.75, {above_, above_});
  pressed.requested = {0, 0};
  pressed.crushed = {0};
  Judge judge(with_arm(true));
  const StepJudgement refuted = judge.judge(pressed);
  EXPECT_EQ(refuted.crushed_with_room, Colliders{0});
  EXPECT_EQ(refuted.entered, Colliders{0}) << "above it was room";
  TraceHeader whole = with_arm(true);
  whole.guarantees = every_clause();
  Judge once(whole);
  const StepJudgement told = once.judge(pressed);
  EXPECT_EQ(told.crushed_with_room, Colliders{0});
  EXPECT_TRUE(told.entered.empty()) << "of who promises `crush` one breach is said once";
  TraceHeader shaft = with_arm(true);
  // Walls and a ceiling around the octagon, less than 1e-7 m away.
  const double e = 0x1p-25;
  shaft.scenery.colliders.push_back(box(0, 0.8 + 1.25 + e, 2, 3));
  shaft.scenery.colliders.push_back(box(-1, 0.9, 1 - 0.3125 - e, 3));
  shaft.scenery.colliders.push_back(box(1 + 0.3125 + e, 0, 3, 3));
  shaft.ids = {"0", "1", "2", "3"};
  Judge narrow(shaft);
  const StepJudgement excused = narrow.judge(pressed);
  EXPECT_EQ(excused.crushed, Colliders{0});
  EXPECT_TRUE(excused.entered.empty());
  EXPECT_EQ(excused.pressed, Colliders{0});
  EXPECT_EQ(excused.max_penetration, 0);
  Judge unnamed(shaft);
  pressed.crushed.clear();
  EXPECT_EQ(unnamed.judge(pressed).entered, Colliders{0}) << "who does not name it is not excused";
  TraceStep still = from(0.85, {above_, above_}, 0);
  still.crushed = {0};
  Judge rests(shaft);
  EXPECT_EQ(rests.judge(still).crushed_with_room, Colliders{0}) << "what rests does not crush";
}

TEST_F(TurningArm, in_which_somebody_is_stuck_has_a_way_out_only_to_the_side_that_he_came_from) {
  Judge judge(with_arm(true));
  const auto stuck = [&](double height, double up) {
    TraceStep rests = from(height, {above_, above_}, up);
    rests.requested = {0, 0};
    rests.stuck = true;
    return judge.judge(rests).stuck_refuted;
  };
  EXPECT_TRUE(stuck(0.6, 0)) << "of nothing";
  EXPECT_EQ(judge.judge(from(0.75, {above_, above_})).entered, Colliders{0});
  EXPECT_TRUE(stuck(0.85, 0)) << "the tip is 5 cm in, and above it is room";
  EXPECT_TRUE(stuck(0.85, 1.15)) << "that is asked where the step begins";
  EXPECT_FALSE(stuck(2, 0)) << "the tip is 5 cm under its head: the shortest way out leads to the other side";
}

TEST_F(TurningArm, that_is_a_sensor_or_far_away_says_nothing) {
  header_.scenery.colliders[0].sensor = true;
  Judge sensor(header_);
  EXPECT_FALSE(sensor.judge(from(0.75, {above_, above_})).broke());
  header_.scenery.colliders[0].sensor = false;
  Judge judge(header_);
  const StepJudgement far = judge.judge(from(0.75, {{50, 0}, {50, 0}}));
  EXPECT_TRUE(far.contacts.empty());
  EXPECT_FALSE(far.broke());
}

TEST_F(TurningArm, that_touches_at_a_moment_no_halving_comes_to_is_decided_by_the_second_method_and_counted) {
  // In units of 0.15625 m: the lower corner of the octagon is at (1, -4), and the end of the arm there at 3/7, on a
  // line of slope -1/2 that the octagon lies above.
  const double unit = 0.15625;
  const auto arm = [&](const Vec2d& a, const Vec2d& b) { return std::vector<Vec2d>{a * unit, b * unit}; };
  Judge judge(with_arm(true));
  TraceStep passes = from(0, {Vec2d(2, 0) * unit, Vec2d(2, 0) * unit});
  passes.step = 8;
  passes.vertex_ways[0].vertices = {arm({7, -7}, {-1, -7}), arm({-7, 0}, {-7, -8})};
  const StepJudgement touched = judge.judge(passes);
  EXPECT_EQ(touched.undecided, Colliders{0});
  EXPECT_FALSE(touched.broke());
  EXPECT_TRUE(touched.methods_disagree.empty());
  for (PathPoint<double>& corner : passes.path) corner.position.y() -= 1e-9;
  const StepJudgement passed = Judge(with_arm(true)).judge(passes);
  EXPECT_EQ(passed.tunnelled, Colliders{0});
  EXPECT_TRUE(passed.undecided.empty());
  EXPECT_TRUE(passed.methods_disagree.empty());
}

TEST_F(TurningArm, of_which_a_step_has_no_way_is_refused) {
  Judge judge(header_);
  TraceStep none = from(0, {above_, above_});
  none.vertex_ways.clear();
  EXPECT_THROW((void)judge.judge(none), std::invalid_argument);
}

TEST(TurningFrame, with_a_concave_outline_and_a_hole_is_judged_by_its_parts) {
  // A frame of 4 m around the octagon, turned by chords of a tenth of a radian about its middle: it is all inside of
  // the hole, until it is too near to the frame's side.
  ColliderDef frame = box(-2, -2, 2, 2);
  frame.holes = {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}};
  frame.mover = 0;
  TraceHeader made = promising({frame});
  made.turning = {true};
  const auto turned = [&](const Vec2d& at) {
    TraceStep one = step({at, at});
    one.movers = {{}};
    VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{}, {}}};
    for (const auto& ring : {frame.points, frame.holes[0]})
      for (const Vec2d& v : ring) {
        way.vertices[0].push_back(v);
        way.vertices[1].push_back(v + 0.1 * Vec2d(-v.y(), v.x()));
      }
    one.vertex_ways = {way};
    return one;
  };
  EXPECT_FALSE(Judge(made).judge(turned({0, 0})).broke());
  EXPECT_EQ(Judge(made).judge(turned({0.68, 0})).entered, Colliders{0});
  EXPECT_EQ(Judge(made).judge(turned({1.5, 0})).end_overlap, Colliders{0}) << "within the frame itself";
}

}  // namespace
}  // namespace paperproof::compare
