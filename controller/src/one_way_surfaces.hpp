/// One-way chains as surfaces: is a character above one?
///
/// Chains of equal `one_way` that go along with the same mover, or stand, are joined where exactly one ends in the
/// vertex where exactly one other begins (as their segments run: the blocking normal on the left). They are cut where
/// they do not go on across `one_way`. Each part is a surface: its two end segments are thought on straight to
/// infinity. The octagon is above when its open interior is wholly on the `one_way` side of that line. Whoever is above
/// when it sets out is blocked by every real segment of the part, and by none of them otherwise.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <limits>
#include <span>
#include <vector>

namespace paperproof {

/// Immutable after construction; may be shared between threads; never allocates while it answers.
template <class Scalar>
class OneWaySurfaces {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

  OneWaySurfaces(const Scenery<Scalar>& scenery, const CharacterShape& shape);

  /// The surface that a piece is part of; none for what blocks both ways.
  [[nodiscard]] Index of(PieceIndex piece) const noexcept { return of_piece_.empty() ? none : of_piece_[piece]; }
  /// A surface that is one straight line.
  [[nodiscard]] bool is_straight(Index surface) const noexcept { return surfaces_[surface].edge_count == 1; }

  /// Whether the octagon at `position`, as the mover of the surface sees it, is above; exact for position + rest. Looks
  /// at the edges that the octagon covers across `one_way`, after a binary search.
  /// @param rest what the position lost when the mover's offset was taken from it: see `lost_by`.
  [[nodiscard, gnu::noinline]] bool is_above(Index surface, const Vec2<Scalar>& position,
                                             const Vec2<Scalar>& rest = Vec2<Scalar>::Zero()) const noexcept;
  /// The same for a position that may be wrong by `slack` [m]: true wherever it could be above.
  [[nodiscard]] bool may_be_above(Index surface, const Vec2<Scalar>& position, Scalar slack) const noexcept;

 private:
  /// A direction along which the octagon can lie clear of an edge and above or beside it.
  struct Axis {
    Vec2<Scalar> normal;  ///< Unit, towards the octagon.
    Scalar low;           ///< Least of normal · o over the octagon [m].
  };
  /// What depends on `one_way` and the octagon alone. Of the octagon and all that lies above it, open, these are the
  /// edges: the octagon's own that face down, and the two sides.
  struct Frame {
    Vec2d one_way;
    Vec2<Scalar> across;  ///< Unit: a coordinate across `one_way`, in which every segment ascends.
    FixedVector<Axis, CharacterShape::max_points + 2> axes;
    FixedVector<std::uint8_t, CharacterShape::max_points> lower;  ///< Edges k -> k + 1 of the hull that face down.
    Scalar first;                                                 ///< What the octagon covers across `one_way` [m],
    Scalar last;                                                  ///< from here to there.
  };
  struct Surface {
    std::uint32_t frame = 0;
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;
  };
  /// Edge i of a surface goes from the vertex of edge i to that of edge i + 1: after the last edge of each surface
  /// stands one more entry, for its last vertex.
  struct Edge {
    Vec2<Scalar> from;
    Scalar begins;        ///< Across `one_way` [m].
    Vec2<Scalar> normal;  ///< Unit, to the left.
    Scalar offset;        ///< Of `normal · position` where the octagon touches the line of the edge [m].
  };

  [[nodiscard]] std::uint32_t find_frame(const Vec2d& one_way);
  void add_surface(std::span<const Vec2d> line, const Vec2d& one_way);
  template <class Visit>
  [[nodiscard]] bool all_edges_below(const Surface& surface, const Vec2<Scalar>& position,
                                     const Visit& is_below) const noexcept;
  [[nodiscard]] Scalar separation(const Surface& surface, std::uint32_t edge,
                                  const Vec2<Scalar>& position) const noexcept;
  [[nodiscard]] bool is_below_exactly(const Surface& surface, std::uint32_t edge, const Vec2<Scalar>& position,
                                      const Vec2<Scalar>& rest) const noexcept;

  FixedVector<Vec2<Scalar>, CharacterShape::max_points> hull_;  ///< Counter-clockwise, rounded [m].
  std::vector<Frame> frames_;
  std::vector<Surface> surfaces_;
  std::vector<Edge> edges_;
  std::vector<Index> of_piece_;
};

/// What rounding takes from the difference `position - offset`: both together are it exactly (D. E. Knuth). Without it
/// who touches a mover to the last bit would now be above it and now not.
template <class Scalar>
[[nodiscard]] Vec2<Scalar> lost_by(const Vec2<Scalar>& position, const Vec2<Scalar>& offset) noexcept {
  const auto lost = [](Scalar a, Scalar b) {
    const Scalar difference = a - b;
    const Scalar part = difference - a;
    return (a - (difference - part)) - (b + part);
  };
  return {lost(position.x(), offset.x()), lost(position.y(), offset.y())};
}

extern template class OneWaySurfaces<float>;
extern template class OneWaySurfaces<double>;

}  // namespace paperproof
