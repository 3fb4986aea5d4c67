/// The way out of a solid.
#pragma once

#include "step/configuration_space.hpp"

#include <paperproof/technique.hpp>

#include <optional>

namespace paperproof::octagon_sweep {

/// Which way out is asked for.
template <class Scalar>
struct WayOutQuery {
  Vec2<Scalar> from;                          ///< Inside of something [m].
  std::optional<Vec2<Scalar>> last_free;      ///< A straight way from here to its end must be free, too [m].
  std::span<const Presser<Scalar>> pressers;  ///< It ends on the side of each from which the character came; `gone` is
                                              ///< by the end of the step.
  std::span<const MoverMotion<Scalar>> movers;  ///< Taken where they are when the step begins.
  bool drops;                                   ///< One-way segments bar nothing.
  Scalar gap;                                   ///< Kept from all that is solid where it ends [m].
  Scalar reach;                                 ///< It is shorter than this [m].
};

/// The end of the shortest straight way out of the colliders that the octagon is inside of: clear of everything, and
/// reached without passing any other solid, nor a one-way segment that blocks.
///
/// Nothing bounds the number of pieces, facets and colliders. It takes the time of (facets of the colliders that are
/// left) × (pieces), exact in its checks. Allocates nothing.
/// @param pieces every piece that may be met on the ways that are asked about; those of one collider in a row. Left in
///   another order.
/// @return nothing where there is no such way.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Vec2<Scalar>> way_out(const ConfigurationSpace<Scalar>& space, std::span<PieceIndex> pieces,
                                                  const WayOutQuery<Scalar>& query) noexcept;

}  // namespace paperproof::octagon_sweep
