#include "oracle/fraction.hpp"

namespace paperproof::compare {

ExactFraction::ExactFraction(double value) : rounded_(value) {
  const int unit = value == 0 ? 0 : std::min(0, detail::lowest_bit(value));
  numerator_ = detail::Convert<Integer>{unit}(value);
  denominator_ = Integer(1) << -unit;
}

ExactFraction::ExactFraction(Integer numerator, Integer denominator)
    : numerator_(std::move(numerator)),
      denominator_(std::move(denominator)),
      rounded_(detail::nearest_double(numerator_, denominator_)) {}

/// Rounding keeps the order of two fractions, but may make them equal.
std::strong_ordering operator<=>(const ExactFraction& a, const ExactFraction& b) {
  if (a.rounded_ != b.rounded_)
    return a.rounded_ < b.rounded_ ? std::strong_ordering::less : std::strong_ordering::greater;
  return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
}

ExactFraction operator+(const ExactFraction& a, const ExactFraction& b) {
  return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_, a.denominator_ * b.denominator_};
}

ExactFraction operator-(const ExactFraction& a, const ExactFraction& b) { return a + ExactFraction(-1) * b; }

ExactFraction operator*(const ExactFraction& a, const ExactFraction& b) {
  return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
}

}  // namespace paperproof::compare
