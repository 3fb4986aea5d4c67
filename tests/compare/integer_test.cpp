/// The oracle's whole numbers and fractions, against Boost's.
#include "compare/exact_shapes.hpp"
#include "oracle/fraction.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

using boost::multiprecision::cpp_int;
using detail::Integer;

/// Up to 370 bits. Every third lies beside a power of two where a word ends, or 256 bits.
cpp_int random_number(Random& random) {
  cpp_int number = 0;
  if (random.below(3) == 0) {
    number = (cpp_int(1) << (64 * random.integer(1, 5) - random.below(3))) + random.integer(-1, 1);
  } else {
    for (int words = random.below(8); words > 0; --words)
      number = (number << 53) + static_cast<std::int64_t>(random.between(0, 0x1p53));
  }
  return random.chance(0.5) ? number : cpp_int(-number);
}

/// The same number, made of its digits.
Integer ours(const cpp_int& number) {
  Integer made = 0;
  for (int i = 23; i >= 0; --i)
    made = (made << 31) + static_cast<std::int64_t>(cpp_int(abs(number) >> 31 * i) & 0x7fffffff);
  return number < 0 ? -made : made;
}

TEST(Integer, calculates_as_boost_does_within_256_bits_and_beyond) {
  Random random(1);
  int beyond = 0;
  for (int i = 0; i < 5'000; ++i) {
    const cpp_int a = random_number(random);
    const cpp_int b = random.below(4) == 0 ? cpp_int(random.integer(-1, 1) - a) : random_number(random);
    const int shift = random.below(140);
    ASSERT_EQ(ours(a) + ours(b), ours(a + b)) << a << " " << b;
    ASSERT_EQ(ours(a) - ours(b), ours(a - b)) << a << " " << b;
    ASSERT_EQ(ours(a) * ours(b), ours(a * b)) << a << " " << b;
    ASSERT_EQ(ours(a) << shift, ours(a << shift)) << a << " " << shift;
    ASSERT_EQ(ours(a) <=> ours(b), a.compare(b) <=> 0) << a << " " << b;
    ASSERT_EQ(ours(a).sign(), a.sign());
    ASSERT_EQ(ours(a).bit_count(), a == 0 ? 0 : static_cast<int>(msb(abs(a))) + 1) << a;
    ASSERT_EQ(static_cast<long double>(ours(a)), static_cast<long double>(a)) << a;
    beyond += msb(abs(a) + 1) >= 255 ? 1 : 0;
  }
  EXPECT_NEAR(beyond, 5'000 * (1.0 / 3 * 1.6 / 5 + 2.0 / 3 * 3 / 8), 500);
}

TEST(ExactFraction, has_the_order_of_boosts_and_its_nearest_double) {
  Random random(2);
  int halfway = 0;
  for (int i = 0; i < 5'000; ++i) {
    // Every other lies in the middle between two doubles, or beside that.
    const cpp_int middle = (cpp_int(1) << 53) + 2 * random.below(1000) + 1;
    const cpp_int over = 1 + abs(random_number(random));
    const bool is_halfway = random.chance(0.5);
    const cpp_int a = is_halfway ? cpp_int(middle * over + random.integer(-1, 1)) : random_number(random);
    const ExactFraction fraction(ours(a), ours(over));
    ASSERT_EQ(static_cast<double>(fraction), static_cast<double>(Rational(a, over))) << a << " / " << over;
    const ExactFraction other(ours(a + 1), ours(over));
    ASSERT_LT(fraction, other) << a << " / " << over;
    ASSERT_EQ(fraction + ExactFraction(1, ours(over)), other);
    ASSERT_EQ((fraction - other) * ExactFraction(ours(over), 1), -1);
    halfway += is_halfway ? 1 : 0;
  }
  EXPECT_GT(halfway, 1'700);
}

TEST(ExactFraction, of_a_double_is_that_double) {
  for (const double x : {0.0, 1.0, -0.1, 0x1p-1074, 1e300, 3 * 0x1p-60}) {
    EXPECT_EQ(static_cast<double>(ExactFraction(x)), x);
    EXPECT_EQ(ExactFraction(x) + x, 2 * x);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
