/// Circles in a level, and on movers that turn. That none is overlapped, the campaign judges: turning/balls.
#include "controller/played.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::test {
namespace {

using compare::circle;
using compare::half_height;

TEST(WheelThatTurns, carries_at_any_speed) {
  for (const double spin : {0.1, 1.0, 3.0, -5.0}) {  // [rad/s]
    Played ride({{circle({0, 0}, 2, 0)}}, {0, 2 + half_height + 0.01});
    ride.scratch.notes_turned = true;
    ride.steps(20);
    ride.step_by({0, 0}, spin * frame);
    ride.step_by({0, 0}, spin * frame);
    EXPECT_NEAR(ride.state.position.x(), -2 * spin * 2 * frame, 0.05 * std::abs(spin) * frame) << spin;
    EXPECT_TRUE(Controller::turned(ride.scratch).empty()) << "no step need be divided";
  }
}

TEST(RiderOfAWheel, stays_on_it_without_a_snap_until_it_is_too_steep) {
  const int wheels = sampled(200);
  int walked = 0;
  int carried = 0;
  for (int wheel = 1; wheel <= wheels; ++wheel) {
    Random random(static_cast<std::uint64_t>(wheel));
    const double radius = random.log_between(0.3, 10);
    const double spin = random.either_sign_log_between(0.02, 3 / std::max(1.0, radius));  // surface: up to 3 m/s
    const Vec2d way = random.chance(0.5) ? Vec2d(0, 0) : Vec2d(0.02, 0.01) * random.between(-1, 1);
    const double move = random.chance(0.5) ? 0 : random.between(-0.3, 0.3);
    Played ride({{circle({0, 0}, radius, 0)}}, {0, radius + half_height + 0.01});
    ride.steps(20);
    ASSERT_TRUE(ride.state.grounded) << "wheel " << wheel;
    const CharacterDef& character = ride.controller.character();
    for (int i = 0; i < 200; ++i) {
      ride.step_by(way, spin * frame, {.move = move});
      if (i == 0) continue;  // it starts with a jerk
      const Vec2d normal = ride.report.move.ground.normal;
      const double limit = std::cos((character.max_climb_degrees - 5) * std::numbers::pi / 180);
      const double turn = (std::abs(spin) + std::abs(move) * character.walk_speed / radius) * frame;
      if (ride.state.grounded && std::acos(normal.y()) + turn > std::acos(limit)) break;
      ASSERT_TRUE(ride.state.grounded) << "wheel " << wheel << " of radius " << radius << ", step " << i;
      ASSERT_EQ(ride.state.ride.ground, 0U) << "wheel " << wheel << ", step " << i;
      (move == 0 ? carried : walked) += normal.y() < 1;
    }
  }
  EXPECT_GT(carried, wheels);
  EXPECT_GT(walked, wheels);
}

TEST(WheelThatTurns, about_another_point_pushes_no_faster_than_it_comes) {
  // A disc on the rim of a wheel that turns about the origin comes from the left, again and again.
  Played ride({{circle({-2, 0.3}, 0.3, 0), compare::box(-9, -1, 9, 0)}}, {1.5, half_height + 1e-6});
  int pushed = 0;
  double fastest = 0;
  for (int i = 0; i < 600; ++i) {
    ride.step_by({0, 0}, -0.03, {.move = ride.state.position.x() > 1.5 ? -1.0 : 1.0});
    pushed += std::any_of(ride.report.move.contacts.begin(), ride.report.move.contacts.end(),
                          [](const Contact& contact) { return contact.collider == 0; });
    fastest = std::max(fastest, ride.state.velocity.norm());
  }
  EXPECT_GT(pushed, 5);
  EXPECT_LT(fastest, 3 * 2.05 * 0.03 / frame) << "squeezed between disc and floor, too";
}

}  // namespace
}  // namespace paperproof::test
