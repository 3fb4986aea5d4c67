/// The time during which two convex outlines overlap while one of them moves straight.
#pragma once

#include "geometry/time_below.hpp"

#include <paperproof/character.hpp>
#include <paperproof/types.hpp>

#include <span>

namespace paperproof::geometry {

/// When two outlines overlap during a straight motion: their separations are below zero.
using OverlapTime = TimeBelow<double>;

/// A direction in which two outlines can be apart: the normal of an edge of one of them.
struct SeparatingAxis {
  Vec2d along;   ///< The edge; the mover is apart on its right-hand side [m].
  Vec2d near;    ///< Subtracted first, as positions are large and outlines small [m].
  Vec2d shift;   ///< [m]
  double reach;  ///< Of the mover beyond the line, times the length of the edge [m²].

  /// Separation of the mover at a position, times the length of the edge: only its sign and ratios are used [m²].
  [[nodiscard]] double separation(const Vec2d& position) const {
    const Vec2d from_near = position - near;
    const Vec2d arm = from_near + shift;
    return reach - (along.x() * arm.y() - along.y() * arm.x());
  }
};

/// Of a character and a piece, which has 32 vertices at most.
using SeparatingAxes = FixedVector<SeparatingAxis, CharacterShape::max_points + 32>;

/// The edge normals of two outlines, along which they can be apart: the edges of their Minkowski sum.
/// @param mover 3 points or more, counter-clockwise, relative to its position [m].
/// @param standing the same, or the two ends of a segment [m].
[[nodiscard]] SeparatingAxes separating_axes(std::span<const Vec2d> mover, std::span<const Vec2d> standing);

/// Finds when the open interior of a convex outline meets the interior of another, or a segment. The position of the
/// first goes straight from `from` to `to`.
///
/// The separation along each axis is linear in time; they overlap while all of them are negative. Whether they overlap
/// at an end of the motion depends on the bits of that position alone, so motions that share this position agree. A
/// fraction is exact but for the rounding of two separations, a few ulp of the distance between the outlines over the
/// length of the motion.
[[nodiscard]] OverlapTime overlap_time(std::span<const SeparatingAxis> axes, const Vec2d& from, const Vec2d& to);

/// Positions at which `mover` overlaps `standing` by more than `depth` in every direction [m]. They are a box around
/// the middle of all overlapping positions, or an inverted box (its lower corner above the upper one) if there are
/// none.
/// @param mover,standing as of `separating_axes`.
[[nodiscard]] Box2 deep_overlap(std::span<const Vec2d> mover, std::span<const Vec2d> standing, double depth);

}  // namespace paperproof::geometry
