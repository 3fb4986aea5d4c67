/// The judge's numbers, against Boost's.
#include "compare/exact_shapes.hpp"
#include "oracle/doubled.hpp"
#include "oracle/fraction.hpp"
#include "oracle/number.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

using boost::multiprecision::cpp_int;
using detail::Integer;
using detail::Ratio;

/// Up to 370 bits. Every third lies beside a power of two.
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

ExactFraction fraction_of(const cpp_int& numerator, const cpp_int& denominator) {
  return ExactFraction(Ratio{Integer(numerator), Integer(denominator)});
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
    const ExactFraction fraction = fraction_of(a, over);
    ASSERT_EQ(static_cast<double>(fraction), static_cast<double>(Rational(a, over))) << a << " / " << over;
    const ExactFraction other = fraction_of(a + 1, over);
    ASSERT_LT(fraction, other) << a << " / " << over;
    ASSERT_EQ(fraction + fraction_of(1, over), other);
    ASSERT_EQ((fraction - other) * fraction_of(over, 1), -1);
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

/// Sums, differences and products of doubles as the judge makes them, most of them nearly nothing.
TEST(Doubled, is_no_farther_from_the_exact_value_than_it_says_and_that_is_next_to_nothing) {
  Random random(3);
  int exactly = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double size = std::ldexp(1.0, random.integer(-40, 40));
    const auto draw = [&] { return random.chance(0.2) ? random.integer(-4, 4) * size : random.between(-size, size); };
    const double a = draw();
    const double b = draw();
    const double near_a = random.chance(0.5) ? a : std::nextafter(a, 1e300);
    const double d = draw();
    const auto value = [](double x) { return detail::Doubled{x}; };
    const detail::Doubled made =
        (value(a) + value(b) - value(d)) * (value(a) - value(near_a) + value(b)) - (value(b) - value(d)) * value(b);
    const Rational exact = (Rational(a) + b - d) * (Rational(a) - near_a + b) - (Rational(b) - d) * b;
    ASSERT_LE(abs(Rational(made.value) + made.rest - exact), made.radius) << a << " " << b << " " << near_a << " " << d;
    ASSERT_LE(made.radius, 0x1p-95 * size * size) << a << " " << b << " " << near_a << " " << d;
    ASSERT_LE(std::abs(made.rest), 0x1p-52 * std::abs(made.value));
    exactly += made.radius == 0 ? 1 : 0;
  }
  EXPECT_GT(exactly, 100);
}

TEST(Doubled, says_so_where_a_product_underflows) {
  const detail::Doubled tiny{0x1p-540 / 3};
  const detail::Doubled square = tiny * tiny;
  EXPECT_LE(abs(Rational(square.value) + square.rest - Rational(tiny.value) * tiny.value), square.radius);
  EXPECT_GT(square.radius, 0);
}

}  // namespace
}  // namespace paperproof::compare::test
