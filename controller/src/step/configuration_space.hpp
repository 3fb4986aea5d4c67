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
#include "step/real.hpp"

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

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Four numbers that are worked on at once.
using Four = Eigen::Array<Real, 4, 1, Eigen::DontAlign>;
/// One number per shared axis: a tile is a few wide subtractions and maxima. See `ConfigurationSpace::groups`.
struct PerAxis {
  std::array<Real, 12> all;

  [[nodiscard]] Real operator[](std::size_t axis) const noexcept { return all[axis]; }
  [[nodiscard, gnu::always_inline]] auto group(std::size_t k) const noexcept { return Four::Map(all.data() + 4 * k); }
  [[nodiscard, gnu::always_inline]] auto group(std::size_t k) noexcept { return Four::Map(all.data() + 4 * k); }
};

/// What of the octagon faces a piece along an axis with normal n: its lowest points along n.
struct OctagonFace {
  Real low;   ///< min n·o [m]
  Real from;  ///< Where they begin along (-n.y, n.x) [m]
  Real to;    ///< Where they end [m]; equal to `from` for a corner.
};

/// An axis that belongs to one piece alone: the normal of an edge that is not parallel to any edge of the octagon.
struct OwnAxis {
  Vec2 normal;
  Real offset;
  OctagonFace face;
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
class ConfigurationSpace {
 public:
  /// Edges of the octagon, and the four box directions where they are not among them: they bevel sharp corners.
  /// The first four are the box directions: up, right, left, down.
  static constexpr std::size_t max_shared = 12;
  static constexpr std::size_t max_axes = 64;  ///< Of one piece: shared ones, and those of at most 32 edges.

  /// `scenery` must outlive it.
  /// @param tree over what stands still, asked once for the neighbours of every piece.
  ConfigurationSpace(const Scenery& scenery, const CharacterShape& shape, const broad_phase::Tree& tree,
                     const MoverPhases& mover_phases);

  [[nodiscard]] const Scenery& scenery() const noexcept { return scenery_; }
  [[nodiscard]] const OneWaySurfaces& surfaces() const noexcept { return surfaces_; }
  /// Hull of the character, counter-clockwise, of coordinates that a `Real` holds [m].
  [[nodiscard]] std::span<const Vec2d> hull() const noexcept { return {hull_.begin(), hull_.end()}; }
  /// Box of the hull, around position zero.
  [[nodiscard]] const Box2& hull_box() const noexcept { return hull_box_; }

  /// What the octagon covers or touches while its reference point is in `box` [m].
  [[nodiscard]] Box2 touched_from(const Box2& box) const noexcept {
    return Box2{box.lower + hull_box_.lower, box.upper + hull_box_.upper}.inflated(tolerances.touch);
  }

  /// Of the box of what it covers or touches in one place [m].
  [[nodiscard]] Vec2 touched_size() const noexcept {
    const Box2 touched = touched_from({Vec2::Zero(), Vec2::Zero()});
    return touched.upper - touched.lower;
  }

  /// Shared axes per piece: 8 or 12, in groups of four. Unused ones have a zero normal and an offset that is never the
  /// largest.
  [[nodiscard]] std::size_t lanes() const noexcept { return lanes_; }
  /// Calls `visit(0)`, `visit(1)` and, for 12 axes, `visit(2)`: most shapes have 8, and a loop took a fifth more
  /// instructions.
  template <class Visit>
  [[gnu::always_inline]] inline void for_each_group(const Visit& visit) const noexcept {
    visit(0);
    visit(1);
    if (lanes_ == max_shared) [[unlikely]]
      visit(2);
  }
  /// The components of four normals.
  [[nodiscard]] auto shared_x(std::size_t group) const noexcept { return Four::Map(shared_x_.data() + 4 * group); }
  [[nodiscard]] auto shared_y(std::size_t group) const noexcept { return Four::Map(shared_y_.data() + 4 * group); }

  /// Offsets along the box directions alone: those of the piece's box.
  [[nodiscard, gnu::always_inline]] inline Four box_offsets(PieceIndex piece) const noexcept {
    Four offsets;
    write_box_offsets(scenery_.box(piece), offsets.data());
    return offsets;
  }
  /// Offsets along four shared axes.
  [[nodiscard, gnu::always_inline]] inline Four offsets(PieceIndex piece, std::size_t group) const noexcept {
    if (group == 0) return box_offsets(piece);
    const std::uint32_t stored = info_[piece].first_offset;
    Four offsets;
    if (stored == ObstacleInfo::rectangle)
      write_rectangle_offsets(scenery_.box(piece), 4 * group, offsets.data());
    else
      std::copy_n(shared_offsets_.data() + stored + 4 * (group - 1), 4, offsets.data());
    return offsets;
  }
  [[nodiscard]] const ObstacleInfo& info(PieceIndex piece) const noexcept { return info_[piece]; }
  [[nodiscard]] std::span<const OwnAxis> own_axes(PieceIndex piece) const noexcept {
    return std::span(own_axes_).subspan(info_[piece].first_own, info_[piece].own_count);
  }
  /// A circle has an axis of its own, a tangent like any other: where a piece has none, nothing more is asked.
  [[nodiscard]] bool is_circle(PieceIndex piece) const noexcept { return info_[piece].surface == ObstacleInfo::round; }
  /// Where the character at p is nearest to a circle.
  [[nodiscard]] geometry::NearCircle near_circle(PieceIndex piece, const Vec2& p) const noexcept {
    return geometry::near_circle(hull(), p, scenery_.circle(piece));
  }
  [[nodiscard]] static std::size_t axis_of(const geometry::NearCircle& near) noexcept {
    return axis_along(near.normal);
  }
  [[nodiscard]] std::size_t axis_count(PieceIndex piece) const noexcept { return lanes_ + info_[piece].own_count; }
  [[nodiscard, gnu::always_inline]] inline Vec2 normal(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis < lanes_) return {shared_x_[axis], shared_y_[axis]};
    if (is_direction(axis)) [[unlikely]]
      return normal_along(axis);
    return own_axes(piece)[axis - lanes_].normal;
  }
  [[nodiscard]] Real offset(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) [[unlikely]]
      return is_direction(axis) ? offset_along(piece, axis) : own_axes(piece)[axis - lanes_].offset;
    if (info_[piece].first_offset == ObstacleInfo::rectangle) return rectangle_offset(piece, axis);
    return axis < 4 ? box_offsets(piece)[static_cast<Eigen::Index>(axis)]
                    : shared_offsets_[info_[piece].first_offset + axis - 4];
  }
  /// @param axis no direction.
  [[nodiscard]] const OctagonFace& octagon_face(PieceIndex piece, std::size_t axis) const noexcept {
    return axis < lanes_ ? shared_faces_[axis] : own_axes(piece)[axis - lanes_].face;
  }
  [[nodiscard]] OctagonFace face_along(const Vec2& normal) const noexcept;
  [[nodiscard]] bool covered(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) return !is_direction(axis) && own_axes(piece)[axis - lanes_].covered;
    return ((info_[piece].covered >> axis) & 1U) != 0;
  }
  [[nodiscard]] bool hidden(PieceIndex piece, std::size_t axis) const noexcept {
    if (axis >= lanes_) return !is_direction(axis) && own_axes(piece)[axis - lanes_].hidden;
    return ((info_[piece].hidden >> axis) & 1U) != 0;
  }
  /// Separation along one axis at p [m].
  [[nodiscard, gnu::always_inline]] inline Real separation(PieceIndex piece, std::size_t axis,
                                                           const Vec2& p) const noexcept {
    const Vec2 n = normal(piece, axis);
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
    Vec2 size;
    Vec2 lower;  ///< Both from the lower corner of the one.
    Vec2 upper;
    friend bool operator==(const Placement&, const Placement&) = default;
  };
  /// What the search for covered facets keeps from piece to piece.
  struct CoverSearch;

  /// Two numbers in one register. Offsets are worked out for each piece that is met: numbers that are put into a vector
  /// one by one wait for the memory, and vectors that a library assembles are not always inlined.
  using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

  [[nodiscard, gnu::always_inline]] static inline Pair load(const double* numbers) noexcept {
    return Pair{numbers[0], numbers[1]};
  }
  [[gnu::always_inline]] static inline void write(const Pair& first, const Pair& second, Real* four) noexcept {
    if constexpr (sizeof(Real) == sizeof(double)) {
      std::memcpy(four, &first, sizeof first);
      std::memcpy(four + 2, &second, sizeof second);
    } else {
      for (int k = 0; k < 2; ++k) {
        four[k] = static_cast<Real>(first[k]);
        four[k + 2] = static_cast<Real>(second[k]);
      }
    }
  }
  [[gnu::always_inline]] inline void write_box_offsets(const Box2& box, Real* four) const noexcept {
    const Pair lower = load(box.lower.data());
    const Pair upper = load(box.upper.data());
    write(Pair{upper[1], upper[0]} - shared_low_[0], -lower - shared_low_[1], four);
  }
  /// Along shared axes that are no box directions: furthest along a normal is the corner on its side.
  [[gnu::always_inline]] inline void write_rectangle_offsets(const Box2& box, std::size_t axis,
                                                             Real* four) const noexcept {
    const Pair lower = load(box.lower.data());
    const Pair upper = load(box.upper.data());
    const auto pair = [&](std::size_t k) {
      const Pair x = rightward_[k] * upper[0] + leftward_[k] * lower[0];
      const Pair y = upward_[k] * upper[1] + downward_[k] * lower[1];
      return (x + y) - shared_low_[k];
    };
    write(pair(axis / 2), pair(axis / 2 + 1), four);
  }
  [[nodiscard]] Real rectangle_offset(PieceIndex piece, std::size_t axis) const noexcept {
    const Box2& box = scenery_.box(piece);
    const double x = shared_x_[axis];
    const double y = shared_y_[axis];
    const double furthest = std::max(x * double{box.lower.x()}, x * double{box.upper.x()}) +
                            std::max(y * double{box.lower.y()}, y * double{box.upper.y()});
    return static_cast<Real>(furthest - low(axis));
  }

  [[nodiscard, gnu::cold, gnu::noinline]] static Vec2 normal_along(std::size_t direction) noexcept {
    return direction_of(direction).cast<Real>();
  }
  [[nodiscard, gnu::cold, gnu::noinline]] Real offset_along(PieceIndex piece, std::size_t direction) const noexcept {
    return support_offset(piece, direction_of(direction));
  }
  [[nodiscard]] double low(std::size_t axis) const noexcept { return shared_low_[axis / 2][axis % 2]; }

  void build_shared_axes();
  void build_obstacle(PieceIndex piece);
  void build_own_axes(PieceIndex piece, ObstacleInfo& info);
  void build_covered(const broad_phase::Tree& tree, const MoverPhases& mover_phases);
  template <class Neighbours>
  void build_covered(PieceIndex piece, PieceRange together, const Neighbours& neighbours, CoverSearch& search);
  [[nodiscard]] bool lies_in(const Facet& facet, PieceIndex other) const noexcept;
  [[nodiscard]] Placement placement(PieceIndex piece, PieceIndex other) const noexcept;
  [[nodiscard]] Box2 around(PieceIndex piece) const noexcept;
  void find_near(PieceIndex piece, std::span<const PieceIndex> found, CoverSearch& search) const;
  [[nodiscard]] double open_part(PieceIndex piece, const Facet& facet, CoverSearch& search) const;
  [[nodiscard]] Interval inside(const Facet& facet, PieceIndex other) const noexcept;
  void set_covered(PieceIndex piece, std::size_t axis, double open) noexcept;
  [[nodiscard]] Facet facet(PieceIndex piece, std::size_t axis) const noexcept;
  template <class Points>
  [[nodiscard]] Interval face_of(const Points& points, const Vec2d& normal) const noexcept;
  [[nodiscard]] Interval face_of_rectangle(const Box2& box, const Vec2d& normal) const noexcept;
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
  [[nodiscard]] Real support_offset(PieceIndex piece, const Vec2d& normal) const noexcept;

  const Scenery& scenery_;
  FixedVector<Vec2d, CharacterShape::max_points> hull_;
  OneWaySurfaces surfaces_;
  Box2 hull_box_;
  bool filters_differ_ = false;
  double facet_noise_ = 0;
  std::size_t lanes_ = 8;
  std::size_t shared_count_ = 0;
  std::array<Real, max_shared> shared_x_{};
  std::array<Real, max_shared> shared_y_{};
  /// By two axes, for offsets: the components of the normals that are above zero, and those below,
  std::array<Pair, max_shared / 2> rightward_{}, leftward_{}, upward_{}, downward_{};
  std::array<Pair, max_shared / 2> shared_low_{};  ///< and the least n·o over the octagon.
  std::array<OctagonFace, max_shared> shared_faces_{};
  std::array<Interval, max_shared> hull_faces_{};  ///< What of the octagon faces a piece, as `face_of` counts.
  std::vector<Real> shared_offsets_;               ///< Of pieces that are no rectangles, without the box directions.
  std::vector<OwnAxis> own_axes_;
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

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
