/// Proof, without rounding, that a straight motion stays clear of a piece.
#pragma once

#include "techniques/octagon_sweep/configuration_space.hpp"

namespace paperproof::octagon_sweep {

/// Whether the octagon's open interior meets the piece at `position`, exactly: the separating axis theorem with signs
/// of exact determinants. Allocates nothing.
template <class Scalar>
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                    const Vec2<Scalar>& position) noexcept;

/// Whether one line separates octagon and piece at both ends of a straight way, exactly. Separations are linear, so the
/// whole way is then clear. (That no single line does so does not prove an overlap: the answer is then `false` all the
/// same.)
template <class Scalar>
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece, const Vec2<Scalar>& from,
                                    const Vec2<Scalar>& to) noexcept;

}  // namespace paperproof::octagon_sweep
