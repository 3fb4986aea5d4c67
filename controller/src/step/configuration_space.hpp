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
///
/// A circle adds its radius to h. The octagon touches it along any normal: there an axis is no index but a direction
/// (see `axis_along`). The shared axes are tangents of the circle's obstacle, so what they say of a separation is never
/// too much.
#pragma once

#include "geometry/circle.hpp"

#include "one_way_surfaces.hpp"
#include "step/mover_phases.hpp"

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>
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
  bool covered = false;  ///< See `ObstacleInfo::covered`.
  bool hidden = false;
};

/// An axis of a circle: its direction, as a number that is larger than any index. The larger component tells the
/// quarter; the other one is divided by it, which keeps what a double has.
[[nodiscard]] inline std::size_t axis_along(const Vec2d& direction) noexcept;
[[nodiscard]] inline Vec2d direction_of(std::size_t axis) noexcept;
/// Whether an axis is a direction.
[[nodiscard]] constexpr bool is_direction(std::size_t axis) noexcept { return axis >> 63U != 0; }

/// Everything about a piece but its shared offsets.
struct ObstacleInfo {
  static constexpr std::uint8_t not_one_way = 255;
  static constexpr std::uint32_t rectangle = ~std::uint32_t{0};
  static constexpr std::uint32_t round = ~std::uint32_t{0};
  std::uint32_t first_own = 0;  ///< Of its own axes.
  /// Of its offsets along shared axes, which of a rectangle follow from its box.
  std::uint32_t first_offset = rectangle;
  /// Bit per shared axis: the facet lies inside other obstacles, so nothing free ever touches it. An edge shared by two
  /// pieces or covered by an abutting tile is such a facet: no contact may have its normal.
  std::uint16_t covered = 0;
  std::uint16_t hidden = 0;  ///< Of the covered ones those of which less is open than counts as closed.
  std::uint8_t own_count = 0;
  std::uint8_t one_way_axis = not_one_way;  ///< The axis whose normal is the blocking normal of a one-way segment.
  bool bent_surface = false;                ///< Its surface is more than one straight line.
  bool whole_collider = false;              ///< Its collider has no other piece.
  std::uint32_t surface = 0;                ///< Of a one-way segment, into `surfaces()`; `round` of a circle.
};

/// Built once for a scenery and a character. Immutable; may be shared between threads.
template <class Scalar>
class ConfigurationSpace {
 public:
  /// Edges of the octagon, and the four box directions where they are not among them: they bevel sharp corners.
  static constexpr std::size_t max_shared = 12;
  static constexpr std::size_t box_axes = 4;   ///< The first shared axes: up, right, left, down.
  static constexpr std::size_t max_axes = 64;  ///< Of one piece: shared ones, and those of at most 32 edges.

  /// `scenery` must outlive it.
  /// @param tree over what stands still, asked once for the neighbours of every piece.
  ConfigurationSpace(const Scenery<Scalar>& scenery, const CharacterShape& shape, const broad_phase::Tree<Scalar>& tree,
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

  /// Of the box of what it covers or touches in one place [m].
  [[nodiscard]] Vec2<Scalar> touched_size() const noexcept {
    const Box2<Scalar> touched = touched_from({Vec2<Scalar>::Zero(), Vec2<Scalar>::Zero()});
    return touched.upper - touched.lower;
  }

  /// Shared axes per piece: 8 or 12. Unused ones have a zero normal and an offset that is never the largest.
  [[nodiscard]] std::size_t lanes() const noexcept { return lanes_; }
  [[nodiscard]] const std::array<Scalar, max_shared>& shared_x() const noexcept { return shared_x_; }
  [[nodiscard]] const std::array<Scalar, max_shared>& shared_y() const noexcept { return shared_y_; }

  /// Offsets along the box directions alone: those of the piece's box.
  [[nodiscard, gnu::always_inline]] inline PerAxis<box_axes, Scalar> box_offsets(PieceIndex piece) const noexcept {
    PerAxis<box_axes, Scalar> offsets;
    write_box_offsets(scenery_.box(piece), offsets.data());
    return offsets;
  }
  /// Along all shared axes. @tparam Lanes as `lanes()`.
  template <std::size_t Lanes>
  [[nodiscard, gnu::always_inline]] inline PerAxis<Lanes, Scalar> shared_offsets(PieceIndex piece) const noexcept {
    const Box2<Scalar>& box = scenery_.box(piece);
    const std::uint32_t stored = info_[piece].first_offset;
    PerAxis<Lanes, Scalar> offsets;
    write_box_offsets(box, offsets.data());
    for (std::size_t k = box_axes; k < Lanes; k += box_axes)
      if (stored == ObstacleInfo::rectangle)
        write_rectangle_offsets(box, k, offsets.data() + k);
      else
        std::copy_n(shared_offsets_.data() + stored + k - box_axes, box_axes, offsets.data() + k);
    return offsets;
  }
  [[nodiscard]] const ObstacleInfo& info(PieceIndex piece) const noexcept { return info_[piece]; }
  [[nodiscard]] std::span<const OwnAxis<Scalar>> own_axes(PieceIndex piece) const noexcept {
    return std::span(own_axes_).subspan(info_[piece].first_own, info_[piece].own_count);
  }
  /// A circle has an axis of its own, a tangent like any other: where a piece has none, nothing more is asked.
  [[nodiscard]] bool is_circle(PieceIndex piece) const noexcept { return info_[piece].surface == ObstacleInfo::round; }
  /// Where the character at p is nearest to a circle.
  [[nodiscard]] geometry::NearCircle<Scalar> near_circle(PieceIndex piece, const Vec2<Scalar>& p) const noexcept {
    return geometry::near_circle<Scalar>(hull(), p, scenery_.circle(piece));
  }
  [[nodiscard]] static std::size_t axis_of(const geometry::NearCircle<Scalar>& near) noexcept {
    return axis_along(near.normal.template cast<double>());
  }
  [[nodiscard]] std::size_t axis_count(PieceIndex piece) const noexcept { return lanes_ + info_[piece].own_count; }
  [[nodiscard, gnu::always_inline]] inline Vec2<Scalar> normal(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis < lanes_) return {shared_x_[axis], shared_y_[axis]};
    if (is_direction(axis)) [[unlikely]]
      return normal_along(axis);
    return own_axes(piece)[axis - lanes_].normal;
  }
  [[nodiscard]] Scalar offset(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) [[unlikely]]
      return is_direction(axis) ? offset_along(piece, axis) : own_axes(piece)[axis - lanes_].offset;
    if (info_[piece].first_offset == ObstacleInfo::rectangle) return rectangle_offset(piece, axis);
    return axis < box_axes ? box_offsets(piece)[static_cast<Eigen::Index>(axis)]
                           : shared_offsets_[info_[piece].first_offset + axis - box_axes];
  }
  /// @param axis no direction.
  [[nodiscard]] const OctagonFace<Scalar>& octagon_face(PieceIndex piece, std::size_t axis) const noexcept {
    return axis < lanes_ ? shared_faces_[axis] : own_axes(piece)[axis - lanes_].face;
  }
  [[nodiscard]] OctagonFace<Scalar> face_along(const Vec2<Scalar>& normal) const noexcept;
  [[nodiscard]] bool covered(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) return !is_direction(axis) && own_axes(piece)[axis - lanes_].covered;
    return ((info_[piece].covered >> axis) & 1U) != 0;
  }
  [[nodiscard]] bool hidden(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) return !is_direction(axis) && own_axes(piece)[axis - lanes_].hidden;
    return ((info_[piece].hidden >> axis) & 1U) != 0;
  }
  /// Separation along one axis at p [m].
  [[nodiscard, gnu::always_inline]] inline Scalar separation(PieceIndex piece, std::size_t axis,
                                                             const Vec2<Scalar>& p) const noexcept {
    const Vec2<Scalar> n = normal(piece, axis);
    return n.x() * p.x() + n.y() * p.y() - offset(piece, axis);
  }

 private:
  /// Part of a line [m], or of a facet, in [0, 1].
  struct Interval {
    double from;
    double to;
  };
  /// A facet of a piece's obstacle.
  struct Facet {
    std::size_t axis;
    Vec2d from;  ///< Its end points [m],
    Vec2d to;
    Vec2d along;    ///< and from one to the other, unit.
    double length;  ///< [m]
  };
  /// How large a rectangle is, and where another lies that it is beside [m].
  struct Placement {
    Vec2<Scalar> size;
    Vec2<Scalar> lower;  ///< Both from the lower corner of the one.
    Vec2<Scalar> upper;
    friend bool operator==(const Placement&, const Placement&) = default;
  };
  /// What the search for covered facets keeps from piece to piece.
  struct CoverSearch;

  /// Two numbers in one register. Offsets are worked out for each piece that is met: numbers that are put into a vector
  /// one by one wait for the memory, and vectors that a library assembles are not always inlined.
  using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

  [[nodiscard, gnu::always_inline]] static inline Pair load(const Scalar* numbers) noexcept {
    return Pair{double{numbers[0]}, double{numbers[1]}};
  }
  [[gnu::always_inline]] static inline void write(const Pair& first, const Pair& second, Scalar* four) noexcept {
    using Four [[gnu::vector_size(4 * sizeof(float))]] = float;
    if constexpr (std::is_same_v<Scalar, float>) {
      const Four all{static_cast<float>(first[0]), static_cast<float>(first[1]), static_cast<float>(second[0]),
                     static_cast<float>(second[1])};
      std::memcpy(four, &all, sizeof all);
    } else {
      std::memcpy(four, &first, sizeof first);
      std::memcpy(four + 2, &second, sizeof second);
    }
  }
  [[gnu::always_inline]] inline void write_box_offsets(const Box2<Scalar>& box, Scalar* four) const noexcept {
    const Pair lower = load(box.lower.data());
    const Pair upper = load(box.upper.data());
    write(Pair{upper[1], upper[0]} - shared_low_[0], -lower - shared_low_[1], four);
  }
  /// Along shared axes that are no box directions: furthest along a normal is the corner on its side.
  [[gnu::always_inline]] inline void write_rectangle_offsets(const Box2<Scalar>& box, std::size_t axis,
                                                             Scalar* four) const noexcept {
    const Pair lower = load(box.lower.data());
    const Pair upper = load(box.upper.data());
    const auto pair = [&](std::size_t k) {
      const Pair x = rightward_[k] * upper[0] + leftward_[k] * lower[0];
      const Pair y = upward_[k] * upper[1] + downward_[k] * lower[1];
      return (x + y) - shared_low_[k];
    };
    write(pair(axis / 2), pair(axis / 2 + 1), four);
  }
  [[nodiscard]] Scalar rectangle_offset(PieceIndex piece, std::size_t axis) const noexcept {
    const Box2<Scalar>& box = scenery_.box(piece);
    const double x = shared_x_[axis];
    const double y = shared_y_[axis];
    const double furthest = std::max(x * double{box.lower.x()}, x * double{box.upper.x()}) +
                            std::max(y * double{box.lower.y()}, y * double{box.upper.y()});
    return static_cast<Scalar>(furthest - low(axis));
  }

  [[nodiscard, gnu::cold, gnu::noinline]] static Vec2<Scalar> normal_along(std::size_t direction) noexcept {
    return direction_of(direction).template cast<Scalar>();
  }
  [[nodiscard, gnu::cold, gnu::noinline]] Scalar offset_along(PieceIndex piece, std::size_t direction) const noexcept {
    return support_offset(piece, direction_of(direction));
  }
  [[nodiscard]] double low(std::size_t axis) const noexcept { return shared_low_[axis / 2][axis % 2]; }

  void build_shared_axes();
  void build_obstacle(PieceIndex piece);
  void build_own_axes(PieceIndex piece, ObstacleInfo& info);
  template <std::size_t Lanes>
  void build_covered(const broad_phase::Tree<Scalar>& tree, const MoverPhases<Scalar>& mover_phases);
  template <std::size_t Lanes, class Neighbours>
  void build_covered(PieceIndex piece, PieceRange together, const Neighbours& neighbours, CoverSearch& search);
  template <std::size_t Lanes>
  [[nodiscard]] bool lies_in(const Facet& facet, PieceIndex other) const noexcept;
  [[nodiscard]] Placement placement(PieceIndex piece, PieceIndex other) const noexcept;
  [[nodiscard]] Box2<Scalar> around(PieceIndex piece) const noexcept;
  void find_near(PieceIndex piece, std::span<const PieceIndex> found, CoverSearch& search) const;
  template <std::size_t Lanes>
  [[nodiscard]] double open_part(PieceIndex piece, const Facet& facet, CoverSearch& search) const;
  template <std::size_t Lanes>
  [[nodiscard]] Interval inside(const Facet& facet, PieceIndex other) const noexcept;
  void set_covered(PieceIndex piece, std::size_t axis, double open) noexcept;
  [[nodiscard]] Facet facet(PieceIndex piece, std::size_t axis) const noexcept;
  template <class Points>
  [[nodiscard]] Interval face_of(const Points& points, const Vec2d& normal) const noexcept;
  [[nodiscard]] Interval face_of_rectangle(const Box2<Scalar>& box, const Vec2d& normal) const noexcept;
  [[nodiscard]] bool may_cover(PieceIndex covering, PieceIndex piece) const noexcept;
  /// A piece that is not there for some characters hides nothing of one that is.
  [[nodiscard]] bool have_equal_filters(PieceIndex a, PieceIndex b) const noexcept {
    const auto filter = [this](PieceIndex piece) {
      return scenery_.collider(scenery_.pieces()[piece].collider).filter;
    };
    return !filters_differ_ || filter(a) == filter(b);
  }
  [[nodiscard]] bool is_covered_corner(PieceIndex piece, std::size_t axis, const Vec2d& corner,
                                       std::span<const PieceIndex> neighbours) const noexcept;
  [[nodiscard]] Scalar support_offset(PieceIndex piece, const Vec2d& normal) const noexcept;

  const Scenery<Scalar>& scenery_;
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> hull_;
  OneWaySurfaces<Scalar> surfaces_;
  Box2<Scalar> hull_box_;
  bool filters_differ_ = false;
  double facet_noise_ = 0;
  std::size_t lanes_ = 8;
  std::size_t shared_count_ = 0;
  std::array<Scalar, max_shared> shared_x_{};
  std::array<Scalar, max_shared> shared_y_{};
  /// By two axes, for offsets: the components of the normals that are above zero, and those below,
  std::array<Pair, max_shared / 2> rightward_{}, leftward_{}, upward_{}, downward_{};
  std::array<Pair, max_shared / 2> shared_low_{};  ///< and the least n·o over the octagon.
  std::array<OctagonFace<Scalar>, max_shared> shared_faces_{};
  std::array<Interval, max_shared> hull_faces_{};  ///< What of the octagon faces a piece, as `face_of` counts.
  std::vector<Scalar> shared_offsets_;             ///< Of what is no rectangle, but for the box directions.
  std::vector<OwnAxis<Scalar>> own_axes_;
  std::vector<ObstacleInfo> info_;
};

inline std::size_t axis_along(const Vec2d& direction) noexcept {
  static_assert(sizeof(std::size_t) == 8);
  const bool level = std::abs(direction.x()) >= std::abs(direction.y());
  const std::size_t quarter = level ? (direction.x() > 0 ? 0 : 2) : (direction.y() > 0 ? 1 : 3);
  const double tangent = level ? direction.y() / direction.x() : -direction.x() / direction.y();
  return std::size_t{1} << 63U | quarter << 61U |
         static_cast<std::size_t>(static_cast<std::int64_t>(tangent * 0x1p59) + (std::int64_t{1} << 59U));
}

inline Vec2d direction_of(std::size_t axis) noexcept {
  const auto rest = static_cast<std::int64_t>(axis & ((std::size_t{1} << 61U) - 1));
  const double tangent = static_cast<double>(rest - (std::int64_t{1} << 59U)) * 0x1p-59;
  const double large = 1 / std::sqrt(1 + tangent * tangent);
  const double small = tangent * large;
  switch (axis >> 61U & 3U) {
    case 0:
      return {large, small};
    case 1:
      return {0 - small, large};
    case 2:
      return {-large, 0 - small};
    default:
      return {small, -large};
  }
}

extern template class ConfigurationSpace<float>;
extern template class ConfigurationSpace<double>;

}  // namespace paperproof::octagon_sweep
