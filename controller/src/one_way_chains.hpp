/// One-way chains that a character drops through: which of them does it pass on the way?
#pragma once

#include "one_way_surfaces.hpp"
#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <span>

namespace paperproof {

/// The one-way chains of one scenery, for one character. Immutable; shareable between threads; never allocates while it
/// looks.
template <class Scalar>
class OneWayChains {
 public:
  using Passed = decltype(StepReport<Scalar>::dropped_through);

  /// `scenery` must outlive the chains.
  OneWayChains(const Scenery<Scalar>& scenery, const CharacterShape& shape);

  [[nodiscard]] Candidates<Scalar> make_candidates() const { return finder_.make_candidates(); }

  /// The chains with a segment that a leg of the way passes, beginning above its surface; ascending. What is missed by
  /// less than a micrometre is named as well: so none that exact arithmetic sees is left out. Where there are more than
  /// `passed` holds the first are kept, and it overflowed.
  /// @param path straight between its corners. @param movers one for each mover of the scenery.
  /// @param candidates made by these chains, or by others of the same scenery and character.
  void find_passed(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
                   Candidates<Scalar>& candidates, Passed& passed) const noexcept;

 private:
  [[nodiscard]] bool passes(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& to) const noexcept;

  const Scenery<Scalar>* scenery_;
  PieceFinder<Scalar> finder_;
  OneWaySurfaces<Scalar> surfaces_;
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> outline_;  ///< Of the character,
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> grown_;    ///< and a little larger.
};

extern template class OneWayChains<float>;
extern template class OneWayChains<double>;

}  // namespace paperproof
