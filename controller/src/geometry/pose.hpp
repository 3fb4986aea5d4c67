/// Where the points of a mover are.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace paperproof::geometry {

/// A turn by an angle about the origin, counter-clockwise.
class Turn {
 public:
  explicit Turn(double angle) : cosine_(std::cos(angle)), sine_(std::sin(angle)) {}

  [[nodiscard]] Vec2d operator()(const Vec2d& v) const {
    return {cosine_ * v.x() - sine_ * v.y(), sine_ * v.x() + cosine_ * v.y()};
  }
  /// Around the turned box.
  [[nodiscard]] Box2 operator()(const Box2& box) const {
    const Vec2d middle = (*this)(box.middle());
    const Vec2d half = box.upper - box.middle();
    const Vec2d reach{std::abs(cosine_) * half.x() + std::abs(sine_) * half.y(),
                      std::abs(sine_) * half.x() + std::abs(cosine_) * half.y()};
    return {middle - reach, middle + reach};
  }

 private:
  double cosine_;
  double sine_;
};

/// A point v of a mover is at position + R(angle) v.
struct Pose {
  Vec2d position{Vec2d::Zero()};  ///< [m]
  double angle = 0;               ///< Counter-clockwise [rad].
};

/// @param points to which those in the pose are appended.
inline void place(std::span<const Vec2d> given, const Pose& pose, std::vector<Vec2d>& points) {
  const Turn turn(pose.angle);
  for (const Vec2d& point : given) points.push_back(pose.position + turn(point));
}

/// The pose at a fraction of a step.
[[nodiscard]] inline Pose pose_at(const MoverMotion& motion, double fraction) {
  return {motion.at(fraction), fraction < 1 ? motion.from_angle + motion.turn() * fraction : motion.to_angle};
}

/// Encloses what is in a box during a step. The box turns about any point that is no farther from the mover's origin
/// than the box is. (A corner of the character may be farther: nothing that turns about it comes nearer to it.)
[[nodiscard]] inline Box2 swept_box(const Box2& box, const MoverMotion& motion) {
  const Box2 before = Turn(motion.from_angle)(box);
  const Box2 after = Turn(motion.to_angle)(box);
  const Box2 both = (before + motion.from).merged(after + motion.to);
  const double turn = std::min(std::abs(motion.turn()), 2.0);
  return both.inflated(2 * turn * box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm());
}

}  // namespace paperproof::geometry
