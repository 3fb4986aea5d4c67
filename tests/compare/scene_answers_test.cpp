/// The exact answers of the registered scenes: that all have some, that octagon_sweep meets them, that a run which does
/// something else does not; and what is between several scenes.
#include "compare/scene_runs.hpp"

#include "metrics/answers.hpp"
#include "runs/vertex_ways.hpp"
#include "support/steps_wanted.hpp"

#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

/// All steps of octagon_sweep in double, and its row.
struct Ran {
  Row row;
  ReportRun run;
  [[nodiscard]] const std::vector<TraceStep>& steps() const& { return run.steps; }
  [[nodiscard]] const Vec2d& end() const { return run.steps.back().path.back().position; }
};

constexpr int most_steps = 20'000;

/// A scene that rests for a million steps does so for fewer here.
Scene shortened(const std::string& name) {
  Scene scene = built_in(name);
  scene.steps = std::min(scene.steps, most_steps);
  return scene;
}

Ran ran(const Scene& scene) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  options.max_replay_steps = most_steps;
  ReportScene result = run_scene(scene, options);
  Ran all{.row = result.rows.front(), .run = {}};
  if (!result.runs.empty()) all.run = std::move(result.runs.front());
  return all;
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
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  EXPECT_TRUE(row_of(run_scene(scene, options), "octagon_sweep").answer_ok);
  options.steps = scene.steps;
  EXPECT_TRUE(row_of(run_scene(scene, options), "octagon_sweep").answer_ok) << "as many as it has";
  options.steps = 10;
  EXPECT_FALSE(row_of(run_scene(scene, options), "octagon_sweep").answer_ok);
  options.steps.reset();
  options.random_input = 1;
  EXPECT_FALSE(row_of(run_scene(scene, options), "octagon_sweep").answer_ok);
  options.random_input.reset();
  options.mode = Mode::lockstep;
  EXPECT_FALSE(row_of(run_scene(scene, options), "octagon_sweep").answer_error);
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

TEST(OneWay, is_met_from_above_only) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    if (!entry.name.starts_with("one_way")) continue;
    const Ran run = ran(entry.name);
    EXPECT_EQ(run.row.one_way_violations, 0) << entry.name;
    for (const TraceStep& step : run.steps())
      for (const Contact<double>& contact : step.contacts)
        if (run.run.header.scenery.colliders[contact.collider].one_way) {
          EXPECT_EQ(contact.side, Side::bottom) << entry.name << ", step " << step.step;
        }
  }
}

TEST(OneWay, that_is_dropped_through_on_purpose_is_named_once) {
  using Chains = std::vector<ColliderIndex>;
  for (const auto& [name, chains] :
       {std::pair{"one_way_drop", Chains{1}}, {"one_way_drop_held", Chains{1, 2}}, {"one_way_lift_drop", Chains{1}}}) {
    const Ran run = ran(name);
    Chains named;
    for (const TraceStep& step : run.steps())
      named.insert(named.end(), step.dropped_through.begin(), step.dropped_through.end());
    EXPECT_EQ(named, chains) << name;
    EXPECT_EQ(run.row.contact_recall, 1.0) << "what is passed on purpose is no contact that was missed";
  }
}

TEST(Fall, of_one_second_nears_the_parabola_with_slope_one) {
  double last_error = 0;
  for (const char* name : {"fall_dt_1", "fall_dt_1e-1", "fall_dt_1e-2", "fall_dt_1e-3", "fall_dt_1e-4"}) {
    const double error = -ran(name).end().y() - 5;  // g t² / 2
    if (last_error > 0) {
      EXPECT_NEAR(last_error / error, 10, 1e-3) << name << ": a tenth of the step, a tenth of the error";
    }
    last_error = error;
  }
}

TEST(UnevenSteps, differ_and_add_up_exactly) {
  const Ran uneven = ran("uneven_flight");
  EXPECT_NE(uneven.steps()[0].dt, uneven.steps()[1].dt);
  double seconds = 0;
  for (const TraceStep& step : uneven.steps()) seconds += step.dt.value_or(0);
  EXPECT_EQ(seconds, 2.0) << "dyadic lengths";
  EXPECT_NE(ran("even_flight").steps()[0].path.back().position, uneven.steps()[0].path.back().position);
}

TEST(UnevenSteps, take_movers_to_where_the_sum_of_the_lengths_says) {
  const Ran run = ran("uneven_lift");
  double time = 0;
  for (const TraceStep& step : run.steps()) {
    const double length = step.dt.value_or(-1);
    // The lift stands for half a second, and rises by 3 m in the two that follow, there and back.
    const auto risen = [](double at) {
      const double within = std::fmod(at, 5.0);
      return 3 * std::clamp(((within <= 2.5 ? within : 5 - within) - 0.5) / 2, 0.0, 1.0);
    };
    ASSERT_NEAR(step.movers[0].from.y(), risen(time), 1e-12) << step.step;
    time += length;
    ASSERT_NEAR(step.movers[0].to.y(), risen(time), 1e-12) << step.step;
  }
  EXPECT_NEAR(time, 8, 1e-12);
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
    for (std::size_t i = 0; i < few.steps().size(); ++i)
      ASSERT_EQ(more.steps()[i].path.back().position, few.steps()[i].path.back().position) << name << ", step " << i;
  }
}

TEST(SensorGate, stops_no_contender_and_is_entered_and_left_once_by_all) {
  const ReportScene result = run_scene(built_in("sensor_gate"), quick());
  ASSERT_EQ(result.rows.size(), contender_names().size());
  for (const Row& row : result.rows) {
    // The bounding box stops at the wall, and gives the end of the step as the time.
    const double late = row.contender == "bounding_box" ? 0.125 : 0;
    EXPECT_EQ(row.verdict, late > 0 ? Verdict::flagged : Verdict::holds) << row.contender << ": " << row.reason;
    if (late > 0) {
      EXPECT_NEAR(row.answer_error.value_or(0), late, 1e-6);
    }
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
    for (const TraceStep& step : run.steps())
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

TEST(WhatTurns, is_met_by_the_twin_a_skin_before_the_root_of_the_sinusoid) {
  RunOptions options = quick();
  options.contenders = {"box2d", "box2d_pieces"};
  options.max_replay_steps = 1000;
  const ReportScene result = run_scene(built_in("turning_arm"), options);
  const double root = 60 * std::asin(0.8);
  for (const char* name : {"box2d", "box2d_pieces"}) {
    const Row& row = row_of(result, name);
    EXPECT_EQ(row.verdict, Verdict::holds) << row.reason;
    ASSERT_TRUE(row.first_contact_step && row.toi_error_max) << name;
    // 20 mm are 1.2 steps of a tip at 1 m/s, somewhat more as it comes at an angle; and it looks once a step.
    const double reported = *row.first_contact_step + *row.first_contact_fraction;
    EXPECT_LE(reported, root);
    EXPECT_NEAR(*row.toi_error_max, root - reported, 60 * most_sag / 0.6)
        << name << ": it is met on a chord, at 0.6 m/s";
    const TraceStep& step = run_of(result, name).steps[30];
    ASSERT_EQ(step.vertex_ways.size(), 1U);
    const VertexWay& way = step.vertex_ways[0];
    for (const std::size_t end : {0U, 1U}) {
      const std::vector<Vec2d>& vertices = end == 0 ? way.vertices.front() : way.vertices.back();
      const double angle = (30.0 + static_cast<double>(end)) / 60;
      EXPECT_EQ(vertices[0], Vec2d(0, 0));
      EXPECT_LE((vertices[1] - Vec2d(std::cos(angle), std::sin(angle))).norm(), 1e-5);
    }
    EXPECT_EQ(row.undecided_steps, 0);
  }
}

}  // namespace
}  // namespace paperproof::compare
