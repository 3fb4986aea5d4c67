/// A fraction as it was found: never cancelled, because the judge compares fractions often and reads few of them.
#pragma once

#include "oracle/number.hpp"

#include <compare>

namespace paperproof::compare {

/// numerator / denominator, exactly.
class ExactFraction {
 public:
  using Integer = detail::Integer;

  ExactFraction(double value = 0);  // NOLINT(google-explicit-constructor): every double is a fraction
  /// @param denominator above zero.
  ExactFraction(Integer numerator, Integer denominator);

  [[nodiscard]] const Integer& numerator() const noexcept { return numerator_; }
  [[nodiscard]] const Integer& denominator() const noexcept { return denominator_; }
  /// The nearest double, the even one of two.
  [[nodiscard]] explicit operator double() const noexcept { return rounded_; }

  friend bool operator==(const ExactFraction& a, const ExactFraction& b) { return (a <=> b) == 0; }
  friend std::strong_ordering operator<=>(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator+(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator-(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator*(const ExactFraction& a, const ExactFraction& b);

 private:
  Integer numerator_;
  Integer denominator_;
  double rounded_;
};

}  // namespace paperproof::compare
