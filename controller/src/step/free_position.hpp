/// The nearest free position that a straight motion reaches: depenetration of a bad start, and a way out for a
/// character that movers press.
#pragma once

#include "step/configuration_space.hpp"

#include <paperproof/step_context.hpp>

#include <limits>
#include <optional>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The least gap around a free position at a place [m]: that of an opening that counts as closed, and more than
/// rounding does to a separation there, which is 4e-9 m at 1e6 m.
[[nodiscard]] inline Real least_gap(const Vec2& p) {
  return tolerances.hit + 32 * std::numeric_limits<Real>::epsilon() * p.cwiseAbs().maxCoeff();
}

struct FreePositionQuery {
  Vec2 from;                        ///< Where the motion starts [m],
  Real begin = 0;                   ///< and when, as a fraction of the step.
  Vec2 near;                        ///< The position nearest to this one is wanted [m].
  Real end = 0;                     ///< When the motion ends. Equal to `begin`: it takes no time, and `near` is `from`.
  std::size_t passable = 0;         ///< The motion may pass so many pieces, the first ones.
  std::optional<Vec2> last_free{};  ///< A straight motion from here must reach the position as well [m].
  /// The position must be on the side of each from which the character came. Displacements are up to the end of the
  /// step.
  std::span<const Crusher> crushers;
  /// The same for the other pieces that may be passed: where the character was before it overlapped them [m].
  std::optional<Vec2> entered_from{};
  std::span<const MoverMotion> movers;
  bool drops = false;  ///< One-way segments do not block.
  Real gap = 0;        ///< Gap to every solid at the end [m].
  Real reach = 0;      ///< The position must be nearer to `near` than this [m].
};

/// The nearest position that is free when the motion ends, and is reached without passing a solid, except those that
/// may be passed, or a one-way segment that blocks.
///
/// Any number of pieces, facets and colliders. The time is (facets that are searched) × (pieces); the checks are exact.
/// Allocates nothing.
/// @param pieces every piece that such a motion may hit, those that may be passed first.
/// @return nothing if there is no such position.
[[nodiscard]] std::optional<Vec2> nearest_free(const ConfigurationSpace& space, std::span<const PieceIndex> pieces,
                                               const FreePositionQuery& query);

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
