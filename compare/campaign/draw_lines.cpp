#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"
#include "scenes/step_times.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace paperproof::compare {
namespace {

/// A flank goes on to the right by so much.
Vec2d flank(Random& random) {
  constexpr std::array some{-45, 0, 45, 50, -50};
  const double steepest = random.chance(0.5) ? 50 : 89;
  const double rise = random.between(-steepest, steepest);
  const double length = random.log_between(1e-2, 4);
  return length * towards((random.chance(0.4) ? some[static_cast<std::size_t>(random.below(5))] : rise) * degree);
}

/// Around the origin.
std::vector<Vec2d> points_of(Line line, Random& random) {
  std::vector<Vec2d> points{{-3, 0}};
  switch (line) {
    case Line::hill:
      for (int flanks = random.integer(2, 8); flanks > 0; --flanks) points.emplace_back(points.back() + flank(random));
      break;
    case Line::arch: {
      const int segments = random.integer(4, 64);
      const double height = random.between(0.2, 2);
      for (int i = segments - 1; i >= 0; --i) {
        const Vec2d at = towards(std::numbers::pi * i / segments);
        points.emplace_back(3 * at.x(), height * at.y());
      }
      break;
    }
    case Line::sawtooth: {
      const double tooth = random.log_between(0.05, 1.5);
      const double height = tooth * random.between(0.05, 1.5);
      const double lean = tooth * random.between(0.1, 0.9);
      for (double x = -3; x <= 3; x += tooth) points.insert(points.end(), {{x + lean, height}, {x + tooth, 0}});
      break;
    }
    case Line::ramp: {
      const Vec2d along = towards(random.chance(0.3) ? 0 : random.between(-47, 47) * degree);
      const bool is_float = random.chance(0.5);
      const double off = random.chance(0.2) ? 0 : random.log_between(1e-13, 1e-6);
      const double piece = random.log_between(0.2, 2);
      const Vec2d origin = random.point(60);
      points.clear();
      for (double at = -8; at < 8; at += piece * random.between(0.5, 1.5)) {
        const Vec2d point = origin + along * at + Vec2d{0, off * random.between(-1, 1)};
        points.emplace_back((is_float ? Vec2d(point.cast<float>().cast<double>()) : point) - origin);
      }
      break;
    }
  }
  return points;
}

/// The ground below a line.
ColliderDef below(std::vector<Vec2d> points, double bottom) {
  points.insert(points.end(), {{points.back().x(), bottom}, {points.front().x(), bottom}});
  return polygon(std::move(points));
}

/// As one solid, as one chain, of tiles, or one-way and of any parts.
std::vector<ColliderDef> made_of(const std::vector<Vec2d>& points, Random& random) {
  double bottom = points[0].y();
  for (const Vec2d& point : points) bottom = std::min(bottom, point.y() - 2);
  const bool one_way = random.chance(0.4);
  const bool is_whole = random.chance(0.6);
  if (!one_way && is_whole) return {random.chance(0.5) ? below(points, bottom) : chain(points)};
  const double cut = !one_way ? 1 : is_whole ? 0 : random.unit();
  std::vector<ColliderDef> parts;
  std::vector<Vec2d> part{points[0]};
  for (std::size_t i = 1; i < points.size(); ++i) {
    part.push_back(points[i]);
    if (i + 1 < points.size() && !random.chance(cut)) continue;
    const bool is_solid = !one_way || random.chance(0.3);
    if (!is_solid && random.chance(0.3)) std::reverse(part.begin(), part.end());
    parts.push_back(is_solid ? below(part, bottom) : chain(part));
    if (one_way) parts.back().one_way = Vec2d{0, 1};
    part = {points[i]};
  }
  return parts;
}

/// Up to a few steps before its last point that touches a flank is at a corner of the line.
void start_before_a_corner(const std::vector<Vec2d>& points, Random& random, Scene& scene) {
  const auto corner = static_cast<std::size_t>(random.integer(1, static_cast<int>(points.size()) - 2));
  const double to_the_right = random.chance(0.5) ? 1 : -1;
  const Vec2d along = (points[corner] - points[to_the_right > 0 ? corner - 1 : corner + 1]).normalized();
  const Vec2d normal = to_the_right * Vec2d{-along.y(), along.x()};
  Vec2d lowest = scene.character.shape.points()[0];
  for (const Vec2d& point : scene.character.shape.points())
    if (normal.dot(point) < normal.dot(lowest) - 1e-12) lowest = point;
  const double speed = random.log_between(0.1, 30);
  const double gap = random.chance(0.6) ? 5e-7 : random.log_between(2e-7, 1e-3);
  scene.start.position = points[corner] - lowest + normal * gap - along * (speed * scene.dt * random.between(0, 5));
  scene.start.velocity = along * speed;
  if (random.chance(0.4)) scene.start.velocity += normal * random.either_sign_log_between(1e-9, 3);
}

}  // namespace

RandomRun draw_on_line(Line line, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  if (random.chance(0.2)) run.centre = random.point(1e5);
  run.reach = 12;
  std::vector<Vec2d> points = points_of(line, random);
  for (Vec2d& point : points) point += run.centre;
  scene.scenery.colliders = made_of(points, random);
  scene.character.shape = play_shape(random.below(3));
  scene.character.walk_speed = random.log_between(0.5, 12);
  if (random.chance(0.3)) scene.character.snap = 0.3;
  scene.gravity = {0, -random.log_between(10, 50)};
  scene.dt = random.chance(0.5) ? 1.0 / 60 : 1 / random.log_between(30, 4096);
  scene.steps = 60;
  if (line == Line::ramp || random.chance(0.5)) {
    start_before_a_corner(points, random, scene);
  } else {
    const double height = random.chance(0.6) ? random.between(0.7, 2.5) : random.between(-2.5, 0);
    scene.start.position = run.centre + Vec2d{random.between(-2, 2), height};
  }
  if (random.chance(0.3)) return run;
  Input input;
  for (int step = 0; step < scene.steps; ++step) {
    if (random.chance(0.1)) input.move = random.integer(-1, 1);
    input.drop = random.chance(input.drop ? 0.7 : 0.05);
    scene.input.push_back({.step = step, .move = input.move, .jump = random.chance(0.05), .drop = input.drop});
    if (!random.chance(0.02)) continue;
    const Vec2d direction = towards(random.angle());
    add_launch(run, {.step = step, .velocity = random.log_between(0.1, 200) * direction});
  }
  return run;
}

}  // namespace paperproof::compare
