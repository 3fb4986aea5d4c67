/// When a piece that turns first touches the octagon: no rational number, so between two bounds.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// A convex piece that turns evenly about a point while that point goes along a straight line: at fraction t of a step
/// a point v is at pivot + turn(v - pivot) + offset, with the angle and the offset of t.
struct TurningPiece {
  std::vector<Vec2d> points;  ///< Counter-clockwise, or the two ends of a segment; where angle and offset are zero [m].
  Vec2d pivot{Vec2d::Zero()};
  double from = 0;  ///< Angle when the step begins [rad], counter-clockwise; |angle| up to 1e6.
  double to = 0;    ///< When it ends.
  MoverMotion<double> motion{};
};

/// A straight motion of the octagon during the step.
struct MovingOctagon {
  std::span<const Vec2d> points;  ///< Relative to its position, counter-clockwise, convex.
  Vec2d position{Vec2d::Zero()};  ///< When the step begins [m].
  Vec2d displacement{Vec2d::Zero()};
};

struct RotationTouch {
  enum class Kind : std::uint8_t {
    none,     ///< The open octagon certainly meets the piece nowhere in the step; no fractions.
    touches,  ///< It is certainly free before `low` and certainly overlaps the piece at `high`.
    grazes,   ///< It is certainly free before `low`; whether it overlaps by `high` is too close to tell.
  };
  Kind kind = Kind::none;
  double low = 0;  ///< Fraction of the step, in [0, 1].
  double high = 0;
};

/// The first touch of a step. The step is halved until every part is certainly free (one edge normal of the two
/// separates them all through it, in arithmetic that rounds outwards) or no wider than `width`.
/// Source: interval bisection, R. E. Moore, Interval Analysis, 1966; D. Snyder, Interval analysis for computer
/// graphics, 1992.
/// @param width of the fraction of the step, above 0. `high - low` is at most a few of it where the touch is not
/// grazing
///   and the width is not below what rounding leaves: 1e-15 of the coordinates over the relative speed.
/// @throws std::invalid_argument for a width or an angle that is out of range or not finite.
[[nodiscard]] RotationTouch first_touch(const MovingOctagon& octagon, const TurningPiece& piece, double width);

}  // namespace paperproof::compare
