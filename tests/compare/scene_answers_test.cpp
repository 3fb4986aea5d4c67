/// The exact answers of the registered scenes: octagon_sweep meets them, and a run which does something else does not.
/// known_and_open_test.py asks the same of octagon_sweep in the scenes that take long.
#include "compare/moments.hpp"
#include "compare/scene_runs.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

constexpr int most_steps = 20'000;

/// A scene that rests for a million steps does so for fewer here.
Scene shortened(const std::string& name) {
  Scene scene = built_in(name);
  scene.steps = std::min(scene.steps, most_steps);
  return scene;
}

/// All steps of octagon_sweep in double, and its row.
ReportScene ran(const Scene& scene) { return run_scene(scene, alone("octagon_sweep", most_steps)); }

std::vector<TraceStep> steps_of_all(const ReportRun& run) {
  std::vector<TraceStep> all = run.steps;
  for (const std::vector<TraceStep>& other : run.others) all.insert(all.end(), other.begin(), other.end());
  return all;
}

TEST(Answers, ask_of_steps_that_the_run_has) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    const Scene scene = built_in(entry.name);
    for (const Answer& answer : scene.answers) EXPECT_LT(answer.step, scene.steps) << entry.name;
  }
}

// What a step says in a run that does something else.
void move_off(TraceStep& step, double sign) {
  const Vec2d off = sign * 1000 * (1 + step.step) * Vec2d(1, 0.3);
  for (PathPoint& corner : step.path) corner.position += off;
  step.velocity += off;
}
void keep_silent(TraceStep& step) {
  step.contacts.clear();
  step.met.clear();
  step.crushed.clear();
  step.sensors.clear();
}
/// Everything is met and crushes as soon as the run begins.
void cry_out(TraceStep& step, std::size_t colliders) {
  for (ColliderIndex collider = 0; step.step == 0 && collider < colliders; ++collider) {
    step.contacts.push_back({.collider = collider, .fraction = 0, .side = Side::bottom});
    step.crushed.push_back(collider);
  }
}
void hang(TraceStep& step, const Vec2d& start) {
  step.grounded = false;
  for (PathPoint& corner : step.path) corner.position = start;
}

TEST(Answers, are_met_by_octagon_sweep_and_each_missed_by_a_run_that_does_something_else) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    const std::string name(entry.name);
    if (name == "crush70") continue;  // its only step takes ten seconds
    const Scene scene = shortened(name);
    if (scene.others.size() > 2) continue;
    const ReportScene result = ran(scene);
    const Row& row = result.rows.front();
    ASSERT_TRUE(row.answer_ok && row.answer_error) << name;
    EXPECT_TRUE(*row.answer_ok) << name << ": " << row.answer;
    if (name.starts_with("tiles_") || name.starts_with("replica_1e")) {
      EXPECT_EQ(row.verdict, Verdict::holds) << name << ": " << row.reason;
    }
    const ReportRun& run = result.runs.at(0);
    const std::vector<TraceStep> all = steps_of_all(run);
    std::vector<std::vector<TraceStep>> spoilt(7, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      move_off(spoilt[0][i], 1);
      move_off(spoilt[1][i], -1);
      keep_silent(spoilt[2][i]);
      cry_out(spoilt[3][i], scene.ids.size());
      hang(spoilt[4][i], all.front().path.front().position);
      spoilt[5][i].grounded = all[i].step % 2 == 0;
      spoilt[6][i].grounded = true;
    }
    for (const Answer& answer : scene.answers) {
      const bool missed = std::any_of(spoilt.begin(), spoilt.end(), [&](const std::vector<TraceStep>& steps) {
        return answered({answer}, steps, run.header).answer_ok == false;
      });
      EXPECT_TRUE(missed) << name << ", answer " << (&answer - scene.answers.data());
    }
  }
}

/// At random among each other, they come to the walls, the floor and the ceiling.
TEST(Answers, of_a_room_are_as_narrow_as_the_room) {
  const Scene scene = built_in("crowd");
  const ReportRun run = ran(scene).runs.at(0);
  const std::vector<TraceStep> all = steps_of_all(run);
  for (Answer answer : scene.answers) {
    answer.at_most -= 1e-3;
    EXPECT_EQ(answered({answer}, all, run.header).answer_ok, false) << answer.along.transpose();
  }
}

}  // namespace
}  // namespace paperproof::compare
