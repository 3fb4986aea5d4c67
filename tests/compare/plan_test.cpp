/// Plans of scenes: what they say the level has no need of, and that the runs are the same bits with and without.
#include "compare/same_steps.hpp"
#include "compare/scene_runs.hpp"
#include "runs/input_cursor.hpp"
#include "runs/scene_plan.hpp"
#include "support/steps_wanted.hpp"

#include "campaign/shapes.hpp"

#include <algorithm>
#include <set>

namespace paperproof::compare {
namespace {

/// Enough for every built-in scene but the million steps of rest, which repeat.
constexpr int most_steps = 400;

/// A contender, or none where it cannot express the scene.
std::unique_ptr<Contender> contender_or_none(std::string_view name, ScalarKind scalar, const Scene& scene,
                                             const Scenery& scenery, const Planning& planning) {
  try {
    return make_contender(name, scalar, scene, scenery, planning);
  } catch (const NotApplicable&) {
    return nullptr;
  }
}

/// Runs one contender planned and full, and compares every bit of every step. @returns whether it could run.
bool expect_same_bits(std::string_view name, ScalarKind scalar, const Scene& scene, const Scenery& scenery,
                      const Script& script, int steps) {
  const auto planned = contender_or_none(name, scalar, scene, scenery, {});
  const auto full = contender_or_none(name, scalar, scene, scenery, {.full = true});
  EXPECT_EQ(planned == nullptr, full == nullptr) << scene.name << " " << name;
  if (!planned || !full) return false;
  InputCursor cursor(scene, script);
  std::vector<TraceStep> one(script.size());
  std::vector<TraceStep> two(script.size());
  try {
    for (int step = 0; step < steps; ++step) {
      const StepInput now = cursor.at(step);
      planned->step(now, one);
      full->step(now, two);
      if (std::equal(one.begin(), one.end(), two.begin(), same_step)) continue;
      ADD_FAILURE() << scene.name << " " << name << ", step " << step << ": planned and full differ";
      return true;
    }
  } catch (const StepRefused&) {
    return true;  // and so does the other, from the same bits
  }
  return true;
}

std::set<std::string_view> left_out(const SceneryDef& def) {
  std::set<std::string_view> stages;
  for (const Omission& omission : plan_of(Scenery(def), {}).omitted) {
    EXPECT_GT(omission.reason.size(), 20U) << omission.stage;
    stages.insert(omission.stage);
  }
  return stages;
}

TEST(LevelPlan, leaves_out_all_but_what_something_in_the_level_needs) {
  const ColliderDef ground = box(-10, -1, 10, 0);
  ColliderDef belt = ground;
  belt.surface_speed = -1;
  ColliderDef ledge = chain({{0, 2}, {1, 2}});
  ledge.one_way = Vec2d(0, 1);
  ColliderDef sensor = polygon({{0, 0}, {2, 0}, {2, 1}});  // slopes of solids alone count
  sensor.sensor = true;
  ColliderDef ghost = ground;
  ghost.filter.group = -1;
  const std::set<std::string_view> all{"filters", "slopes", "movers", "one_way", "sensors"};
  EXPECT_EQ(left_out({{ground}}), all);
  const std::vector<std::pair<std::string_view, ColliderDef>> needs{{"movers", box(20, 0, 21, 1, 0)},
                                                                    {"movers", belt},
                                                                    {"one_way", ledge},
                                                                    {"sensors", sensor},
                                                                    {"filters", ghost},
                                                                    {"slopes", polygon({{0, 0}, {2, 0}, {2, 1}})},
                                                                    {"slopes", chain({{0, 2}, {1, 2 + 0x1p-51}})},
                                                                    {"slopes", circle({0, 5}, 1)}};
  for (const auto& [stage, collider] : needs) {
    std::set<std::string_view> others = all;
    others.erase(stage);
    EXPECT_EQ(left_out({{ground, collider}}), others) << stage;
  }
  EXPECT_TRUE(plan_of(Scenery(SceneryDef{{ground}}), {.full = true}).omitted.empty());
}

TEST(PlanOfScenes, planned_and_full_give_the_same_bits_on_every_registered_scene) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    // As tiles_1e3: full, it takes half a minute to set up.
    if (entry.name == "tiles_1e4" && paperproof::test::steps_wanted("PAPERPROOF_LONG_TESTS", 0) == 0) continue;
    const Scene scene = built_in(entry.name);
    const Scenery scenery(scene.scenery);
    const int steps = std::min(scene.steps, most_steps);
    for (const std::string_view kind : technique_names()) {
      // A step of a march or a picture takes as many units as it is long: in these scenes millions.
      const bool huge =
          entry.name == "article_bullet_extreme" || entry.name == "gravity_1e6" || entry.name == "scaled_1e3";
      if (huge && kind != "octagon_sweep" && kind != "speculative") continue;
      const bool ran = expect_same_bits(kind, ScalarKind::binary64, scene, scenery, script_of(scene), steps);
      EXPECT_TRUE(ran || kind != "octagon_sweep") << entry.name;
    }
    expect_same_bits("octagon_sweep", ScalarKind::binary32, scene, scenery, script_of(scene), steps);
  }
}

}  // namespace
}  // namespace paperproof::compare
