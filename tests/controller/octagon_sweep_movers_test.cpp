/// octagon_sweep among movers: carried, pushed, met head-on, crushed.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::stepping {
namespace {

constexpr Tolerances<double> tolerances{};
constexpr int an_hour = 216'000;

ColliderDef moving(ColliderDef collider, MoverIndex mover = 0) {
  collider.mover = mover;
  return collider;
}

/// Distance to the next double.
double ulp(double value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

/// Where a lift is that goes to and fro.
Vec2d ping_pong(const Vec2d& by, int steps_each_way, int step) {
  const int phase = step % (2 * steps_each_way);
  const int along = phase <= steps_each_way ? phase : 2 * steps_each_way - phase;
  return by * (static_cast<double>(along) / steps_each_way);
}

struct RideResult {
  double furthest_off_in_ulps = 0;
  int begins = 0;
  int ends = 0;
};

/// Rides for an hour on a lift 3 m wide whose top is at y = 0, and compares with where it stood on it.
RideResult ride(const Vec2d& by, int steps_each_way) {
  Stepper<double> rider({moving(rectangle(-1.5, -0.25, 1.5, 0))});
  rider.gravity = {0, -30};
  rider.at(0.1, half_height + tolerances.stop);
  rider.step();
  const Vec2d start = rider.state.position;
  RideResult result;
  bool touched = true;
  for (int step = 0; step < an_hour; ++step) {
    rider.movers[0] = {rider.movers[0].to, ping_pong(by, steps_each_way, step + 1)};
    rider.step();
    const Vec2d& lift = rider.movers[0].to;
    for (const Eigen::Index i : {0, 1}) {
      const double off = std::abs((rider.state.position[i] - lift[i]) - start[i]);
      const double larger = std::max({std::abs(rider.state.position[i]), std::abs(lift[i]), std::abs(start[i])});
      result.furthest_off_in_ulps = std::max(result.furthest_off_in_ulps, off / ulp(larger));
    }
    const bool touches = rider.state.grounded && rider.report.move.contacts.size() == 1;
    result.begins += touches && !touched;
    result.ends += !touches && touched;
    touched = touches;
  }
  return result;
}

class Lift : public ::testing::TestWithParam<Vec2d> {};

TEST_P(Lift, carries_for_an_hour_without_a_step_of_difference) {
  const RideResult result = ride(GetParam(), 97);
  EXPECT_LE(result.furthest_off_in_ulps, 1);
  EXPECT_EQ(result.begins, 0) << "besides the first";
  EXPECT_EQ(result.ends, 0);
}

INSTANTIATE_TEST_SUITE_P(UpDownAndSideways, Lift,
                         ::testing::Values(Vec2d{0, 7.3}, Vec2d{0, -7.3}, Vec2d{5.1, 0}, Vec2d{-3.3, 2.7},
                                           Vec2d{400.1, -300.7}));

TEST(HeadOn, is_met_when_the_sum_of_the_speeds_has_closed_the_distance) {
  for (const double paper : {0.0, 1e-6, 0.01}) {
    for (const double own : {0.1, 3.7, 950.0}) {
      for (const double other : {0.2, 13.3, 1e5}) {
        const double distance = 0.7 * std::min(1.0, own + other);
        const double left = half_width + distance;
        ColliderDef def = paper > 0 ? rectangle(left, -5, left + paper, 5) : chain({{left, -5}, {left, 5}});
        Stepper<double> flyer({moving(def)});
        flyer.movers[0].to = {-other, 0};
        const MoveResult<double>& move = flyer.fly(own, 0);
        ASSERT_EQ(move.contacts.size(), 1U) << own << " " << other;
        EXPECT_NEAR(move.contacts[0].fraction, (left - half_width) / (own + other), 1e-12);
        EXPECT_EQ(move.contacts[0].side, Side::right);
        EXPECT_LT(move.position.x() + half_width, left - other) << "on the side it came from";
      }
    }
  }
}

TEST(Push, by_a_wall_gives_its_normal_speed_and_nothing_along_it) {
  Stepper<double> pushed({moving(rectangle(-3, -9, -2, 9))});
  pushed.at(0, 0);
  pushed.movers[0].to = {5, 3};
  pushed.fly(0, 0);
  EXPECT_NEAR(pushed.state.position.x(), 3 + half_width, 2 * tolerances.touch);
  EXPECT_EQ(pushed.state.position.y(), 0);
  EXPECT_EQ(pushed.state.velocity.x(), 5);
  EXPECT_EQ(pushed.state.velocity.y(), 0);
  ASSERT_EQ(pushed.report.move.contacts.size(), 1U);
  // The wall's right side is at -2, the arm at -half_width.
  EXPECT_NEAR(pushed.report.move.contacts[0].fraction, (2 - half_width) / 5, 1e-12);
}

TEST(Crush, is_reported_in_the_step_that_closes_the_gap) {
  // Floor and ceiling close at 1 m/s each.
  const double gap = 1.505;
  Stepper<double> pressed({moving(rectangle(-5, -1, 5, 0), 0), moving(rectangle(-5, 2 * half_height + gap, 5, 9), 1)});
  pressed.at(0, half_height + gap / 2);
  pressed.gravity = {0, 0};
  const double closed_by_a_step = 2.0 / 60;
  const int expected = static_cast<int>(std::ceil(gap / closed_by_a_step));
  int step = 0;
  do {
    ++step;
    pressed.movers[0] = {pressed.movers[0].to, Vec2d{0, step / 60.0}};
    pressed.movers[1] = {pressed.movers[1].to, Vec2d{0, -step / 60.0}};
  } while (pressed.step() != StepStatus::crushed && step < 1000);
  EXPECT_EQ(step, expected);
  EXPECT_FALSE(pressed.report.move.crushed.empty());
}

TEST(Crush, never_pushes_through_what_stands_still) {
  Stepper<double> pressed({rectangle(-5, -1, 5, 0), moving(rectangle(-5, 3, 5, 4))});
  pressed.at(0, half_height + 0.5);
  for (int step = 1; step <= 300; ++step) {
    const StepStatus status = pressed.step_with_mover_by(0, step <= 150 ? -0.02 : 0.02);
    ASSERT_GE(pressed.state.position.y(), half_height) << step;
    // The press, 3 m above the floor, is at the character's height of 1.25 m after 87.5 and after 212.5 steps.
    const bool closed = step >= 88 && step <= 212;
    EXPECT_EQ(status == StepStatus::crushed, step == 88) << step;
    EXPECT_EQ(status == StepStatus::stuck, closed && step > 88) << step;
  }
  EXPECT_TRUE(pressed.state.grounded);
}

}  // namespace
}  // namespace paperproof::stepping
