/// octagon_sweep at rest, far away, and at other scales: what must not change does not.
#include "controller/stepping.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int a_million = test::sampled(1'000'000);

/// Steps until position and velocity repeat, then a given number of steps more, on which nothing may change.
template <class Scalar>
void expect_rest(Stepper<Scalar>& stepper, const Input& input, int steps) {
  CharacterState<Scalar> before;
  int settling = 0;
  do {
    before = stepper.state;
    stepper.step(input);
    ASSERT_LT(++settling, 600) << "does not come to rest";
  } while (!same_bits(before, stepper.state));
  ASSERT_TRUE(stepper.state.grounded);
  ASSERT_FALSE(stepper.report.move.contacts.empty());
  const std::size_t contacts = stepper.report.move.contacts.size();
  for (int n = 0; n < steps; ++n) {
    stepper.step(input);
    const bool same = same_bits(before.position, stepper.state.position) &&
                      same_bits(before.velocity, stepper.state.velocity) && stepper.state.grounded &&
                      stepper.report.move.contacts.size() == contacts;
    ASSERT_TRUE(same) << "step " << n << ": moved by " << (stepper.state.position - before.position).transpose();
  }
}

TEST(Rest, on_flat_ground_changes_no_bit_in_a_million_steps) {
  Stepper<double> stepper({rectangle(-4, -1, 4, 0)});
  expect_rest(stepper.at(0.3, half_height + 0.25), {}, a_million);
}

TEST(Rest, on_a_slope_of_30_degrees_changes_no_bit_in_a_million_steps) {
  const double rise = 4 * std::tan(30 * degree);
  Stepper<double> stepper({polygon({{-4, -9}, {4, -9}, {4, rise}, {-4, -rise}})});
  expect_rest(stepper.at(0.3, half_height + 0.6), {}, a_million);
}

TEST(Rest, in_a_wedge_changes_no_bit_in_a_million_steps) {
  const double half = 5 * std::tan(20 * degree);
  Stepper<double> stepper(
      {polygon({{0, 0}, {half, 5}, {half + 1, 5}, {half + 1, -1}, {-half - 1, -1}, {-half - 1, 5}, {-half, 5}})});
  expect_rest(stepper.at(0.01, 3), {}, a_million);
}

TEST(Rest, walking_into_a_corner_changes_no_bit_in_a_million_steps) {
  Stepper<double> stepper({rectangle(-4, -1, 4, 0), rectangle(1, 0, 2, 3)});
  expect_rest(stepper.at(0, half_height + 0.1), {.move = 1}, a_million);
}

TEST(Rest, on_a_one_way_platform_changes_no_bit_in_a_million_steps) {
  Stepper<double> stepper({chain({{-4, 0}, {4, 0}}, Vec2d{0, 1})});
  expect_rest(stepper.at(0.3, half_height + 0.25), {}, a_million);
}

TEST(Rest, under_a_gravity_of_a_million_changes_no_bit_in_a_million_steps) {
  Stepper<double> stepper({rectangle(-4, -1, 4, 0)});
  stepper.gravity = {0, -1e6};
  expect_rest(stepper.at(0.3, half_height + 0.25), {}, a_million);
}

TEST(Rest, a_thousand_kilometres_away_changes_no_bit_in_a_million_steps) {
  const double far = 1e6 - 8;
  Stepper<double> stepper({rectangle(far - 4, far - 1, far + 4, far)});
  expect_rest(stepper.at(far + 0.3, far + half_height + 0.25), {}, a_million);
}

TEST(Rest, in_float_changes_no_bit_either) {
  Stepper<float> flat({rectangle(-4, -1, 4, 0)});
  expect_rest(flat.at(0.3, half_height + 0.25), {}, 100'000);
  Stepper<float> one_way({chain({{-4, 0}, {4, 0}}, Vec2d{0, 1})});
  expect_rest(one_way.at(0.3, half_height + 0.25), {}, 100'000);
}

TEST(RestGap, does_not_depend_on_gravity) {
  for (const double gravity : {10.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    Stepper<double> stepper({rectangle(-4, -1, 4, 0)});
    stepper.gravity = {0, -gravity};
    stepper.at(0, half_height + 0.25).steps(120);
    // It stops where the gap is `stop`; the last fall of up to g/3600 m is cut to 2^-53 of its length.
    const double rounding = 4 * gravity / 3600 * 0x1p-53 + 1e-15;
    EXPECT_NEAR(stepper.state.position.y() - half_height, Tolerances<double>{}.stop, rounding) << gravity;
  }
}

/// The fraction of a flight to a slanted wall, everything multiplied by `scale`.
double fraction_at(double scale) {
  std::vector<Vec2d> points;
  const CharacterShape article = CharacterShape::article();
  for (const Vec2d& point : article.points()) points.push_back(point * scale);
  CharacterDef character;
  character.shape = CharacterShape(points);
  const auto at = [scale](double x, double y) { return Vec2d{x * scale, y * scale}; };
  Stepper<double> flyer({polygon({at(2, -5), at(3, -5), at(5, 6), at(4, 6)})}, character);
  const MoveResult<double>& move = flyer.at(0.3 * scale, 0.2 * scale).fly(7.7 * scale, -1.3 * scale);
  EXPECT_FALSE(move.contacts.empty()) << scale;
  return move.contacts.empty() ? -1 : move.contacts[0].fraction;
}

TEST(Scale, by_a_power_of_two_gives_the_same_bits_of_the_time_of_impact) {
  const double expected = fraction_at(1);
  // The wall's left edge goes from (2, -5) to (4, 6): n = (11, -2) / sqrt(125) towards it; the arm (10, -10) px is the
  // octagon's furthest point along it.
  const Vec2d n = Vec2d{11, -2} / std::sqrt(125.0);
  const double distance = n.dot(Vec2d{2, -5} - Vec2d{0.3, 0.2} - Vec2d{10 * px, -10 * px});
  EXPECT_NEAR(expected, distance / n.dot(Vec2d{7.7, -1.3}), 1e-14);
  for (int k = -13; k <= 13; ++k) EXPECT_TRUE(same_bits(fraction_at(std::ldexp(1.0, k)), expected)) << "2^" << k;
}

/// Walks over tiles into a wall and jumps, beside an origin.
std::vector<Vec2d> journey(double origin) {
  std::vector<ColliderDef> colliders;
  for (int i = 0; i < 14; ++i) colliders.push_back(rectangle(origin + i - 1, origin - 1, origin + i, origin));
  colliders.push_back(rectangle(origin + 12, origin, origin + 13, origin + 12));
  Stepper<double> walker(colliders);
  walker.dt = 1.0 / 64;
  walker.at(origin + 0.5, origin + half_height + px);
  std::vector<Vec2d> positions;
  for (int n = 0; n < 240; ++n) {
    walker.step({.move = 1, .jump = n >= 90 && n < 100});
    positions.push_back(walker.state.position - Vec2d{origin, origin});
  }
  return positions;
}

TEST(Origin, moved_by_up_to_a_thousand_kilometres_changes_nothing_but_the_last_bits) {
  const std::vector<Vec2d> here = journey(0);
  ASSERT_NEAR(here.back().x(), 12 - half_width, 1e-6) << "it reaches the wall";
  for (const double origin : {1024.0, 16384.0, 131072.0, 983040.0, -983040.0}) {
    const std::vector<Vec2d> there = journey(origin);
    const double ulp = std::nextafter(std::abs(origin), 2e6) - std::abs(origin);
    double furthest = 0;
    for (std::size_t n = 0; n < here.size(); ++n)
      furthest = std::max(furthest, (there[n] - here[n]).cwiseAbs().maxCoeff());
    // Every step is a multiple of 2^-11 m and adds without rounding, wherever it is. What is rounded is where a motion
    // stops at a gap, once at the landing, once at the wall and once at the landing after the jump.
    EXPECT_LE(furthest, 3 * ulp) << origin;
    std::printf("origin %.0f m: up to %.3g m off, %.1f ulp\n", origin, furthest, furthest / ulp);
  }
}

}  // namespace
}  // namespace paperproof::stepping
