/// The same questions as controller/src/geometry, answered in rational numbers.
#pragma once

#include <paperproof/types.hpp>

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

namespace paperproof::test {

using Rational = boost::multiprecision::cpp_rational;

struct ExactPoint {
  Rational x;
  Rational y;

  explicit ExactPoint(const Vec2d& point) : x(point.x()), y(point.y()) {}
  ExactPoint(const Vec2d& point, const Vec2d& offset)
      : x(Rational(point.x()) + Rational(offset.x())), y(Rational(point.y()) + Rational(offset.y())) {}
};

/// Twice the signed area of a triangle.
inline Rational cross(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Twice the signed area of a closed outline.
template <class Points>
Rational twice_area(const Points& points) {
  Rational sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ExactPoint from(points[i]);
    const ExactPoint to(points[(i + 1) % points.size()]);
    sum += from.x * to.y - to.x * from.y;
  }
  return sum;
}

}  // namespace paperproof::test
