#include "agreement/golden_scenes.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace paperproof::golden {
namespace {

ColliderDef polygon(const Vec2d& at, std::vector<Vec2d> points) {
  for (Vec2d& point : points) point += at;
  return {.points = std::move(points)};
}

ColliderDef chain(const Vec2d& at, std::vector<Vec2d> points, bool one_way) {
  ColliderDef def = polygon(at, std::move(points));
  def.shape = ColliderDef::Shape::chain;
  if (one_way) def.one_way = Vec2d(0, 1);
  return def;
}

ColliderDef box(const Vec2d& at, double width, double height) {
  return polygon(at, {{0, 0}, {width, 0}, {width, height}, {0, height}});
}

ColliderDef random_box(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.2, 4);
  return box(at, width, random.uniform(0.2, 2));
}

ColliderDef random_slope(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.5, 5);
  const double height = random.uniform(0.1, 3);
  const std::vector<Vec2d> shapes[]{
      {{0, 0}, {width, 0}, {0, height}},
      {{0, height}, {width, height}, {0.3 * width, 0}},
      {{0, 0}, {width, 0}, {width, height}, {0.5 * width, 0.2 * height}, {0, height}},
      {{0, 0}, {width, 0}, {0.8 * width, height}, {0.1 * width, 0.7 * height}},
  };
  return polygon(at, shapes[random.below(4)]);
}

ColliderDef random_paper(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.5, 6);
  const double rise = random.uniform(-1, 1);
  const double thickness = 0.001;
  const ColliderDef papers[]{
      box(at, width, thickness),
      polygon(at, {{0, 0}, {width, rise}, {width, rise + thickness}, {0, thickness}}),
      chain(at, {{0, 0}, {0.5 * width, rise}, {width, 0}}, false),
      chain(at, {{0, 0}, {width, rise}}, true),
  };
  return papers[random.below(4)];
}

Scene make_scene(const std::string& name, const Vec2d& origin, std::uint64_t seed, int pieces,
                 ColliderDef (*make_piece)(Random&, const Vec2d&)) {
  Scene scene{name, origin, {}, {}};
  std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  colliders = {box(origin - Vec2d(1, 1), arena_width + 2, 1), box(origin + Vec2d(-1, arena_height), arena_width + 2, 1),
               box(origin - Vec2d(1, 0), 1, arena_height), box(origin + Vec2d(arena_width, 0), 1, arena_height)};
  Random random(seed);
  for (int piece = 0; piece < pieces; ++piece)
    colliders.push_back(make_piece(random, random.point(origin, origin + Vec2d(arena_width, arena_height))));
  return scene;
}

ColliderDef any(Random& random, const Vec2d& at) {
  constexpr std::array makers{random_box, random_slope, random_paper};
  return makers[random.below(3)](random, at);
}

/// Every third piece moves, every fifth one carries along its surface, and there are sensors that stand and that move.
Scene with_movers(Scene scene, std::uint64_t seed) {
  Random random(seed);
  std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  const std::size_t pieces = colliders.size();
  const auto set_going = [&](ColliderDef& collider) {
    collider.mover = static_cast<MoverIndex>(scene.shuttles.size());
    // Braces: they are drawn in this order.
    scene.shuttles.push_back({random.point({-6, -4}, {6, 4}), random.uniform(0.5, 5), random.uniform(0, 1)});
  };
  for (std::size_t i = 4; i < pieces; ++i) {
    if (i % 3 == 0) set_going(colliders[i]);
    if (i % 5 == 0) colliders[i].surface_speed = random.uniform(-3, 3);
  }
  for (int i = 0; i < 4; ++i) {
    const Vec2d at = random.point(scene.origin, scene.origin + Vec2d(arena_width, arena_height));
    ColliderDef sensor = random_slope(random, at);
    sensor.sensor = true;
    if (i % 2 == 0) set_going(sensor);
    colliders.push_back(std::move(sensor));
  }
  return scene;
}

}  // namespace

Vec2d Shuttle::offset_at(double time) const {
  const double turns = time / period + phase;
  const double share = turns - std::floor(turns);
  return reach * (share < 0.5 ? 2 * share : 2 - 2 * share);
}

std::vector<Scene> make_scenes() {
  return {make_scene("boxes", {0, 0}, 1, 40, random_box), make_scene("slopes", {-13, 7}, 2, 40, random_slope),
          make_scene("paper", {0.1, 0.7}, 3, 40, random_paper), make_scene("far_away", {1e5, -1e5}, 4, 60, any),
          with_movers(make_scene("movers", {0.3, -2}, 6, 40, any), 7)};
}

}  // namespace paperproof::golden
