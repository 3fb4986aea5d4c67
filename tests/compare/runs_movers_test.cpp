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

/// Whoever stands on it without steering, the twin too: 2 m/s along the surface.
TEST(Movers, and_conveyors_take_along_whoever_comes_to_rest_on_them) {
  Scene belt = on_a_slab(120);
  belt.scenery.colliders[1].surface_speed = 2;
  belt.scenery.colliders[1].points = slab(-3, -1, 9, 0).points;
  belt.input.clear();
  const ReportScene result = run_scene(belt, watched(belt, {"octagon_sweep"}));
  for (const ReportRun& run : result.runs)
    EXPECT_NEAR(run.steps.back().path.back().position.x(), 4, 0.15) << run.header.contender;
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

/// Beside a wheel that turns, so that a step goes in parts.
TEST(Movers, that_turn_let_who_lands_in_a_part_of_a_step_jump_in_the_next_and_use_up_the_press) {
  using Presses = std::vector<InputEvent>;
  const InputEvent press{.step = 0, .move = 0, .jump = true};
  const auto at = [](int step, bool jump) { return InputEvent{.step = step, .move = 0, .jump = jump}; };
  int jumps = 0;
  for (const Presses& presses :
       {Presses{press}, {press, at(4, false)}, {press, at(20, false), at(30, true)}, {press, at(1, false)}})
    for (const double height : {0.16, 0.22, 0.27, 0.34}) {
      Scene scene = on_a_slab(100);
      scene.start = {.position = {0, half_height + height}, .velocity = {0, -9}};
      scene.scenery.colliders.push_back(slab(-0.5, -0.5, 0.5, 0.5));
      scene.scenery.colliders.back().mover = 0;
      scene.ids.emplace_back("wheel");
      scene.movers = {{.id = "wheel",
                       .path = {{.time = 0, .at = {1.1, 0.8}}},
                       .loop = MoverDef::Loop::loop,
                       .turns = {{.time = 0, .at = 0}, {.time = 1, .at = 15}}}};
      scene.input = presses;
      scene.character.jump_cut = 0.5;
      if (presses.size() == 2 && presses[1].step == 1) scene.character.jump_buffer = 0.05;
      RunOptions options = watched(scene, {"octagon_sweep"});
      options.reference = false;
      const ReportScene result = run_scene(scene, options);
      EXPECT_EQ(result.rows.front().verdict, Verdict::holds) << height << ": " << result.rows.front().reason;
      const std::vector<TraceStep>& steps = result.runs.front().steps;
      for (std::size_t i = 1; i < steps.size(); ++i) jumps += steps[i].velocity.y() > steps[i - 1].velocity.y() + 9;
    }
  EXPECT_GE(jumps, 16);
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
