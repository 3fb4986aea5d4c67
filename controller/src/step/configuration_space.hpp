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
#include "inlining.hpp"
#include "step/real.hpp"

#include "one_way_surfaces.hpp"
#include "piece_finder.hpp"

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <cmath>
#include <map>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Four numbers that are worked on at once.
using Four = Eigen::Array<Real, 4, 1, Eigen::DontAlign>;
/// One number per shared axis: a piece is a few wide subtractions and maxima.
struct PerAxis {
  std::array<Real, 12> all;

  [[nodiscard]] Real operator[](std::size_t axis) const { return all[axis]; }
  [[nodiscard]] PAPERPROOF_INLINE auto group(std::size_t k) const { return Four::Map(all.data() + 4 * k); }
  [[nodiscard]] PAPERPROOF_INLINE auto group(std::size_t k) { return Four::Map(all.data() + 4 * k); }
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
};

/// An axis of a circle: its direction, as a number that is larger than any index. The larger component tells the
/// quarter; the other one is divided by it, which keeps what a double has.
[[nodiscard]] inline std::size_t axis_along(const Vec2d& direction) {
  static_assert(sizeof(std::size_t) == 8);
  const bool level = std::abs(direction.x()) >= std::abs(direction.y());
  const std::size_t quarter = level ? (direction.x() > 0 ? 0 : 2) : (direction.y() > 0 ? 1 : 3);
  const double tangent = level ? direction.y() / direction.x() : -direction.x() / direction.y();
  return std::size_t{1} << 63U | quarter << 61U |
         static_cast<std::size_t>(static_cast<std::int64_t>(tangent * 0x1p59) + (std::int64_t{1} << 59U));
}

[[nodiscard]] inline Vec2d direction_of(std::size_t axis) {
  const auto rest = static_cast<std::int64_t>(axis & ((std::size_t{1} << 61U) - 1));
  const double tangent = static_cast<double>(rest - (std::int64_t{1} << 59U)) * 0x1p-59;
  const double large = 1 / std::sqrt(1 + tangent * tangent);
  const double small = tangent * large;
  const std::array quarters{Vec2d(large, small), Vec2d(0 - small, large), Vec2d(-large, 0 - small),
                            Vec2d(small, -large)};
  return quarters[axis >> 61U & 3U];
}

/// Whether an axis is a direction.
[[nodiscard]] constexpr bool is_direction(std::size_t axis) { return axis >> 63U != 0; }

/// Part of a line [m], or of a facet, in [0, 1].
struct Interval {
  double from;
  double to;
};

/// The directions that the character's shape gives to every obstacle: the normals of its edges, and the four box
/// directions where they are not among them, which bevel sharp corners. The first four are the box directions: up,
/// right, left, down.
struct SharedAxes {
  static constexpr std::size_t most = 12;

  explicit SharedAxes(const CharacterShape& shape);

  [[nodiscard]] std::span<const Vec2d> hull() const { return {points.begin(), points.end()}; }
  /// What of the hull faces a piece along a direction.
  [[nodiscard]] OctagonFace face_along(const Vec2& normal) const;

  FixedVector<Vec2d, CharacterShape::max_points> points;  ///< Of the hull, counter-clockwise [m].
  Box2 box;                                               ///< Of the hull, around position zero [m].
  std::size_t count = 0;
  std::size_t lanes = 8;  ///< 8 or 12. Unused ones have a zero normal, and an offset that is never the largest.
  std::array<Real, most> x{};
  std::array<Real, most> y{};
  std::array<double, most> low{};  ///< Least n·o over the hull [m].
  std::array<OctagonFace, most> faces{};
  std::array<Interval, most> hull_faces{};  ///< What of the hull faces a piece, across the normal.
};

/// What a piece is for the character.
struct Obstacle {
  static constexpr std::uint8_t not_one_way = 255;

  PerAxis offsets;   ///< Along the shared axes [m].
  Box2 box;          ///< Of the piece [m].
  PieceInfo source;  ///< Its mover is the index of its motion: see `Moving`.
  const ColliderInfo* collider = nullptr;
  PieceIndex piece = 0;                     ///< In the scenery.
  std::vector<OwnAxis> own{};               ///< The axes that follow the shared ones.
  std::uint8_t one_way_axis = not_one_way;  ///< The axis whose normal is the blocking normal of a one-way segment.
  bool bent_surface = false;                ///< Its surface is more than one straight line.
  bool whole_collider = false;              ///< Its collider has no other piece.
  OneWaySurfaces::Index surface = OneWaySurfaces::none;  ///< Of a one-way segment,
  const OneWaySurfaces* surfaces = nullptr;              ///< and which one that is.
  /// Bit per axis: the facet lies inside other obstacles, so nothing free ever touches it. An edge shared by two
  /// pieces or covered by an abutting tile is such a facet: no contact may have its normal.
  std::uint64_t covered = 0;
  std::uint64_t hidden = 0;      ///< Of the covered ones those of which less is open than counts as closed.
  bool knows_its_seams = false;  ///< What is covered and hidden is known.
  double angle = 0;              ///< Of its mover [rad].
  std::vector<Vec2d> turned{};   ///< Its vertices, if there is an angle.

  [[nodiscard]] bool is_one_way() const { return one_way_axis != not_one_way; }
};

/// The obstacles near a character, or near several of one shape. An obstacle is made when its piece comes near for the
/// first time, and kept: what it is depends on the scenery around it alone. Not thread-safe: each thread has its own.
///
/// A step names a piece by its index among the obstacles.
class ConfigurationSpace {
 public:
  static constexpr std::size_t max_axes = 64;           ///< Of one piece: shared ones, and those of at most 32 edges.
  static constexpr std::size_t no_axis = max_axes - 1;  ///< No piece has so many.

  /// @param solids must outlive it.
  ConfigurationSpace(const CharacterShape& shape, const PieceFinder& solids);

  /// Makes the obstacles of pieces, and writes their indices in the places of the pieces.
  void prepare(std::span<PieceIndex> pieces, MoverIndex mover, double angle);
  /// Forgets the obstacles of pieces that came or went, and of those near them.
  void follow_edits();

  [[nodiscard]] const Scenery& scenery() const { return solids_.scenery(); }
  /// Hull of the character, counter-clockwise [m].
  [[nodiscard]] std::span<const Vec2d> hull() const { return axes_.hull(); }
  /// Box of the hull, around position zero.
  [[nodiscard]] const Box2& hull_box() const { return axes_.box; }

  /// What the octagon covers or touches while its reference point is in `box` [m].
  [[nodiscard]] Box2 touched_from(const Box2& box) const { return (box + axes_.box).inflated(tolerances.touch); }

  /// Shared axes per piece: 8 or 12, in groups of four.
  [[nodiscard]] std::size_t lanes() const { return axes_.lanes; }
  /// Calls `visit(0)`, `visit(1)` and, for 12 axes, `visit(2)`: most shapes have 8, and a loop took a fifth more
  /// instructions.
  template <class Visit>
  PAPERPROOF_INLINE void for_each_group(const Visit& visit) const {
    visit(0);
    visit(1);
    if (axes_.lanes == SharedAxes::most) [[unlikely]]
      visit(2);
  }
  /// The components of four normals.
  [[nodiscard]] auto shared_x(std::size_t group) const { return Four::Map(axes_.x.data() + 4 * group); }
  [[nodiscard]] auto shared_y(std::size_t group) const { return Four::Map(axes_.y.data() + 4 * group); }

  [[nodiscard]] const Obstacle& info(PieceIndex piece) const { return obstacles_[piece]; }
  /// Offsets along four shared axes. The first group are the box directions: the offsets of the piece's box.
  [[nodiscard]] auto offsets(PieceIndex piece, std::size_t group) const {
    return obstacles_[piece].offsets.group(group);
  }
  [[nodiscard]] std::span<const OwnAxis> own_axes(PieceIndex piece) const { return info(piece).own; }
  /// A circle has an axis of its own, a tangent like any other: where a piece has none, nothing more is asked.
  [[nodiscard]] bool is_circle(PieceIndex piece) const { return info(piece).source.is_circle(); }
  [[nodiscard]] Circle circle(PieceIndex piece) const { return circle(info(piece)); }
  [[nodiscard]] PieceVertices vertices_of(PieceIndex piece) const { return vertices_of(info(piece)); }
  /// Where the character at p is nearest to a circle.
  [[nodiscard]] geometry::NearCircle near_circle(PieceIndex piece, const Vec2& p) const {
    return geometry::near_circle(hull(), p, circle(piece));
  }
  [[nodiscard]] std::size_t axis_count(PieceIndex piece) const { return axes_.lanes + info(piece).own.size(); }
  [[nodiscard]] PAPERPROOF_INLINE Vec2 normal(PieceIndex piece, std::size_t axis) const {
    if (axis < axes_.lanes) return {axes_.x[axis], axes_.y[axis]};
    if (is_direction(axis)) [[unlikely]]
      return normal_along(axis);
    return own_axes(piece)[axis - axes_.lanes].normal;
  }
  [[nodiscard]] Real offset(PieceIndex piece, std::size_t axis) const {
    if (axis < axes_.lanes) return info(piece).offsets[axis];
    return is_direction(axis) ? offset_along(piece, axis) : own_axes(piece)[axis - axes_.lanes].offset;
  }
  /// @param axis no direction.
  [[nodiscard]] const OctagonFace& octagon_face(PieceIndex piece, std::size_t axis) const {
    return axis < axes_.lanes ? axes_.faces[axis] : own_axes(piece)[axis - axes_.lanes].face;
  }
  [[nodiscard]] OctagonFace face_along(const Vec2& normal) const { return axes_.face_along(normal); }
  [[nodiscard]] bool covered(PieceIndex piece, std::size_t axis) const {
    return !is_direction(axis) && (info(piece).covered >> axis & 1U) != 0;
  }
  [[nodiscard]] bool hidden(PieceIndex piece, std::size_t axis) const {
    return !is_direction(axis) && (info(piece).hidden >> axis & 1U) != 0;
  }
  /// Separation along one axis at p [m].
  [[nodiscard]] PAPERPROOF_INLINE Real separation(PieceIndex piece, std::size_t axis, const Vec2& p) const {
    const Vec2 n = normal(piece, axis);
    return n.x() * p.x() + n.y() * p.y() - offset(piece, axis);
  }

 private:
  /// A facet of a piece's obstacle.
  struct Facet {
    std::size_t axis;
    Vec2d from;  ///< Its end points [m].
    Vec2d to;
    double length;  ///< [m]
    double noise;   ///< Of rounding, in what is compared with it [m].
  };

  [[nodiscard]] PAPERPROOF_COLD static Vec2 normal_along(std::size_t direction) {
    return direction_of(direction).cast<Real>();
  }
  [[nodiscard]] PAPERPROOF_COLD Real offset_along(PieceIndex piece, std::size_t direction) const {
    return support_offset(info(piece), direction_of(direction));
  }
  [[nodiscard]] Circle circle(const Obstacle& of) const {
    const Circle circle = scenery().circle(of.piece);
    return of.angle == 0 ? circle : Circle{of.turned[0], circle.radius};
  }
  [[nodiscard]] PieceVertices vertices_of(const Obstacle& of) const {
    if (of.angle != 0) [[unlikely]]
      return std::span<const Vec2d>(of.turned);
    return scenery().vertices_of(of.piece);
  }
  [[nodiscard]] Real support_offset(const Obstacle& of, const Vec2d& normal) const;

  /// A lane that no axis has.
  [[nodiscard]] bool is_unused(std::size_t axis) const { return axis >= axes_.count && axis < axes_.lanes; }
  [[nodiscard]] Vec2d reach() const { return axes_.box.size(); }
  [[nodiscard]] const OneWaySurfaces& surfaces_of(MoverIndex mover, double angle);
  [[nodiscard]] PieceIndex make(PieceIndex source, double angle);
  void fill(Obstacle& obstacle, PieceIndex source, double angle);
  void drop(PieceIndex source);
  void drop_all();
  void find_axes(Obstacle& obstacle);
  void find_seams(PieceIndex piece);
  [[nodiscard]] double open_part(const Facet& facet);
  [[nodiscard]] Interval inside(const Facet& facet, PieceIndex other) const;
  [[nodiscard]] Facet facet(PieceIndex piece, std::size_t axis, double noise) const;
  [[nodiscard]] bool may_cover(PieceIndex covering, PieceIndex piece, double noise) const;
  [[nodiscard]] bool is_covered_corner(PieceIndex piece, const Facet& corner) const;

  const PieceFinder& solids_;
  CharacterShape shape_;
  OneWaySurfaces surfaces_;
  /// Of movers that have an angle.
  struct TurnedSurfaces {
    double angle;
    OneWaySurfaces surfaces;
  };
  std::map<MoverIndex, TurnedSurfaces> turned_surfaces_;
  SharedAxes axes_;
  std::vector<Obstacle> obstacles_;
  std::vector<PieceIndex> free_obstacles_;
  std::uint64_t edit_ = 0;            ///< See `EditLog::count`.
  std::vector<PieceIndex> index_of_;  ///< Among the obstacles, of each solid piece: one more, or zero for none.
  // While an obstacle is made.
  std::vector<PieceIndex> neighbours_;  ///< What may cover its facets.
  std::vector<Interval> inside_;        ///< Parts of the present facet that are in another obstacle.
};

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
