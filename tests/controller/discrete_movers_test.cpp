/// The discrete technique among movers: they are bodies whose motion is given.
#include "controller/passenger.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::article_tests {
namespace {

constexpr double gap = Tolerances<double>{}.stop;
constexpr double rounding = 1e-12;

TEST(DiscreteMovers, a_block_that_arrives_over_a_resting_character_pushes_it_by_what_it_would_overlap) {
  // The face comes from -2 m to 1 m, and meets the arm at -10 px.
  Passenger passenger("discrete", {of_mover(rectangle(-6, -2, -2, 2))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {3, 0}}});
  EXPECT_NEAR(result.position.x(), 1 + 10 * px + gap, rounding);
  EXPECT_EQ(result.position.y(), 0);
  EXPECT_EQ(result.velocity, Vec2d(3, 0));
  EXPECT_NEAR(only_contact(result).fraction, (2 - 10 * px) / 3, rounding);
  EXPECT_EQ(only_contact(result).side, Side::left);
  EXPECT_NEAR(only_contact(result).separation, gap, rounding);
  EXPECT_EQ(result.status, MoveStatus::moved);
}

TEST(DiscreteMovers, paper_that_has_passed_at_the_end_of_the_step_is_not_met) {
  Passenger passenger("discrete", {of_mover(rectangle(-2.01, -2, -2, 2))});
  EXPECT_TRUE(passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {5, 0}}}).contacts.empty());
  EXPECT_EQ(passenger.position, Vec2d(0, 0));
}

TEST(DiscreteMovers, head_on_the_speeds_add_up) {
  Passenger passenger("discrete", {of_mover(rectangle(4, -2, 40, 2))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {3, 0}, {{{0, 0}, {-5, 0}}});
  EXPECT_NEAR(only_contact(result).fraction, (4 - 10 * px) / (3 + 5), rounding);
  EXPECT_NEAR(result.position.x(), 4 - 5 - 10 * px - gap, rounding);
  EXPECT_EQ(result.velocity.x(), -5);
}

TEST(DiscreteMovers, a_rider_keeps_its_place_and_its_contact_from_the_first_step_on) {
  for (const Vec2d& reach : {Vec2d{0, 3}, Vec2d{5, 0}, Vec2d{-4, 2.5}}) {
    Passenger passenger("discrete", {rectangle(-90, -9, 90, -5), of_mover(rectangle(-2, -1, 2, 0))});
    passenger.position = {0.25, 20 * px + gap};
    Vec2d place{0.25, 20 * px + gap};
    for (int step = 0; step < test::sampled(20000); ++step) {
      const MoverMotion<double> motion{swing(reach, step), swing(reach, step + 1)};
      const MoveResult<double>& result = passenger.step({motion});
      ASSERT_TRUE(result.grounded) << "step " << step;
      ASSERT_EQ(result.ride.ground, 1U);
      ASSERT_EQ(result.position, motion.to + result.ride.place);
      // The first contact begins where the fall has closed the gap: the lift has gone on a little until then.
      if (step == 0) place.x() = result.ride.place.x();
      ASSERT_NEAR(place.x(), 0.25, gap);
      ASSERT_NEAR((result.ride.place - place).norm(), 0, rounding) << "step " << step;
    }
  }
}

TEST(DiscreteMovers, closing_walls_crush_at_the_step_that_the_gap_gives) {
  // The ceiling comes down at 1/64 m per step. The gaps of rest at floor and ceiling are far below a tenth of a step.
  const double room = 10.4 / 64;
  Passenger passenger("discrete", {rectangle(-9, -3, 9, 0), of_mover(rectangle(-9, 40 * px + room, 9, 9))});
  passenger.position = {0, 20 * px + gap};
  for (int step = 1; step <= 30; ++step) {
    const MoveResult<double>& result = passenger.step({{{0, -(step - 1) / 64.0}, {0, -step / 64.0}}});
    ASSERT_EQ(result.status == MoveStatus::crushed, step >= 11) << "step " << step;
    ASSERT_GE(passenger.position.y(), 20 * px) << "never in the floor, step " << step;
    if (step < 11) continue;
    ASSERT_EQ(result.crushed.size(), 1U);
    ASSERT_EQ(result.crushed[0], 1U);
  }
}

TEST(DiscreteMovers, a_push_through_paper_that_stands_still_is_none) {
  Passenger passenger("discrete", {rectangle(0.5, -9, 0.501, 9), of_mover(rectangle(-6, -2, -2, 2))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {4, 0}}});
  EXPECT_EQ(result.status, MoveStatus::crushed);
  EXPECT_EQ(result.crushed[0], 1U);
  EXPECT_EQ(result.position, Vec2d(0, 0)) << "its last free position";
  EXPECT_EQ(result.velocity, Vec2d(0, 0));
}

TEST(DiscreteMovers, a_conveyor_carries) {
  Passenger passenger("discrete", {conveyor(rectangle(-9, -1, 9, 0), 2)});
  passenger.position = {0, 20 * px + gap};
  for (int step = 1; step <= 64; ++step) {
    passenger.step({});
    // In the first step from the time of impact on, which is half of the way of the gap and one step's fall.
    ASSERT_NEAR(passenger.position.x(), step / 32.0, 1.0 / 32) << "step " << step;
    ASSERT_EQ(passenger.velocity.x(), 2) << "step " << step;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
