/// The motion nearest to a wanted one that several contacts allow.
#pragma once

#include "step/real.hpp"

#include <paperproof/types.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The motions w with n·w >= least: those that a touched surface with unit normal n allows, as the character sees it: x
/// is across it, and y is up.
struct HalfPlane {
  Vec2 normal;
  Real least = 0;
  bool walkable = false;
  Vec2 rest{Vec2::Zero()};  ///< The motion of who rests at the surface.

  /// How far `w` is on the allowed side.
  [[nodiscard]] Real margin(const Vec2& w) const { return normal.x() * w.x() + normal.y() * w.y() - least; }
  /// Up to the rounding of the margin: a motion along the surface is allowed.
  [[nodiscard]] bool allows(const Vec2& w) const {
    constexpr Real noise = std::numeric_limits<Real>::epsilon() * 16;
    return margin(w) >= -noise * (std::abs(w.x()) + std::abs(w.y()) + std::abs(least));
  }
  /// The motion along the border that goes so far across. Only of ground. Adding zero turns a negative zero into a
  /// positive one: rest has one pattern of bits.
  [[nodiscard]] Vec2 along(Real across) const { return {across, (least - normal.x() * across) / normal.y() + Real(0)}; }
};

/// Of surfaces with one normal only the one that leaves least counts: a handful are left, however many are touched.
inline void add_plane(const HalfPlane& plane, std::vector<HalfPlane>& planes) {
  for (HalfPlane& known : planes) {
    if (known.normal != plane.normal) continue;
    if (known.least < plane.least) known = plane;
    return;
  }
  planes.push_back(plane);
}

/// Where the borders of two cross. Borders that are one line, or parallel, but for rounding would cross anywhere: they
/// cross at NaN.
[[nodiscard]] inline Vec2 crossing(const HalfPlane& a, const HalfPlane& b) {
  constexpr Real parallel = std::numeric_limits<Real>::epsilon() * 64;
  Real determinant = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
  if (std::abs(determinant) < parallel) determinant = std::numeric_limits<Real>::quiet_NaN();
  return {(a.least * b.normal.y() - b.least * a.normal.y()) / determinant + Real(0),
          (b.least * a.normal.x() - a.least * b.normal.x()) / determinant + Real(0)};
}

/// The point of the intersection of half planes that is nearest to `wanted`; nothing where they have none in common.
/// In the plane it is `wanted` itself, its foot on one border, or a crossing of two borders. O(n³) for a handful.
[[nodiscard]] inline std::optional<Vec2> nearest_allowed(const Vec2& wanted, std::span<const HalfPlane> planes) {
  const auto allowed = [&](const Vec2& w, const HalfPlane* on, const HalfPlane* also_on) {
    for (const HalfPlane& plane : planes)
      if (&plane != on && &plane != also_on && !plane.allows(w)) return false;
    return std::isfinite(w.x()) && std::isfinite(w.y());
  };
  if (allowed(wanted, nullptr, nullptr)) return wanted;

  std::optional<Vec2> nearest;
  Real least_squared = std::numeric_limits<Real>::infinity();
  const auto consider = [&](const Vec2& w, const HalfPlane* on, const HalfPlane* also_on) {
    const Vec2 off = w - wanted;
    const Real squared = off.x() * off.x() + off.y() * off.y();
    if (!(squared < least_squared) || !allowed(w, on, also_on)) return;
    nearest = w;
    least_squared = squared;
  };
  for (const HalfPlane& plane : planes)
    if (plane.margin(wanted) < 0) consider(wanted - plane.normal * plane.margin(wanted), &plane, nullptr);
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) consider(crossing(planes[i], planes[j]), &planes[i], &planes[j]);
  return nearest;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
