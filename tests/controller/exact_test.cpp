#include "geometry/exact.hpp"

#include "campaign/random.hpp"
#include "support/exact_points.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace paperproof {
namespace {

using test::cross;
using test::ExactPoint;
using test::Rational;

constexpr unsigned seed = 20240607;
const int cases = test::sampled(20000);

class Dice : public compare::Random {
 public:
  Dice() : Random(seed) {}
  double power_of_two(int range) { return std::ldexp(1.0, integer(-range, range)); }
  double an_ulp_away(double value) {
    const int direction = integer(-1, 1);
    return geometry::without_traces(direction == 0 ? value : std::nextafter(value, direction * 1e308));
  }
  Vec2d few_digits(double scale, double digit) { return (point(scale) / digit).array().round().matrix() * digit; }
  /// Of any magnitude.
  double any() {
    if (chance(0.1)) return 0;
    const double magnitude = std::ldexp(between(1, 2), integer(-300, 296));
    return chance(0.5) ? magnitude : -magnitude;
  }
  /// Two points of a line.
  std::pair<Vec2d, Vec2d> line() {
    if (chance(0.1)) return {Vec2d{any(), any()}, Vec2d{any(), any()}};
    const double scale = power_of_two(20);
    if (chance(0.2)) return {few_digits(scale, scale / 1024), few_digits(scale, scale / 1024)};
    const Vec2d a = point(scale);
    return {a, a + point(scale * power_of_two(10) / 1024)};
  }
  /// Near the line through a and b, as nearly as doubles can say; now and then on it, if a and b have few digits.
  Vec2d near_line(const Vec2d& a, const Vec2d& b) {
    const double t = chance(0.5) ? 0.5 * integer(-2, 4) : between(-0.5, 1.5);
    const Vec2d on_line = a + t * (b - a);
    if (chance(0.25)) return {geometry::without_traces(on_line.x()), geometry::without_traces(on_line.y())};
    return {an_ulp_away(on_line.x()), an_ulp_away(on_line.y())};
  }
  /// What a double cannot hold of a position.
  Vec2d rest() { return chance(0.5) ? Vec2d(0, 0) : point(0x1p-56); }
};

using Terms = std::vector<Vec2d>;

ExactPoint sum_of(const Terms& terms) {
  ExactPoint sum(Vec2d(0, 0));
  for (const Vec2d& term : terms) sum.x += Rational(term.x()), sum.y += Rational(term.y());
  return sum;
}

/// The orientation of three points, each the unrounded sum of terms.
int exact(const Terms& a, const Terms& b, const Terms& c) { return cross(sum_of(a), sum_of(b), sum_of(c)).sign(); }

TEST(ExactSigns, agree_with_rational_numbers_within_ulps_of_one_line) {
  Dice dice;
  int zero = 0;
  int wrong_in_doubles = 0;
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
    const auto [a, b] = dice.line();
    const Vec2d c = dice.near_line(a, b);
    const int sign = exact({a}, {b}, {c});
    ASSERT_EQ(geometry::orientation_sign(a, b, c), sign);
    const double left = (b.x() - a.x()) * (c.y() - a.y());
    const double right = (b.y() - a.y()) * (c.x() - a.x());
    zero += sign == 0;
    wrong_in_doubles += (left > right) - (left < right) != sign;

    const Vec2d offset = dice.point(1);
    const Vec2d rest = dice.rest();
    const Terms sum{c - offset, offset, rest};
    ASSERT_EQ(geometry::orientation_sign_of_sum(a, b, sum), exact({a}, {b}, sum));
    ASSERT_EQ(geometry::turn_sign(a, b, b, c), exact({Vec2d(0, 0)}, {b, -a}, {c, -b}));
    const Terms more{c - offset, offset, rest, a, -a};
    ASSERT_EQ(geometry::orientation_sign_of_sum(a, b, more), exact({a}, {b}, more));
    const Vec2d position = dice.point(dice.power_of_two(20));
    const Vec2d from = a - position;
    const Vec2d to = b - position;
    ASSERT_EQ(geometry::orientation_sign_of_sum(from, to, std::array<Vec2d, 3>{c, -position, -rest}),
              exact({position, rest, from}, {position, rest, to}, {c}));
  }
  // A test that never met a hard case shows nothing.
  EXPECT_GE(zero, cases / 100);
  EXPECT_GE(wrong_in_doubles, cases / 30);
}

TEST(ExactLengths, and_heights_agree_with_rational_numbers_within_ulps_of_a_circle) {
  Dice dice;
  int zeros = 0;
  int longer = 0;
  int further = 0;
  int separated = 0;
  for (int i = 0; i < cases / 4; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
    // 3, 4 and 5, so that lengths are exact now and then.
    const double scale = dice.power_of_two(10);
    const bool pythagorean = dice.chance(1.0 / 3);
    const Vec2d arm = pythagorean ? Vec2d(3 * scale, 4 * scale) : dice.point(scale);
    const double length = pythagorean && dice.chance(0.5) ? 5 * scale : dice.an_ulp_away(arm.norm());
    const Vec2d offset = pythagorean ? dice.few_digits(scale, scale / 1024) : dice.point(scale);
    const Vec2d moved = dice.few_digits(scale, scale / 1024);
    const Terms terms{arm - offset, offset, moved, -moved};
    const auto [x, y] = sum_of(terms);
    const Rational beyond = x * x + y * y - Rational(length) * Rational(length);
    ASSERT_EQ(geometry::is_sum_as_long_as(terms, length), beyond >= 0);
    zeros += beyond == 0;
    longer += beyond >= 0;

    const Vec2d a = dice.few_digits(scale, scale / 16);
    const Vec2d b = a + (pythagorean ? Vec2d(-4 * scale, 3 * scale) : dice.point(scale));
    const ExactPoint edge(b, -a);
    const Rational right = x * edge.y - y * edge.x;
    const double height = dice.an_ulp_away(right.convert_to<double>() / (b - a).norm());
    if (height > 0) {
      const Rational least = Rational(height) * Rational(height) * (edge.x * edge.x + edge.y * edge.y);
      const bool is_as_far = right >= 0 && right * right >= least;
      ASSERT_EQ(geometry::is_sum_as_far_right(a, b, terms, height), is_as_far);
      further += is_as_far;
    }

    const Vec2d normal = arm / arm.norm();
    const Rational nx(normal.x());
    const Rational ny(normal.y());
    const double rounded_up = geometry::length_rounded_up(normal);
    const Rational below(std::nextafter(rounded_up, 0.0));
    ASSERT_GE(Rational(rounded_up) * Rational(rounded_up), nx * nx + ny * ny);
    ASSERT_LT(below * below, nx * nx + ny * ny);
    const int sign = Rational(nx * x + ny * y - Rational(length) * Rational(rounded_up)).sign();
    ASSERT_EQ(geometry::height_sign_of_sum(normal, terms, length, rounded_up), sign);
    separated += sign >= 0;

    const Terms others{a, -b, moved};
    const auto [other_x, other_y] = sum_of(others);
    ASSERT_EQ(geometry::dot_sign_of_sums(terms, others), Rational(x * other_x + y * other_y).sign());

    const double part = dice.chance(0.25) ? 0.5 * dice.integer(0, 2) : dice.unit();
    const auto parts = geometry::part_of_way(a, b, part);
    const auto [way_x, way_y] = sum_of({parts.begin(), parts.end()});
    ASSERT_TRUE(way_x == edge.x * Rational(part) && way_y == edge.y * Rational(part));
  }
  EXPECT_GT(zeros, cases / 200);
  for (const int some : {longer, further, separated}) {
    EXPECT_GT(some, cases / 40);
    EXPECT_LT(some, cases / 4 - cases / 40);
  }
}

TEST(WithoutTraces, lengths_too_small_for_exact_products_become_zero_and_others_stay) {
  EXPECT_EQ(geometry::without_traces(std::nextafter(geometry::smallest_exact, 0)), 0);
  EXPECT_EQ(geometry::without_traces(-5e-324), 0);
  EXPECT_EQ(geometry::without_traces(-geometry::smallest_exact), -geometry::smallest_exact);
  EXPECT_EQ(geometry::without_traces(0.1), 0.1);
}

}  // namespace
}  // namespace paperproof
