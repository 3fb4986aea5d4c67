/// Cuts polygons into convex parts, for depths only: every yes or no is decided on the uncut boundary.
#pragma once

#include <paperproof/scenery.hpp>

#include <vector>

namespace paperproof::compare::detail {

/// Counter-clockwise vertices, or the two ends of a segment.
struct ConvexPart {
  std::vector<Vec2d> points;
  Box2<double> box;
};

/// The parts of one collider: a convex polygon is its own only part; a chain has its segments, and a one-way polygon
/// those of its lines; a concave polygon is cut
/// into triangles by clipping ears (G. Meisters 1975; holes are first joined to the outer ring), which are then merged
/// greedily while they stay convex (S. Hertel, K. Mehlhorn 1983). Only the collider's own vertices are used, and every
/// turn is decided exactly.
/// @throws std::logic_error for a polygon that touches itself.
[[nodiscard]] std::vector<ConvexPart> convex_parts(const ColliderDef& def);

}  // namespace paperproof::compare::detail
