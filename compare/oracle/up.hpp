/// Vectors: their cross product, and as a character sees them whose up is not that of the world.
#pragma once

#include <paperproof/types.hpp>

namespace paperproof::compare {

/// Twice the area between them; positive where `b` is to the left of `a`.
[[nodiscard]] inline double cross_of(const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); }
/// Across up, to the right. @param up unit vector.
[[nodiscard]] inline Vec2d right_of(const Vec2d& up) { return {up.y(), -up.x()}; }
/// Components across up, to the right, and along it. @param up unit vector.
[[nodiscard]] inline Vec2d seen(const Vec2d& v, const Vec2d& up) { return {cross_of(v, up), v.dot(up)}; }
/// The inverse.
[[nodiscard]] inline Vec2d in_world(const Vec2d& v, const Vec2d& up) {
  return {v.x() * up.y() + v.y() * up.x(), v.y() * up.y() - v.x() * up.x()};
}

}  // namespace paperproof::compare
