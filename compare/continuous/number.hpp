/// Numbers and points of the continuous reference: more digits than any double needs.
#pragma once

#include <paperproof/types.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <limits>

namespace paperproof::compare::continuous {

/// A binary floating-point number of at least 50 decimal digits.
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Two lengths, velocities or accelerations are one where they differ by less than this [m, m/s, m/s²], times their
/// size where that is more than one. A quarter of the digits is left for rounding. It is 1e-37: what differs by one bit
/// of a double, 1e-16 and less at small coordinates, still counts as different.
[[nodiscard]] inline const Real& same() {
  static const Real tolerance = pow(Real(10), -(std::numeric_limits<Real>::digits10 * 3 / 4));
  return tolerance;
}

/// A place, velocity or acceleration.
using Point = Eigen::Matrix<Real, 2, 1>;

[[nodiscard]] inline Point point_of(const Vec2d& v) { return v.cast<Real>(); }
[[nodiscard]] inline Real cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace paperproof::compare::continuous
