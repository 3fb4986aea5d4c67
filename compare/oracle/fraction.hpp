/// A fraction as it was found: never cancelled, because the judge compares fractions often and reads few of them.
#pragma once

#include <compare>
#include <memory>
#include <string>

namespace paperproof::compare {

namespace detail {
struct Ratio;
}

/// An exact fraction. Immutable. Copies share the numerator and the denominator.
class ExactFraction {
 public:
  ExactFraction(double value = 0) : rounded_(value) {}  // NOLINT(google-explicit-constructor): a double is one
  explicit ExactFraction(detail::Ratio ratio);

  /// The nearest double, the even one of two.
  [[nodiscard]] explicit operator double() const noexcept { return rounded_; }

  /// Numerator and denominator, without a common divisor: `17/32`.
  [[nodiscard]] std::string text() const;

  friend bool operator==(const ExactFraction& a, const ExactFraction& b) { return (a <=> b) == 0; }
  friend std::strong_ordering operator<=>(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator+(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator-(const ExactFraction& a, const ExactFraction& b);
  friend ExactFraction operator*(const ExactFraction& a, const ExactFraction& b);

 private:
  [[nodiscard]] detail::Ratio ratio() const;

  double rounded_;
  std::shared_ptr<const detail::Ratio> exact_;  ///< None where `rounded_` is exact.
};

}  // namespace paperproof::compare
