/// Checks of the closed outlines of a polygon.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof::geometry {

/// The vertices of a closed outline, in order; the first is not repeated at the end.
using Ring = std::span<const Vec2d>;

/// Order of sweeps: by x, and by y where x is the same. This order works as if the plane were turned by a very small
/// angle, so that no side is vertical.
[[nodiscard]] inline bool left_of(const Vec2d& a, const Vec2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

/// Whether the ring is the outline of a convex polygon with an area. Vertices on a straight side are allowed. A convex
/// ring needs no other check. Exact; linear in the number of vertices.
[[nodiscard]] bool is_convex(Ring ring);

/// Which of some points is the first in the order of sweeps.
[[nodiscard]] std::size_t leftmost(Ring ring);

/// +1: counter-clockwise, -1: clockwise. Exact. `ring` must not touch itself and must have an area.
[[nodiscard]] int winding(Ring ring);

/// @param is_closed the first point follows the last.
/// @throws std::invalid_argument on a point that repeats the one before it.
void check_neighbours(std::span<const Vec2d> points, bool is_closed, const std::string& name);

/// Checks that a ring alone could bound something.
/// @param name the ring's name in a message: "the outline".
/// @throws std::invalid_argument on fewer than 3 vertices, a vertex that repeats its neighbour, no area, a side that
///   folds back onto the side before it. A level designer understands its words.
void check_ring(Ring ring, const std::string& name);

/// Checks that the rings bound one polygon: none touches or crosses itself or another, and every hole is inside the
/// outer ring and outside the other holes. Exact.
/// Sweeps over the sides by x: fast while few sides lie above one another, quadratic (with a small factor) at worst.
/// @param rings each passed `check_ring`; the first is the outer one, the others are holes.
/// @throws std::invalid_argument in such words.
void check_rings(std::span<const Ring> rings);

}  // namespace paperproof::geometry
