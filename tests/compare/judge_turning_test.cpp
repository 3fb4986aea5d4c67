/// What turns, as the judge sees it: an arm whose tip comes up to the feet on a straight line.
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

/// An arm about (0, 0) whose tip is at x = 1. The feet are 0.8 m up.
TraceHeader with_arm(bool promises) {
  const ColliderDef arm = chain({{0, 0}, {1, 0}}, 0);
  TraceHeader made = promises ? promising({arm}) : header({arm}, false);
  made.turning = {true};
  return made;
}
const Vec2d above(1, 0.8 + half_height);
const std::vector<Vec2d> stays{above, above};

/// The tip comes up from a height.
TraceStep from(double height, const std::vector<Vec2d>& path = stays, double up = 0.1) {
  TraceStep made = among(step(path), {{}});
  made.vertex_ways = {
      {.collider = 0, .instants = {0, 1}, .vertices = {{{0, 0}, {1, height}}, {{0, 0}, {1, height + up}}}}};
  return made;
}
Contact touch(double fraction) { return {.collider = 0, .point = {1, 0.8}, .normal = {0, 1}, .fraction = fraction}; }

TEST(TurningArm, is_inside_of_or_passes_the_octagon_as_exactly_as_what_stands) {
  const std::vector<std::pair<TraceStep, const char*>> story{
      {from(0.75), "inside 0, entered 0"},
      {from(0.85), "inside 0"},
      {from(0.75, {above, above + Vec2d(0, 1)}), ""},  // it gets out of the way
      {from(0.7 + 1e-12), "inside 0, entered 0"},
      {from(0.7 - 1e-12), ""},
      {from(0, stays, 3), "tunnelled 0"},
      {from(0, stays, -3), ""},  // the other way there is nobody
      {from(3, stays, -3), "tunnelled 0"},
      {from(0.75, {{50, 0}, {50, 0}}), ""},
  };
  // Its tip passes under the left foot and is 2 mm into it half-way.
  TraceStep dip = from(0.8);
  dip.vertex_ways[0].instants = {0, 0.5, 1};
  dip.vertex_ways[0].vertices = {{{0, 0}, {1, 0.7}}, {{0, 0}, {1, 0.802}}, {{0, 0}, {1, 0.7}}};
  for (const bool promises : {false, true}) {
    Judge judge(with_arm(promises));
    for (std::size_t i = 0; i < story.size(); ++i) EXPECT_EQ(told(judge.judge(story[i].first)), story[i].second) << i;
    EXPECT_NEAR(judged(with_arm(promises), from(0.75)).max_penetration, 0.05, 1e-9) << "so far above the feet";
    EXPECT_EQ(told(judged(with_arm(promises), dip)), promises ? "tunnelled 0" : "clipped 0");
    TraceHeader sensor = with_arm(promises);
    sensor.scenery.colliders[0].sensor = true;
    EXPECT_EQ(told(judged(sensor, from(0.75))), "");
  }
  EXPECT_TRUE(judged(with_arm(false), story.back().first).contacts.empty()) << "far away";
  dip.vertex_ways.clear();
  EXPECT_THROW((void)judged(with_arm(false), dip), std::invalid_argument) << "it has no way";
}

TEST(TurningArm, that_comes_into_the_feet_is_an_exact_contact_at_the_root) {
  EXPECT_TRUE(judged(with_arm(false), from(0.6)).contacts.empty());
  TraceStep gives_way = from(0.75, {above, above + Vec2d(0, 0.2)});
  gives_way.requested = {0, 0};
  const StepJudgement met = judged(with_arm(false), gives_way);
  EXPECT_EQ(demanded(met), (Touches{{0, Side::bottom}})) << "that it moved away is its answer";
  EXPECT_NEAR(met.contacts.at(0).fraction, 0.5, 1e-9);
}

TEST(TurningArm, has_a_time_of_impact_error_where_its_contact_begins) {
  Judge judge(with_arm(false));
  // What turns goes on by the same rigid motion: in the second step the tip is turned on, from (1, 0.75) to about
  // (1 - 0.005, 0.845).
  TraceStep before = from(0.65);
  before.contacts = {touch(0.25)};
  EXPECT_NEAR(judge.judge(before).turning_toi_error.value_or(0), 1.5 - 0.25, 0.05);
  TraceStep on = from(0.75);
  on.contacts = {touch(0)};
  EXPECT_FALSE(judge.judge(on).turning_toi_error) << "it goes on touching";
}

TEST(TurningArm, of_who_is_excused_nothing_the_first_contact_is_held_against_the_root) {
  // It falls by 0.1 m in a step, the tip comes up by as much: 0.1 m are between them.
  TraceStep met = from(0.7, {above, above - Vec2d(0, 0.05 - 1e-7), above + Vec2d(0, 1e-7)});
  met.requested = {0, -0.1};
  met.contacts = {touch(0.5)};
  const StepJudgement one = judged(with_arm(true), met);
  EXPECT_EQ(told(one), "");
  EXPECT_TRUE(one.undecided.empty());
  EXPECT_EQ(one.turning_toi_error, 0) << "1e-7 m are left, where 0.2 m in a step come closer";
  EXPECT_LE(one.max_contact_gap, 1e-6);
  EXPECT_NEAR(one.first_impact.value_or(0), 0.5, 1e-9);
  met.path = {{above, 0}, {above - Vec2d(0, 0.025), 0.25}, {above + Vec2d(0, 0.05), 1}};
  met.contacts = {touch(0.25)};
  EXPECT_NEAR(judged(with_arm(true), met).turning_toi_error.value_or(0), 0.25, 1e-9) << "said too early";
}

TEST(TurningArm, that_is_said_to_crush_is_excused_only_where_there_is_no_room) {
  TraceStep pressed = from(0.75);
  pressed.crushed = {0};
  EXPECT_EQ(told(judged(with_arm(true), pressed)), "inside 0, entered 0, crushed with room 0") << "above it is room";
  TraceHeader whole = with_arm(true);
  whole.guarantees = every_clause();
  EXPECT_EQ(told(judged(whole, pressed)), "inside 0, pressed 0, crushed with room 0") << "one breach is said once";
  // Walls and a ceiling around the octagon, less than 1e-7 m away.
  TraceHeader shaft = with_arm(true);
  const double e = 0x1p-25;
  for (const ColliderDef& solid :
       {box(0, 0.8 + 1.25 + e, 2, 3), box(-1, 0.9, 1 - half_width - e, 3), box(1 + half_width + e, 0, 3, 3)})
    add(shaft, solid);
  EXPECT_EQ(told(judged(shaft, pressed)), "inside 0, pressed 0, crushed 0");
  EXPECT_EQ(judged(shaft, pressed).max_penetration, 0);
  pressed.crushed.clear();
  EXPECT_EQ(told(judged(shaft, pressed)), "inside 0, entered 0") << "who does not name it is not excused";
  TraceStep still = from(0.85, stays, 0);
  still.crushed = {0};
  EXPECT_EQ(told(judged(shaft, still)), "inside 0, crushed with room 0") << "what rests does not crush";
}

TEST(TurningArm, in_which_somebody_is_stuck_has_a_way_out_only_to_the_side_that_he_came_from) {
  Judge judge(with_arm(true));
  const auto is_refuted = [&](double height, double up) {
    TraceStep rests = from(height, stays, up);
    rests.stuck = true;
    return judge.judge(rests).stuck_refuted;
  };
  EXPECT_TRUE(is_refuted(0.6, 0)) << "of nothing";
  EXPECT_EQ(told(judge.judge(from(0.75))), "inside 0, entered 0");
  EXPECT_TRUE(is_refuted(0.85, 0)) << "the tip is 5 cm in, and above it is room";
  EXPECT_TRUE(is_refuted(0.85, 1.15)) << "that is asked where the step begins";
  EXPECT_FALSE(is_refuted(2, 0)) << "the tip is 5 cm under its head: the shortest way out leads to the other side";
}

TEST(TurningArm, that_touches_at_a_moment_no_halving_comes_to_is_decided_by_the_second_method_and_counted) {
  // In units of 0.15625 m: the lower corner of the octagon is at (1, -4), and the end of the arm there at 3/7, on a
  // line of slope -1/2 that the octagon lies above.
  const double unit = 0.15625;
  for (const double lower : {0.0, 1e-9}) {
    const Vec2d at(2 * unit, -lower);
    TraceStep passes = from(0, {at, at});
    passes.step = 8;
    passes.vertex_ways[0].vertices = {{Vec2d(7, -7) * unit, Vec2d(-1, -7) * unit},
                                      {Vec2d(-7, 0) * unit, Vec2d(-7, -8) * unit}};
    const StepJudgement one = judged(with_arm(true), passes);
    EXPECT_EQ(told(one), lower > 0 ? "tunnelled 0" : "");
    EXPECT_EQ(one.undecided, lower > 0 ? Colliders{} : Colliders{0});
    EXPECT_TRUE(one.methods_disagree.empty());
  }
}

TEST(TurningFrame, with_a_concave_outline_and_a_hole_is_judged_by_its_parts) {
  // A frame of 4 m around the octagon, turned by a chord of a tenth of a radian about its middle: it is all inside of
  // the hole, until it is too near to the frame's side.
  ColliderDef frame = box(-2, -2, 2, 2, 0);
  frame.holes = {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}};
  TraceHeader made = promising({frame});
  made.turning = {true};
  VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {frame.points, {}}};
  way.vertices[0].insert(way.vertices[0].end(), frame.holes[0].begin(), frame.holes[0].end());
  for (const Vec2d& v : way.vertices[0]) way.vertices[1].push_back(v + 0.1 * Vec2d(-v.y(), v.x()));
  for (const auto& [x, expected] : {std::pair{0.0, ""}, {0.68, "inside 0, entered 0"}, {1.5, "inside 0"}}) {
    TraceStep one = among(step({{x, 0}, {x, 0}}), {{}});
    one.vertex_ways = {way};
    EXPECT_EQ(told(judged(made, one)), expected) << x;
  }
}

}  // namespace
}  // namespace paperproof::compare::test
