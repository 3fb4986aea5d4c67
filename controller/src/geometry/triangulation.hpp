/// Cuts a polygon into triangles that use only its own vertices.
#pragma once

#include "geometry/rings.hpp"

namespace paperproof::geometry {

/// Indices of three vertices, counter-clockwise, not on one line.
using Triangle = std::array<std::uint32_t, 3>;

/// A polygon's rings one after another: the outer one counter-clockwise, then the holes clockwise, so that the inside
/// is on the left of every side.
struct DirectedRings {
  std::vector<Vec2d> vertices;
  std::vector<std::uint32_t> first_vertex;  ///< Of each ring.

  [[nodiscard]] std::uint32_t size_of(std::size_t ring) const {
    const std::size_t end = ring + 1 < first_vertex.size() ? first_vertex[ring + 1] : vertices.size();
    return static_cast<std::uint32_t>(end) - first_vertex[ring];
  }
};

/// Triangles that tile the polygon exactly: no gap, no overlap, and no vertex of one on the side of another. Their
/// number is vertices - 2 + 2 * holes.
///
/// Each hole is joined to the outline on its left by a bridge (a diagonal that is walked both ways), then ears are
/// clipped: G. H. Meisters, "Polygons have ears", 1975; M. Held, "FIST: fast industrial-strength triangulation of
/// polygons", 2001. Every decision is exact. Time is vertices * (reflex vertices + holes).
/// @param rings passed `check_rings`.
[[nodiscard]] std::vector<Triangle> triangulate(const DirectedRings& rings);

}  // namespace paperproof::geometry
