/// Random scenes for the continuous reference, and steps of octagon_sweep beside it.
#pragma once

#include "continuous/course.hpp"
#include "scenes/scene.hpp"
#include "support/random_runs.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/techniques.hpp>

#include <cmath>
#include <numbers>

namespace paperproof::compare::continuous {

inline void add_solid(Scene& scene, std::vector<Vec2d> points) {
  scene.ids.push_back("solid_" + std::to_string(scene.ids.size()));
  scene.scenery.colliders.push_back({.points = std::move(points)});
}

/// The scene with steps that are 2^halvings times shorter; its events stay at their times.
inline Scene refined(Scene scene, int halvings) {
  const int factor = 1 << halvings;
  scene.dt /= factor;
  scene.steps *= factor;
  for (InputEvent& event : scene.input) event.step *= factor;
  return scene;
}

/// The largest distance between octagon_sweep's positions at the ends of steps and the course [m].
inline double error_of(const Scene& scene, const Course<Number<50>>& course) {
  const Scenery<double> scenery(scene.scenery);
  const Controller<double> controller(scenery, scene.character);
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
  state.position = scene.start.position;
  state.velocity = scene.start.velocity;
  double largest = 0;
  Input input;
  auto next = scene.input.begin();
  for (int step = 0; step < scene.steps; ++step) {
    for (; next != scene.input.end() && next->step == step; ++next) apply(*next, input);
    controller.step(state, input, {scene.gravity, scene.dt}, scratch, report);
    largest = std::max(largest, (state.position - course.at((step + 1) * scene.dt)).norm());
  }
  return largest;
}

/// Ground of slopes of any steepness and of kerbs, from one wall to another; each part is a solid of its own.
inline void add_random_ground(Scene& scene, test::Random& random) {
  double x = -12;
  double y = 0;
  add_solid(scene, {{-14, -20}, {-12, -20}, {-12, 20}, {-14, 20}});
  while (x < 12) {
    const double width = random.between(0.5, 3);
    const bool steep = random.chance(0.3);
    const double degrees = steep ? random.between(52, 75) : random.between(0, 48);
    const bool up = y < -1 || (y <= 1 && random.chance(0.5));
    const double sign = up ? 1 : -1;
    const double share = steep ? 0.4 : 1;
    const double next = random.chance(0.3) ? y : y + sign * share * width * std::tan(degrees * std::numbers::pi / 180);
    add_solid(scene, {{x, -20}, {x + share * width, -20}, {x + share * width, next}, {x, y}});
    x += share * width;
    y = next;
    if (random.chance(0.15)) y += random.between(-1, 0.5);
  }
  add_solid(scene, {{x, -20}, {x + 2, -20}, {x + 2, 20}, {x, 20}});
}

/// Convex solids that hang over the ground: their lower sides are ceilings.
inline void add_random_blocks(Scene& scene, test::Random& random) {
  for (int count = random.integer(0, 5); count > 0; --count) {
    const Vec2d middle{random.between(-10, 10), random.between(2, 6)};
    const double radius = random.between(0.3, 1.2);
    const double turn = random.angle();
    std::vector<Vec2d> points;
    const int corners = random.integer(3, 6);
    for (int k = 0; k < corners; ++k) {
      const double angle = turn + 2 * std::numbers::pi * k / corners;
      points.push_back(middle + radius * Vec2d(std::cos(angle), std::sin(angle)));
    }
    add_solid(scene, points);
  }
}

/// Falls from above the ground, and walks, stands and jumps at random for three seconds. Steps are 1/32 s.
inline Scene random_scene(std::uint64_t seed) {
  test::Random random(seed);
  Scene scene;
  scene.name = "random_" + std::to_string(seed);
  scene.gravity = {0, -random.between(8, 30)};
  scene.dt = 1.0 / 32;
  scene.steps = 96;
  scene.character.walk_speed = random.between(2, 8);
  scene.character.acceleration = random.between(10, 60);
  scene.character.jump_speed = random.between(4, 11);
  if (random.chance(0.3)) scene.character.max_fall_speed = random.between(5, 15);
  add_random_ground(scene, random);
  add_random_blocks(scene, random);
  scene.start.position = {random.between(-8, 8), 10};
  scene.start.velocity = {random.between(-6, 6), random.between(-15, 0)};
  for (int step = 0; step < scene.steps; step += random.integer(4, 24)) {
    InputEvent event{.step = step, .move = random.integer(-1, 1), .jump = random.chance(0.4)};
    if (random.chance(0.2)) event.move = random.between(-1, 1);
    scene.input.push_back(event);
  }
  return scene;
}

}  // namespace paperproof::compare::continuous
