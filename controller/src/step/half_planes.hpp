/// The motion nearest to a wanted one that several contacts allow.
#pragma once

#include "step/real.hpp"

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The motions w with n·w >= least: those that a surface with unit normal n allows.
struct HalfPlane {
  Vec2 normal;
  Real least = 0;

  /// How far `w` is on the allowed side.
  [[nodiscard]] Real margin(const Vec2& w) const { return normal.x() * w.x() + normal.y() * w.y() - least; }
  /// Up to the rounding of the margin: a motion along the surface is allowed.
  [[nodiscard]] bool allows(const Vec2& w) const {
    constexpr Real noise = std::numeric_limits<Real>::epsilon() * 16;
    return margin(w) >= -noise * (std::abs(w.x()) + std::abs(w.y()) + std::abs(least));
  }
};

/// Of surfaces with one normal only the one that leaves least counts: a handful are left, however many are touched.
inline void add_plane(const HalfPlane& plane, std::vector<HalfPlane>& planes) {
  for (HalfPlane& known : planes) {
    if (known.normal != plane.normal) continue;
    known.least = std::max(known.least, plane.least);
    return;
  }
  planes.push_back(plane);
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
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2& a = planes[i].normal;
      const Vec2& b = planes[j].normal;
      const Real determinant = a.x() * b.y() - a.y() * b.x();
      // Borders that are one line but for rounding cross anywhere: they give no point of their own.
      constexpr Real one_line = std::numeric_limits<Real>::epsilon() * 64;
      if (std::abs(determinant) < one_line) continue;
      const Real p = planes[i].least;
      const Real q = planes[j].least;
      consider({(p * b.y() - q * a.y()) / determinant, (q * a.x() - p * b.x()) / determinant}, &planes[i], &planes[j]);
    }
  }
  return nearest;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
