/// When a one-way segment is in the way.
#pragma once

#include "techniques/octagon_sweep/certificate.hpp"
#include "techniques/octagon_sweep/narrow_phase.hpp"

namespace paperproof::octagon_sweep {

/// Whether a piece can stop a motion at all. A solid always can. A one-way segment blocks motion against its normal
/// that begins with the whole octagon on the side of the normal; near the line that is decided exactly.
template <Variant variant, class Scalar>
[[nodiscard, gnu::always_inline]] inline bool blocks(const ConfigurationSpace<Scalar>& space,
                                                     const Motion<variant.lanes, Scalar>& motion,
                                                     PieceIndex piece) noexcept {
  if constexpr (!variant.one_way) return true;
  constexpr Tolerances<Scalar> tolerances{};
  const std::size_t axis = space.info(piece).one_way_axis;
  if (axis == ObstacleInfo::not_one_way) return true;
  const Vec2<Scalar> n = space.normal(piece, axis);
  if (!(n.x() * motion.way.x() + n.y() * motion.way.y() < 0)) return false;
  const Scalar start = space.separation(piece, axis, motion.from);
  if (start >= tolerances.certain) return true;
  return start > -tolerances.certain && on_blocking_side_exactly(space, piece, motion.from);
}

}  // namespace paperproof::octagon_sweep
