/// Points and areas in rational numbers.
#pragma once

#include <paperproof/scenery.hpp>

#include <boost/multiprecision/cpp_int.hpp>
#include <utility>
#include <vector>

namespace paperproof::test {

using Rational = boost::multiprecision::cpp_rational;

struct ExactPoint {
  Rational x;
  Rational y;

  ExactPoint(Rational across, Rational up) : x(std::move(across)), y(std::move(up)) {}
  explicit ExactPoint(const Vec2d& point) : x(point.x()), y(point.y()) {}
  ExactPoint(const Vec2d& point, const Vec2d& offset)
      : x(Rational(point.x()) + Rational(offset.x())), y(Rational(point.y()) + Rational(offset.y())) {}

  friend ExactPoint operator+(const ExactPoint& a, const ExactPoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) { return {a.x - b.x, a.y - b.y}; }
  friend ExactPoint operator*(const Rational& s, const ExactPoint& a) { return {s * a.x, s * a.y}; }
};

/// Twice the signed area of a triangle.
inline Rational cross(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Twice the signed area of a closed outline.
inline Rational twice_area(const std::vector<Vec2d>& outline) {
  Rational sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sum += cross(ExactPoint(0, 0), ExactPoint(outline[i]), ExactPoint(outline[(i + 1) % outline.size()]));
  return sum;
}

/// That of a polygon without its holes.
inline Rational twice_area(const ColliderDef& polygon) {
  Rational area = abs(twice_area(polygon.points));
  for (const std::vector<Vec2d>& hole : polygon.holes) area -= abs(twice_area(hole));
  return area;
}

}  // namespace paperproof::test
