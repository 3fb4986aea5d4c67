/// Positions that are free, nearest first candidates.
#pragma once

#include "techniques/octagon_sweep/narrow_phase.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>

namespace paperproof::octagon_sweep {

/// The facets of some obstacles that other obstacles do not cover. The boundary of the union of the obstacles is made
/// of them: the free position that is nearest to a given one lies on one of them, or where two of them cross.
template <class Scalar>
class OpenFacets {
 public:
  /// @param gap how far in front of the facets the positions are [m].
  OpenFacets(const ConfigurationSpace<Scalar>& space, const Vec2<Scalar>& from, Scalar gap) noexcept
      : space_(space), from_(from), gap_(gap) {}

  /// @param offset where the mover of the piece is [m]; zero where it stands still.
  void add(PieceIndex piece, const Vec2<Scalar>& offset) noexcept {
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) {
      const Vec2<Scalar> n = space_.normal(piece, axis);
      if (!space_.covered(piece, axis) && (n.x() != 0 || n.y() != 0)) keep_nearest(open_facet(piece, axis, offset));
    }
  }

  /// Calls `consider(position)` for the nearest position in front of each facet, and for all crossings.
  template <class Consider>
  void for_each_position(const Consider& consider) const noexcept {
    for (const Facet& facet : facets_) consider(facet.nearest);
    for (std::size_t i = 0; i < facets_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) consider_crossing(facets_[i], facets_[j], consider);
  }

 private:
  /// The nearest this many are looked at.
  static constexpr std::size_t max_facets = 96;

  struct Facet {
    Vec2<Scalar> normal;
    Scalar separation;     ///< Of `from` [m].
    Vec2<Scalar> nearest;  ///< Position in front of it that is nearest to `from`.
    Scalar distance;
  };

  [[nodiscard]] Facet open_facet(PieceIndex piece, std::size_t axis, const Vec2<Scalar>& offset) const noexcept {
    const auto facet = space_.facet(piece, axis);
    const Vec2<Scalar> local = from_ - offset;
    const Vec2d from = local.template cast<double>();
    const Vec2d span = facet.to - facet.from;
    const double squared = span.dot(span);
    const double share = squared > 0 ? std::clamp(span.dot(from - facet.from) / squared, 0.0, 1.0) : 0.0;
    const Vec2d foot = facet.from + span * share;
    const Vec2<Scalar> normal = space_.normal(piece, axis);
    const Vec2<Scalar> out = foot.template cast<Scalar>() + normal * gap_ + offset;
    return {normal, space_.separation(piece, axis, local), out, length_of(Vec2<Scalar>(out - from_))};
  }

  void keep_nearest(const Facet& facet) noexcept {
    if (facets_.push_back(facet)) return;
    auto furthest = std::max_element(facets_.begin(), facets_.end(),
                                     [](const Facet& a, const Facet& b) { return a.distance < b.distance; });
    if (facet.distance < furthest->distance) *furthest = facet;
  }

  /// Where the two inflated facets' lines cross: the way out of a corner.
  template <class Consider>
  void consider_crossing(const Facet& a, const Facet& b, const Consider& consider) const noexcept {
    const Scalar determinant = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
    if (std::abs(determinant) < Tolerances<Scalar>{}.hit) return;
    const Scalar da = gap_ - a.separation;
    const Scalar db = gap_ - b.separation;
    consider(from_ + Vec2<Scalar>((da * b.normal.y() - db * a.normal.y()) / determinant,
                                  (db * a.normal.x() - da * b.normal.x()) / determinant));
  }

  const ConfigurationSpace<Scalar>& space_;
  Vec2<Scalar> from_;
  Scalar gap_;
  FixedVector<Facet, max_facets> facets_;
};

}  // namespace paperproof::octagon_sweep
