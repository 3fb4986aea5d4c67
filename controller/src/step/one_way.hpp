/// When a one-way segment blocks.
#pragma once

#include "inlining.hpp"
#include "step/narrow_phase.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Whether the octagon at p + rest, as its mover sees it, is above the surface of a one-way segment. Near the line of a
/// straight one that is decided exactly; elsewhere a product tells.
[[nodiscard]] PAPERPROOF_INLINE bool is_above(const ConfigurationSpace& space, PieceIndex piece, const Vec2& p,
                                              const Vec2& rest) {
  const Obstacle& info = space.info(piece);
  if (!info.bent_surface) {
    const Real apart = space.separation(piece, info.one_way_axis, p);
    if (apart >= tolerances.certain) return true;
    if (apart <= -tolerances.certain) return false;
  }
  return info.surfaces->is_above(info.surface, p, rest);
}

/// Whether a one-way segment can stop a motion: one that begins above its surface. From a gap on, a motion that does
/// not go against a straight segment is clear of it. Nearer than that the segment is looked at, whatever the direction:
/// its separation counts.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool one_way_blocks(const ConfigurationSpace& space, const Motion& motion,
                                                               PieceIndex piece) {
  const Obstacle& info = space.info(piece);
  if (!info.bent_surface && space.separation(piece, info.one_way_axis, motion.from) >= tolerances.hit)
    return dot(space.normal(piece, info.one_way_axis), motion.displacement) < 0;
  return is_above(space, piece, motion.from, motion.lost);
}

/// Whether a piece can stop a motion at all. A solid always can.
[[nodiscard]] PAPERPROOF_INLINE bool blocks(const ConfigurationSpace& space, const Motion& motion, PieceIndex piece) {
  return !space.info(piece).is_one_way() || one_way_blocks(space, motion, piece);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
