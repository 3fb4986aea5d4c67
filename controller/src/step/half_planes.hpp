/// The motion nearest to a wanted one that several contacts allow.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep {

/// The motions w with n·w >= least: those that a surface with unit normal n allows.
template <class Scalar>
struct HalfPlane {
  Vec2<Scalar> normal;
  Scalar least = 0;

  /// How far `w` is on the allowed side.
  [[nodiscard]] Scalar margin(const Vec2<Scalar>& w) const noexcept {
    return normal.x() * w.x() + normal.y() * w.y() - least;
  }
  /// Up to the rounding of the margin: a motion along the surface is allowed.
  [[nodiscard]] bool allows(const Vec2<Scalar>& w) const noexcept {
    constexpr Scalar noise = std::numeric_limits<Scalar>::epsilon() * 16;
    return margin(w) >= -noise * (std::abs(w.x()) + std::abs(w.y()) + std::abs(least));
  }
};

/// Of surfaces with one normal only the one that leaves least counts: a handful are left, however many are touched.
template <class Scalar>
void add_plane(const HalfPlane<Scalar>& plane, std::vector<HalfPlane<Scalar>>& planes) noexcept {
  for (HalfPlane<Scalar>& known : planes) {
    if (known.normal != plane.normal) continue;
    known.least = std::max(known.least, plane.least);
    return;
  }
  planes.push_back(plane);
}

/// The point of the intersection of half planes that is nearest to `wanted`; nothing where they have none in common.
/// In the plane it is `wanted` itself, its foot on one border, or a crossing of two borders. O(n³) for a handful.
template <class Scalar>
[[nodiscard]] std::optional<Vec2<Scalar>> nearest_allowed(const Vec2<Scalar>& wanted,
                                                          std::span<const HalfPlane<Scalar>> planes) noexcept {
  const auto allowed = [&](const Vec2<Scalar>& w, const HalfPlane<Scalar>* on, const HalfPlane<Scalar>* also_on) {
    for (const HalfPlane<Scalar>& plane : planes)
      if (&plane != on && &plane != also_on && !plane.allows(w)) return false;
    return std::isfinite(w.x()) && std::isfinite(w.y());
  };
  if (allowed(wanted, nullptr, nullptr)) return wanted;

  std::optional<Vec2<Scalar>> nearest;
  Scalar least_squared = std::numeric_limits<Scalar>::infinity();
  const auto consider = [&](const Vec2<Scalar>& w, const HalfPlane<Scalar>* on, const HalfPlane<Scalar>* also_on) {
    const Vec2<Scalar> off = w - wanted;
    const Scalar squared = off.x() * off.x() + off.y() * off.y();
    if (!(squared < least_squared) || !allowed(w, on, also_on)) return;
    nearest = w;
    least_squared = squared;
  };
  for (const HalfPlane<Scalar>& plane : planes)
    if (plane.margin(wanted) < 0) consider(wanted - plane.normal * plane.margin(wanted), &plane, nullptr);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2<Scalar>& a = planes[i].normal;
      const Vec2<Scalar>& b = planes[j].normal;
      const Scalar determinant = a.x() * b.y() - a.y() * b.x();
      // Borders that are one line but for rounding cross anywhere: they give no point of their own.
      constexpr Scalar one_line = std::numeric_limits<Scalar>::epsilon() * 64;
      if (std::abs(determinant) < one_line) continue;
      const Scalar p = planes[i].least;
      const Scalar q = planes[j].least;
      consider({(p * b.y() - q * a.y()) / determinant, (q * a.x() - p * b.x()) / determinant}, &planes[i], &planes[j]);
    }
  }
  return nearest;
}

}  // namespace paperproof::octagon_sweep
