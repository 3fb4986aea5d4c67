/// Shapes of which scenes of tests are made.
#pragma once

#include <paperproof/scenery.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace paperproof::compare {

inline constexpr double degree = std::numbers::pi / 180;  ///< [radians]

inline constexpr double half_width = 0.3125;  ///< Of the article's character [m],
inline constexpr double half_height = 0.625;  ///< and half of its height.

[[nodiscard]] inline ColliderDef polygon(std::vector<Vec2d> points, MoverIndex mover = no_mover) {
  return {.points = std::move(points), .mover = mover};
}
[[nodiscard]] inline ColliderDef box(double left, double bottom, double right, double top,
                                     MoverIndex mover = no_mover) {
  return polygon({{left, bottom}, {right, bottom}, {right, top}, {left, top}}, mover);
}
[[nodiscard]] inline ColliderDef chain(std::vector<Vec2d> points, MoverIndex mover = no_mover) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .mover = mover};
}
[[nodiscard]] inline ColliderDef circle(const Vec2d& centre, double radius, MoverIndex mover = no_mover) {
  ColliderDef def{.shape = ColliderDef::Shape::circle, .points = {centre}, .mover = mover};
  def.radius = radius;
  return def;
}

[[nodiscard]] inline Vec2d towards(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace paperproof::compare
