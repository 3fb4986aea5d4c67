/// Plans of scenes: what they leave out, and that the runs are the same bits with and without. Random sceneries are
/// planned in the tests of the controller.
#include "compare/same_steps.hpp"
#include "compare/scene_runs.hpp"
#include "runs/input_cursor.hpp"
#include "runs/scene_plan.hpp"

#include <algorithm>
#include <set>

namespace paperproof::compare {
namespace {

/// Enough for every built-in scene but the million steps of rest, which repeat.
constexpr int most_steps = 400;

/// A contender, or none where it cannot express the scene.
std::unique_ptr<Contender> contender_or_none(std::string_view name, ScalarKind scalar, const Scene& scene,
                                             const Scenery<double>& scenery, const Planning& planning) {
  try {
    return make_contender(name, scalar, scene, scenery, planning);
  } catch (const NotApplicable&) {
    return nullptr;
  }
}

/// Runs one contender planned and full, and compares every bit of every step. @returns whether it could run.
bool expect_same_bits(std::string_view name, ScalarKind scalar, const Scene& scene, const Scenery<double>& scenery,
                      const Script& script, int steps) {
  const Foreseen foreseen = foreseen_in(scene, script);
  const auto planned = contender_or_none(name, scalar, scene, scenery, {.full = false, .foreseen = foreseen});
  const auto full = contender_or_none(name, scalar, scene, scenery, {.full = true, .foreseen = foreseen});
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

std::set<Stage> left_out(const std::string& name) {
  const Scene scene = built_in(name);
  const Plan plan = plan_of(Scenery<double>(scene.scenery), Planning{.foreseen = foreseen_in(scene, script_of(scene))});
  std::set<Stage> stages;
  for (const Omission& omission : plan.omitted) stages.insert(omission.stage);
  return stages;
}

TEST(PlanOfScenes, leaves_out_five_different_sets_of_five_scenes) {
  using enum Stage;
  EXPECT_EQ(left_out("article_bullet"), (std::set{movers, one_way, sensors, slopes, jump, gravity}));
  EXPECT_EQ(left_out("flush_tiles"), (std::set{movers, one_way, sensors, slopes, jump}));
  EXPECT_EQ(left_out("skier"), (std::set{movers, one_way, sensors, jump}));
  EXPECT_EQ(left_out("jump_into_wall"), (std::set{movers, one_way, sensors, slopes}));
  EXPECT_EQ(left_out("rotated_wall"), (std::set{movers, one_way, sensors, jump, gravity}));
}

TEST(PlanOfScenes, minus_zero_is_a_gravity_and_random_input_may_jump) {
  Scene scene = built_in("article_bullet");
  EXPECT_FALSE(foreseen_in(scene, script_of(scene)).gravity);
  scene.gravity = {0, -0.0};
  scene.start.velocity = {-0.0, -0.0};
  EXPECT_TRUE(foreseen_in(scene, script_of(scene)).gravity);
  EXPECT_FALSE(foreseen_in(scene, script_of(scene)).jump);
  EXPECT_TRUE(foreseen_in(scene, random_script(scene, 1, 600)).jump);
  const Scenery<double> scenery(scene.scenery);
  for (const std::string_view name : contender_names())
    if (!is_reference(name)) expect_same_bits(name, ScalarKind::binary64, scene, scenery, script_of(scene), 3);
}

TEST(PlanOfScenes, among_movers_characters_are_slopes_to_each_other) {
  const Scene scene = built_in("two_on_a_lift");
  Foreseen foreseen = foreseen_in(scene, script_of(scene));
  EXPECT_TRUE(foreseen.company);
  const Scenery<double> scenery(scene.scenery);
  EXPECT_TRUE(make_plan(scenery, foreseen).stages.slopes);
  foreseen.company = false;
  EXPECT_FALSE(make_plan(scenery, foreseen).stages.slopes);
}

TEST(PlanOfScenes, planned_and_full_give_the_same_bits_on_every_registered_scene) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    const Scene scene = built_in(entry.name);
    const Scenery<double> scenery(scene.scenery);
    const int steps = std::min(scene.steps, most_steps);
    for (const std::string_view kind : technique_names()) {
      // A step of a march or a picture takes as many units as it is long: in these scenes millions.
      const bool huge =
          entry.name == "article_bullet_extreme" || entry.name == "gravity_1e6" || entry.name == "scaled_1e3";
      if (huge && kind != "octagon_sweep" && kind != "speculative") continue;
      expect_same_bits(kind, ScalarKind::binary64, scene, scenery, script_of(scene), steps);
    }
    EXPECT_TRUE(expect_same_bits("octagon_sweep", ScalarKind::binary64, scene, scenery, script_of(scene), steps))
        << entry.name;
    expect_same_bits("octagon_sweep", ScalarKind::binary32, scene, scenery, script_of(scene), steps);
  }
}

}  // namespace
}  // namespace paperproof::compare
