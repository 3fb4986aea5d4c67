/// Sums that are rounded to the safe side.
#pragma once

#include <cmath>
#include <limits>

namespace paperproof {

/// a - b, rounded up: what the rounding lost is known exactly (Knuth's two-sum). Finite arguments, no overflow.
template <class Scalar>
[[nodiscard]] Scalar difference_rounded_up(Scalar a, Scalar b) noexcept {
  const Scalar rounded = a - b;
  const Scalar b_taken = a - rounded;
  const Scalar a_left = rounded + b_taken;
  const Scalar lost = (a - a_left) + (b_taken - b);
  return lost > 0 ? std::nextafter(rounded, std::numeric_limits<Scalar>::infinity()) : rounded;
}

}  // namespace paperproof
