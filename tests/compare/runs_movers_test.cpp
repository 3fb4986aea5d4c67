/// Runs among what moves: who is handed what, how the twin rides, and what a row says of it.
#include "compare/scene_runs.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double half_height = 20.0 / 32;  // of the article's character at 32 pixels per metre

ColliderDef slab(double left, double bottom, double right, double top) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

/// A slab with its top at 0 that a character stands on, and a floor far below.
Scene on_a_slab(int steps) {
  Scene scene;
  scene.name = "slab";
  scene.steps = steps;
  scene.start.position = {0, half_height + 0.015};
  scene.scenery.colliders = {slab(-50, -31, 50, -30), slab(-3, -1, 3, 0)};
  scene.ids = {"floor", "slab"};
  scene.input = {{.step = 0, .move = 0, .jump = false}};
  return scene;
}

Scene on_a_mover(int steps, std::vector<MoverDef::Waypoint> path) {
  Scene scene = on_a_slab(steps);
  scene.movers = {{.id = "slab", .path = std::move(path), .loop = MoverDef::Loop::ping_pong}};
  scene.scenery.colliders[1].mover = 0;
  return scene;
}

RunOptions watched(const Scene& scene, std::vector<std::string> contenders) {
  RunOptions options = quick();
  options.contenders = std::move(contenders);
  options.max_replay_steps = scene.steps;
  return options;
}

TEST(Movers, are_the_same_for_everyone_and_begin_each_step_where_they_ended_the_last) {
  const Scene scene = on_a_mover(200, {{.time = 0, .at = {0, 0}}, {.time = 1.1, .at = {4, 3}}});
  const ReportScene result = run_scene(scene, watched(scene, {"speculative"}));
  for (const char* name : {"speculative", "box2d"}) {
    const ReportRun& run = run_of(result, name);
    ASSERT_EQ(run.steps.size(), 200U) << name;
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      ASSERT_EQ(run.steps[i].movers.size(), 1U);
      const Vec2d to = offset_at(scene.movers[0], static_cast<double>(i + 1) * scene.dt);
      EXPECT_LE((run.steps[i].movers[0].to - to).norm(), name[0] == 'b' ? 2e-6 : 0) << name << " " << i;
      if (i > 0) {
        EXPECT_EQ(run.steps[i].movers[0].from, run.steps[i - 1].movers[0].to) << name << " " << i;
      }
    }
  }
}

TEST(Movers, and_conveyors_take_along_whoever_comes_to_rest_on_them_the_twin_too) {
  Scene belt = on_a_slab(120);
  belt.scenery.colliders[1].surface_speed = 2;
  belt.scenery.colliders[1].points = slab(-3, -1, 9, 0).points;
  belt.input.clear();
  for (const char* name : {"octagon_sweep", "box2d"}) {
    const ReportScene result = run_scene(belt, watched(belt, {"octagon_sweep"}));
    EXPECT_NEAR(run_of(result, name).steps.back().path.back().position.x(), 4, 0.15) << name;
  }
}

TEST(Movers, are_part_of_the_displacement_that_a_rider_wants) {
  Scene scene = on_a_mover(100, {{.time = 0, .at = {0, 0}}, {.time = 2, .at = {6, 2}}});
  scene.scenery.colliders[1].surface_speed = 1.5;
  const ReportScene result = run_scene(scene, watched(scene, {"octagon_sweep"}));
  const ReportRun& run = run_of(result, "octagon_sweep");
  for (std::size_t i = 30; i < run.steps.size(); ++i) {
    const Vec2d ridden = run.steps[i].movers[0].to - run.steps[i].movers[0].from;
    const Vec2d fall = scene.gravity * scene.dt * scene.dt;
    EXPECT_LE((run.steps[i].requested - (ridden + Vec2d(1.5 * scene.dt, 0) + fall)).norm(), 1e-12) << i;
  }
  const Row& row = row_of(result, "octagon_sweep");
  EXPECT_EQ(row.verdict, Verdict::holds) << row.reason;
  EXPECT_EQ(row.contact_recall, 1.0);
  EXPECT_EQ(row.contact_precision, 1.0) << "exact arithmetic judges the displacement that was wanted";
}

TEST(Movers, carry_the_twin_sideways_as_if_it_stood_still) {
  const Scene scene = on_a_mover(240, {{.time = 0, .at = {0, 0}}, {.time = 2, .at = {6, 2}}});
  const ReportScene result = run_scene(scene, watched(scene, {"box2d"}));
  const ReportRun& run = run_of(result, "box2d");
  // It gets up to the slab's speed as it would from standing to walking: 60 m/s² by the intent, in the third step.
  const auto place = [&run](std::size_t i) -> Vec2d {
    return run.steps[i].path.back().position - run.steps[i].movers[0].to;
  };
  for (std::size_t i = 30; i < run.steps.size(); ++i) {
    EXPECT_TRUE(run.steps[i].grounded) << i;
    EXPECT_NEAR(place(i).x(), place(29).x(), i < 120 ? 1e-3 : 0.06) << i << ": it turns at step 120";
  }
  const Row& row = row_of(result, "box2d");
  EXPECT_EQ(row.verdict, Verdict::holds) << row.reason;
  ASSERT_TRUE(row.rest_peak_to_peak_m);
  EXPECT_LE(*row.rest_peak_to_peak_m, 0.02);
}

TEST(Movers, give_the_twin_that_jumps_off_their_speed) {
  Scene scene = on_a_mover(100, {{.time = 0, .at = {0, 0}}, {.time = 4, .at = {12, 0}}});
  scene.input.push_back({.step = 60, .move = std::nullopt, .jump = true});
  scene.input.front().move.reset();  // nobody steers: what it has it keeps
  const ReportScene result = run_scene(scene, watched(scene, {"box2d"}));
  const ReportRun& run = run_of(result, "box2d");
  const double speed = 12.0 / 4;
  EXPECT_NEAR(run.steps[59].velocity.x(), run.steps[65].velocity.x(), 1e-5);
  EXPECT_FALSE(run.steps[65].grounded);
  // Standing still in the world it would stay behind: relative to the slab it keeps the speed it began with.
  EXPECT_NEAR(run.steps[65].velocity.x(), run.steps[5].velocity.x(), 1e-5);
  EXPECT_LE(std::abs(run.steps[65].velocity.x()), speed + 1e-5);
}

/// Beside a wheel that turns, so that a step goes in parts.
Scene beside_a_wheel(double height) {
  Scene scene = on_a_slab(100);
  scene.start = {.position = {0, half_height + height}, .velocity = {0, -9}};
  scene.scenery.colliders.push_back(slab(-0.5, -0.5, 0.5, 0.5));
  scene.ids.emplace_back("wheel");
  scene.movers = {{.id = "wheel",
                   .path = {{.time = 0, .at = {1.1, 0.8}}},
                   .loop = MoverDef::Loop::loop,
                   .turns = {{.time = 0, .at = 0}, {.time = 1, .at = 15}}}};
  scene.scenery.colliders.back().mover = 0;
  return scene;
}

TEST(Movers, that_turn_let_who_lands_in_a_part_of_a_step_jump_in_the_next_and_use_up_the_press) {
  using Presses = std::vector<InputEvent>;
  const Presses held{{.step = 0, .move = 0, .jump = true}};
  const Presses released{{.step = 0, .move = 0, .jump = true}, {.step = 4, .move = 0, .jump = false}};
  const Presses pressed_in_the_air{{.step = 0, .move = 0, .jump = true},
                                   {.step = 20, .move = 0, .jump = false},
                                   {.step = 30, .move = 0, .jump = true}};
  const Presses buffered{{.step = 0, .move = 0, .jump = true}, {.step = 1, .move = 0, .jump = false}};
  int jumps = 0;
  for (const Presses& presses : {held, released, pressed_in_the_air, buffered})
    for (const double height : {0.16, 0.22, 0.27, 0.34}) {
      Scene scene = beside_a_wheel(height);
      scene.input = presses;
      scene.character.jump_cut = 0.5;
      if (presses == buffered) scene.character.jump_buffer = 0.05;
      RunOptions options = watched(scene, {"octagon_sweep"});
      options.reference = false;
      const ReportScene result = run_scene(scene, options);
      const Row& row = row_of(result, "octagon_sweep");
      EXPECT_EQ(row.verdict, Verdict::holds) << height << ": " << row.reason;
      const ReportRun& run = run_of(result, "octagon_sweep");
      for (std::size_t i = 1; i < run.steps.size(); ++i)
        jumps += run.steps[i].velocity.y() > run.steps[i - 1].velocity.y() + 9;
    }
  EXPECT_GE(jumps, 16);
}

TEST(Crushes, are_events_and_what_they_press_into_is_none) {
  const Scene scene = built_in("closing_ceiling");
  RunOptions options = watched(scene, {"octagon_sweep"});
  options.reference = false;
  const ReportScene result = run_scene(scene, options);
  const std::vector<ReportEvent>& events = run_of(result, "octagon_sweep").events;
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, ReportEvent::Kind::crush);
  EXPECT_EQ(events[0].step, 21) << "where gap / (v h) = 21.4 falls";
}

TEST(Conveyors, carry_the_twin_along_their_surface) {
  for (const double speed : {2.0, -3.5}) {
    Scene scene = on_a_slab(60);
    scene.scenery.colliders[1].surface_speed = speed;
    const ReportScene result = run_scene(scene, watched(scene, {"box2d"}));
    const ReportRun& run = run_of(result, "box2d");
    for (std::size_t i = 20; i < 30; ++i) EXPECT_NEAR(run.steps[i].velocity.x(), speed, 1e-5) << i;
  }
}

TEST(Sensors, are_reported_by_the_twin_and_held_against_exact_arithmetic) {
  Scene scene = on_a_slab(60);
  scene.scenery.colliders.push_back(slab(-1, 5, 1, 6));
  scene.scenery.colliders.back().sensor = true;
  scene.ids.emplace_back("zone");
  scene.start.position = {0, 8};  // it falls through
  scene.gravity = {0, -10};
  const ReportScene result = run_scene(scene, watched(scene, {"speculative"}));
  for (const char* name : {"speculative", "box2d"}) {
    const Row& row = row_of(result, name);
    EXPECT_EQ(row.sensor_events, 2) << name;
    std::vector<SensorEvent<double>> events;
    for (const TraceStep& step : run_of(result, name).steps)
      events.insert(events.end(), step.sensors.begin(), step.sensors.end());
    ASSERT_EQ(events.size(), 2U) << name;
    EXPECT_EQ(events[0].change, SensorEvent<double>::Change::enter);
    EXPECT_EQ(events[1].change, SensorEvent<double>::Change::exit);
  }
  EXPECT_EQ(row_of(result, "speculative").sensor_errors, 0);
}

TEST(Lockstep, goes_on_among_movers) {
  Scene scene = on_a_mover(120, {{.time = 0, .at = {0, 0}}, {.time = 2, .at = {2, 1}}});
  RunOptions options = watched(scene, {"speculative"});
  options.mode = Mode::lockstep;
  const ReportScene result = run_scene(scene, options);
  const ReportRun& run = run_of(result, "speculative");
  const ReportRun& twin = run_of(result, "box2d");
  ASSERT_EQ(run.steps.size(), twin.steps.size());
  for (std::size_t i = 1; i < run.steps.size(); ++i) {
    // Each begins where the other is, moved out to Box2D's rest gap at the most.
    EXPECT_LE((twin.steps[i].path.front().position - run.steps[i].path.front().position).norm(), 0.0151) << i;
    EXPECT_LE((twin.steps[i].movers[0].from - run.steps[i].movers[0].from).norm(), 2e-6) << i;
  }
}

}  // namespace
}  // namespace paperproof::compare
