/// A convex outline beside a circle, at rest and on a straight motion.
///
/// Seen by its reference point, an outline meets the open circle where the point is nearer than the radius to the
/// outline that is turned round and put around the centre. That region is convex, and so is the distance to it: every
/// tangent is a lower bound. So the time at which a motion comes within a distance is found by Newton's method, from
/// one tangent to the next: each is as near as the motion may come, none too near.
#pragma once

#include <paperproof/scenery.hpp>

#include <optional>
#include <span>

#include "geometry/overlap_time.hpp"

namespace paperproof::geometry {

/// Where an outline is nearest to a circle.
template <class Scalar>
struct NearCircle {
  Scalar separation;    ///< Below zero: inside [m].
  Vec2<Scalar> normal;  ///< From the circle to the outline.
};

/// @param outline 3 points or more, strictly convex, counter-clockwise, relative to `position` [m].
template <class Scalar>
[[nodiscard]] NearCircle<Scalar> near_circle(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& position,
                                             const Circle<Scalar>& circle) noexcept;

/// When a motion comes near.
template <class Scalar>
struct Approach {
  Scalar time;  ///< Fraction of the motion.
  NearCircle<Scalar> there;
};

/// When an outline on a straight motion is at a distance `level` from a circle for the first time, or at once where it
/// is nearer than that already and comes nearer; to a few ulp of the positions, and never later. Nothing where it stays
/// further away, or only goes away.
template <class Scalar>
[[nodiscard]] std::optional<Approach<Scalar>> approach(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& from,
                                                       const Vec2<Scalar>& displacement, const Circle<Scalar>& circle,
                                                       Scalar level) noexcept;

/// See the `overlap_time` of two outlines.
template <class Scalar>
[[nodiscard]] OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>> mover, const Circle<Scalar>& standing,
                                               const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept;

}  // namespace paperproof::geometry
