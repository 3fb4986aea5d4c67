/// The scenery as the character's reference point sees it.
///
/// The octagon O at p touches a convex piece P exactly when the point p touches the Minkowski sum of P and -O. That sum
/// is again convex; its facets have the normals of P's edges and the negated normals of O's edges. For an axis with
/// normal n
///
///     f(p) = n·p - h,    h = max over P of n·v  -  min over O of n·o
///
/// is the separation along n, and the interiors are apart exactly when the largest f is >= 0. (Lozano-Perez 1983; the
/// separating axis theorem read as a distance.) The normals of O's edges are the same for every piece, so their
/// products with p and with the motion are formed once per motion, and a tile costs a handful of subtractions.
#pragma once

#include "one_way_surfaces.hpp"
#include "step/mover_phases.hpp"

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <span>
#include <vector>

namespace paperproof::octagon_sweep {

/// One number per shared axis. All lanes are worked on at once: a tile is a few wide subtractions and maxima.
template <std::size_t Lanes, class Scalar>
using PerAxis = Eigen::Array<Scalar, static_cast<int>(Lanes), 1, Eigen::DontAlign>;

/// What of the octagon faces a piece along an axis with normal n: its lowest points along n.
template <class Scalar>
struct OctagonFace {
  Scalar low;   ///< min n·o [m]
  Scalar from;  ///< Where they begin along (-n.y, n.x) [m]
  Scalar to;    ///< Where they end [m]; equal to `from` for a corner.
};

/// An axis that belongs to one piece alone: the normal of an edge that is not parallel to any edge of the octagon.
template <class Scalar>
struct OwnAxis {
  Vec2<Scalar> normal;
  Scalar offset;
  OctagonFace<Scalar> face;
};

/// Everything about a piece but its shared offsets.
struct ObstacleInfo {
  std::uint32_t first_own = 0;  ///< Into `own_axes()`.
  std::uint16_t own_count = 0;
  /// Bit per axis (shared ones first, then its own): the facet lies inside other obstacles, so nothing free ever
  /// touches it. An edge shared by two pieces or covered by an abutting tile is such a facet: no contact may have its
  /// normal.
  std::uint64_t covered = 0;
  std::uint64_t hidden = 0;  ///< Of the covered ones those of which less is open than counts as closed.
  static constexpr std::uint8_t not_one_way = 255;
  std::uint8_t one_way_axis = not_one_way;  ///< The axis whose normal is the blocking normal of a one-way segment.
  bool bent_surface = false;                ///< Its surface is more than one straight line.
  bool whole_collider = false;              ///< Its collider has no other piece.
  std::uint32_t surface = 0;                ///< Of a one-way segment, into `surfaces()`.
};

/// Built once for a scenery and a character. Immutable; may be shared between threads.
template <class Scalar>
class ConfigurationSpace {
 public:
  /// Edges of the octagon, and the four box directions where they are not among them: they bevel sharp corners.
  static constexpr std::size_t max_shared = 12;
  static constexpr std::size_t box_axes = 4;   ///< The first shared axes: up, right, left, down.
  static constexpr std::size_t max_axes = 64;  ///< Of one piece; the covered mask has as many bits.

  /// `scenery` must outlive it.
  /// @param broad_phase over what stands still, asked once for the neighbours of every piece.
  /// @throws InvalidScenery for a piece with more edges than axes are kept for.
  ConfigurationSpace(const Scenery<Scalar>& scenery, const CharacterShape& shape, const BroadPhase<Scalar>& broad_phase,
                     const MoverPhases<Scalar>& mover_phases);

  [[nodiscard]] const Scenery<Scalar>& scenery() const noexcept { return scenery_; }
  [[nodiscard]] const OneWaySurfaces<Scalar>& surfaces() const noexcept { return surfaces_; }
  /// Hull of the character, counter-clockwise, rounded to Scalar [m].
  [[nodiscard]] std::span<const Vec2<Scalar>> hull() const noexcept { return {hull_.begin(), hull_.end()}; }
  /// Box of the hull, around position zero.
  [[nodiscard]] const Box2<Scalar>& hull_box() const noexcept { return hull_box_; }

  /// What the octagon covers or touches while its reference point is in `box` [m].
  [[nodiscard]] Box2<Scalar> touched_from(const Box2<Scalar>& box) const noexcept {
    return Box2<Scalar>{box.lower + hull_box_.lower, box.upper + hull_box_.upper}.inflated(Tolerances<Scalar>{}.touch);
  }

  /// Shared axes per piece: 8 or 12. Unused ones have a zero normal and an offset that is never the largest.
  [[nodiscard]] std::size_t lanes() const noexcept { return lanes_; }
  [[nodiscard]] const std::array<Scalar, max_shared>& shared_x() const noexcept { return shared_x_; }
  [[nodiscard]] const std::array<Scalar, max_shared>& shared_y() const noexcept { return shared_y_; }

  [[nodiscard]] const Scalar* shared_offsets(PieceIndex piece) const noexcept {
    return shared_offsets_.data() + piece * lanes_;
  }
  [[nodiscard]] const ObstacleInfo& info(PieceIndex piece) const noexcept { return info_[piece]; }
  [[nodiscard]] std::span<const OwnAxis<Scalar>> own_axes(PieceIndex piece) const noexcept {
    return std::span(own_axes_).subspan(info_[piece].first_own, info_[piece].own_count);
  }
  /// Some piece that blocks has an axis of its own.
  [[nodiscard]] bool has_own_axes() const noexcept;
  [[nodiscard]] std::size_t axis_count(PieceIndex piece) const noexcept { return lanes_ + info_[piece].own_count; }
  [[nodiscard]] Vec2<Scalar> normal(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis < lanes_) return {shared_x_[axis], shared_y_[axis]};
    return own_axes(piece)[axis - lanes_].normal;
  }
  [[nodiscard]] Scalar offset(PieceIndex piece, std::size_t axis) const noexcept {
    return axis < lanes_ ? shared_offsets(piece)[axis] : own_axes(piece)[axis - lanes_].offset;
  }
  [[nodiscard]] const OctagonFace<Scalar>& octagon_face(PieceIndex piece, std::size_t axis) const noexcept {
    return axis < lanes_ ? shared_faces_[axis] : own_axes(piece)[axis - lanes_].face;
  }
  [[nodiscard]] bool covered(PieceIndex piece, std::size_t axis) const noexcept {
    return ((info_[piece].covered >> axis) & 1U) != 0;
  }
  [[nodiscard]] bool hidden(PieceIndex piece, std::size_t axis) const noexcept {
    return ((info_[piece].hidden >> axis) & 1U) != 0;
  }
  /// Separation along one axis at p [m].
  [[nodiscard]] Scalar separation(PieceIndex piece, std::size_t axis, const Vec2<Scalar>& p) const noexcept {
    const Vec2<Scalar> n = normal(piece, axis);
    return n.x() * p.x() + n.y() * p.y() - offset(piece, axis);
  }

  /// End points of a facet of a piece's obstacle [m].
  struct Facet {
    Vec2d from;
    Vec2d to;
  };
  [[nodiscard]] Facet facet(PieceIndex piece, std::size_t axis) const noexcept;

 private:
  void build_shared_axes();
  void build_obstacle(PieceIndex piece);
  [[nodiscard]] bool may_cover(PieceIndex covering, PieceIndex piece) const noexcept;
  [[nodiscard]] bool is_covered_corner(PieceIndex piece, std::size_t axis, const Vec2d& corner,
                                       std::span<const PieceIndex> neighbours) const noexcept;
  void build_covered(PieceIndex piece, std::span<const PieceIndex> neighbours);
  [[nodiscard]] Scalar support_offset(PieceIndex piece, const Vec2d& normal) const noexcept;
  [[nodiscard]] OctagonFace<Scalar> face_along(const Vec2<Scalar>& normal) const noexcept;

  const Scenery<Scalar>& scenery_;
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> hull_;
  OneWaySurfaces<Scalar> surfaces_;
  Box2<Scalar> hull_box_;
  double facet_noise_ = 0;
  std::size_t lanes_ = 8;
  std::size_t shared_count_ = 0;
  std::array<Scalar, max_shared> shared_x_{};
  std::array<Scalar, max_shared> shared_y_{};
  std::array<OctagonFace<Scalar>, max_shared> shared_faces_{};
  std::vector<Scalar> shared_offsets_;
  std::vector<OwnAxis<Scalar>> own_axes_;
  std::vector<ObstacleInfo> info_;
};

extern template class ConfigurationSpace<float>;
extern template class ConfigurationSpace<double>;

}  // namespace paperproof::octagon_sweep
