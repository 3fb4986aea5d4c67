/// Where straight ways end in free space.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/way.hpp"

#include <span>
#include <vector>

namespace paperproof::compare::detail {

/// A convex part that bars straight ways, or their ends, or both.
struct Barrier {
  const ConvexPart* part = nullptr;   ///< With corners.
  const ConvexPart* exact = nullptr;  ///< The disc that `part` is drawn around; else `part`.
  FramePlace end;                     ///< Of the octagon in the frame of the part, at the moment when the ways end.
  bool bars_ends = false;             ///< No way may end in it.
  /// Where the octagon begins in the frame of the part, of ways that may not pass it; none where they may.
  std::optional<FramePlace> from{};
  std::span<const Vec2d> shape{};  ///< That may not pass it: the octagon, or one that is a little wider.
};

/// How ends of ways are looked for.
struct EndSearch {
  double reach = 0;      ///< No way is longer [m].
  double clearance = 0;  ///< That the ends keep from every obstacle [m].
  double beside = 0;     ///< That they keep from the edges of a shadow [m].
  /// Only at the rims of barriers that may be passed: enough where a way begins in one.
  bool from_inside_only = false;
};

/// The displacements of the octagon at whose ends the shortest straight way must be looked for, nearest first; in
/// doubles, so that each is still to be checked.
///
/// In configuration space every barrier is convex, and so is its shadow from where the octagon begins: what lies behind
/// it, between its two tangents. A straight way that has entered a shadow never leaves it. The places that are free and
/// in no shadow are what is left of the plane without these convex regions: the nearest of them is the start, or lies
/// on the rim of a region, at the foot of the perpendicular or where another region begins. So every rim is cut by all
/// regions.
[[nodiscard]] std::vector<Vec2d> ends_of_ways(std::span<const Barrier> barriers, std::span<const Vec2d> octagon,
                                              const EndSearch& search);

}  // namespace paperproof::compare::detail
