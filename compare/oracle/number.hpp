/// The two kinds of number that the oracle decides with: doubles that know how wrong they are, and integers that are
/// never wrong. The same algorithms run on both; the second is asked where the first does not know.
#pragma once

#include <paperproof/types.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace paperproof::compare::detail {

/// What is known about the sign of a value.
enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1, unknown = 2 };

/// A yes or no that may have to be asked again in exact arithmetic.
enum class Answer : std::uint8_t { no, yes, unknown };

/// Both, and where one does not know: unknown.
[[nodiscard]] inline Answer both(Answer a, Answer b) {
  if (a == Answer::no || b == Answer::no) return Answer::no;
  return a == Answer::yes ? b : a;
}

/// One of them, and where neither is known to be: unknown, if one is.
[[nodiscard]] inline Answer either(Answer a, Answer b) {
  if (a == Answer::yes || b == Answer::yes) return Answer::yes;
  return a == Answer::no ? b : a;
}

[[nodiscard]] inline Answer is(Sign sign, Sign wanted) {
  if (sign == Sign::unknown) return Answer::unknown;
  return sign == wanted ? Answer::yes : Answer::no;
}

[[nodiscard]] inline Answer is_not(Answer a) {
  if (a == Answer::unknown) return a;
  return a == Answer::yes ? Answer::no : Answer::yes;
}

/// A rounded sum, and what rounding took from it: exact.
[[nodiscard]] inline std::pair<double, double> two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// A double and a bound on its distance from the exact value. The bound follows the real rounding errors (two-sum, and
/// the fused product for two-product), so it stays 0 while every operation is exact: a character that touches a tile on
/// whole pixels is known to touch, without any exact arithmetic. T. J. Dekker 1971; J. R. Shewchuk 1997.
struct Approximate {
  double value = 0;
  double radius = 0;

  /// Covers the roundings made while the radius itself is computed.
  static constexpr double outward = 1 + 0x1p-50;
  static constexpr double underflow = std::numeric_limits<double>::min();

  friend Approximate operator+(const Approximate& a, const Approximate& b) noexcept {
    const auto [sum, error] = two_sum(a.value, b.value);
    return {sum, (a.radius + b.radius + std::abs(error)) * outward};
  }
  friend Approximate operator-(const Approximate& a) noexcept { return {-a.value, a.radius}; }
  friend Approximate operator-(const Approximate& a, const Approximate& b) noexcept { return a + -b; }
  friend Approximate operator*(const Approximate& a, const Approximate& b) noexcept {
    const double product = a.value * b.value;
    const double error = std::fma(a.value, b.value, -product);
    double bound =
        (std::abs(a.value) * b.radius + std::abs(b.value) * a.radius + a.radius * b.radius + std::abs(error)) * outward;
    const bool may_underflow = std::abs(product) < 0x1p-900 && a.value != 0 && b.value != 0;
    if (may_underflow || a.radius != 0 || b.radius != 0) bound += underflow;
    return {product, bound};
  }
};

[[nodiscard]] inline Sign sign_of(const Approximate& x) noexcept {
  if (std::abs(x.value) > x.radius) return x.value > 0 ? Sign::positive : Sign::negative;
  return x.radius == 0 ? Sign::zero : Sign::unknown;  // an infinite or NaN radius is unknown too
}

/// Grows without limit; the first 512 bits need no allocation.
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

/// numerator / denominator, the latter above zero.
struct Ratio {
  Integer numerator;
  Integer denominator;
};

[[nodiscard]] inline Sign sign_of(const Integer& x) noexcept {
  const int sign = x.sign();
  return sign > 0 ? Sign::positive : sign < 0 ? Sign::negative : Sign::zero;
}

/// The smaller of two; of two approximate values a number whose bound holds for either choice.
[[nodiscard]] inline Integer least(const Integer& a, const Integer& b) { return a < b ? a : b; }
[[nodiscard]] inline Approximate least(const Approximate& a, const Approximate& b) noexcept {
  return {std::min(a.value, b.value), std::max(a.radius, b.radius)};
}

/// The exponent of the lowest bit that is set in a finite double; large for zero.
[[nodiscard]] inline int lowest_bit(double x) noexcept {
  if (x == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::abs(std::ldexp(std::frexp(x, &exponent), 53)));
  return exponent - 53 + std::countr_zero(mantissa);
}

/// The lowest bit that the exact product of two doubles can have set.
[[nodiscard]] inline int lowest_bit_of_product(double a, double b) noexcept {
  return a == 0 || b == 0 ? std::numeric_limits<int>::max() : lowest_bit(a) + lowest_bit(b);
}

/// Turns doubles into numbers of one kind. Integers count units of 2^unit, where `unit` is no larger than the lowest
/// bit of anything that is converted.
template <class Number>
struct Convert;

template <>
struct Convert<Approximate> {
  int unit = 0;
  [[nodiscard]] Approximate operator()(double x) const noexcept { return {x, 0}; }
  [[nodiscard]] Approximate product(double a, double b) const noexcept { return (*this)(a) * (*this)(b); }
};

template <>
struct Convert<Integer> {
  int unit = 0;
  [[nodiscard]] Integer operator()(double x) const {
    if (x == 0) return 0;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int shift = exponent - 53 - unit;
    if (shift < 0) return Integer(mantissa / (std::int64_t{1} << -shift));  // exact: those bits are zero
    return Integer(mantissa) << shift;
  }
  /// `unit` is no larger than the sum of the lowest bits of the two.
  [[nodiscard]] Integer product(double a, double b) const {
    if (a == 0 || b == 0) return 0;
    const Convert first{lowest_bit(a)};
    const Convert second{lowest_bit(b)};
    return (first(a) * second(b)) << (first.unit + second.unit - unit);
  }
};

template <class Number>
struct Point {
  Number x{};
  Number y{};

  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator-(const Point& a) { return {-a.x, -a.y}; }
};

template <class Number>
[[nodiscard]] Number cross(const Point<Number>& a, const Point<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class Number>
[[nodiscard]] Number dot(const Point<Number>& a, const Point<Number>& b) {
  return a.x * b.x + a.y * b.y;
}

template <class Number>
[[nodiscard]] Point<Number> convert(const Convert<Number>& to, const Vec2d& v) {
  return {to(v.x()), to(v.y())};
}

[[nodiscard]] inline int lowest_bit(const Vec2d& v) noexcept { return std::min(lowest_bit(v.x()), lowest_bit(v.y())); }
[[nodiscard]] inline int lowest_bit_of(std::span<const Vec2d> points) noexcept {
  int lowest = std::numeric_limits<int>::max();
  for (const Vec2d& point : points) lowest = std::min(lowest, lowest_bit(point));
  return lowest;
}

/// The leading bits of an integer: value * 2^exponent, rounded towards zero.
struct Leading {
  double value = 0;
  int exponent = 0;
};
[[nodiscard]] inline Leading leading_bits(const Integer& x) {
  if (x == 0) return {};
  const Integer size = abs(x);
  const int drop = std::max(0, static_cast<int>(msb(size)) - 62);
  const auto value = static_cast<double>(static_cast<std::int64_t>(Integer(size >> drop)));
  return {x < 0 ? -value : value, drop};
}

/// x * 2^exponent.
[[nodiscard]] inline double to_double(const Integer& x, int exponent) {
  const Leading leading = leading_bits(x);
  return std::ldexp(leading.value, leading.exponent + exponent);
}

/// numerator / denominator as a double, exact to a few ulp whatever the size of the two.
[[nodiscard]] inline double ratio(const Integer& numerator, const Integer& denominator) {
  const Leading above = leading_bits(numerator);
  const Leading below = leading_bits(denominator);
  return std::ldexp(above.value / below.value, above.exponent - below.exponent);
}

}  // namespace paperproof::compare::detail
