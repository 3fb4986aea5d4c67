/// Where the octagon may have room.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/way.hpp"

#include <span>
#include <vector>

namespace paperproof::compare::detail {

struct Obstacle {
  const ConvexPart* part = nullptr;
  FramePlace place;                   ///< Of the octagon, in the frame of the part.
  const ConvexPart* exact = nullptr;  ///< The disc that the part is drawn around; else the part itself.
};

/// The positions in which the nearest free place must be looked for, nearest first: `at`, `others`, the feet of
/// perpendiculars from `at` to the lines that bound the space free with 0.5 % more than `clearance`, and the places
/// where two of these lines cross, each computed exactly and rounded once; as far as they are within `reach` and not
/// certainly taken.
[[nodiscard]] std::vector<Vec2d> free_candidates(std::span<const Obstacle> obstacles, std::span<const Vec2d> octagon,
                                                 const Vec2d& at, double reach, double clearance,
                                                 std::span<const Vec2d> others);

}  // namespace paperproof::compare::detail
