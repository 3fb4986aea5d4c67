/// When a quadratic quantity falls below zero, in closed form.
#pragma once

#include "continuous/number.hpp"

#include <optional>

namespace paperproof::compare::continuous {

/// The time t > 0 at which a + b t + c t² / 2 falls through zero. Nothing where it never does; of what is at zero and
/// falling already nothing either. There is one such time at most: a parabola falls through a line once.
[[nodiscard]] inline std::optional<Real> falls_through_zero(const Real& a, const Real& b, const Real& c) {
  const Real& zero = same();
  if (abs(a) <= zero) {
    if (!(b > zero) || !(c < 0)) return std::nullopt;
    return Real(-2 * b / c);
  }
  if (c == 0) {
    if (!(a > 0) || !(b < 0)) return std::nullopt;
    return Real(-a / b);
  }
  if (c > 0 && !(a > 0 && b < 0)) return std::nullopt;
  const Real discriminant = b * b - 2 * a * c;
  if (!(discriminant > 0)) return std::nullopt;
  const Real root = sqrt(discriminant);
  // Of the two forms of one root that which subtracts nothing of equal size.
  const Real time = b < 0 ? Real(2 * a / (root - b)) : Real((-b - root) / c);
  return time > 0 ? std::optional<Real>(time) : std::nullopt;
}

}  // namespace paperproof::compare::continuous
