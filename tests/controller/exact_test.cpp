#include "geometry/exact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "exact_reference.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using geometry::orientation_sign;
using geometry::orientation_sign_of_edge_offset;
using geometry::orientation_sign_of_offset;
using test::cross;
using test::ExactPoint;
using test::Rational;

/// What plain doubles make of it, and whether they can be sure.
struct InDoubles {
  int sign;
  bool undecided;
};

InDoubles in_doubles(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double value = left - right;
  const double four_roundings = 4 * 0x1p-53 * (std::abs(left) + std::abs(right));
  return {value > 0 ? 1 : value < 0 ? -1 : 0, std::abs(value) <= four_roundings};
}

/// What the cases were like: a test that never met a hard one shows nothing.
struct Coverage {
  int cases = 0;
  int zeros = 0;
  int undecided_in_doubles = 0;
  int wrong_in_doubles = 0;

  void count(int exact, const InDoubles& doubles) {
    ++cases;
    if (exact == 0) ++zeros;
    if (doubles.undecided) ++undecided_in_doubles;
    if (doubles.sign != exact) ++wrong_in_doubles;
  }
  void expect_hard_cases() const {
    EXPECT_GE(undecided_in_doubles, cases / 4);
    EXPECT_GE(wrong_in_doubles, cases / 30);
  }
};

class ExactSigns : public testing::Test {
 protected:
  static constexpr unsigned seed = 20240607;
  static constexpr int cases = test::sampled(20000);

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vec2d point(double reach) { return {uniform(-reach, reach), uniform(-reach, reach)}; }

  double an_ulp_away(double value) {
    const int direction = integer(-1, 1);
    return direction == 0 ? value : std::nextafter(value, direction * 1e308);
  }
  Vec2d an_ulp_away(const Vec2d& at) { return {an_ulp_away(at.x()), an_ulp_away(at.y())}; }
  /// Near the line through a and b, as nearly as doubles can say; now and then on it, if a and b have few digits.
  Vec2d near_line(const Vec2d& a, const Vec2d& b) {
    const double t = integer(0, 1) == 0 ? 0.5 * integer(-2, 4) : uniform(-0.5, 1.5);
    const Vec2d on_line = a + t * (b - a);
    return integer(0, 3) == 0 ? on_line : an_ulp_away(on_line);
  }
  Vec2d few_digits(const Vec2d& at, double scale) {
    return {scale * std::round(at.x() / scale), scale * std::round(at.y() / scale)};
  }
  static Vec2d without_traces(const Vec2d& at) {
    return {geometry::without_traces(at.x()), geometry::without_traces(at.y())};
  }
  double power_of_two(int range) { return std::ldexp(1.0, integer(-range, range)); }

  std::mt19937 random_{seed};
};

TEST_F(ExactSigns, orientation_agrees_with_rational_numbers_for_points_within_ulps_of_one_line) {
  Coverage coverage;
  for (int i = 0; i < cases; ++i) {
    const double scale = power_of_two(20);
    const bool few = integer(0, 4) == 0;
    const Vec2d a = few ? few_digits(point(scale), scale / 1024) : point(scale);
    const Vec2d b = few ? few_digits(point(scale), scale / 1024) : Vec2d(a + point(scale * power_of_two(10) / 1024));
    const Vec2d c = near_line(a, b);
    const int exact = cross(ExactPoint(a), ExactPoint(b), ExactPoint(c)).sign();
    ASSERT_EQ(orientation_sign(a, b, c), exact) << "seed " << seed << ", case " << i;
    coverage.count(exact, in_doubles(a, b, c));
  }
  coverage.expect_hard_cases();
  EXPECT_GE(coverage.zeros, coverage.cases / 100);
}

TEST_F(ExactSigns, orientation_of_an_offset_point_does_not_round_the_sum) {
  Coverage coverage;
  for (int i = 0; i < cases; ++i) {
    const Vec2d offset = point(1);
    const Vec2d a = point(power_of_two(20));
    const Vec2d b = a + point(power_of_two(6));
    const Vec2d position = near_line(a, b) - offset;
    const int exact = cross(ExactPoint(a), ExactPoint(b), ExactPoint(position, offset)).sign();
    ASSERT_EQ(orientation_sign_of_offset(a, b, position, offset), exact) << "seed " << seed << ", case " << i;
    coverage.count(exact, in_doubles(a, b, position + offset));
  }
  coverage.expect_hard_cases();
}

TEST_F(ExactSigns, orientation_of_an_offset_edge_does_not_round_the_sums) {
  Coverage coverage;
  for (int i = 0; i < cases; ++i) {
    const Vec2d from = point(1);
    const Vec2d to = point(1);
    const Vec2d position = point(power_of_two(20));
    const Vec2d v = near_line(position + from, position + to);
    const int exact = cross(ExactPoint(position, from), ExactPoint(position, to), ExactPoint(v)).sign();
    ASSERT_EQ(orientation_sign_of_edge_offset(position, from, to, v), exact) << "seed " << seed << ", case " << i;
    coverage.count(exact, in_doubles(position + from, position + to, v));
  }
  coverage.expect_hard_cases();
}

/// As a mover sees a point of a character within a step: position + offset - (from + part of its way).
TEST_F(ExactSigns, orientation_of_a_sum_of_many_terms_does_not_round_it) {
  Coverage coverage;
  for (int i = 0; i < cases; ++i) {
    const Vec2d offset = point(1);
    const Vec2d from = point(power_of_two(10));
    const Vec2d to = from + point(power_of_two(6));
    const double time = integer(0, 3) == 0 ? 0.5 * integer(0, 2) : uniform(0, 1);
    const Vec2d moved = from + (to - from) * time;
    const Vec2d a = point(power_of_two(10));
    const Vec2d b = a + point(power_of_two(6));
    const Vec2d position = near_line(a, b) - offset + moved;
    std::vector<Vec2d> terms{position, offset, -from};
    for (const Vec2d& part : geometry::part_of_way(from, to, time)) terms.push_back(-part);
    ExactPoint sum(position, offset);
    sum.x -= Rational(from.x()) + (Rational(to.x()) - Rational(from.x())) * Rational(time);
    sum.y -= Rational(from.y()) + (Rational(to.y()) - Rational(from.y())) * Rational(time);
    const int exact = cross(ExactPoint(a), ExactPoint(b), sum).sign();
    ASSERT_EQ(geometry::orientation_sign_of_sum(a, b, terms), exact) << "seed " << seed << ", case " << i;
    coverage.count(exact, in_doubles(a, b, position + offset - moved));
  }
  EXPECT_GE(coverage.undecided_in_doubles, coverage.cases / 10);
  EXPECT_GE(coverage.wrong_in_doubles, coverage.cases / 100);
}

TEST_F(ExactSigns, of_lengths_and_heights_agree_with_rational_numbers_within_ulps_of_a_circle) {
  int zeros = 0;
  int longer = 0;
  int further = 0;
  int separated = 0;
  for (int i = 0; i < cases / 4; ++i) {
    // 3, 4 and 5, so that lengths are exact now and then.
    const double scale = power_of_two(10);
    const bool pythagorean = integer(0, 2) == 0;
    const Vec2d arm = pythagorean ? Vec2d(3 * scale, 4 * scale) : point(scale);
    const double length = pythagorean && integer(0, 1) == 0 ? 5 * scale : an_ulp_away(arm.norm());
    const Vec2d offset = pythagorean ? few_digits(point(scale), scale / 1024) : point(scale);
    const Vec2d moved = few_digits(point(scale), scale / 1024);
    const std::array terms{Vec2d(arm - offset), offset, moved, Vec2d(-moved)};
    Rational x = 0;
    Rational y = 0;
    for (const Vec2d& term : terms) x += Rational(term.x()), y += Rational(term.y());
    const Rational squared_length = Rational(length) * Rational(length);
    const bool is_as_long = x * x + y * y >= squared_length;
    ASSERT_EQ(geometry::is_sum_as_long_as(terms, length), is_as_long) << "seed " << seed << ", case " << i;
    zeros += x * x + y * y == squared_length;
    longer += is_as_long;

    const Vec2d a = few_digits(point(scale), scale / 16);
    const Vec2d b = a + (pythagorean ? Vec2d(-4 * scale, 3 * scale) : point(scale));
    const Rational edge_x = Rational(b.x()) - Rational(a.x());
    const Rational edge_y = Rational(b.y()) - Rational(a.y());
    const Rational right = x * edge_y - y * edge_x;
    const double height = an_ulp_away(right.convert_to<double>() / (b - a).norm());
    if (height > 0) {
      const bool is_as_far =
          right >= 0 && right * right >= Rational(height) * Rational(height) * (edge_x * edge_x + edge_y * edge_y);
      ASSERT_EQ(geometry::is_sum_as_far_right(a, b, terms, height), is_as_far) << "seed " << seed << ", case " << i;
      further += is_as_far;
    }

    const Vec2d normal = arm / arm.norm();
    const double rounded_up = geometry::length_rounded_up(normal);
    const Rational square = Rational(normal.x()) * Rational(normal.x()) + Rational(normal.y()) * Rational(normal.y());
    ASSERT_GE(Rational(rounded_up) * Rational(rounded_up), square);
    const double below = std::nextafter(rounded_up, 0.0);
    ASSERT_LT(Rational(below) * Rational(below), square);
    const Rational over = Rational(normal.x()) * x + Rational(normal.y()) * y - Rational(length) * Rational(rounded_up);
    const int sign = over.sign();
    ASSERT_EQ(geometry::height_sign_of_sum(normal, terms, length, rounded_up), sign);
    separated += sign >= 0;

    const std::array others{a, Vec2d(-b), moved};
    const Rational dot = x * (Rational(moved.x()) - edge_x) + y * (Rational(moved.y()) - edge_y);
    ASSERT_EQ(geometry::dot_sign_of_sums(terms, others), dot.sign());
  }
  EXPECT_GT(zeros, cases / 200);
  for (const int some : {longer, further, separated}) {
    EXPECT_GT(some, cases / 40);
    EXPECT_LT(some, cases / 4 - cases / 40);
  }
}

TEST_F(ExactSigns, signs_are_exact_for_every_mixture_of_magnitudes_in_range) {
  const auto any = [&] {
    if (integer(0, 9) == 0) return 0.0;
    const double significand = uniform(1, 2);
    const double magnitude = std::ldexp(significand, integer(-300, 299));
    return std::copysign(magnitude, uniform(-1, 1));
  };
  int on_line = 0;
  for (int i = 0; i < cases / 4; ++i) {
    const Vec2d a{any(), any()};
    const Vec2d b = integer(0, 4) == 0 ? a : Vec2d{any(), any()};
    const Vec2d c = integer(0, 1) == 0 ? Vec2d{any(), any()} : without_traces(an_ulp_away(b));
    const Vec2d offset{any(), any()};
    const int exact = cross(ExactPoint(a), ExactPoint(b), ExactPoint(c)).sign();
    ASSERT_EQ(orientation_sign(a, b, c), exact) << "seed " << seed << ", case " << i;
    ASSERT_EQ(orientation_sign_of_offset(a, b, c, offset),
              cross(ExactPoint(a), ExactPoint(b), ExactPoint(c, offset)).sign());
    ASSERT_EQ(orientation_sign_of_edge_offset(a, b, offset, c),
              cross(ExactPoint(a, b), ExactPoint(a, offset), ExactPoint(c)).sign());
    if (exact == 0) ++on_line;
  }
  EXPECT_GE(on_line, cases / 100);
}

TEST_F(ExactSigns, left_is_positive_and_swapping_two_points_changes_the_sign) {
  EXPECT_EQ(orientation_sign({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation_sign({1, 0}, {0, 0}, {0, 1}), -1);
  EXPECT_EQ(orientation_sign({0, 0}, {1, 1}, {3, 3}), 0);
  for (int i = 0; i < cases; ++i) {
    const Vec2d a = point(1e6);
    const Vec2d b = point(1e6);
    const Vec2d c = near_line(a, b);
    ASSERT_EQ(orientation_sign(a, b, c), -orientation_sign(b, a, c)) << "seed " << seed << ", case " << i;
    ASSERT_EQ(orientation_sign(a, b, c), orientation_sign(b, c, a)) << "seed " << seed << ", case " << i;
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
