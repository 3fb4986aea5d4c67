#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"
#include "scenes/step_times.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

namespace paperproof::compare {
namespace {

/// How far the character reaches that way [m].
double reach_of(const Scene& scene, const Vec2d& way) {
  double reach = 0;
  for (const Vec2d& point : scene.character.shape.points()) reach = std::max(reach, way.dot(point));
  return reach;
}

/// A mover that goes on by the same way in each step.
MoverIndex add_steady(Scene& scene, const Vec2d& from, const Vec2d& way) {
  add_sampled_mover(scene, [&](int step) { return Vec2d(from + step * way); });
  return static_cast<MoverIndex>(scene.movers.size() - 1);
}

/// A run of so many steps without gravity; a velocity of 1 m/s is a way of 1 m per step.
RandomRun of_free_flight(int steps) {
  RandomRun run;
  run.scene.gravity.setZero();
  run.scene.dt = 1;
  run.scene.steps = steps;
  return run;
}

/// A box of the article's size, with corners cut off or without.
CharacterShape draw_box(Random& random) {
  const double cut = random.chance(0.5) ? 0 : random.log_between(1e-6, 0.1);
  std::vector<Vec2d> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      points.emplace_back(x * half_width, y * (half_height - cut));
      if (cut > 0) points.emplace_back(x * (half_width - 0.7 * cut), y * half_height);  // at 45 degrees sides are alike
    }
  return CharacterShape(points);
}

Vec2d rounded(const Vec2d& v, double lattice) { return (v / lattice).array().round() * lattice; }

}  // namespace

RandomRun draw_near_a_corner(std::uint64_t seed) {
  Random random(seed);
  RandomRun run = of_free_flight(1);
  const double heading = any_direction(random);
  const Vec2d along = towards(heading);
  const Vec2d side{-along.y(), along.x()};  // the triangle is on this side of the flight
  const Vec2d corner = random.point(100);
  const auto behind = [&](double turned) -> Vec2d {
    return corner + towards(heading + std::numbers::pi / 2 + turned) * random.between(0.5, 2);
  };
  const Vec2d before = behind(-random.between(0.2, 1.4));
  run.scene.scenery.colliders = {polygon({corner, before, behind(random.between(0.2, 1.4))})};
  const double nearer = random.either_sign_log_between(1e-16, 1e-1);
  run.scene.start.position = corner - side * (reach_of(run.scene, side) - nearer) - along * random.between(2, 5);
  run.scene.start.velocity = along * random.between(8, 20);
  return run;
}

RandomRun draw_through_sensors(std::uint64_t seed) {
  Random random(seed);
  RandomRun run = of_free_flight(4);
  // Coarse: the same coordinates come again, so that there are touches, grazes and shared corners.
  const double lattice = random.chance(0.5) ? 0.25 : 1.0 / 1024;
  for (int n = random.integer(1, 3); n > 0; --n) {
    const Vec2d centre = random.point(2);
    ColliderDef sensor = random.chance(0.25) ? chain({}) : polygon({});
    sensor.sensor = true;
    const int corners = random.integer(3, 8);
    for (int i = 0; i < corners; ++i)
      sensor.points.push_back(
          rounded(centre + random.between(0.75, 3) * towards(2 * std::numbers::pi * i / corners), lattice));
    const Vec2d from = rounded(random.point(2), lattice);
    if (random.chance(0.5)) sensor.mover = add_steady(run.scene, from, rounded(random.point(2), lattice));
    run.scene.scenery.colliders.push_back(sensor);
  }
  run.scene.start.position = rounded(random.point(4), lattice);
  for (int step = 0; step < run.scene.steps; ++step) {
    Vec2d way = rounded(random.point(6), lattice);
    if (random.chance(0.3)) way[random.below(2)] = 0;
    add_launch(run, {.step = step, .velocity = way});
  }
  return run;
}

RandomRun draw_exact_fit(bool rests, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  constexpr std::array gaps{0.0, 1e-9, 1e-8, 1e-7, 2e-7};
  const double gap = gaps[static_cast<std::size_t>(random.below(5))];
  const auto motion = [&random, rests]() -> Vec2d {
    const double scale = random.chance(0.5) ? 1.0 / 16 : 1.0 / 3;
    Vec2d way = scale * rounded(random.point(2.5), 1);
    if (random.chance(0.5)) way[random.below(2)] = 0;
    return rests ? Vec2d{0, 0} : way;
  };
  const Vec2d middle = rounded(random.point(1), 1.0 / 64);
  scene.start.position = middle;
  scene.gravity = {0, -15.0 * random.below(3)};
  scene.steps = 3;
  const Vec2d together = motion();
  const int sides = random.below(3);  // 0: only left and right, 1: only below and above
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0}) {
      if (sides == 1 - axis) continue;
      Vec2d lower = middle - Vec2d(2, 2);
      Vec2d upper = middle + Vec2d(2, 2);
      if (random.chance(0.2)) lower[1 - axis] = middle[1 - axis];  // there is a way around
      const double near = middle[axis] + sign * ((axis == 0 ? half_width : half_height) + gap);
      (sign < 0 ? upper : lower)[axis] = near;
      (sign < 0 ? lower : upper)[axis] = near + sign * random.integer(1, 4) / 8.0;
      ColliderDef& wall = scene.scenery.colliders.emplace_back(box(lower.x(), lower.y(), upper.x(), upper.y()));
      const int kind = random.below(5);
      if (kind == 0) continue;
      const Vec2d from = rounded(random.point(1), 1.0 / 64) / (gap > 0 && random.chance(0.5) ? 3 : 1);
      for (Vec2d& point : wall.points) point -= from;
      wall.mover = add_steady(scene, from, kind == 1 ? Vec2d{0, 0} : kind == 2 ? motion() : together);
    }
  for (int step = 0; step < scene.steps; ++step) {
    const double move = random.integer(-1, 1);
    scene.input.push_back({.step = step, .move = move, .jump = random.chance(0.4)});
  }
  return run;
}

RandomRun draw_opening(std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  scene.gravity = {0, -30};
  scene.dt = random.chance(0.5) ? 1.0 / 60 : random.log_between(1e-4, 1.0 / 30);
  scene.steps = 12;
  draw_rules(random, scene.character);
  scene.character.shape = draw_box(random);
  const Vec2d middle = random.chance(0.5) ? random.point(100) : Vec2d{0, 0};
  scene.start.position = middle;
  const int across = random.integer(0, 1);  // 1: a window, which is as high as the character
  const int into = 1 - across;
  const Vec2d half{half_width, half_height};
  const double side = across == 0 || random.chance(0.5) ? -1 : 1;
  const double larger = random.between(-1e-6, 1e-6);
  const double share = random.chance(0.3) ? 0.5 : random.between(0, 1);
  const double near =
      side * (half[into] + (random.chance(0.7) ? random.between(0, 1e-6) : random.log_between(1e-9, 1e-3)));
  for (const double end : {-1.0, 1.0}) {
    const double rim = end * (half[across] + larger * (end < 0 ? share : 1 - share));
    Vec2d corner;
    Vec2d opposite;
    corner[across] = rim;
    corner[into] = near;
    opposite[across] = rim + end * random.between(0.1, 8);
    opposite[into] = near + side * random.between(0.05, 2);
    const Vec2d lower = middle + corner.cwiseMin(opposite);
    const Vec2d upper = middle + corner.cwiseMax(opposite);
    scene.scenery.colliders.push_back(box(lower.x(), lower.y(), upper.x(), upper.y()));
  }
  for (int step = 0; step < scene.steps; ++step) {
    const double move = across == 1 && random.chance(0.8) ? side : random.integer(-1, 1);
    scene.input.push_back({.step = step, .move = move, .jump = random.chance(0.05)});
  }
  return run;
}

RandomRun draw_touched_by_ledge(std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  const Vec2d along = towards(random.chance(0.3) ? 0 : random.between(-1, 1));
  const Vec2d normal{-along.y(), along.x()};
  if (random.chance(0.5)) run.centre = random.point(1e4);
  for (const double end : {-3, 3}) {
    scene.scenery.colliders.push_back(chain({run.centre, run.centre + end * along}, 0));
    scene.scenery.colliders.back().one_way = Vec2d{0, 1};
  }
  scene.dt = random.chance(0.5) ? 1.0 / 60 : random.log_between(1e-4, 0.1);
  scene.gravity = {0, random.chance(0.7) ? -30 : 0};
  scene.steps = 6;
  const Vec2d velocity = random.point(random.log_between(1e-3, 100));
  if (random.chance(0.7)) scene.start.velocity = velocity;
  const Vec2d way = (scene.start.velocity + scene.gravity * scene.dt) * scene.dt;
  Vec2d at = random.chance(0.3) ? Vec2d{0, 0} : random.point(2);
  // What is wanted ends where the two touch, but for rounding; the ledge comes from below by `closes`.
  const double closes = random.chance(0.3) ? 0 : random.log_between(1e-16, 10);
  const double slides = random.chance(0.3) ? 0 : random.between(-1, 1);
  scene.start.position = run.centre + at + along * random.between(-1, 1) + normal * reach_of(scene, -normal) - way;
  const StepTimes times(scene);
  scene.movers = {{.id = "ledge", .path = {{0, at - (normal * closes + along * slides + way)}}}};
  for (int step = 0; step < scene.steps; ++step) {
    scene.movers[0].path.push_back({times.end(step), at});
    if (random.chance(0.5)) at += random.point(0.1);
  }
  return run;
}

RandomRun draw_inside(Terrain terrain, std::uint64_t seed) {
  RandomRun run = draw_still(terrain, seed, false);
  Random random(seed);
  run.may_begin_inside = true;
  run.launches.clear();
  run.scene.start.velocity.setZero();
  run.scene.steps = 1;
  if (!random.chance(0.5)) return run;
  // A frame around, so that there may be no way out.
  const double r = random.between(0.7, 3.5);
  const double opening = random.chance(0.3) ? random.between(0.1, 1.5) : 0;
  ColliderDef frame = chain({{-r + opening, -r}, {r, -r}, {r, r}, {-r, r}, {-r, -r}});
  for (Vec2d& point : frame.points) point += run.scene.start.position;
  run.scene.scenery.colliders.push_back(frame);
  return run;
}

}  // namespace paperproof::compare
