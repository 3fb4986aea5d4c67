/// Finds the one-way chains that a character passes when it drops through.
#pragma once

#include "one_way_surfaces.hpp"
#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <span>

namespace paperproof {

/// The one-way chains of one scenery, for one character. Immutable; shareable between threads; a search never
/// allocates.
class OneWayChains {
 public:
  using Passed = decltype(StepReport::dropped_through);

  /// `scenery` must outlive the chains.
  OneWayChains(const Scenery& scenery, const CharacterShape& shape, PieceSearch search);

  [[nodiscard]] Candidates make_candidates() const { return finder_.make_candidates(); }

  /// Finds the chains with a segment that a leg of the path passes, if this leg begins above the chain's surface;
  /// ascending. A chain that is missed by less than a micrometre is named as well, so no chain that exact arithmetic
  /// finds is left out. If `passed` is full, it keeps the first chains and has overflowed.
  /// @param path straight between its corners. @param movers one for each mover of the scenery.
  /// @param candidates made by these chains, or by others of the same scenery and character.
  /// @param filter null: all chains are there.
  void find_passed(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Candidates& candidates,
                   Passed& passed, const ColliderFilter* filter = nullptr) const noexcept;

 private:
  [[nodiscard]] bool passes(PieceIndex piece, const Vec2d& from, const Vec2d& to) const noexcept;

  const Scenery* scenery_;
  PieceFinder finder_;
  OneWaySurfaces surfaces_;
  FixedVector<Vec2d, CharacterShape::max_points> outline_;  ///< The character's outline,
  FixedVector<Vec2d, CharacterShape::max_points> grown_;    ///< and a slightly larger one.
};

}  // namespace paperproof
