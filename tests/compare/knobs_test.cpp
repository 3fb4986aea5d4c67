/// The knobs of the command line: who has which. tables/refused_calls.json has what cannot be one.
#include "runs/knobs.hpp"
#include "compare/scene_runs.hpp"
#include "runs/technique_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

/// The feet begin in the floor, an arm in a low wall that is looked at first. Lifted out of the floor it is above the
/// wall.
Scene low_wall_on_a_floor() {
  Scene scene = built_in("flush_tiles");
  constexpr double px = 1.0 / 32;
  scene.scenery.colliders = {{.points = {{8 * px, -1}, {4, -1}, {4, 4 * px}, {8 * px, 4 * px}}},
                             {.points = {{-4, -1}, {4, -1}, {4, 0}, {-4, 0}}}};
  scene.ids = {"wall", "floor"};
  scene.start = {.position = {0, 8 * px}};
  return scene;
}

/// Where everybody is in each step of the first second, and what the technique keeps in memory.
std::pair<std::vector<Vec2d>, std::optional<std::size_t>> run(const std::string& contender, const Scene& scene,
                                                              const std::vector<KnobSetting>& knobs) {
  RunOptions options = alone(contender, std::min(scene.steps, 60));
  options.steps = options.max_replay_steps;
  options.knobs = knobs;
  const ReportScene result = run_scene(scene, options);
  std::vector<Vec2d> ends;
  for (const ReportRun& run : result.runs)
    for (const TraceStep& step : run.steps) ends.push_back(step.path.back().position);
  return {ends, result.rows.front().memory_bytes};
}

TEST(Knobs, change_each_technique_that_has_them_on_some_scene) {
  std::vector<Scene> scenes{low_wall_on_a_floor()};
  for (const char* name : {"article_bullet", "stuck_points", "valley", "leaning_valley", "ledge_hang", "wedge_60",
                           "jump_into_corner", "one_square", "flush_tiles"})
    scenes.push_back(built_in(name));
  for (const char* text : {"unit=0.1", "iterations=1", "points=4", "pairs=all", "response=shorten", "objects=all",
                           "square=0.5", "raster_pixels_per_metre=8", "pixels_per_tile=7"}) {
    const KnobSetting setting = parse_knob(text);
    for (const std::string_view kind : technique_names()) {
      if (!has_knob(kind, setting.key)) continue;
      bool changes = false;
      const std::string contender(kind);
      for (const Scene& scene : scenes)
        changes = changes || run(contender, scene, {}) != run(contender, scene, {setting});
      EXPECT_TRUE(changes) << kind << " " << text;
    }
  }
}

TEST(JumpRules, are_decided_by_the_knob_then_by_the_scene_then_by_who_it_is) {
  const std::vector<KnobSetting> on{parse_knob("jump_rules=on")};
  const std::vector<KnobSetting> off{parse_knob("jump_rules=off")};
  Scene scene = built_in("article_bullet");
  const auto in_force = [&](std::string_view kind, std::span<const KnobSetting> knobs) {
    return jump_rules_in_force(rules_for(*find_technique(kind), scene, knobs));
  };
  for (const std::optional<bool> said : {std::optional<bool>(), std::optional(false), std::optional(true)}) {
    scene.jump_rules = {said, said};
    for (const std::string_view kind : technique_names()) {
      EXPECT_EQ(in_force(kind, on), 1) << kind;
      EXPECT_EQ(in_force(kind, off), 0) << kind;
      EXPECT_EQ(in_force(kind, {}), said.value_or(kind != "octagon_sweep") ? 1 : 0) << kind;
    }
    EXPECT_EQ(jump_rules_in_force(rules_for_twin(scene)), said.value_or(false) ? 1 : 0);
  }
  scene.jump_rules = {.no_jump_toward_wall = false};
  EXPECT_EQ(in_force("speculative", {}), 0.5) << "the scene speaks of one of the two";
  EXPECT_FALSE(rules_for(*find_technique("speculative"), scene).no_jump_toward_wall);
}

}  // namespace
}  // namespace paperproof::compare
