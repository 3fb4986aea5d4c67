/// What turns, as the judge sees it: against the closed form of an arm whose tip meets the feet.
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;

/// An arm of one metre about (0, 0), horizontal at angle 0, that turns by 0.1 in a step. Feet at height 0.8 above
/// (0.6, 0) are met by its tip at the angle asin 0.8.
class TurningArm : public testing::Test {
 protected:
  TurningArm() : header_(header({arm()}, false)) { header_.turning = {true}; }

  static ColliderDef arm() {
    ColliderDef def = chain({{0, 0}, {1, 0}});
    def.mover = 0;
    return def;
  }
  static TraceStep at(double angle, const std::vector<Vec2d>& path) {
    TraceStep made = step(path);
    made.movers = {{}};
    made.turns = {{angle, angle + 0.1}};
    return made;
  }
  static Contact<double> contact(double fraction) {
    return {.collider = 0, .point = {0.6, 0.8}, .normal = {0, 1}, .fraction = fraction};
  }

  TraceHeader header_;
  const Vec2d above_{0.6, 0.8 + 0.625};
  const double root_ = std::asin(0.8);
};

TEST_F(TurningArm, that_comes_into_the_feet_is_an_exact_contact_at_the_root) {
  Judge judge(header_);
  EXPECT_TRUE(judge.judge(at(0.7, {above_, above_})).contacts.empty());
  TraceStep gives_way = at(0.9, {above_, above_ + Vec2d(0, 0.2)});
  gives_way.requested = {0, 0};
  const StepJudgement met = judge.judge(gives_way);
  ASSERT_EQ(met.contacts.size(), 1U) << "the wanted motion, none, is met; that it moved away is its answer";
  EXPECT_EQ(met.contacts[0].side, Side::bottom);
  EXPECT_NEAR(met.contacts[0].fraction, (root_ - 0.9) / 0.1, 1e-8);
}

TEST_F(TurningArm, has_a_time_of_impact_error_where_its_contact_begins) {
  Judge judge(header_);
  TraceStep before = at(0.8, {above_, above_});
  before.contacts = {contact(0.25)};
  const double ahead = (root_ - 0.8) / 0.1;  // in steps from where this one begins: the next step has it
  const StepJudgement early = judge.judge(before);
  ASSERT_TRUE(early.turning_toi_error);
  EXPECT_NEAR(*early.turning_toi_error, ahead - 0.25, 1e-8);
  TraceStep on = at(0.9, {above_, above_});
  on.contacts = {contact(0)};
  EXPECT_FALSE(judge.judge(on).turning_toi_error) << "it goes on touching";
}

TEST_F(TurningArm, that_ends_in_the_octagon_counts_as_inside_with_its_depth) {
  Judge judge(header_);
  const StepJudgement entered = judge.judge(at(0.9, {above_, above_}));
  EXPECT_EQ(entered.end_overlap, Colliders{0});
  EXPECT_EQ(entered.entered, Colliders{0});
  EXPECT_NEAR(entered.max_penetration, std::sin(1.0) - 0.8, 0.01) << "the tip is that far above the feet";
  const StepJudgement stays = judge.judge(at(1.0, {above_, above_}));
  EXPECT_EQ(stays.end_overlap, Colliders{0});
  EXPECT_TRUE(stays.entered.empty());
  EXPECT_FALSE(judge.judge(at(0.9, {above_, above_ + Vec2d(0, 1)})).broke()) << "it got out of the way";
}

TEST_F(TurningArm, that_goes_through_the_octagon_in_one_step_is_a_passage) {
  Judge judge(header_);
  TraceStep sweep = at(0, {above_, above_});
  sweep.turns = {{0, 3}};
  EXPECT_EQ(judge.judge(sweep).tunnelled, Colliders{0});
  sweep.turns = {{0, -3}};
  EXPECT_TRUE(judge.judge(sweep).tunnelled.empty()) << "the other way round there is nobody";
}

TEST_F(TurningArm, that_is_a_sensor_or_far_away_says_nothing) {
  header_.scenery.colliders[0].sensor = true;
  Judge sensor(header_);
  EXPECT_FALSE(sensor.judge(at(0.9, {above_, above_})).broke());
  header_.scenery.colliders[0].sensor = false;
  Judge judge(header_);
  const StepJudgement far = judge.judge(at(0.9, {{50, 0}, {50, 0}}));
  EXPECT_TRUE(far.contacts.empty());
  EXPECT_FALSE(far.broke());
}

}  // namespace
}  // namespace paperproof::compare
