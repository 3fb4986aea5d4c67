/// How far in, or how far away: the separation along the best axis.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/predicates.hpp"
#include "oracle/way.hpp"

#include <optional>
#include <span>

namespace paperproof::compare::detail {

struct Axis {
  double separation = 0;        ///< Along the normal [m]; negative: the length of the shortest way out.
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the part towards the octagon, rounded.
};

/// The axis, of all edge normals of the two, along which they are separated best. Rounded once from the exact value. Of
/// a disc, the direction in which the octagon is nearest; long doubles know it to 1e-18 of the radius.
/// @param place in the frame of the part.
[[nodiscard]] Axis best_axis(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place);

/// All axes along which the two are apart, the best first; where they overlap, and of a disc, the best one alone. Empty
/// where they are farther apart than `within` along the best one.
[[nodiscard]] std::vector<Axis> separating_axes(const ConvexPart& part, std::span<const Vec2d> octagon,
                                                const FramePlace& place, double within);

/// An edge whose left normal points from the part towards the octagon: of the part, reversed, or of the octagon. The
/// two are apart exactly if they are along one of these normals.
struct AxisEdge {
  Vec2d start;  ///< In its owner's frame.
  Vec2d end;
};
[[nodiscard]] std::vector<AxisEdge> axis_edges(const ConvexPart& part, std::span<const Vec2d> octagon);

/// For every axis the separation times the length of its edge, in units of 2^(2 unit).
/// @param unit no larger than `common_unit` of the same.
[[nodiscard]] std::vector<Integer> scaled_separations(const ConvexPart& part, std::span<const Vec2d> octagon,
                                                      const FramePlace& place, int unit);
/// The lowest bit of the place, the part (a disc's radius is no part of that) and the octagon.
[[nodiscard]] int common_unit(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place);

}  // namespace paperproof::compare::detail
