/// Cuts a polygon into convex pieces.
#pragma once

#include "geometry/rings.hpp"

namespace paperproof::geometry {

/// Convex polygons one after another.
struct ConvexPieces {
  std::vector<Vec2d> vertices;
  std::vector<std::uint32_t> sizes;  ///< Vertices of each piece, at least 3.
};

/// Checks a polygon and cuts it into strictly convex pieces, counter-clockwise, that tile it exactly and use only its
/// own vertices.
///
/// Triangles are merged across every diagonal that leaves both ends convex (S. Hertel and K. Mehlhorn, 1983): at most
/// four times as many pieces as possible. A convex outline without holes is one piece, found in linear time.
/// @param outer, holes either winding; vertices on a straight side are allowed. Coordinates as exact.hpp demands.
/// @throws std::invalid_argument as `check_ring` and `check_rings`.
[[nodiscard]] ConvexPieces cut_into_convex_pieces(Ring outer, std::span<const std::vector<Vec2d>> holes);

}  // namespace paperproof::geometry
