/// The nearest free position that a straight way reaches: out of a solid in which a step begins, and to room where
/// movers press.
#pragma once

#include "step/configuration_space.hpp"

#include <paperproof/technique.hpp>

#include <optional>

namespace paperproof::octagon_sweep {

/// Kept where there is little room, of the hit distance: room must be a little more than what counts as closed. One:
/// far from the origin, where 4e-9 m are rounding, none is found. Large: what would do is not seen.
inline constexpr double least_room = 1.25;

template <class Scalar>
struct FreePositionQuery {
  Vec2<Scalar> from;                      ///< Where the way begins [m],
  Scalar begin = 0;                       ///< and when, as a fraction of the step.
  Vec2<Scalar> near;                      ///< Near which it ends [m], and
  Scalar end = 0;                         ///< when. At once: `near` is `from`, inside the pieces that may be passed.
  std::size_t passable = 0;               ///< The way may pass so many pieces, the first ones.
  std::optional<Vec2<Scalar>> last_free;  ///< The straight way from here to its end must be free, too [m].
  /// It ends on the side of each from which the character came; `displacement` is by the end of the step.
  std::span<const Crusher<Scalar>> crushers;
  /// The same for the other pieces that may be passed: where the character was before it came into them [m].
  std::optional<Vec2<Scalar>> entered_from;
  std::span<const MoverMotion<Scalar>> movers;
  bool drops = false;  ///< One-way segments bar nothing.
  Scalar gap;          ///< Kept from all that is solid where it ends [m].
  Scalar reach;        ///< It ends nearer to `near` than this [m].
};

/// The nearest position that is free of everything when the way ends, and is reached without passing any piece but
/// those that may be passed, nor a one-way segment that blocks.
///
/// Nothing bounds the number of pieces, facets and colliders. It takes the time of (facets that are looked along) ×
/// (pieces), exact in its checks. Allocates nothing.
/// @param pieces every piece that may be met on the ways that are asked about, those that may be passed first.
/// @return nothing where there is no such position.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Vec2<Scalar>> nearest_free(const ConfigurationSpace<Scalar>& space,
                                                       std::span<const PieceIndex> pieces,
                                                       const FreePositionQuery<Scalar>& query) noexcept;

/// Whether `q` is such a position, near or not.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] bool reaches(const ConfigurationSpace<Scalar>& space, std::span<const PieceIndex> pieces,
                           const FreePositionQuery<Scalar>& query, const Vec2<Scalar>& q) noexcept;

}  // namespace paperproof::octagon_sweep
