/// The time during which two convex outlines overlap while one of them moves straight.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::geometry {

/// The open interval of a straight motion, whose fractions run from 0 to 1, in which two outlines overlap. Empty where
/// `begin >= end`. If they overlap at the start already, `begin` is `before`. If they still overlap at the end, `end`
/// is `after`. The other values are fractions in [0, 1].
template <class Scalar>
struct OverlapTime {
  static constexpr Scalar before = -1;
  static constexpr Scalar after = 2;
  Scalar begin = before;
  Scalar end = after;

  [[nodiscard]] bool any() const noexcept { return begin < end; }
};

/// Finds when the open interior of the convex `mover` meets the interior of the convex `standing`, or a segment if
/// `standing` has two points. The position of `mover` goes straight from `from` to `to`.
///
/// The separation along each edge normal of the two (separating axes, which are the edges of their Minkowski sum) is
/// linear in time; they overlap while all of them are negative. Whether they overlap at an end of the motion depends
/// on the bits of that position alone, so motions that share this position agree. A fraction is exact but for the
/// rounding of two separations, a few ulp of the distance between the outlines over the length of the motion.
/// @param mover 3 points or more, counter-clockwise, relative to its position [m].
/// @param standing the same, or the two ends of a segment [m].
template <class Scalar>
[[nodiscard]] OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>> mover,
                                               std::span<const Vec2<Scalar>> standing, const Vec2<Scalar>& from,
                                               const Vec2<Scalar>& to) noexcept;

/// A direction in which two outlines can be apart: the normal of an edge of one of them.
template <class Scalar>
struct SeparatingAxis {
  Vec2<Scalar> along;  ///< The edge; the mover is apart on its right-hand side [m].
  Vec2<Scalar> near;   ///< Subtracted first, as positions are large and outlines small [m].
  Vec2<Scalar> shift;  ///< [m]
  Scalar reach;        ///< Of the mover beyond the line, times the length of the edge [m²].

  /// Separation of the mover at a position, times the length of the edge: only its sign and ratios are used [m²].
  [[nodiscard]] Scalar separation(const Vec2<Scalar>& position) const noexcept {
    const Vec2<Scalar> from_near = position - near;
    const Vec2<Scalar> arm = from_near + shift;
    return reach - (along.x() * arm.y() - along.y() * arm.x());
  }
};

/// All separating axes of two outlines.
/// @param mover,standing as of `overlap_time`.
template <class Scalar>
[[nodiscard]] std::vector<SeparatingAxis<Scalar>> separating_axes(std::span<const Vec2<Scalar>> mover,
                                                                  std::span<const Vec2<Scalar>> standing);

/// The same as the other `overlap_time`, with axes that are already known.
template <class Scalar>
[[nodiscard]] OverlapTime<Scalar> overlap_time(std::span<const SeparatingAxis<Scalar>> axes, const Vec2<Scalar>& from,
                                               const Vec2<Scalar>& to) noexcept;

/// Positions at which `mover` overlaps `standing` by more than `depth` in every direction [m]. They are a box around
/// the middle of all overlapping positions, or an inverted box (its lower corner above the upper one) if there are
/// none.
/// @param mover,standing as of `overlap_time`.
template <class Scalar>
[[nodiscard]] Box2<Scalar> deep_overlap(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                                        Scalar depth) noexcept;

}  // namespace paperproof::geometry
