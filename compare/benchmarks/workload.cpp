#include "workload.hpp"

#include "scenes/load.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace paperproof::benchmarks {
namespace {

using compare::InputEvent;
using compare::Scene;

/// Steps per pass: 16 s of play.
constexpr int steps = 1000;
constexpr std::uint64_t seed = 1;
/// The first with which neither the controller nor Box2D falls off the level, where a step costs next to nothing.
constexpr std::uint64_t supertux_seed = 6;

constexpr int level_width = 500;
constexpr int ground_depth = 16;
constexpr int level_pieces = 10'000;
constexpr double half_height = 20.0 / 32;

void add_tile(Scene& scene, int column, int row) {
  const double left = column;
  const double bottom = row;
  scene.ids.push_back("tile" + std::to_string(scene.ids.size()));
  scene.scenery.colliders.push_back(
      {.points = {{left, bottom}, {left + 1, bottom}, {left + 1, bottom + 1}, {left, bottom + 1}}});
}

/// Flat ground of tiles, many deep, under rows of platforms up to 8 tiles wide. Each tile is a collider: the level that
/// an editor exports when nobody joins the tiles.
Scene tiles() {
  Scene scene;
  for (int row = -ground_depth; row < 0; ++row)
    for (int column = 0; column < level_width; ++column) add_tile(scene, column, row);
  for (int row = 3; static_cast<int>(scene.ids.size()) < level_pieces; row += 3)
    for (int column = row % 16; column + 8 < level_width && static_cast<int>(scene.ids.size()) < level_pieces; ++column)
      if (column / 8 % 2 == 0) add_tile(scene, column, row);
  scene.start.position = {level_width / 2.0 + 0.25, half_height + 0.02};
  scene.steps = steps;
  return scene;
}

Scene fast_tiles() {
  Scene scene = tiles();
  scene.character.walk_speed = scene.character.jump_speed = 100;
  scene.character.acceleration = 100 / scene.dt;
  return scene;
}

void add_supertux(std::vector<std::shared_ptr<const Workload>>& all) {
  const char* const level = "/usr/share/games/supertux2/levels/bonus3/hilly_landscape.stl";
  if (!std::filesystem::exists(level)) {
    std::cerr << level << " is not installed (package supertux-data): left out\n";
    return;
  }
  all.push_back(std::make_shared<const Workload>("hilly_landscape", compare::load_scenes(level).front(),
                                                 compare::random_input(supertux_seed, steps)));
}

std::vector<Input> input_of_every_step(const std::vector<InputEvent>& events) {
  std::vector<Input> inputs;
  for (int step = 0; step < steps; ++step) inputs.push_back(compare::input_at(events, step));
  return inputs;
}

}  // namespace

Workload::Workload(std::string name_, Scene scene_, const std::vector<InputEvent>& events)
    : name(std::move(name_)), scene(std::move(scene_)), inputs(input_of_every_step(events)), scenery(scene.scenery) {}

std::vector<std::shared_ptr<const Workload>> all_workloads() {
  const std::vector<InputEvent> stand{{.step = 0, .move = 0.0, .jump = false}};
  const std::vector<InputEvent> walk{{.step = 0, .move = 1.0, .jump = false}};
  const std::vector<InputEvent> random = compare::random_input(seed, steps);
  std::vector<std::shared_ptr<const Workload>> all;
  add_supertux(all);
  all.push_back(std::make_shared<const Workload>("tiles_resting", tiles(), stand));
  all.push_back(std::make_shared<const Workload>("tiles_walking", tiles(), walk));
  all.push_back(std::make_shared<const Workload>("tiles_walking_and_jumping", tiles(), random));
  all.push_back(std::make_shared<const Workload>("tiles_100_metres_per_second", fast_tiles(), random));
  return all;
}

}  // namespace paperproof::benchmarks
