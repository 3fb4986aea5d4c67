#include "oracle/met_surface.hpp"

#include "contains.hpp"

#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace paperproof::compare::surfaces {

std::optional<Vec2d> held_by(const MetSurface& a, const MetSurface& b) {
  const double determinant = cross_of(a.normal, b.normal);
  if (std::abs(determinant) < one_direction) return std::nullopt;
  const double of_a = a.velocity.dot(a.normal);
  const double of_b = b.velocity.dot(b.normal);
  return Vec2d((of_a * b.normal.y() - of_b * a.normal.y()) / determinant,
               (of_b * a.normal.x() - of_a * b.normal.x()) / determinant);
}

std::optional<Vec2d> nearest_allowed(const Vec2d& wanted, std::span<const MetSurface> surfaces) {
  std::optional<Vec2d> best;
  const auto consider = [&](const Vec2d& v, std::initializer_list<std::size_t> along) {
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      if (!contains(along, i) && enters(v, surfaces[i])) return;
    if (!best || (v - wanted).squaredNorm() < (*best - wanted).squaredNorm()) best = v;
  };
  consider(wanted, {});
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    consider(slid(wanted, surfaces[i]), {i});
    for (std::size_t k = 0; k < i; ++k)
      if (const std::optional<Vec2d> held = held_by(surfaces[i], surfaces[k])) consider(*held, {i, k});
  }
  return best;
}

}  // namespace paperproof::compare::surfaces
