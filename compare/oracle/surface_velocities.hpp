/// How a velocity stands to surfaces: what the laws of response ask of each.
#pragma once

#include "oracle/met_surface.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace paperproof::compare::surfaces {

/// A velocity that enters or leaves a surface by no more than this share of its length runs along it.
inline constexpr double grazing = 1e-9;
/// Normals whose cross product is smaller are of one direction.
inline constexpr double one_direction = 1e-9;

[[nodiscard]] inline double entering(const Vec2d& v, const MetSurface& at) { return (v - at.velocity).dot(at.normal); }

[[nodiscard]] inline bool enters(const Vec2d& v, const MetSurface& at) {
  return entering(v, at) < -grazing * std::max(1.0, (v - at.velocity).norm());
}

[[nodiscard]] inline bool leaves(const Vec2d& v, const MetSurface& at) {
  return entering(v, at) > grazing * std::max(1.0, (v - at.velocity).norm());
}

[[nodiscard]] inline Vec2d slid(const Vec2d& v, const MetSurface& at) { return v - entering(v, at) * at.normal; }

[[nodiscard]] inline Vec2d follow(double x, const Vec2d& n) { return {x, -x * n.x() / n.y()}; }

/// The velocity that neither enters nor leaves either of two surfaces.
[[nodiscard]] std::optional<Vec2d> held_by(const MetSurface& a, const MetSurface& b);

/// The velocity nearest to `wanted` that enters none of the surfaces, if there is one. What runs along a surface does
/// not enter it, however it is rounded.
[[nodiscard]] std::optional<Vec2d> nearest_allowed(const Vec2d& wanted, std::span<const MetSurface> surfaces);

}  // namespace paperproof::compare::surfaces
