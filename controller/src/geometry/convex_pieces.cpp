#include "geometry/convex_pieces.hpp"

#include <string>
#include <utility>

#include "geometry/exact.hpp"
#include "geometry/triangulation.hpp"

namespace paperproof::geometry {
namespace {

/// A convex piece does not need its vertices on a straight side; pieces beside it that need them keep them.
void append_piece(const std::vector<Vec2d>& outline, ConvexPieces& pieces) {
  const std::size_t before = pieces.vertices.size();
  const std::size_t size = outline.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (orientation_sign(outline[(i + size - 1) % size], outline[i], outline[(i + 1) % size]) != 0) {
      pieces.vertices.push_back(outline[i]);
    }
  }
  pieces.sizes.push_back(static_cast<std::uint32_t>(pieces.vertices.size() - before));
}

void append_ring(Ring ring, int wanted_winding, DirectedRings& rings) {
  rings.first_vertex.push_back(static_cast<std::uint32_t>(rings.vertices.size()));
  rings.vertices.insert(rings.vertices.end(), ring.begin(), ring.end());
  if (winding(ring) != wanted_winding) std::reverse(rings.vertices.end() - std::ssize(ring), rings.vertices.end());
}

/// The sides of a tiling, each directed with its piece on the left. Sides 3k, 3k + 1, 3k + 2 begin as triangle k.
class Tiling {
 public:
  Tiling(const std::vector<Vec2d>& vertices, const std::vector<Triangle>& triangles) : vertices_(vertices) {
    for (const Triangle& triangle : triangles) {
      const auto first = static_cast<SideIndex>(sides_.size());
      for (SideIndex i = 0; i < 3; ++i)
        sides_.push_back({triangle[i], first + (i + 2) % 3, first + (i + 1) % 3, false});
    }
  }

  /// Removes every diagonal that neither of its ends needs.
  void merge() {
    for (const auto& [side, twin] : diagonals()) {
      if (!stays_convex(side, twin) || !stays_convex(twin, side)) continue;
      link(sides_[side].previous, sides_[twin].next);
      link(sides_[twin].previous, sides_[side].next);
      sides_[side].used = sides_[twin].used = true;
    }
  }

  [[nodiscard]] ConvexPieces pieces() {
    ConvexPieces pieces;
    std::vector<Vec2d> outline;
    for (Side& start : sides_) {
      outline.clear();
      for (Side* side = &start; !side->used; side = &sides_[side->next]) {
        outline.push_back(vertices_[side->vertex]);
        side->used = true;
      }
      if (!outline.empty()) append_piece(outline, pieces);
    }
    return pieces;
  }

 private:
  using SideIndex = std::uint32_t;

  struct Side {
    std::uint32_t vertex;  ///< Where it begins.
    SideIndex previous;
    SideIndex next;
    bool used;  ///< Removed, or already part of a finished piece.
  };

  /// Pairs each side that is walked both ways with its opposite.
  [[nodiscard]] std::vector<std::pair<SideIndex, SideIndex>> diagonals() const {
    std::vector<std::array<std::uint32_t, 3>> named;  // both ends, the lower index first, and the side
    for (SideIndex i = 0; i < sides_.size(); ++i) {
      const auto [low, high] = std::minmax(sides_[i].vertex, sides_[sides_[i].next].vertex);
      named.push_back({low, high, i});
    }
    std::ranges::sort(named);
    std::vector<std::pair<SideIndex, SideIndex>> pairs;
    for (std::size_t i = 1; i < named.size(); ++i)
      if (named[i - 1][0] == named[i][0] && named[i - 1][1] == named[i][1])
        pairs.emplace_back(named[i - 1][2], named[i][2]);
    return pairs;
  }

  /// Without `side`, is the corner that it begins at still convex? It cannot become a full turn: the polygon's outline
  /// passes through every vertex.
  [[nodiscard]] bool stays_convex(SideIndex side, SideIndex twin) const {
    const Side& before = sides_[sides_[side].previous];
    const Side& after = sides_[sides_[twin].next];
    return orientation_sign(vertices_[before.vertex], vertices_[sides_[side].vertex],
                            vertices_[sides_[after.next].vertex]) >= 0;
  }

  void link(SideIndex before, SideIndex after) {
    sides_[before].next = after;
    sides_[after].previous = before;
  }

  const std::vector<Vec2d>& vertices_;
  std::vector<Side> sides_;
};

}  // namespace

ConvexPieces cut_into_convex_pieces(Ring outer, std::span<const std::vector<Vec2d>> holes) {
  if (holes.empty() && is_convex(outer)) {
    std::vector<Vec2d> outline(outer.begin(), outer.end());
    if (winding(outer) < 0) std::reverse(outline.begin(), outline.end());
    ConvexPieces pieces;
    append_piece(outline, pieces);
    return pieces;
  }
  std::vector<Ring> rings{outer};
  check_ring(outer, "the outline");
  for (std::size_t i = 0; i < holes.size(); ++i) {
    check_ring(holes[i], "hole " + std::to_string(i));
    rings.emplace_back(holes[i]);
  }
  check_rings(rings);

  DirectedRings directed;
  for (std::size_t i = 0; i < rings.size(); ++i) append_ring(rings[i], i == 0 ? 1 : -1, directed);
  Tiling tiling(directed.vertices, triangulate(directed));
  tiling.merge();
  return tiling.pieces();
}

}  // namespace paperproof::geometry
