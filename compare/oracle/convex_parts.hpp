/// Cuts polygons into convex parts, for depths only: every yes or no is decided on the uncut boundary.
#pragma once

#include <paperproof/scenery.hpp>

#include <vector>

namespace paperproof::compare::detail {

/// Counter-clockwise vertices, or the two ends of a segment, or the centre of a disc.
struct ConvexPart {
  std::vector<Vec2d> points;
  Box2 box;
  double radius = 0;  ///< Of a disc, and of nothing else [m].
};

/// The parts of one collider: a circle, or a convex polygon, is its own only part; a chain has its segments, and a
/// one-way polygon those of its lines; a concave polygon is cut into triangles by clipping ears (G. Meisters 1975;
/// holes are first joined to the outer ring), which are then merged greedily while they stay convex (S. Hertel, K.
/// Mehlhorn 1983). Only the collider's own vertices are used, and every turn is decided exactly.
/// @throws std::logic_error for a polygon that touches itself.
[[nodiscard]] std::vector<ConvexPart> convex_parts(const ColliderDef& def);

/// A polygon that encloses a disc, and reaches beyond it by 0.12 % of its radius. Others are what they are.
[[nodiscard]] ConvexPart with_corners(ConvexPart part);

/// Encloses a disc, rounding included.
[[nodiscard]] Box2 box_of_disc(const Vec2d& centre, double radius);

}  // namespace paperproof::compare::detail
