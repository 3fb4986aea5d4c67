/// What becomes of a motion that met a surface.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>

namespace paperproof::octagon_sweep {

/// The part of `wanted` that remains at a surface with unit normal `n`, where `wanted` points into it.
///
/// - Walkable ground: the horizontal part is kept by following the surface; falling ends.
/// - Steep ground and walls: a fall goes on along the surface and never turns into a climb; a rise goes on, and what is
///   horizontal shrinks to what follows the surface.
/// - Ceilings: a fall goes on (what is horizontal shrinks); a rise loses the part into the normal.
///
/// Homogeneous of degree one, so velocity and displacement can be treated alike. A falling motion never comes to rise
/// on anything but walkable ground and its horizontal part never grows there: a step cannot go round in circles.
template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Vec2<Scalar> respond(const Vec2<Scalar>& wanted, const Vec2<Scalar>& n,
                                                              Scalar walkable_cosine) noexcept {
  const Scalar into = wanted.x() * n.x() + wanted.y() * n.y();
  if (into >= 0) return wanted;
  // Adding zero turns a negative zero into a positive one: rest has one pattern of bits.
  if (n.y() >= walkable_cosine) return {wanted.x(), -wanted.x() * n.x() / n.y() + Scalar(0)};
  const bool ceiling = n.y() < 0;
  if (ceiling && wanted.y() > 0) return {wanted.x() - into * n.x(), wanted.y() - into * n.y()};
  Scalar y = wanted.y();
  if (!ceiling && y <= 0) y = std::min(Scalar(0), y - into * n.y());
  return {-y * n.y() / n.x() + Scalar(0), y + Scalar(0)};
}

}  // namespace paperproof::octagon_sweep
