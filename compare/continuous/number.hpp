/// Numbers and points of the continuous reference: more digits than any double needs.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>

namespace paperproof::compare::continuous {

/// A binary floating-point number of at least so many decimal digits.
template <unsigned digits>
using Number =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>, boost::multiprecision::et_off>;

/// Two lengths, velocities or accelerations are one where they differ by less than this [m, m/s, m/s²], times their
/// size where that is more than one. A quarter of the digits is left for rounding. At 30 digits it is 1e-22: what
/// differs by one bit of a double, 1e-16 and less at small coordinates, still counts as different.
template <class Real>
[[nodiscard]] const Real& same() {
  static const Real tolerance = pow(Real(10), -(std::numeric_limits<Real>::digits10 * 3 / 4));
  return tolerance;
}

/// A place, velocity or acceleration.
template <class Real>
struct Point {
  Real x{0};
  Real y{0};

  Point& operator+=(const Point& other) {
    x += other.x;
    y += other.y;
    return *this;
  }
  Point& operator-=(const Point& other) {
    x -= other.x;
    y -= other.y;
    return *this;
  }
  friend Point operator+(Point a, const Point& b) { return a += b; }
  friend Point operator-(Point a, const Point& b) { return a -= b; }
  friend Point operator-(const Point& a) { return {-a.x, -a.y}; }
  friend Point operator*(const Point& a, const Real& factor) { return {a.x * factor, a.y * factor}; }
};

template <class Real>
[[nodiscard]] Real dot(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Real>
[[nodiscard]] Real cross(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Real>
[[nodiscard]] Real length_of(const Point<Real>& a) {
  return sqrt(dot(a, a));
}

}  // namespace paperproof::compare::continuous
