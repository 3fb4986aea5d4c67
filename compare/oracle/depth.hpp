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

/// The axis, of all edge normals of the two, along which they are separated best. Rounded once from the exact value.
/// @param place in the frame of the part.
[[nodiscard]] Axis best_axis(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place);

}  // namespace paperproof::compare::detail
