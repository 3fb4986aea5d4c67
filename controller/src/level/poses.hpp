/// Where the points of a mover are.
#pragma once

#include <paperproof/local_controller.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace paperproof::level {

[[nodiscard]] inline Vec2d rotated(const Vec2d& v, double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

[[nodiscard]] inline Vec2d placed(const Vec2d& v, const Pose& pose) noexcept {
  return pose.position + rotated(v, pose.angle);
}

[[nodiscard]] inline std::vector<Vec2d> placed(std::span<const Vec2d> points, const Pose& pose) {
  std::vector<Vec2d> result;
  for (const Vec2d& point : points) result.push_back(placed(point, pose));
  return result;
}

/// The pose at a fraction of a step, as if position and angle changed evenly.
[[nodiscard]] inline Pose pose_at(const PoseMotion& motion, double fraction) noexcept {
  if (fraction == 0) return motion.from;
  if (fraction == 1) return motion.to;
  return {motion.from.position + (motion.to.position - motion.from.position) * fraction,
          motion.from.angle + (motion.to.angle - motion.from.angle) * fraction};
}

/// Encloses points in their pose.
[[nodiscard]] inline Box2 box_at(std::span<const Vec2d> points, const Pose& pose) noexcept {
  const Vec2d first = rotated(points[0], pose.angle);
  Box2 box{first, first};
  for (const Vec2d& point : points) {
    const Vec2d here = rotated(point, pose.angle);
    box = box.merged({here, here});
  }
  return {box.lower + pose.position, box.upper + pose.position};
}

/// Encloses the way of points during a step, whatever point they turn about that is not farther from the mover's
/// origin than they are. (About a corner of the character, which may be farther, none of them comes nearer to it.)
[[nodiscard]] inline Box2 swept_box(std::span<const Vec2d> points, const PoseMotion& motion) noexcept {
  const Box2 box = box_at(points, motion.from).merged(box_at(points, motion.to));
  const double turn = std::min(std::abs(motion.to.angle - motion.from.angle), 2.0);
  if (turn == 0) return box;
  double reach = 0;
  for (const Vec2d& point : points) reach = std::max(reach, point.norm());
  return box.inflated(2 * turn * reach);
}

}  // namespace paperproof::level
