#include "campaign/wanderers.hpp"

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

void turn(Wanderer& wanderer, Random& r) {
  wanderer.until_turn = r.integer(3, 40);
  const double speed = r.chance(0.02) ? r.log_between(1, 1e6) : r.log_between(1e-4, r.chance(0.3) ? 2 : 0.2);
  const double angle = r.chance(0.5) ? r.integer(0, 7) * std::numbers::pi / 4 : r.angle();
  wanderer.velocity = Vec2d{std::cos(angle), std::sin(angle)} * speed;
  if (r.chance(0.15)) wanderer.velocity.setZero();
  if (r.chance(0.3)) wanderer.velocity.x() = 0;
  if (r.chance(0.3)) wanderer.velocity.y() = 0;
}

}  // namespace

void add_mover(std::vector<ColliderDef>& colliders, MoverIndex mover, Random& r, const Vec2d& origin) {
  const auto add = [&](std::vector<Vec2d> points, ColliderDef::Shape shape = ColliderDef::Shape::polygon) {
    ColliderDef def{.shape = shape, .points = std::move(points), .mover = mover};
    const double offset_x = r.between(-5, 5);
    const double offset_y = r.between(-4, 4);
    for (Vec2d& p : def.points) p += origin + Vec2d{offset_x, offset_y};
    if (r.chance(0.1)) def.surface_speed = r.between(-5, 5);
    colliders.push_back(def);
  };
  const double width = r.between(0.2, 3);
  const double height = r.between(0.1, 1.5);
  const double thin = r.log_between(1e-6, 0.05);
  switch (r.integer(0, 6)) {
    case 0:
    case 1:
      return add({{0, 0}, {width, 0}, {width, height}, {0, height}});
    case 2:
      return add({{0, 0}, {width, r.between(-1, 1)}, {0.5 * width, 1.5}});
    case 3:
      return add({{0, 0}, {thin, 0}, {thin, 2 * height}, {0, 2 * height}});
    case 4:
      return add({{0, 0}, {width, r.between(-1, 1)}}, ColliderDef::Shape::chain);
    case 5:
      add({{0, 0}, {width, r.between(-0.5, 0.5)}}, ColliderDef::Shape::chain);
      colliders.back().one_way = Vec2d{0, 1};
      return;
    default:
      for (int i = 0; i < 6; ++i) {
        ColliderDef tile{.points = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}, .mover = mover};
        const Vec2d at{i * 0.5, r.chance(0.2) ? 0.5 : 0};
        for (Vec2d& p : tile.points) p += origin + at;
        colliders.push_back(tile);
      }
  }
}

void round_movers(std::vector<ColliderDef>& colliders, Random& r) {
  for (ColliderDef& def : colliders) {
    if (def.mover == no_mover || def.shape != ColliderDef::Shape::polygon || r.chance(0.3)) continue;
    def.shape = ColliderDef::Shape::circle;
    def.points.resize(1);
    def.radius = r.log_between(1e-4, 1.5);
  }
}

Vec2d next_offset(Wanderer& wanderer, const Vec2d& offset, Random& r) {
  if (wanderer.until_turn-- <= 0) turn(wanderer, r);
  const Vec2d next = offset + wanderer.velocity;
  // Back to the arena.
  for (const Eigen::Index k : {0, 1})
    if (std::abs(next[k]) > 6 && next[k] * wanderer.velocity[k] > 0) wanderer.velocity[k] = -wanderer.velocity[k];
  if (next.cwiseAbs().maxCoeff() > 1e6) return {0, 0};
  return next;
}

}  // namespace paperproof::compare
