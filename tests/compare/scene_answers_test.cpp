/// The exact answers of scenes that are told by a formula: what octagon_sweep does there, through the run itself.
#include "compare/scene_runs.hpp"

#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double half_height = 20.0 / 32;
constexpr double half_width = 10.0 / 32;

/// All steps of octagon_sweep in double, and its row.
struct Ran {
  Row row;
  std::vector<TraceStep> steps;
  [[nodiscard]] const Vec2d& end() const { return steps.back().path.back().position; }
};

Ran ran(const std::string& name) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  options.max_replay_steps = 20'000;
  const ReportScene result = run_scene(built_in(name), options);
  EXPECT_EQ(result.rows.front().verdict, Verdict::holds) << name << ": " << result.rows.front().reason;
  return {result.rows.front(), result.runs.front().steps};
}

TEST(ClimbLimit, is_walked_up_exactly_where_the_angle_is_not_above_it) {
  // The ramp is 3 m long; who climbs it ends on the plateau, who does not keeps his feet below it.
  for (const auto& [name, tangent] :
       {std::pair{"climb_limit_-1e-6", 1.1917511723204688}, {"climb_limit_-0.05", 1.0774552687432373}})
    EXPECT_NEAR(ran(name).end().y(), 3 * tangent + half_height, 1e-5) << name;
  for (const char* name : {"climb_limit_+1e-6", "climb_limit_+0.05"}) {
    EXPECT_LT(ran(name).end().y(), half_height + 0.5) << name;
    EXPECT_LT(ran(name).end().x(), 0.5) << name;
  }
}

TEST(Fall, of_one_second_is_the_sum_of_its_steps_and_nears_the_parabola_with_slope_one) {
  double last_error = 0;
  for (const auto& [name, dt, n] : {std::tuple{"fall_dt_1", 1.0, 1},
                                    {"fall_dt_1e-1", 0.1, 10},
                                    {"fall_dt_1e-2", 0.01, 100},
                                    {"fall_dt_1e-3", 0.001, 1000},
                                    {"fall_dt_1e-4", 0.0001, 10'000}}) {
    const double fallen = -ran(name).end().y();
    EXPECT_NEAR(fallen, 10 * dt * dt * n * (n + 1) / 2, 1e-11 * n) << name;
    const double error = fallen - 5;  // g t² / 2
    if (last_error > 0) {
      EXPECT_NEAR(last_error / error, 10, 1e-3) << name << ": a tenth of the step, a tenth of the error";
    }
    last_error = error;
  }
}

/// |(p - m) - (p0 - m0)| of a rider from `settled` on, in units of the last place of the larger coordinate.
double drift_in_ulps(const Ran& run, std::size_t settled) {
  const auto relative = [&run](std::size_t i) -> Vec2d {
    return run.steps[i].path.back().position - run.steps[i].movers[0].to;
  };
  double drift = 0;
  double largest = 0;
  for (std::size_t i = settled; i < run.steps.size(); ++i) {
    drift = std::max(drift, (relative(i) - relative(settled)).cwiseAbs().maxCoeff());
    largest = std::max(largest, run.steps[i].path.back().position.cwiseAbs().maxCoeff());
  }
  return drift / (std::nextafter(largest, 1e9) - largest);
}

/// Steps with a contact with a collider.
long steps_met(const Ran& run, ColliderIndex collider) {
  return std::count_if(run.steps.begin(), run.steps.end(), [collider](const TraceStep& step) {
    return std::any_of(step.contacts.begin(), step.contacts.end(),
                       [collider](const auto& contact) { return contact.collider == collider; });
  });
}

/// The chains that were dropped through, in the order of the steps.
std::vector<ColliderIndex> dropped_through(const Ran& run) {
  std::vector<ColliderIndex> all;
  for (const TraceStep& step : run.steps)
    all.insert(all.end(), step.dropped_through.begin(), step.dropped_through.end());
  return all;
}

/// Every contact with a collider is below the character.
void expect_only_stood_on(const Ran& run, ColliderIndex collider) {
  for (const TraceStep& step : run.steps)
    for (const auto& contact : step.contacts)
      if (contact.collider == collider) {
        EXPECT_EQ(contact.side, Side::bottom) << "step " << step.step;
      }
}

TEST(OneWay, blocks_from_above_only) {
  const Ran below = ran("one_way_from_below");
  EXPECT_NEAR(below.end().y(), 2 + half_height, 1e-6) << "stands on the ledge";
  expect_only_stood_on(below, 1);
  EXPECT_GT(steps_met(below, 1), 30);
  EXPECT_NEAR(ran("one_way_from_above").end().y(), half_height, 1e-6);
  const Ran side = ran("one_way_from_the_side");
  EXPECT_EQ(side.row.contact_steps, 0);
  EXPECT_EQ(side.steps.back().velocity, Vec2d(6, 0));
  const Ran within = ran("one_way_from_within");
  EXPECT_EQ(steps_met(within, 1), 0);
  EXPECT_NEAR(within.end().y(), -3 + half_height, 1e-6);
}

TEST(OneWay, holds_what_rests_on_it_without_moving_it) {
  const Ran run = ran("one_way_at_rest");
  for (std::size_t i = 60; i < run.steps.size(); ++i) {
    ASSERT_EQ(run.steps[i].path.back().position, run.steps[59].path.back().position) << i;
    ASSERT_TRUE(run.steps[i].grounded) << i;
  }
  EXPECT_NEAR(run.end().y(), 2 + half_height, 1e-6);
}

TEST(OneWay, is_dropped_through_on_purpose_and_the_next_one_holds) {
  const Ran run = ran("one_way_drop");
  EXPECT_EQ(dropped_through(run), std::vector<ColliderIndex>{1});
  EXPECT_NEAR(run.end().y(), 0.5 + half_height, 1e-6);
  EXPECT_EQ(run.row.one_way_violations, 0);
  const Ran held = ran("one_way_drop_held");
  EXPECT_EQ(dropped_through(held), (std::vector<ColliderIndex>{1, 2}));
  EXPECT_NEAR(held.end().y(), half_height, 1e-6);
  EXPECT_EQ(held.row.one_way_violations, 0);
  EXPECT_EQ(held.row.contact_recall, 1.0) << "what is passed on purpose is no contact that was missed";
}

TEST(OneWay, is_passed_from_below_while_it_moves_and_then_stood_on) {
  const Ran run = ran("one_way_lift_from_below");
  expect_only_stood_on(run, 1);
  EXPECT_GT(steps_met(run, 1), 30);
  EXPECT_NEAR(run.end().y(), 1.5 + run.steps.back().movers[0].to.y() + half_height, 1e-6);
}

TEST(OneWay, is_left_downwards_with_its_own_speed_and_the_floor_holds) {
  const Ran run = ran("one_way_lift_drop");
  EXPECT_EQ(dropped_through(run), std::vector<ColliderIndex>{1});
  EXPECT_EQ(run.row.one_way_violations, 0);
  // It rises at 2 m/s; 30 m/s² take a sixtieth of that off in one step.
  EXPECT_NEAR(run.steps[60].velocity.y(), 2 - 30.0 / 60, 1e-9);
  EXPECT_NEAR(run.end().y(), half_height, 1e-6);
}

TEST(OneWay, that_turns_while_it_overlaps_the_character_is_not_there) {
  const Ran run = ran("one_way_turns_within");
  EXPECT_EQ(steps_met(run, 1), 0);
  EXPECT_NEAR(run.end().y(), half_height, 1e-6);
}

TEST(OneWay, that_turns_below_the_character_gives_it_its_speed) {
  const Ran run = ran("one_way_turns_below");
  expect_only_stood_on(run, 0);
  // 0.5 m below the feet it turns, after 45 steps, and rises by 1.5 m in 0.97 s: it is there after a third of that.
  const double met = 45 + 0.97 * 60 / 3;
  EXPECT_EQ(run.row.first_contact_step, static_cast<int>(met));
  EXPECT_NEAR(run.row.first_contact_fraction.value_or(-1), met - std::floor(met), 1e-5);
  EXPECT_EQ(steps_met(run, 0), 1);
  EXPECT_NEAR(run.end().y(), 1.5 / 0.97 * (120 - met) / 60, 1e-6) << "and goes on with that";
}

TEST(Sawtooth, of_k_teeth_crossed_in_one_step_gives_k_impacts_at_the_times_of_the_formula) {
  for (const auto& [name, teeth] : {std::pair{"sawtooth_1", 1}, {"sawtooth_4", 4}, {"sawtooth_11", 11}}) {
    const Ran run = ran(name);
    const auto& contacts = run.steps[0].contacts;
    ASSERT_EQ(contacts.size(), static_cast<std::size_t>(teeth)) << name;
    // A tooth of the floor keeps what is horizontal: it is ground. One of the ceiling halves it: from (1, tan 30) it
    // takes the part into its normal (-1/2, -cos 30), which is 1 long, and leaves (1/2, -tan(30)/2).
    double share = 1;
    double spent = 0;
    for (int k = 0; k < teeth; ++k) {
      spent += 0.5 / share;
      const auto& contact = contacts[static_cast<std::size_t>(k)];
      EXPECT_EQ(contact.collider, static_cast<ColliderIndex>(k)) << name;
      // Each is stopped at up to 2 gaps early, and what that shifts grows with the shares that follow.
      EXPECT_NEAR(contact.fraction, spent / 200, 1e-6) << name << ", tooth " << k;
      if (k % 2 == 1) share /= 2;
    }
  }
}

TEST(UnevenSteps, end_a_constant_velocity_where_even_ones_do) {
  const Ran even = ran("even_flight");
  const Ran uneven = ran("uneven_flight");
  EXPECT_NE(uneven.steps[0].dt, uneven.steps[1].dt);
  double seconds = 0;
  for (const TraceStep& step : uneven.steps) seconds += step.dt.value_or(0);
  EXPECT_EQ(seconds, 2.0) << "dyadic lengths add up exactly";
  for (const Ran* run : {&even, &uneven}) {
    const Vec2d exact = Vec2d(0.1, 0.2) + 2 * Vec2d(3.7, -1.3);
    // The way of a step and the position after it are rounded once each.
    const double ulp = std::nextafter(8.0, 9.0) - 8;
    EXPECT_LE((run->end() - exact).cwiseAbs().maxCoeff(), 128 * ulp);
  }
  EXPECT_NE(even.steps[0].path.back().position, uneven.steps[0].path.back().position);
}

TEST(UnevenSteps, take_movers_and_riders_to_where_the_sum_of_the_lengths_says) {
  const Ran run = ran("uneven_lift");
  EXPECT_LE(drift_in_ulps(run, 30), 1);
  double time = 0;
  for (const TraceStep& step : run.steps) {
    const double length = step.dt.value_or(-1);
    // It stands for half a second, and goes (1, 3) m in the two that follow, there and back.
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
  for (const char* name : {"tiles_1e3", "tiles_1e4"}) {
    const Ran more = ran(name);
    for (std::size_t i = 0; i < few.steps.size(); ++i)
      ASSERT_EQ(more.steps[i].path.back().position, few.steps[i].path.back().position) << name << ", step " << i;
  }
}

TEST(ThinSensor, is_entered_and_left_once_each_at_the_exact_fraction) {
  const Ran run = ran("thin_sensor");
  EXPECT_EQ(run.row.sensor_events, 4);
  EXPECT_EQ(run.row.sensor_errors, 0);
  using Change = SensorEvent<double>::Change;
  struct Event {
    ColliderIndex sensor;
    Change change;
    double place;  ///< Of the character, after so many metres.
  };
  const std::array<Event, 4> expected{{{0, Change::enter, 20 - half_width},
                                       {0, Change::exit, 20.01 + half_width},
                                       {1, Change::enter, 40 - half_width},
                                       {1, Change::exit, 40 + half_width}}};
  ASSERT_EQ(run.steps[0].sensors.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const SensorEvent<double>& event = run.steps[0].sensors[i];
    EXPECT_EQ(event.sensor, expected[i].sensor);
    EXPECT_EQ(event.change, expected[i].change);
    EXPECT_NEAR(event.fraction, expected[i].place / 100, 1e-12);
  }
  EXPECT_TRUE(run.steps[1].sensors.empty());
}

TEST(SensorGate, stops_no_contender_and_is_entered_and_left_once_by_all) {
  const ReportScene result = run_scene(built_in("sensor_gate"), quick());
  ASSERT_EQ(result.rows.size(), contender_names().size());
  for (const Row& row : result.rows) {
    EXPECT_EQ(row.verdict, Verdict::holds) << row.contender << ": " << row.reason;
    EXPECT_EQ(row.sensor_events, 2) << row.contender;
    EXPECT_EQ(row.contact_recall.value_or(1), 1) << row.contender;
    EXPECT_EQ(row.colliders_touched, 1) << row.contender << ": the wall, and not the gate";
  }
  // 0.1 m a step: (4 - 0.5 - half_width) / 0.1 is 31.875, and so on.
  const Ran run = ran("sensor_gate");
  ASSERT_EQ(run.steps[31].sensors.size(), 1U);
  ASSERT_EQ(run.steps[43].sensors.size(), 1U);
  EXPECT_NEAR(run.steps[31].sensors[0].fraction, 0.875, 1e-10);
  EXPECT_NEAR(run.steps[43].sensors[0].fraction, 0.125, 1e-10);
  EXPECT_EQ(run.row.first_contact_step, 71);
  EXPECT_NEAR(run.row.first_contact_fraction.value_or(0), 0.875, 1e-10);
}

TEST(Replicas, share_the_sequence_of_events) {
  const auto events = [](const std::string& name) {
    std::vector<std::tuple<int, ColliderIndex, Side>> all;
    for (const TraceStep& step : ran(name).steps)
      for (const auto& contact : step.contacts) all.emplace_back(step.step, contact.collider, contact.side);
    return all;
  };
  const auto expected = events("replica");
  EXPECT_GT(expected.size(), 50U);
  for (const char* name : {"replica_1e-12", "replica_1e-9", "replica_1e-6", "replica_1e-3"})
    EXPECT_EQ(events(name), expected) << name;
}

TEST(Lifts, carry_without_a_lag_and_without_drift) {
  for (const char* name :
       {"lift_up", "lift_down", "lift_sideways", "one_way_lift_up", "one_way_lift_down", "one_way_lift_sideways"}) {
    const Ran run = ran(name);
    EXPECT_LE(drift_in_ulps(run, 10), 1) << name;
    // 4 m or 3 m, there and back: it has moved that far at some time.
    double far = 0;
    for (const TraceStep& step : run.steps)
      far = std::max(far, (step.path.back().position - run.steps[10].path.back().position).norm());
    EXPECT_NEAR(far, std::string(name) == "lift_sideways" ? 4 : 3, 1e-6) << name;
    for (std::size_t i = 10; i < run.steps.size(); ++i) ASSERT_TRUE(run.steps[i].grounded) << name << ", step " << i;
  }
}

TEST(Conveyor, carries_at_its_speed) {
  const Ran run = ran("conveyor");
  for (std::size_t i = 20; i < run.steps.size(); ++i)
    ASSERT_NEAR(run.steps[i].path.back().position.x() - run.steps[i].path.front().position.x(), 2.0 / 60, 1e-12) << i;
}

TEST(ClosingCeiling, crushes_in_the_step_of_the_formula_and_never_pushes_out) {
  const Ran run = ran("closing_ceiling");
  // It stands 5e-7 m above the floor, so the way to its head is that much shorter.
  const double way = 1.07 - 5e-7;
  const int expected = static_cast<int>(std::ceil(way / (3.0 / 60))) - 1;  // counted from 0
  int first = -1;
  for (const TraceStep& step : run.steps) {
    if (first < 0 && !step.crushed.empty()) first = step.step;
    EXPECT_GE(step.path.back().position.y(), half_height) << "below the floor in step " << step.step;
    EXPECT_LE(step.path.back().position.y(), half_height + 1e-6) << "in step " << step.step;
  }
  EXPECT_EQ(first, expected);
  EXPECT_GT(run.row.crushes, 0);
  EXPECT_EQ(run.row.crushes_with_room.value_or(0), 0);
}

TEST(SweepingPaper, is_met_after_distance_over_speed_and_stays_on_its_side) {
  const Ran run = ran("sweeping_paper");
  const double steps = 1.9 / 20 * 60;
  const auto step = static_cast<std::size_t>(steps);
  const auto& contacts = run.steps[step].contacts;
  const auto met = std::find_if(contacts.begin(), contacts.end(), [](const auto& c) { return c.collider == 1; });
  ASSERT_NE(met, contacts.end());
  EXPECT_NEAR(met->fraction, steps - std::floor(steps), 1e-6);
  for (const TraceStep& each : run.steps)
    EXPECT_GT(each.path.back().position.x() - half_width, -half_width - 1.9 + each.movers[0].to.x())
        << "the paper is on its left in step " << each.step;
}

TEST(HeadOn, is_met_after_distance_over_both_speeds) {
  const Ran run = ran("head_on");
  EXPECT_EQ(run.row.first_contact_step, 2);
  ASSERT_TRUE(run.row.first_contact_fraction);
  EXPECT_NEAR(*run.row.first_contact_fraction, 2 / (30.0 + 18.0) * 60 - 2, 1e-12);
}

TEST(PapersSwap, meet_nobody) { EXPECT_EQ(ran("papers_swap").row.contact_steps, 0); }

TEST(WhatTurns, is_refused_in_words_by_every_technique_and_run_by_the_twin) {
  const ReportScene result = run_scene(built_in("rotating_paper"), quick());
  for (const Row& row : result.rows) {
    if (is_reference(row.contender)) {
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
    EXPECT_GE(reported, root - 4);
    EXPECT_NEAR(*row.toi_error_max, root - reported, 1e-3) << name << ": Box2D's angles are floats";
    const TraceStep& step = run_of(result, name).steps[30];
    ASSERT_EQ(step.turns.size(), 1U);
    EXPECT_NEAR(step.turns[0].from, 30.0 / 60, 1e-5);
    EXPECT_NEAR(step.turns[0].to, 31.0 / 60, 1e-5);
  }
}

}  // namespace
}  // namespace paperproof::compare
