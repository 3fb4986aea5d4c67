/// Runs among what moves, and of several characters: who is handed what, and who cannot run. How stacks carry and
/// crates crush, and what octagon_sweep makes of crowds, is said by the answers of their scenes.
#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "compare/scene_runs.hpp"
#include "runs/vertex_ways.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

/// A slab with its top at 0 that a character stands on, and a floor far below.
Scene on_a_slab(int steps) {
  Scene scene;
  scene.name = "slab";
  scene.steps = steps;
  scene.start.position = {0, half_height + 0.015};
  scene.scenery.colliders = {box(-50, -31, 50, -30), box(-3, -1, 3, 0)};
  scene.ids = {"floor", "slab"};
  scene.input = {{.step = 0, .move = 0, .jump = false}};
  return scene;
}

/// By a script, and by Box2D.
TEST(Movers, go_the_same_way_for_everyone_and_begin_each_step_where_they_ended_the_last) {
  Scene slab = on_a_slab(200);
  slab.movers = {{.id = "slab",
                  .path = {{.time = 0, .at = {0, 0}}, {.time = 1.1, .at = {4, 3}}},
                  .loop = MoverDef::Loop::ping_pong}};
  slab.scenery.colliders[1].mover = 0;
  for (const auto& [scene, off] : {std::pair{slab, 2e-6}, {built_in("stack_100"), 1e-6}}) {
    const ReportScene result = run_scene(scene, quick({"octagon_sweep", "speculative"}, scene.steps));
    const std::vector<TraceStep>& mine = run_of(result, "octagon_sweep").steps;
    for (const char* name : {"octagon_sweep", "speculative", "box2d"}) {
      SCOPED_TRACE(scene.name + " " + name);
      const std::vector<TraceStep>& steps = run_of(result, name).steps;
      ASSERT_EQ(steps.size(), static_cast<std::size_t>(scene.steps));
      for (std::size_t i = 0; i < steps.size(); ++i) {
        ASSERT_EQ(steps[i].movers.size(), scene.movers.size());
        for (std::size_t k = 0; k < scene.movers.size(); ++k) {
          EXPECT_LE((steps[i].movers[k].to - mine[i].movers[k].to).norm(), name[0] == 'b' ? off : 0) << i;
          EXPECT_TRUE(i == 0 || steps[i].movers[k].from == steps[i - 1].movers[k].to) << i;
          const double time = static_cast<double>(i + 1) * scene.dt;
          EXPECT_TRUE(scene.movers[k].body || mine[i].movers[k].to == offset_at(scene.movers[k], time)) << i;
        }
      }
    }
  }
}

/// The arc over a chord of angle a is r (1 - cos(a / 2)) high. A third of the chords would be too few.
TEST(VertexWays, are_as_many_chords_as_keep_them_within_their_sag) {
  Random random(31);
  for (int i = 0; i < 200; ++i) {
    const double radius = random.log_between(1e-3, 1e3);
    const double turn = random.log_between(1e-6, 30) * (random.chance(0.5) ? 1 : -1);
    VertexWay way;
    add_turn({.points = {radius * towards(random.angle()), {0, 0}}}, {.to_angle = turn}, {}, way);
    const auto chords = static_cast<double>(way.instants.size() - 1);
    const auto sag = [&](double many) {
      return radius * (1 - std::cos(std::min(std::numbers::pi, std::abs(turn) / many / 2)));
    };
    EXPECT_LE(sag(chords), most_sag * (1 + 1e-6)) << i;
    EXPECT_TRUE(chords <= 2 || sag(chords / 3) > most_sag) << i;
    const Vec2d end = Eigen::Rotation2D<double>(turn) * way.vertices.front()[0];
    EXPECT_NEAR((way.vertices.back()[0] - end).norm(), 0, 1e-12 * radius) << i;
  }
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
      scene.scenery.colliders.push_back(box(-0.5, -0.5, 0.5, 0.5));
      scene.scenery.colliders.back().mover = 0;
      scene.ids.emplace_back("wheel");
      scene.movers = {{.id = "wheel",
                       .path = {{.time = 0, .at = {1.1, 0.8}}},
                       .loop = MoverDef::Loop::loop,
                       .turns = {{.time = 0, .at = 0}, {.time = 1, .at = 15}}}};
      scene.input = presses;
      scene.character.jump_cut = 0.5;
      if (presses.size() == 2 && presses[1].step == 1) scene.character.jump_buffer = 0.05;
      const ReportScene result = run_scene(scene, alone("octagon_sweep", scene.steps));
      EXPECT_EQ(result.rows.front().verdict, Verdict::holds) << height << ": " << result.rows.front().reason;
      const std::vector<TraceStep>& steps = result.runs.front().steps;
      for (std::size_t i = 1; i < steps.size(); ++i) jumps += steps[i].velocity.y() > steps[i - 1].velocity.y() + 9;
    }
  EXPECT_GE(jumps, 16);
}

}  // namespace
}  // namespace paperproof::compare
