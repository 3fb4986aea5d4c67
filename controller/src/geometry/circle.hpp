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
struct NearCircle {
  double separation;  ///< Below zero: inside [m].
  Vec2d normal;       ///< From the circle to the outline.
};

/// @param outline 3 points or more, strictly convex, counter-clockwise, relative to `position` [m].
[[nodiscard]] NearCircle near_circle(std::span<const Vec2d> outline, const Vec2d& position, const Circle& circle);

/// When a motion comes near.
struct Approach {
  double time;  ///< Fraction of the motion.
  NearCircle there;
};

/// When an outline on a straight motion is at a distance `level` from a circle for the first time, or at once where it
/// is nearer than that already and comes nearer; to a few ulp of the positions, and never later. Nothing where it stays
/// further away, or only goes away.
[[nodiscard]] std::optional<Approach> approach(std::span<const Vec2d> outline, const Vec2d& from,
                                               const Vec2d& displacement, const Circle& circle, double level);

/// See the `overlap_time` of two outlines.
[[nodiscard]] OverlapTime overlap_time(std::span<const Vec2d> mover, const Circle& standing, const Vec2d& from,
                                       const Vec2d& to);

}  // namespace paperproof::geometry
