/// A hero in a Box2D world made of a map steps as the controller over the whole map.
#include "scenes/load.hpp"
#include "support/box2d_level.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/box2d/hero.hpp>
#include <paperproof/box2d/world_scenery.hpp>

#include <gtest/gtest.h>

#include <filesystem>

namespace paperproof::compare {
namespace {

using paperproof::box2d::Hero;
using paperproof::box2d::scenery_of;
using paperproof::box2d::WorldScenery;

/// @return how many steps the hero touched something in.
int expect_same_bits(const Scene& scene, const std::string& name) {
  constexpr double dt = 1.0 / 60;
  test::Random random(1);
  b2World world({0, -30});
  test::build_level(world, Scenery<double>(scene.scenery));
  const WorldScenery borrowed = scenery_of(world);
  const Scenery<double> scenery(borrowed.scenery);
  const Controller<double> controller(scenery, scene.character);
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
  state.position = scene.start.position;
  // `scenery_of` reads one-sided chains as chains that block from both sides.
  const auto solid = [](b2Fixture&) { return box2d::Surface{.blocks = box2d::Blocking::from_everywhere}; };
  Hero hero(world, {.character = scene.character, .position = state.position, .surface_of = solid});
  Input input;
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    if (i % 20 == 0) input = {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
    world.Step(static_cast<float>(dt), 8, 3);
    hero.step(input, dt);
    controller.step(state, input, {{0, -30}, dt}, scratch, report);
    EXPECT_EQ(hero.position(), state.position) << name << ", step " << i;
    EXPECT_EQ(hero.velocity(), state.velocity) << name << ", step " << i;
    EXPECT_EQ(hero.grounded(), state.grounded) << name << ", step " << i;
    touching += !hero.contacts().empty();
    if (hero.position() != state.position) break;
  }
  return touching;
}

void expect_same_in_maps(const std::filesystem::path& folder, int every, int least) {
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is missing";
  int maps = 0;
  int touching = 0;
  int levels = 0;
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
    for (const Scene& scene : scenes) touching += expect_same_bits(scene, entry.path().string());
    maps += static_cast<int>(scenes.size());
  }
  EXPECT_GE(maps, least);
  EXPECT_GE(touching, 20 * maps);
}

TEST(HeroInMaps, steps_as_the_controller_over_the_maps_of_four_families) {
  expect_same_in_maps(std::filesystem::path(PAPERPROOF_SOURCE_DIR) / ".." / "shared" / "levels", 1, 10);
}

TEST(HeroInMaps, steps_as_the_controller_over_supertux_levels) {
  const int every = test::steps_wanted("PAPERPROOF_EVERY_LEVEL", 0) > 0 ? 1 : 8;
  expect_same_in_maps("/usr/share/games/supertux2/levels", every, 200 / every);
}

}  // namespace
}  // namespace paperproof::compare
