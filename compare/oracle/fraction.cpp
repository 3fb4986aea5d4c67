#include "oracle/fraction.hpp"

#include "oracle/number.hpp"

namespace paperproof::compare {

using detail::Integer;
using detail::Ratio;

namespace {

double nearest_double(const Ratio& ratio) {
  if (ratio.numerator == 0) return 0;
  const Integer size = abs(ratio.numerator);
  // The quotient has 62 or 63 bits. Its lowest bit is set if the division leaves a rest: so only one rounding follows.
  const int shift = 62 + static_cast<int>(msb(ratio.denominator)) - static_cast<int>(msb(size));
  Integer quotient;
  Integer rest;
  divide_qr(Integer(size << std::max(shift, 0)), Integer(ratio.denominator << std::max(-shift, 0)), quotient, rest);
  const std::int64_t bits = static_cast<std::int64_t>(quotient) | (rest == 0 ? 0 : 1);
  return std::ldexp(static_cast<double>(ratio.numerator < 0 ? -bits : bits), -shift);
}

}  // namespace

ExactFraction::ExactFraction(Ratio ratio)
    : rounded_(nearest_double(ratio)), exact_(std::make_shared<const Ratio>(std::move(ratio))) {}

Ratio ExactFraction::ratio() const {
  if (exact_) return *exact_;
  const int unit = std::min(0, detail::lowest_bit(rounded_));
  return {detail::Convert<Integer>{unit}(rounded_), Integer(1) << -unit};
}

std::string ExactFraction::text() const {
  const Ratio cancelled = ratio();
  const Integer common = gcd(cancelled.numerator, cancelled.denominator);
  return Integer(cancelled.numerator / common).str() + '/' + Integer(cancelled.denominator / common).str();
}

/// Rounding keeps the order of two fractions, but may make them equal.
std::strong_ordering operator<=>(const ExactFraction& a, const ExactFraction& b) {
  if (a.rounded_ != b.rounded_)
    return a.rounded_ < b.rounded_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (!a.exact_ && !b.exact_) return std::strong_ordering::equal;
  const Ratio of_a = a.ratio();
  const Ratio of_b = b.ratio();
  return Integer(of_a.numerator * of_b.denominator).compare(of_b.numerator * of_a.denominator) <=> 0;
}

ExactFraction operator+(const ExactFraction& a, const ExactFraction& b) {
  const Ratio of_a = a.ratio();
  const Ratio of_b = b.ratio();
  // The power of two that both denominators hold: a sum of doubles grows no longer than it must.
  const unsigned both = std::min(lsb(of_a.denominator), lsb(of_b.denominator));
  const Integer by = of_b.denominator >> both;
  return ExactFraction(Ratio{of_a.numerator * by + of_b.numerator * (of_a.denominator >> both), of_a.denominator * by});
}

ExactFraction operator-(const ExactFraction& a, const ExactFraction& b) { return a + ExactFraction(-1) * b; }

ExactFraction operator*(const ExactFraction& a, const ExactFraction& b) {
  const Ratio of_a = a.ratio();
  const Ratio of_b = b.ratio();
  return ExactFraction(Ratio{of_a.numerator * of_b.numerator, of_a.denominator * of_b.denominator});
}

}  // namespace paperproof::compare
