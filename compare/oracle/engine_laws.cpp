#include "oracle/engine_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace paperproof::compare {
namespace {

using namespace surfaces;

/// Share of a velocity that is rounding in Box2D.
constexpr double in_float = 1e-5;

/// The impulses along both normals that make the change, per mass; none where the normals are of one direction.
std::optional<Vec2d> impulses_of(const Vec2d& change, const MetSurface& a, const MetSurface& b) {
  const double determinant = cross_of(a.normal, b.normal);
  if (std::abs(determinant) < one_direction) return std::nullopt;
  return Vec2d(cross_of(change, b.normal) / determinant, cross_of(a.normal, change) / determinant);
}

}  // namespace

std::vector<Vec2d> frictionless_outcomes(const Vec2d& wanted, std::span<const MetSurface> surfaces) {
  std::vector<Vec2d> outcomes{wanted};
  const auto meet = [&](const Vec2d& v) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (enters(v, surfaces[i])) outcomes.push_back(slid(v, surfaces[i]));
      for (std::size_t k = 0; k < i; ++k)
        if (const auto both = nearest_allowed(v, std::array{surfaces[i], surfaces[k]})) outcomes.push_back(*both);
    }
  };
  meet(wanted);
  const std::size_t once = outcomes.size();
  for (std::size_t k = 1; k < once; ++k) meet(Vec2d(outcomes[k]));
  return outcomes;
}

bool is_short_of_limit(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces,
                       const Vec2d& kept, int rounds) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const std::array both{surfaces[i], surfaces[k]};
      const std::optional<Vec2d> limit = nearest_allowed(wanted, both);
      const std::optional<Vec2d> pushes = impulses_of(velocity - wanted, both[0], both[1]);
      if (!limit || !pushes || pushes->minCoeff() < -in_float * std::max(1.0, pushes->norm())) continue;
      const double speed = wanted.norm() + impulses_of(kept, both[0], both[1])->lpNorm<1>();
      const double left = std::pow(std::abs(both[0].normal.dot(both[1].normal)), 2 * rounds - 1);
      if ((velocity - *limit).norm() <= left * speed + in_float) return true;
    }
  return false;
}

bool is_turned_by_tilt(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces, double tilt) {
  const Vec2d change = velocity - wanted;
  const double slack = in_float * std::max(1.0, wanted.norm());
  if (!(change.norm() > slack)) return false;
  return std::ranges::any_of(surfaces, [&](const MetSurface& at) {
    // What is left runs along the tilted surface, or there is nothing left.
    const Vec2d along_it = velocity - at.velocity;
    const bool ends = !(along_it.norm() > slack);
    const Vec2d across = ends ? change : Vec2d(-along_it.y(), along_it.x());
    const Vec2d normal = across.normalized() * (across.dot(at.normal) < 0 ? -1 : 1);
    return std::abs(cross_of(normal, at.normal)) <= tilt && std::abs(cross_of(change, normal)) <= slack &&
           change.dot(normal) > 0;
  });
}

}  // namespace paperproof::compare
