/// Where a straight way out of what the octagon is inside of may end.
#pragma once

#include "oracle/free_space.hpp"

namespace paperproof::compare::detail {

/// What an obstacle bars.
enum class Bars : std::uint8_t {
  ends,           ///< The way may pass it, but not end in it: the octagon is inside of its collider.
  ways_and_ends,  ///< Any other solid.
  ways,           ///< A one-way segment that blocks: where the way ends it may be overlapped.
};

struct Barrier {
  Obstacle obstacle;
  Bars bars = Bars::ways_and_ends;
};

/// The positions in which the end of the shortest straight way out must be looked for, nearest first, as far as they
/// are within `reach`; in doubles, so that each is still to be checked.
///
/// In configuration space every obstacle is convex, and so is its shadow from `at`: what lies behind it, between its
/// two tangents. A straight way that has entered a shadow never leaves it, and a solid that may not be passed is
/// entered from outside. So where the shortest way ends it leaves an obstacle that may be passed: on a facet of one of
/// these, at the foot of the perpendicular or where another obstacle or a shadow begins. Every such facet is cut by all
/// of them.
/// @param clearance that the ends keep from every obstacle [m].
/// @param beside that they keep from the edges of a shadow [m].
[[nodiscard]] std::vector<Vec2d> ways_out(std::span<const Barrier> barriers, std::span<const Vec2d> octagon,
                                          const Vec2d& at, double reach, double clearance, double beside);

}  // namespace paperproof::compare::detail
