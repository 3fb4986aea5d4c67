/// One-way chains as surfaces: is a character above one? The lines of a one-way polygon are such chains.
///
/// Chains with equal `one_way` and filter and the same mover (or none) are joined where exactly one chain ends in the
/// vertex in which exactly one other chain begins. (A segment runs so that its blocking normal is on its left.) Chains
/// are cut where they turn back across `one_way` or run along it. Each part is a surface: its two end segments are
/// extended straight to infinity. The octagon is above a surface when its open interior is wholly on the `one_way` side
/// of this line. Every real segment of the surface blocks a character that begins its move above the surface; no
/// segment blocks any other character.
#pragma once

#include "geometry/exact.hpp"
#include "inlining.hpp"

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace paperproof {

/// Immutable after construction; may be shared between threads; a query never allocates.
class OneWaySurfaces {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Those at angle zero.
  OneWaySurfaces(const Scenery& scenery, const CharacterShape& shape);
  /// Those of one mover, at an angle. Their `one_way` turns with them.
  OneWaySurfaces(const Scenery& scenery, const CharacterShape& shape, MoverIndex mover, double angle);

  /// The surface that a piece is part of; `none` for a piece that blocks from both sides.
  [[nodiscard]] Index of(PieceIndex piece) const {
    const auto known = of_piece_.find(piece);
    return known == of_piece_.end() ? none : known->second;
  }
  /// A surface that is one straight line.
  [[nodiscard]] bool is_straight(Index surface) const { return surfaces_[surface].edge_count == 1; }

  /// Whether the octagon at `position` (relative to the offset of the surface's mover) is above the surface; exact for
  /// position + rest. A binary search finds the edges that the octagon covers across `one_way`; only these are tested.
  /// @param rest the rounding error of the subtraction of the mover's offset: see `lost_by`.
  [[nodiscard]] PAPERPROOF_NOT_INLINE bool is_above(Index surface, const Vec2d& position,
                                                    const Vec2d& rest = Vec2d::Zero()) const;
  /// The same for a position that may be wrong by `slack` [m]: true wherever it could be above.
  [[nodiscard]] bool may_be_above(Index surface, const Vec2d& position, double slack) const;

 private:
  /// A direction in which the octagon can be separated from an edge, above or beside it.
  struct Axis {
    Vec2d normal;  ///< Unit, towards the octagon.
    double low;    ///< Least of normal · o over the octagon [m].
  };
  /// Data that depends on `one_way` and the octagon alone. The octagon and the open region above it are bounded by the
  /// octagon's edges that face down and by two sides along `one_way`.
  struct Frame {
    Vec2d one_way;
    Vec2d across;  ///< Unit: a coordinate across `one_way`, in which every segment ascends.
    FixedVector<Axis, CharacterShape::max_points + 2> axes;
    FixedVector<std::uint8_t, CharacterShape::max_points> lower;  ///< Edges k -> k + 1 of the hull that face down.
    double first;                                                 ///< The octagon covers, across `one_way` [m],
    double last;                                                  ///< from `first` to `last`.
  };
  struct Surface {
    std::uint32_t frame = 0;
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;
  };
  /// Edge i of a surface goes from the vertex of edge i to that of edge i + 1: after the last edge of each surface
  /// stands one more entry, for its last vertex.
  struct Edge {
    Vec2d from;
    double begins;  ///< Across `one_way` [m].
    Vec2d normal;   ///< Unit, to the left.
    double offset;  ///< Of `normal · position` where the octagon touches the line of the edge [m].
  };

  [[nodiscard]] std::span<const Vec2d> hull() const { return shape_.hull(); }
  void build(const Scenery& scenery, std::span<const PieceIndex> pieces, double angle);
  [[nodiscard]] std::uint32_t find_frame(const Vec2d& one_way);
  void add_surface(std::span<const Vec2d> line, const Vec2d& one_way);
  template <class Visit>
  [[nodiscard]] bool all_edges_below(const Surface& surface, const Vec2d& position, const Visit& is_below) const;
  [[nodiscard]] double separation(const Surface& surface, std::uint32_t edge, const Vec2d& position) const;
  [[nodiscard]] bool is_below_exactly(const Surface& surface, std::uint32_t edge, const Vec2d& position,
                                      const Vec2d& rest) const;

  CharacterShape shape_;
  std::vector<Frame> frames_;
  std::vector<Surface> surfaces_;
  std::vector<Edge> edges_;
  std::unordered_map<PieceIndex, Index> of_piece_;
};

/// The rounding error of `position - offset`: the rounded difference plus this error is the exact difference. Without
/// the error, a character that touches a mover to the last bit would be above it in one step and not in the next.
[[nodiscard]] inline Vec2d lost_by(const Vec2d& position, const Vec2d& offset) {
  const auto lost = [](double a, double b) { return geometry::two_sum(a, -b).low; };
  return {lost(position.x(), offset.x()), lost(position.y(), offset.y())};
}

}  // namespace paperproof
