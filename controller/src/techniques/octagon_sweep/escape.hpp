/// The way out of a solid.
#pragma once

#include "techniques/octagon_sweep/configuration_space.hpp"

#include <paperproof/types.hpp>

#include <optional>

namespace paperproof::octagon_sweep {

/// The nearest position that is clear of everything and can be reached from `from` without passing a solid that the
/// octagon is not inside of already. Where `last_free` is given, positions that it could reach in a straight line come
/// first: out to the side one came from.
///
/// Slow (it looks at pairs of facets), and exact in its checks. Allocates nothing.
/// Movers are taken where they are when the step begins.
/// @param candidates every piece that may be met on the way. A result further from `from` than they are known to reach
///   has to be asked for again with more.
/// @param movers those of the candidates' scenery; may be empty where no candidate moves.
/// @return nothing where there is no such position.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Vec2<Scalar>> way_out(const ConfigurationSpace<Scalar>& space,
                                                  std::span<const PieceIndex> candidates,
                                                  std::span<const MoverMotion<Scalar>> movers, const Vec2<Scalar>& from,
                                                  const Vec2<Scalar>* last_free) noexcept;

}  // namespace paperproof::octagon_sweep
