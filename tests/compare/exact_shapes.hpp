/// Shapes, random numbers and exact points for the tests of the oracle.
#pragma once

#include "campaign/random.hpp"
#include "oracle/exact.hpp"

#include <cmath>

namespace paperproof::compare::test {

inline double one_ulp_up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double one_ulp_down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

using Exact = Rational;

struct ExactPoint {
  Exact x;
  Exact y;

  friend ExactPoint operator+(const ExactPoint& a, const ExactPoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) { return {a.x - b.x, a.y - b.y}; }
  friend ExactPoint operator*(const Exact& s, const ExactPoint& a) { return {s * a.x, s * a.y}; }
};

inline Exact cross(const ExactPoint& o, const ExactPoint& a, const ExactPoint& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

inline ExactPoint exact(const Vec2d& v) { return {Exact(v.x()), Exact(v.y())}; }

/// The article's hull at 32 pixels per metre, counter-clockwise.
inline std::vector<Vec2d> octagon() {
  return {{-0.15625, -0.625}, {0.15625, -0.625}, {0.3125, -0.3125}, {0.3125, 0.3125},
          {0.15625, 0.625},   {-0.15625, 0.625}, {-0.3125, 0.3125}, {-0.3125, -0.3125}};
}

inline ColliderDef polygon(std::vector<Vec2d> points) { return {.points = std::move(points)}; }
inline ColliderDef box(double left, double bottom, double right, double top) {
  return polygon({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}
inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}
inline SceneryDef scenery(std::vector<ColliderDef> colliders) { return {.colliders = std::move(colliders)}; }

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
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
        const Exact t = at_p / (at_p - at_q);
        kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    left = std::move(kept);
  }
  Exact twice = 0;
  for (std::size_t i = 1; i + 1 < left.size(); ++i) twice += cross(left[0], left[i], left[i + 1]);
  return abs(twice) / 2;
}

/// Another formulation of overlap, for convex things: the origin against the hull of all pairwise differences.
inline bool in_minkowski_difference(const std::vector<Vec2d>& convex, const std::vector<Vec2d>& points,
                                    const Vec2d& position) {
  std::vector<ExactPoint> all;
  for (const Vec2d& v : convex) {
    for (const Vec2d& o : points) {
      all.push_back({Exact(v.x()) - Exact(o.x()), Exact(v.y()) - Exact(o.y())});
    }
  }
  const ExactPoint p = exact(position);
  std::sort(all.begin(), all.end(),
            [](const ExactPoint& a, const ExactPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto strictly_left = [&](auto begin, auto end) {
    std::vector<ExactPoint> half;
    for (auto it = begin; it != end; ++it) {
      while (half.size() > 1 && cross(half[half.size() - 2], half.back(), *it) <= 0) half.pop_back();
      half.push_back(*it);
    }
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
      if (cross(half[i], half[i + 1], p) <= 0) return false;
    }
    return true;
  };
  return strictly_left(all.begin(), all.end()) && strictly_left(all.rbegin(), all.rend());
}

/// A star-shaped ring, concave as a rule.
inline std::vector<Vec2d> star(Random& random, const Vec2d& centre, double radius, int corners) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + random.between(0, 0.8)) / corners;
    const double r = radius * random.between(0.2, 1);
    ring.emplace_back(centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle));
  }
  return ring;
}

}  // namespace paperproof::compare::test
