/// Sums that are rounded to the safe side.
#pragma once

#include <cmath>
#include <limits>

namespace paperproof {

/// a - b, rounded up: what the rounding lost is known exactly (Knuth's two-sum). Finite arguments, no overflow.
[[nodiscard]] inline double difference_rounded_up(double a, double b) noexcept {
  const double rounded = a - b;
  const double b_taken = a - rounded;
  const double a_left = rounded + b_taken;
  const double lost = (a - a_left) + (b_taken - b);
  return lost > 0 ? std::nextafter(rounded, std::numeric_limits<double>::infinity()) : rounded;
}

}  // namespace paperproof
