#include "oracle/integer.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

using boost::multiprecision::cpp_int;
__extension__ using Wide = unsigned __int128;

using Limbs = std::array<std::uint64_t, 4>;
/// Of an absolute value that fits.
constexpr int fitting_bits = 255;

int bit_count_of(const Limbs& limbs) noexcept {
  for (int i = 3; i >= 0; --i)
    if (limbs[static_cast<std::size_t>(i)] != 0)
      return 64 * (i + 1) - std::countl_zero(limbs[static_cast<std::size_t>(i)]);
  return 0;
}

Limbs negated(const Limbs& limbs) noexcept {
  Limbs result;
  std::uint64_t carry = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = ~limbs[i] + carry;
    carry = carry != 0 && result[i] == 0 ? 1 : 0;
  }
  return result;
}

Limbs shifted_right(const Limbs& limbs, int bits) noexcept {
  Limbs result{};
  const auto whole = static_cast<std::size_t>(bits / 64);
  for (std::size_t i = whole; i < 4; ++i) {
    result[i - whole] = limbs[i] >> bits % 64;
    if (bits % 64 != 0 && i + 1 < 4) result[i - whole] |= limbs[i + 1] << (64 - bits % 64);
  }
  return result;
}

}  // namespace

struct Integer::Large {
  cpp_int value;
};

Integer Integer::of(Large value) {
  Integer result;
  const cpp_int size = abs(value.value);
  if (size != 0 && msb(size) >= fitting_bits) {
    result.large_ = std::make_shared<const Large>(std::move(value));
    return result;
  }
  for (unsigned i = 0; i < 4; ++i)
    result.limbs_[i] = static_cast<std::uint64_t>(cpp_int(size >> 64 * i) & ~std::uint64_t{0});
  if (value.value < 0) result.limbs_ = negated(result.limbs_);
  return result;
}

Integer::Large Integer::large() const {
  if (large_) return *large_;
  const Limbs limbs = magnitude();
  cpp_int value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 64) | limbs[i];
  return {is_negative() ? cpp_int(-value) : value};
}

Limbs Integer::magnitude() const noexcept { return is_negative() ? negated(limbs_) : limbs_; }

Integer::Integer(std::int64_t value) noexcept {
  limbs_.fill(value < 0 ? ~std::uint64_t{0} : 0);
  limbs_[0] = static_cast<std::uint64_t>(value);
}

int Integer::sign() const noexcept {
  if (large_) return large_->value.sign();
  if (is_negative()) return -1;
  return (limbs_[0] | limbs_[1] | limbs_[2] | limbs_[3]) != 0 ? 1 : 0;
}

int Integer::bit_count() const {
  return large_ ? static_cast<int>(msb(abs(large_->value))) + 1 : bit_count_of(magnitude());
}

Integer::operator long double() const {
  if (large_) return static_cast<long double>(large_->value);
  const Limbs limbs = magnitude();
  long double sum = 0;
  for (int i = 0; i < 4; ++i) sum += std::ldexp(static_cast<long double>(limbs[static_cast<std::size_t>(i)]), 64 * i);
  return is_negative() ? -sum : sum;
}

/// Negated is what has all bits turned, and one more. Nothing where the sum does not fit.
bool Integer::add(const Integer& other, bool negated) {
  if (large_ || other.large_) return false;
  const std::uint64_t turned = negated ? ~std::uint64_t{0} : 0;
  Limbs sum;
  Wide carry = negated ? 1 : 0;
  for (std::size_t i = 0; i < 4; ++i) {
    carry += Wide{limbs_[i]} + (other.limbs_[i] ^ turned);
    sum[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  // It has grown over where its sign is neither's.
  if (((limbs_[3] ^ sum[3]) & (other.limbs_[3] ^ turned ^ sum[3])) >> 63 != 0) return false;
  limbs_ = sum;
  return true;
}

Integer operator+(Integer a, const Integer& b) {
  if (a.add(b, false)) return a;
  return Integer::of({a.large().value + b.large().value});
}

Integer operator-(Integer a, const Integer& b) {
  if (a.add(b, true)) return a;
  return Integer::of({a.large().value - b.large().value});
}

Integer operator-(const Integer& a) { return Integer() - a; }

Integer operator*(const Integer& a, const Integer& b) {
  if (!a.large_ && !b.large_) {
    const Limbs x = a.magnitude();
    const Limbs y = b.magnitude();
    const int x_bits = bit_count_of(x);
    const int y_bits = bit_count_of(y);
    if (x_bits + y_bits <= fitting_bits) {
      const auto x_size = static_cast<std::size_t>((x_bits + 63) / 64);
      const auto y_size = static_cast<std::size_t>((y_bits + 63) / 64);
      Integer product;
      for (std::size_t i = 0; i < x_size; ++i) {
        Wide carry = 0;
        for (std::size_t j = 0; j < y_size; ++j) {
          carry += Wide{x[i]} * y[j] + product.limbs_[i + j];
          product.limbs_[i + j] = static_cast<std::uint64_t>(carry);
          carry >>= 64;
        }
        if (i + y_size < 4) product.limbs_[i + y_size] = static_cast<std::uint64_t>(carry);
      }
      if (a.is_negative() != b.is_negative()) product.limbs_ = negated(product.limbs_);
      return product;
    }
  }
  return Integer::of({a.large().value * b.large().value});
}

Integer operator<<(const Integer& a, int bits) {
  if (!a.large_ && bit_count_of(a.magnitude()) + bits <= fitting_bits) {
    Integer result;
    const auto whole = static_cast<std::size_t>(bits / 64);
    for (std::size_t i = whole; i < 4; ++i) {
      result.limbs_[i] = a.limbs_[i - whole] << bits % 64;
      if (bits % 64 != 0 && i > whole) result.limbs_[i] |= a.limbs_[i - whole - 1] >> (64 - bits % 64);
    }
    return result;
  }
  return a.sign() == 0 ? a : Integer::of({a.large().value << bits});
}

std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
  if (a.large_ || b.large_) return a.large().value.compare(b.large().value) <=> 0;
  if (a.is_negative() != b.is_negative())
    return a.is_negative() ? std::strong_ordering::less : std::strong_ordering::greater;
  for (std::size_t i = 4; i-- > 0;)
    if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] <=> b.limbs_[i];
  return std::strong_ordering::equal;
}

LeadingBits leading_bits_of(const Integer& x) {
  const int drop = std::max(0, x.bit_count() - 63);
  if (x.large_) return {static_cast<std::uint64_t>(cpp_int(abs(x.large_->value) >> drop)), drop};
  return {shifted_right(x.magnitude(), drop)[0], drop};
}

double nearest_double(const Integer& numerator, const Integer& denominator) {
  if (numerator.sign() == 0) return 0;
  const auto signed_as = [&](double size) { return numerator.sign() < 0 ? -size : size; };
  // The first 63 bits of both leave the first 62 of the quotient open by less than 4.
  const auto first_bits = [](const Integer& x) {
    const LeadingBits leading = leading_bits_of(x);
    const int up = std::countl_zero(leading.bits) - 1;
    return LeadingBits{leading.bits << up, leading.exponent - up};
  };
  const LeadingBits above = first_bits(numerator);
  const LeadingBits below = first_bits(denominator);
  const auto about = static_cast<std::uint64_t>((Wide{above.bits} << 62) / below.bits);
  const auto least = static_cast<double>(about - 4);
  if (least == static_cast<double>(about + 4))
    return signed_as(std::ldexp(least, above.exponent - below.exponent - 62));
  // The quotient has 63 or 64 bits, and its lowest stands for all that follow: what is left is rounded once.
  const int shift = 63 + denominator.bit_count() - numerator.bit_count();
  cpp_int quotient;
  cpp_int rest;
  divide_qr(cpp_int(abs(numerator.large().value) << std::max(shift, 0)),
            cpp_int(denominator.large().value << std::max(-shift, 0)), quotient, rest);
  const auto bits = static_cast<std::uint64_t>(quotient) | static_cast<std::uint64_t>(rest != 0);
  return signed_as(std::ldexp(static_cast<double>(bits), -shift));
}

}  // namespace paperproof::compare::detail
