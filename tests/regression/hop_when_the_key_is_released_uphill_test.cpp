// Symptom: a walker on a slope of 30 degrees whose key is released is in the air for 37 frames; with a `snap` of 0.2 m
// on a slope of 49 degrees for 79. Cause: braking slowed the walk and not its climb, so the velocity pointed off the
// slope. Remedy: on the ground the climb slows with the walk.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof {
namespace {

struct Walk : stepping::Stepper {
  /// @param rise of the slope over its run.
  Walk(double rise, const CharacterDef& character)
      : Stepper({compare::chain({{-60, -60 * rise}, {60, 60 * rise}})}, character), slope(rise) {
    at(0, 2 + slope);
  }
  StepStatus go(double move) { return step({.move = move}); }

  double slope;
};

TEST(Regression, a_walker_that_stops_or_turns_round_on_a_slope_stays_on_it) {
  for (const double degrees : {1.0, 5.0, 15.0, 30.0, 40.0, 45.0, 49.0}) {
    for (const double side : {1.0, -1.0}) {
      for (const double then : {0.0, 0.3, -0.2}) {
        for (const double acceleration : {5.0, 60.0, 1e4}) {
          const double rise = side * std::tan(degrees * compare::degree);
          Walk walk(rise, {.acceleration = acceleration, .snap = then < 0 ? 0.5 : 0.0});
          for (int i = 0; i < 150; ++i) walk.go(side);
          ASSERT_TRUE(walk.state.grounded);
          for (int i = 0; i < 240; ++i) {
            walk.go(side * then);
            ASSERT_TRUE(walk.state.grounded)
                << degrees << " degrees, move " << side * then << ", acceleration " << acceleration << ", frame " << i;
          }
          EXPECT_NEAR(walk.state.velocity.x(), side * then * 6, 1e-9);
          EXPECT_NEAR(walk.state.velocity.y(), walk.state.velocity.x() * walk.slope, 1e-9);
        }
      }
    }
  }
}

TEST(Regression, a_launch_on_the_ground_is_no_climb_and_is_not_slowed_by_braking) {
  Walk walk(0, {});
  for (int i = 0; i < 90; ++i) walk.go(1);
  walk.state.velocity.y() = 9;  // steeper than walkable ground: 9 / 6 against tan 50 degrees
  walk.go(0);
  EXPECT_NEAR(walk.state.velocity.y(), 9 - 10.0 / 60, 1e-9);
}

}  // namespace
}  // namespace paperproof
