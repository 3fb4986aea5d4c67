/// The exact answers of the registered scenes: that all have some, that octagon_sweep meets them, that a run which does
/// something else does not; and what is between several scenes.
#include "compare/scene_runs.hpp"

#include "metrics/answers.hpp"
#include "support/steps_wanted.hpp"

#include <cmath>

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
struct Ran {
  Row row;
  ReportRun run;
};

Ran ran(const Scene& scene) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  options.max_replay_steps = most_steps;
  ReportScene result = run_scene(scene, options);
  return {result.rows.front(), result.runs.empty() ? ReportRun() : std::move(result.runs.front())};
}

Ran ran(const std::string& name) {
  Ran all = ran(built_in(name));
  EXPECT_EQ(all.row.verdict, Verdict::holds) << name << ": " << all.row.reason;
  return all;
}

bool turns(const Scene& scene) {
  return std::any_of(scene.movers.begin(), scene.movers.end(),
                     [](const MoverDef& mover) { return !mover.turns.empty(); });
}

TEST(Answers, are_of_every_registered_scene) {
  for (const BuiltInScene& entry : built_in_scenes()) EXPECT_FALSE(built_in(entry.name).answers.empty()) << entry.name;
}

TEST(Answers, are_met_by_octagon_sweep_in_every_registered_scene) {
  for (const BuiltInScene& entry : paperproof::test::sampled_of(built_in_scenes())) {
    const Scene scene = shortened(entry.name);
    const Row row = ran(scene).row;
    ASSERT_TRUE(row.answer_ok && row.answer_error) << entry.name;
    EXPECT_TRUE(*row.answer_ok) << entry.name << ": " << row.answer;
  }
}

TEST(Answers, are_met_by_box2d_too_where_something_turns) {
  RunOptions options = quick();
  options.contenders = {"box2d", "box2d_pieces"};
  for (const BuiltInScene& entry : built_in_scenes()) {
    const Scene scene = shortened(entry.name);
    if (!turns(scene)) continue;
    for (const Row& row : run_scene(scene, options).rows)
      EXPECT_EQ(row.answer_ok, true) << entry.name << ", " << row.contender << ": " << row.answer;
  }
}

/// Characters that move off ever faster, one way or the other.
void run_away(std::vector<TraceStep>& steps, double sign) {
  for (TraceStep& step : steps) {
    const Vec2d off = sign * 1000 * (1 + step.step) * Vec2d(1, 0.3);
    for (PathPoint<double>& corner : step.path) corner.position += off;
    step.velocity += off;
  }
}

/// Nothing is met, entered or crushing.
void keep_silent(std::vector<TraceStep>& steps) {
  for (TraceStep& step : steps) {
    step.contacts.clear();
    step.met.clear();
    step.crushed.clear();
    step.sensors.clear();
  }
}

/// Everything is met and crushes as soon as the run begins.
void cry_out(std::vector<TraceStep>& steps, std::size_t colliders) {
  for (TraceStep& step : steps) {
    if (step.step > 0) continue;
    for (ColliderIndex collider = 0; collider < colliders; ++collider) {
      step.contacts.push_back({.collider = collider, .fraction = 0, .side = Side::bottom});
      step.crushed.push_back(collider);
    }
  }
}

/// Nothing is ever stood on, and nobody moves.
void hang(std::vector<TraceStep>& steps) {
  for (TraceStep& step : steps) {
    step.grounded = false;
    for (PathPoint<double>& corner : step.path) corner.position = steps.front().path.front().position;
  }
}

/// Always on the ground.
void stand(std::vector<TraceStep>& steps) {
  for (TraceStep& step : steps) step.grounded = true;
}

/// Is and is not grounded in turn, where it was before.
void toggle(std::vector<TraceStep>& steps) {
  for (TraceStep& step : steps) step.grounded = step.step % 2 == 0;
}

TEST(Answers, are_each_missed_by_a_run_that_does_something_else) {
  for (const BuiltInScene& entry : paperproof::test::sampled_of(built_in_scenes())) {
    const Scene scene = shortened(entry.name);
    if (scene.others.size() > 2) continue;
    const ReportRun run = ran(scene).run;
    std::vector<std::vector<TraceStep>> spoilt(7, run.steps);
    for (const std::vector<TraceStep>& other : run.others)
      for (std::vector<TraceStep>& all : spoilt) all.insert(all.end(), other.begin(), other.end());
    run_away(spoilt[0], 1);
    run_away(spoilt[1], -1);
    keep_silent(spoilt[2]);
    cry_out(spoilt[3], scene.ids.size());
    hang(spoilt[4]);
    toggle(spoilt[5]);
    stand(spoilt[6]);
    for (const Answer& answer : scene.answers) {
      const bool missed = std::any_of(spoilt.begin(), spoilt.end(), [&](const std::vector<TraceStep>& steps) {
        AnswerCheck check({answer}, run.header);
        for (const TraceStep& step : steps) check.add(step);
        Row row;
        check.write(row);
        return row.answer_ok == false;
      });
      EXPECT_TRUE(missed) << entry.name << ", answer " << (&answer - scene.answers.data());
    }
  }
}

TEST(Answers, are_absent_where_an_option_changes_the_scene) {
  const Scene scene = built_in("flush_tiles");
  const auto has_answer = [&](const auto& change) {
    RunOptions options = quick();
    options.contenders = {"octagon_sweep"};
    change(options);
    const ReportScene result = run_scene(scene, options);
    EXPECT_EQ(row_of(result, "octagon_sweep").answer_ok.has_value(),
              row_of(result, "octagon_sweep").answer_error.has_value());
    return row_of(result, "octagon_sweep").answer_ok.has_value();
  };
  EXPECT_TRUE(has_answer([](RunOptions&) {}));
  EXPECT_TRUE(has_answer([&](RunOptions& options) { options.steps = scene.steps; })) << "as many as it has";
  EXPECT_FALSE(has_answer([](RunOptions& options) { options.steps = 10; }));
  EXPECT_FALSE(has_answer([](RunOptions& options) { options.random_input = 1; }));
  EXPECT_FALSE(has_answer([](RunOptions& options) { options.mode = Mode::lockstep; }));
}

TEST(Answers, that_are_wrong_flag_the_run_and_say_what_is_wrong) {
  RunOptions options = quick();
  options.contenders = {"wind_back"};
  const ReportScene result = run_scene(built_in("flush_tiles"), options);
  const Row& row = row_of(result, "wind_back");
  EXPECT_EQ(row.verdict, Verdict::flagged);
  EXPECT_TRUE(holds(row.reason, "answer: stands at x = ")) << row.reason;
  EXPECT_GT(row.answer_error.value_or(0), 30) << "it stands still at the first seam of 37 m";
  EXPECT_EQ(row.answer_ok, false);
  EXPECT_EQ(row_of(result, "box2d").answer_ok, true);
}

TEST(UnevenSteps, are_the_same_for_the_twin) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.max_replay_steps = 1000;
  const ReportScene result = run_scene(built_in("uneven_lift"), options);
  const ReportRun& twin = run_of(result, "box2d");
  const ReportRun& mine = run_of(result, "octagon_sweep");
  ASSERT_EQ(twin.steps.size(), mine.steps.size());
  for (std::size_t i = 0; i < twin.steps.size(); ++i) {
    EXPECT_EQ(twin.steps[i].dt, mine.steps[i].dt) << i;
    EXPECT_LE((twin.steps[i].movers[0].to - mine.steps[i].movers[0].to).norm(), 2e-6) << i;
    if (i > 60) {
      EXPECT_TRUE(twin.steps[i].grounded) << i;
    }
  }
}

TEST(Tiles, far_away_change_nothing) {
  const Ran few = ran("tiles_1e2");
  for (const char* name : {"tiles_1e3", paperproof::test::sanitized ? "tiles_1e3" : "tiles_1e4"}) {
    const Ran more = ran(name);
    for (std::size_t i = 0; i < few.run.steps.size(); ++i)
      ASSERT_EQ(more.run.steps[i].path.back().position, few.run.steps[i].path.back().position)
          << name << ", step " << i;
  }
}

TEST(SensorGate, stops_no_contender_and_is_entered_and_left_once_by_all) {
  const ReportScene result = run_scene(built_in("sensor_gate"), quick());
  ASSERT_EQ(result.rows.size(), contender_names().size());
  for (const Row& row : result.rows) {
    // The bounding box stops at the wall, and gives the end of the step as the time.
    const bool late = row.contender == "bounding_box";
    EXPECT_EQ(row.verdict, late ? Verdict::flagged : Verdict::holds) << row.contender << ": " << row.reason;
    EXPECT_TRUE(!late || std::abs(row.answer_error.value_or(0) - 0.125) < 1e-6) << *row.answer_error;
    EXPECT_EQ(row.sensor_events, 2) << row.contender;
    // The grid stops a whole square before the wall, and meets nothing.
    EXPECT_EQ(row.contact_recall, row.contender == "grid" ? std::optional<double>() : 1) << row.contender;
    EXPECT_EQ(row.colliders_touched, 1) << row.contender << ": the wall, and not the gate";
  }
}

TEST(Replicas, share_the_sequence_of_events) {
  const auto events = [](const std::string& name) {
    std::vector<std::tuple<int, ColliderIndex, Side>> all;
    const Ran run = ran(name);
    for (const TraceStep& step : run.run.steps)
      for (const auto& contact : step.contacts) all.emplace_back(step.step, contact.collider, contact.side);
    return all;
  };
  const auto expected = events("replica");
  EXPECT_GT(expected.size(), 50U);
  for (const char* name : {"replica_1e-12", "replica_1e-9", "replica_1e-6", "replica_1e-3"})
    EXPECT_EQ(events(name), expected) << name;
}

TEST(WhatTurns, is_refused_in_words_by_every_technique_but_octagon_sweep_in_double) {
  RunOptions options = quick();
  options.scalars = {ScalarKind::binary64, ScalarKind::binary32};
  const ReportScene result = run_scene(built_in("rotating_paper"), options);
  for (const Row& row : result.rows) {
    if (is_reference(row.contender) || (row.contender == "octagon_sweep" && row.scalar == "double")) {
      EXPECT_EQ(row.verdict, Verdict::holds) << row.contender << ": " << row.reason;
    } else {
      EXPECT_EQ(row.verdict, Verdict::not_applicable) << row.contender;
      EXPECT_TRUE(holds(row.reason, "paper")) << row.contender;
    }
  }
}

}  // namespace
}  // namespace paperproof::compare
