/// Plans of scenes: what they leave out, and that the runs are the same bits with and without.
#include "compare/scene_runs.hpp"
#include "runs/input_cursor.hpp"
#include "runs/scene_plan.hpp"
#include "support/steps_wanted.hpp"

#include <algorithm>
#include <set>

namespace paperproof::compare {
namespace {

/// Enough for every built-in scene but the million steps of rest, which repeat.
constexpr int most_steps = 400;

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const Vec2d& a, const Vec2d& b) { return same(a.x(), b.x()) && same(a.y(), b.y()); }

bool same(const Contact<double>& a, const Contact<double>& b) {
  return a.collider == b.collider && a.side == b.side && same(a.point, b.point) && same(a.normal, b.normal) &&
         same(a.fraction, b.fraction) && same(a.separation, b.separation);
}

bool same(const CrowdContact<double>& a, const CrowdContact<double>& b) {
  return a.other == b.other && a.side == b.side && same(a.normal, b.normal) && same(a.fraction, b.fraction);
}

bool same(const PathPoint<double>& a, const PathPoint<double>& b) {
  return same(a.position, b.position) && same(a.fraction, b.fraction);
}

bool same(const SensorEvent<double>& a, const SensorEvent<double>& b) {
  return a.sensor == b.sensor && a.change == b.change && same(a.fraction, b.fraction);
}

template <class Item>
bool same(const std::vector<Item>& a, const std::vector<Item>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Item& x, const Item& y) { return same(x, y); });
}

bool same_step(const TraceStep& a, const TraceStep& b) {
  return same(a.path, b.path) && same(a.requested, b.requested) && same(a.velocity, b.velocity) &&
         a.grounded == b.grounded && a.jumping == b.jumping && same(a.contacts, b.contacts) && same(a.met, b.met) &&
         a.crushed == b.crushed && a.dropped_through == b.dropped_through && same(a.sensors, b.sensors) &&
         a.stuck == b.stuck && a.dropped == b.dropped;
}

/// A contestant, or none where it cannot express the scene.
std::unique_ptr<Contestant> contestant_or_none(std::string_view name, ScalarKind scalar, const Scene& scene,
                                               const Scenery<double>& scenery, const Planning& planning) {
  try {
    return make_contestant(name, scalar, scene, scenery, planning);
  } catch (const NotApplicable&) {
    return nullptr;
  }
}

/// Runs one contender planned and full, and compares every bit of every step. @returns whether it could run.
bool expect_same_bits(std::string_view name, ScalarKind scalar, const Scene& scene, const Scenery<double>& scenery,
                      const Script& script, int steps) {
  const Foreseen foreseen = foreseen_in(scene, script);
  const auto planned = contestant_or_none(name, scalar, scene, scenery, {.full = false, .foreseen = foreseen});
  const auto full = contestant_or_none(name, scalar, scene, scenery, {.full = true, .foreseen = foreseen});
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

TEST(PlanOfScenes, takes_back_an_omission_when_the_scene_comes_to_need_it) {
  Scene scene = built_in("article_bullet");
  const auto stages = [&scene] {
    return plan_of(Scenery<double>(scene.scenery), Planning{.foreseen = foreseen_in(scene, script_of(scene))}).stages;
  };
  EXPECT_FALSE(stages().one_way || stages().movers || stages().jump || stages().gravity);
  scene.scenery.colliders.push_back(
      {.shape = ColliderDef::Shape::chain, .points = {{0, 9}, {1, 9}}, .one_way = Vec2d(0, 1)});
  EXPECT_TRUE(stages().one_way);
  scene.scenery.colliders.push_back({.points = {{5, 9}, {6, 9}, {6, 10}}, .mover = 0});
  EXPECT_TRUE(stages().movers && stages().slopes);
  scene.input = {{.step = 7, .move = std::nullopt, .jump = true}};
  EXPECT_TRUE(stages().jump);
  scene.gravity = {0, -0x1p-1074};
  EXPECT_TRUE(stages().gravity);
}

TEST(PlanOfScenes, minus_zero_is_a_gravity) {
  Scene scene = built_in("article_bullet");
  EXPECT_FALSE(foreseen_in(scene, script_of(scene)).gravity);
  scene.gravity = {0, -0.0};
  scene.start.velocity = {-0.0, -0.0};
  EXPECT_TRUE(foreseen_in(scene, script_of(scene)).gravity);
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

TEST(PlanOfScenes, random_input_may_jump) {
  const Scene scene = built_in("flush_tiles");
  EXPECT_FALSE(foreseen_in(scene, script_of(scene)).jump);
  EXPECT_TRUE(foreseen_in(scene, random_script(scene, 1, 600)).jump);
}

TEST(PlanOfScenes, planned_and_full_give_the_same_bits_on_every_registered_scene) {
  for (const BuiltInScene& entry : test::sampled_of(built_in_scenes())) {
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

/// Every map under a folder, with random walking and jumping. @returns how many.
/// @param every of so many levels one is run.
int compare_maps(const std::filesystem::path& folder, int every = 1) {
  int maps = 0;
  int levels = 0;
  constexpr int steps = 300;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".tmx" && extension != ".tmj" && extension != ".json" && extension != ".stl") continue;
    if (levels++ % every != 0) continue;
    std::vector<Scene> scenes;
    try {
      scenes = load_scenes(entry.path().string());
    } catch (const InputError&) {
      continue;  // a tileset, a world map: no level
    }
    for (const Scene& scene : scenes) {
      const Scenery<double> scenery(scene.scenery);
      maps += expect_same_bits("octagon_sweep", ScalarKind::binary64, scene, scenery, random_script(scene, 1, steps),
                               steps);
    }
  }
  return maps;
}

TEST(PlanOfMaps, planned_and_full_give_the_same_bits_on_the_maps_of_four_families) {
  const std::filesystem::path folder = std::filesystem::path(PAPERPROOF_SOURCE_DIR) / ".." / "shared" / "levels";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is missing";
  EXPECT_GE(compare_maps(folder), 10);
}

TEST(PlanOfMaps, planned_and_full_give_the_same_bits_on_every_supertux_level) {
  const std::filesystem::path folder = "/usr/share/games/supertux2/levels";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "supertux-data is not installed";
  const int every = test::sanitized ? 8 : 1;  // what a level's content needs is needed by many
  EXPECT_GE(compare_maps(folder, every), 200 / every);
}

}  // namespace
}  // namespace paperproof::compare
