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
  using Passed = std::vector<ColliderIndex>;

  /// `scenery` must outlive the chains.
  OneWayChains(const Scenery& scenery, const CharacterShape& shape);

  /// Finds the chains with a segment that a leg of the path passes, if this leg begins above the chain's surface;
  /// ascending. A chain that is missed by less than a micrometre is named as well, so no chain that exact arithmetic
  /// finds is left out.
  /// @param path straight between its corners. @param movers one for each mover of the scenery.
  /// @param near the solid pieces. @param surfaces of the scenery as it is now, for the same shape.
  void find_passed(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Nearby near,
                   const OneWaySurfaces& surfaces, Passed& passed) const noexcept;

 private:
  [[nodiscard]] bool passes(const OneWaySurfaces& surfaces, PieceIndex piece, const Vec2d& from,
                            const Vec2d& to) const noexcept;

  const Scenery* scenery_;
  FixedVector<Vec2d, CharacterShape::max_points> outline_;  ///< The character's outline,
  FixedVector<Vec2d, CharacterShape::max_points> grown_;    ///< and a slightly larger one.
};

}  // namespace paperproof
