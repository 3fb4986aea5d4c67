/// Whole numbers without limit, at the price of plain ones as long as they fit into 256 bits. Nearly all that the
/// oracle asks of exact arithmetic does: a product of two coordinates has 106 bits and the distance of their exponents.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>

namespace paperproof::compare::detail {

/// The first bits of an absolute value, at most 63 of them: bits * 2^exponent, rounded towards zero.
struct LeadingBits {
  std::uint64_t bits = 0;
  int exponent = 0;
};

class Integer {
 public:
  Integer(std::int64_t value = 0) noexcept;  // NOLINT(google-explicit-constructor): every whole number is one

  [[nodiscard]] int sign() const noexcept;
  /// Of the absolute value; 0 of zero.
  [[nodiscard]] int bit_count() const;
  [[nodiscard]] explicit operator long double() const;

  friend Integer operator+(Integer a, const Integer& b);
  friend Integer operator-(Integer a, const Integer& b);
  friend Integer operator*(const Integer& a, const Integer& b);
  friend Integer operator-(const Integer& a);
  friend Integer operator<<(const Integer& a, int bits);
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b);
  friend bool operator==(const Integer& a, const Integer& b) { return (a <=> b) == 0; }
  friend Integer abs(const Integer& a) { return a.sign() < 0 ? -a : a; }

 private:
  friend LeadingBits leading_bits_of(const Integer& x);
  friend double nearest_double(const Integer& numerator, const Integer& denominator);

  struct Large;
  using Limbs = std::array<std::uint64_t, 4>;
  [[nodiscard]] static Integer of(Large value);
  [[nodiscard]] Large large() const;
  [[nodiscard]] bool add(const Integer& other, bool negated);
  [[nodiscard]] Limbs magnitude() const noexcept;
  [[nodiscard]] bool is_negative() const noexcept { return limbs_[3] >> 63 != 0; }

  Limbs limbs_{};                       ///< Two's complement, the lowest first.
  std::shared_ptr<const Large> large_;  ///< What does not fit, instead.
};

[[nodiscard]] LeadingBits leading_bits_of(const Integer& x);

/// The double that is nearest to a quotient, the even one of two. @param denominator above zero.
[[nodiscard]] double nearest_double(const Integer& numerator, const Integer& denominator);

}  // namespace paperproof::compare::detail
