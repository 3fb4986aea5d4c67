/// Twice the digits of a double.
#pragma once

#include "oracle/number.hpp"

namespace paperproof::compare::detail {

/// The sum of two doubles, the second below the rounding of the first, and a bound on its distance from the exact
/// value. T. J. Dekker 1971; Y. Hida, X. S. Li, D. H. Bailey 2001.
struct Doubled {
  double value = 0;
  double rest = 0;
  double radius = 0;

  friend Doubled operator-(const Doubled& a) noexcept { return {-a.value, -a.rest, a.radius}; }
  friend Doubled operator-(const Doubled& a, const Doubled& b) noexcept { return a + -b; }
  friend Doubled operator+(const Doubled& a, const Doubled& b) noexcept {
    const auto [sum, error] = two_sum(a.value, b.value);
    const auto [rests, lost] = two_sum(a.rest, b.rest);
    const auto [low, dropped] = two_sum(error, rests);
    const auto [high, left] = two_sum(sum, low);
    return {high, left, (a.radius + b.radius + std::abs(lost) + std::abs(dropped)) * Approximate::outward};
  }
  friend Doubled operator*(const Doubled& a, const Doubled& b) noexcept {
    const double product = a.value * b.value;
    const double error = std::fma(a.value, b.value, -product);
    const double one = a.value * b.rest;
    const double two = a.rest * b.value;
    const double low = error + (one + two);
    const auto [high, left] = two_sum(product, low);
    const bool is_exact = a.rest == 0 && b.rest == 0 && a.radius == 0 && b.radius == 0;
    // The error of a product of doubles is a double.
    double bound = a.size() * b.radius + b.size() * a.radius + a.radius * b.radius + std::abs(a.rest * b.rest) +
                   2 * rounding * (std::abs(one) + std::abs(two) + (is_exact ? 0 : std::abs(low)));
    const bool may_underflow = std::abs(product) < 0x1p-900 && a.value != 0 && b.value != 0;
    if (!is_exact || may_underflow) bound += Approximate::underflow;
    return {high, left, bound * Approximate::outward};
  }

 private:
  static constexpr double rounding = 0x1p-53;

  [[nodiscard]] double size() const noexcept { return std::abs(value) + std::abs(rest); }
};

/// The smaller of two; the bound holds for either choice.
[[nodiscard]] inline Doubled least(const Doubled& a, const Doubled& b) noexcept {
  const bool first = a.value < b.value || (a.value == b.value && a.rest < b.rest);
  const Doubled& lower = first ? a : b;
  return {lower.value, lower.rest, std::max(a.radius, b.radius)};
}

template <>
struct Convert<Doubled> {
  [[nodiscard]] Doubled operator()(double x) const noexcept { return {x}; }
  [[nodiscard]] Doubled product(double a, double b) const noexcept { return (*this)(a) * (*this)(b); }
};

}  // namespace paperproof::compare::detail
