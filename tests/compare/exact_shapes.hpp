/// Shapes, random numbers and exact points for the tests of the oracle.
#pragma once

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "oracle/exact.hpp"
#include "support/exact_points.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::test {

using Colliders = std::vector<ColliderIndex>;
using Motions = std::vector<MoverMotion>;

inline double one_ulp_up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double one_ulp_down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

using paperproof::test::Rational;
using Exact = Rational;
using paperproof::test::cross;
using paperproof::test::ExactPoint;

inline ExactPoint exact(const Vec2d& v) { return ExactPoint(v); }

/// The article's hull at 32 pixels per metre, counter-clockwise.
inline std::vector<Vec2d> octagon() {
  return {{-0.15625, -0.625}, {0.15625, -0.625}, {0.3125, -0.3125}, {0.3125, 0.3125},
          {0.15625, 0.625},   {-0.15625, 0.625}, {-0.3125, 0.3125}, {-0.3125, -0.3125}};
}

inline std::vector<Vec2d> square(double half) { return {{-half, -half}, {half, -half}, {half, half}, {-half, half}}; }
inline ColliderDef one_way(ColliderDef def, const Vec2d& normal = {0, 1}) {
  def.one_way = normal;
  return def;
}
inline ExactScenery world(std::vector<ColliderDef> colliders, std::vector<Vec2d> points = octagon()) {
  return {SceneryDef{.colliders = std::move(colliders)}, std::move(points)};
}

/// Counter-clockwise, without points on its edges (A. M. Andrew 1979).
inline std::vector<ExactPoint> hull_of(std::vector<ExactPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const ExactPoint& a, const ExactPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<ExactPoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const ExactPoint& point : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Where the corners of the octagon are.
inline std::vector<ExactPoint> octagon_at(const ExactPoint& position) {
  std::vector<ExactPoint> corners;
  for (const Vec2d& corner : octagon()) corners.push_back(position + exact(corner));
  return corners;
}

/// Another formulation of overlap: what is left of the ring after clipping it by every edge of a convex polygon, in
/// rationals (Sutherland, Hodgman 1974); its area is right for concave rings too.
inline Exact area_within(const std::vector<Vec2d>& ring, const std::vector<ExactPoint>& clip) {
  std::vector<ExactPoint> left;
  for (const Vec2d& v : ring) left.push_back(exact(v));
  for (std::size_t k = 0; k < clip.size(); ++k) {
    const ExactPoint& a = clip[k];
    const ExactPoint& b = clip[(k + 1) % clip.size()];
    std::vector<ExactPoint> kept;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const ExactPoint& p = left[i];
      const ExactPoint& q = left[(i + 1) % left.size()];
      const Exact at_p = cross(a, b, p);
      const Exact at_q = cross(a, b, q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    left = std::move(kept);
  }
  Exact twice = 0;
  for (std::size_t i = 1; i + 1 < left.size(); ++i) twice += cross(left[0], left[i], left[i + 1]);
  return abs(twice) / 2;
}

/// A star-shaped ring, concave as a rule.
inline std::vector<Vec2d> star(Random& random, const Vec2d& centre, double radius, int corners) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.between(0, 0.8)) / corners;
    ring.emplace_back(centre + radius * random.between(0.2, 1) * towards(angle));
  }
  return ring;
}

}  // namespace paperproof::compare::test
