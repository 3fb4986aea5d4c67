/// The way out of a solid.
#pragma once

#include "techniques/octagon_sweep/configuration_space.hpp"

#include <paperproof/technique.hpp>

#include <optional>

namespace paperproof::octagon_sweep {

/// The nearest position that is clear of everything and can be reached from `from` without passing a solid that the
/// octagon is not inside of already, nor a one-way segment against its normal. Where there is a last free position,
/// those that it could reach in a straight line come first: out to the side one came from. In a step that drops,
/// one-way segments bar neither: they hold nobody then, and a way out that only they bar would else be none.
///
/// Slow (it looks at pairs of facets), and exact in its checks. Allocates nothing.
/// Movers are taken where they are when the step begins.
/// @param candidates every piece that may be met on the way. A result further from `from` than they are known to reach
///   has to be asked for again with more.
/// @param request says what moves, where the last free position was, and whether to drop.
/// @return nothing where there is no such position.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Vec2<Scalar>> way_out(const ConfigurationSpace<Scalar>& space,
                                                  std::span<const PieceIndex> candidates,
                                                  const MoveRequest<Scalar>& request,
                                                  const Vec2<Scalar>& from) noexcept;

}  // namespace paperproof::octagon_sweep
