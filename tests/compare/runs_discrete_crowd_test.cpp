/// Runs of several characters by `discrete`: what its law makes of the scenes, and what the judge says of that.
#include "compare/scene_runs.hpp"
#include "runs/crowd_contestant.hpp"
#include "runs/input_cursor.hpp"
#include "runs/technique_contestant.hpp"
#include "scenes/built_in.hpp"
#include "support/steps_wanted.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

struct DiscreteRan {
  Row row;
  ReportRun run;
  [[nodiscard]] const TraceStep& at(std::size_t step, std::size_t character) const {
    return character == 0 ? run.steps.at(step) : run.others.at(character - 1).at(step);
  }
  [[nodiscard]] double end(std::size_t step, std::size_t character) const {
    return at(step, character).path.back().position.x();
  }
};

DiscreteRan ran_by_discrete(const Scene& scene) {
  RunOptions options = quick();
  options.contenders = {"discrete"};
  options.reference = false;
  options.max_replay_steps = scene.steps;
  const ReportScene result = run_scene(scene, options);
  return {row_of(result, "discrete"), run_of(result, "discrete")};
}

Scene head_on_at(double v1, double v2) {
  Scene scene = built_in("characters_head_on");
  scene.start.velocity.x() = v1;
  scene.others[0].start.velocity.x() = -v2;
  scene.answers.clear();  // those are for other speeds
  return scene;
}

TEST(DiscreteCharactersHeadOn, meet_when_the_gap_is_closed_and_go_on_with_the_mean_of_their_velocities) {
  const double v1 = 30;
  const double v2 = 18;
  const DiscreteRan run = ran_by_discrete(head_on_at(v1, v2));
  const double steps = 2 / (v1 + v2) * 60;
  const auto meeting = static_cast<std::size_t>(steps);
  EXPECT_EQ(run.row.verdict, Verdict::holds) << run.row.reason;
  EXPECT_EQ(run.row.first_contact_step, static_cast<int>(meeting));
  ASSERT_TRUE(run.row.first_contact_fraction && run.row.toi_error_max);
  EXPECT_NEAR(*run.row.first_contact_fraction, steps - std::floor(steps), 1e-12);
  EXPECT_LE(*run.row.toi_error_max, 1e-12);
  // Each is pushed back by half of what they would overlap, and half of the gap; from then on both go at the mean.
  const double now = static_cast<double>(meeting + 1) / 60;
  const double overlap = (v1 + v2) * now - 2;
  const double mean = (v1 - v2) / 2;
  for (const std::size_t step : {meeting, std::size_t{29}}) {
    const double since = static_cast<double>(step - meeting) / 60;
    EXPECT_NEAR(run.end(step, 0), v1 * now - overlap / 2 + mean * since, 1e-6) << step;
    EXPECT_NEAR(run.end(step, 1), 2 * half_width + 2 - v2 * now + overlap / 2 + mean * since, 1e-6) << step;
    for (const std::size_t k : {0U, 1U}) EXPECT_NEAR(run.at(step, k).velocity.x(), mean, 1e-12) << step;
  }
  ASSERT_EQ(run.at(meeting, 0).met.size(), 1U);
  EXPECT_EQ(run.at(meeting, 0).met[0].other, 1U);
  EXPECT_EQ(run.at(meeting, 1).met[0].side, Side::left);
  EXPECT_TRUE(run.at(meeting + 1, 0).met.empty()) << "they no longer come nearer";
}

TEST(DiscreteCharactersHeadOn, pass_where_a_step_takes_them_beyond_each_other_and_the_judge_says_so) {
  // Apart at both ends of the step: 2 m and both widths. A tenth of a metre less, and they are expected to overlap.
  const double passing = (2 + 4 * half_width) * 60;
  const DiscreteRan slower = ran_by_discrete(head_on_at(passing - 66, 60));
  EXPECT_EQ(slower.row.verdict, Verdict::holds) << slower.row.reason;
  EXPECT_EQ(slower.row.first_contact_step, 0);
  const DiscreteRan faster = ran_by_discrete(head_on_at(passing - 54, 60));
  EXPECT_EQ(faster.row.verdict, Verdict::tunnels);
  EXPECT_EQ(faster.row.tunnels, 1);
  EXPECT_TRUE(holds(faster.row.reason, "character 1")) << faster.row.reason;
  EXPECT_FALSE(faster.row.first_contact_step);
  EXPECT_GT(faster.end(0, 0), faster.end(0, 1));
}

TEST(DiscreteThreeInARow, are_one_island_and_hand_their_momentum_on) {
  const DiscreteRan run = ran_by_discrete(built_in("three_in_a_row"));
  EXPECT_NEAR(run.at(0, 1).met[0].fraction, 0.05 / (6.0 / 60), 1e-12) << "the last two meet first";
  for (const std::size_t step : {0U, 29U}) {
    double momentum = 0;
    for (const std::size_t k : {0U, 1U, 2U}) momentum += run.at(step, k).velocity.x();
    EXPECT_NEAR(momentum, 24 + 6, 1e-12) << step;
  }
  EXPECT_GT(run.at(29, 2).velocity.x(), 0) << "who stood is pushed";
}

TEST(DiscreteCrowdOf16, runs_through_and_everyone_meets_others) {
  Scene scene = built_in("crowd_of_16");
  const int steps = scene.steps = test::sampled(scene.steps);
  scene.answers.clear();  // those are for all steps
  const DiscreteRan run = ran_by_discrete(scene);
  EXPECT_EQ(run.row.steps, steps);
  EXPECT_EQ(run.row.characters, 16);
  EXPECT_NE(run.row.verdict, Verdict::failed) << run.row.reason;
  for (std::size_t k = 0; k < 16; ++k) {
    int met = 0;
    for (int step = 0; step < steps; ++step) {
      const TraceStep& at = run.at(static_cast<std::size_t>(step), k);
      ASSERT_TRUE(at.path.back().position.allFinite());
      met += static_cast<int>(at.met.size());
    }
    EXPECT_GT(met, steps / 20) << k;
  }
}

/// Every bit of a step but the numbers of its character.
void expect_same(const TraceStep& a, const TraceStep& b, const std::string& where) {
  ASSERT_EQ(a.path.size(), b.path.size()) << where;
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    ASSERT_EQ(a.path[i].position, b.path[i].position) << where;
    ASSERT_EQ(a.path[i].fraction, b.path[i].fraction) << where;
  }
  ASSERT_EQ(a.velocity, b.velocity) << where;
  ASSERT_EQ(a.requested, b.requested) << where;
  ASSERT_EQ(a.grounded, b.grounded) << where;
  ASSERT_EQ(a.crushed, b.crushed) << where;
  ASSERT_EQ(a.dropped_through, b.dropped_through) << where;
  ASSERT_EQ(a.sensors.size(), b.sensors.size()) << where;
  ASSERT_EQ(a.contacts.size(), b.contacts.size()) << where;
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    ASSERT_EQ(a.contacts[i].collider, b.contacts[i].collider) << where;
    ASSERT_EQ(a.contacts[i].point, b.contacts[i].point) << where;
    ASSERT_EQ(a.contacts[i].normal, b.contacts[i].normal) << where;
    ASSERT_EQ(a.contacts[i].fraction, b.contacts[i].fraction) << where;
    ASSERT_EQ(a.contacts[i].separation, b.contacts[i].separation) << where;
  }
}

TEST(DiscreteCrowdOfOne, has_the_bits_of_the_run_of_one_character) {
  const TechniqueEntry& discrete = *find_technique("discrete");
  for (const char* name : {"article_bullet", "slope_joints", "jump_into_corner", "flush_tiles", "lift_sideways",
                           "closing_ceiling", "one_way_lift_drop", "thin_sensor", "sweeping_paper"}) {
    const Scene scene = built_in(name);
    const Scenery<double> scenery(scene.scenery);
    const auto alone = make_technique_contestant(discrete, ScalarKind::binary64, scene, scenery, {});
    const auto one = make_crowd_contestant(discrete, ScalarKind::binary64, scene, scenery, {});
    const Script script = script_of(scene);
    InputCursor cursor(scene, script);
    std::vector<TraceStep> of_alone(1);
    std::vector<TraceStep> of_one(1);
    for (int step = 0; step < scene.steps; ++step) {
      const StepInput input = cursor.at(step);
      alone->step(input, of_alone);
      one->step(input, of_one);
      expect_same(of_one[0], of_alone[0], name + (", step " + std::to_string(step)));
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace paperproof::compare
