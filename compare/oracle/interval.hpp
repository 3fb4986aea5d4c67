/// A number known to lie between two doubles. Every operation rounds outwards, without touching the rounding mode.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare::detail {

struct Interval {
  double low = 0;
  double high = 0;

  Interval() = default;
  Interval(double x) : low(x), high(x) {}  // NOLINT(google-explicit-constructor): a double is known exactly
  Interval(double a, double b) : low(a), high(b) {}

  [[nodiscard]] static double down(double x) noexcept {
    return std::nextafter(x, -std::numeric_limits<double>::infinity());
  }
  [[nodiscard]] static double up(double x) noexcept {
    return std::nextafter(x, std::numeric_limits<double>::infinity());
  }

  friend Interval operator+(const Interval& a, const Interval& b) noexcept {
    return {down(a.low + b.low), up(a.high + b.high)};
  }
  friend Interval operator-(const Interval& a) noexcept { return {-a.high, -a.low}; }
  friend Interval operator-(const Interval& a, const Interval& b) noexcept { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) noexcept {
    const auto [least, most] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {down(least), up(most)};
  }
  /// @param b above zero.
  friend Interval operator/(const Interval& a, double b) noexcept { return {down(a.low / b), up(a.high / b)}; }
};

struct SineCosine {
  Interval sine;
  Interval cosine;
};

/// Of every angle in the interval [rad]; |angle| up to 1e6. The Taylor series of its middle, reduced by multiples of
/// pi/2, with its remainder; then as far as the angle is from the middle, for no derivative is larger than 1.
[[nodiscard]] SineCosine sine_cosine(const Interval& angle);

}  // namespace paperproof::compare::detail
