/// What becomes of a velocity that met surfaces: both laws in closed form.
#include "metrics/response_laws.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

const double half = std::sqrt(0.5);

MetSurface surface(double x, double y, bool walkable = false) {
  MetSurface one;
  one.normal = {x, y};
  one.walkable = walkable;
  return one;
}

bool has(const std::vector<Vec2d>& outcomes, const Vec2d& velocity) {
  return distance_from(outcomes, velocity) <= 1e-12;
}

TEST(FrictionlessLaw, loses_the_part_into_one_surface) {
  const std::array slope{surface(-half, half)};
  EXPECT_TRUE(has(frictionless_outcomes({1, 0}, slope), {0.5, 0.5}));
  EXPECT_FALSE(has(frictionless_outcomes({1, 0}, slope), {1, 1})) << "that is the law of the controller";
  EXPECT_EQ(frictionless_outcomes({-1, 0}, slope).size(), 1U) << "what leaves a surface stays as it is";
}

TEST(FrictionlessLaw, ends_between_two_surfaces_that_both_hold) {
  const std::array corner{surface(0, 1), surface(-1, 0)};
  EXPECT_TRUE(has(frictionless_outcomes({2, -3}, corner), {0, 0}));
  EXPECT_TRUE(has(frictionless_outcomes({2, -3}, corner), {2, 0})) << "the floor may be met alone";
  EXPECT_FALSE(has(frictionless_outcomes({2, -3}, corner), {-2, 0}));
}

TEST(FrictionlessLaw, is_relative_to_what_moves) {
  std::array lift{surface(0, 1)};
  lift[0].velocity = {0, 2};
  EXPECT_TRUE(has(frictionless_outcomes({1, 0}, lift), {1, 2}));
  EXPECT_FALSE(has(frictionless_outcomes({1, 0}, lift), {1, 0.5}));
}

/// Between a wall and a slope of 45 degrees each round halves what is left: cos² of the angle between the normals.
TEST(IteratedLaw, leaves_a_part_that_shrinks_with_every_round) {
  const std::array corner{surface(-1, 0), surface(-half, half)};
  const Vec2d wanted(1, -0.5);
  Vec2d v = wanted;
  double of_wall = 0;
  double of_slope = 0;
  const auto push = [&v](const Vec2d& n, double& sum) {
    const double next = std::max(sum - v.dot(n), 0.0);
    v += (next - sum) * n;
    sum = next;
  };
  for (int round = 1; round <= 8; ++round) {
    push(corner[1].normal, of_slope);
    push(corner[0].normal, of_wall);
    EXPECT_TRUE(is_short_of_limit(wanted, v, corner, Vec2d::Zero(), round)) << round;
    EXPECT_LE(v.norm(), 2 * std::pow(0.5, round)) << round;
  }
  EXPECT_FALSE(is_short_of_limit(wanted, v + Vec2d(0.1, 0), corner, Vec2d::Zero(), 8)) << "more than 8 rounds leave";
  EXPECT_FALSE(is_short_of_limit(wanted, wanted, std::array{surface(-1, 0)}, Vec2d::Zero(), 8)) << "one surface";
  EXPECT_FALSE(is_short_of_limit({0, 1}, {0, 2}, corner, Vec2d::Zero(), 1)) << "no push along the normals makes that";
}

TEST(TiltedLaw, is_a_push_along_nearly_the_normal_that_ends_the_entering) {
  const std::array floor{surface(0, 1)};
  const Vec2d wanted(2, -1);
  const Vec2d normal = Vec2d(-0.01, 1).normalized();
  const Vec2d turned = wanted - wanted.dot(normal) * normal;
  EXPECT_TRUE(is_turned_by_tilt(wanted, turned, floor, 0.011));
  EXPECT_FALSE(is_turned_by_tilt(wanted, turned, floor, 0.009));
  EXPECT_FALSE(is_turned_by_tilt(wanted, wanted - 0.9 * wanted.dot(normal) * normal, floor, 0.011));
  EXPECT_FALSE(is_turned_by_tilt(wanted, wanted, floor, 0.011)) << "nothing was turned";
}

TEST(ControlledLaw, ends_between_ground_and_what_pushes_along_it) {
  std::array pressed{surface(0, 1, true), surface(half, -half)};
  pressed[1].velocity = {0.5, -0.5};
  EXPECT_TRUE(has(controlled_outcomes({{-1, -0.5}, {-1, -0.5}}, pressed), {1, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{-1, -0.5}, {-1, -0.5}}, pressed), {-1, 0}));
}

TEST(ControlledLaw, keeps_the_horizontal_part_on_walkable_ground_alone) {
  const SteeredVelocity walk{{1, -0.5}, {1, -0.5}};
  const std::array ground{surface(-half, half, true)};
  EXPECT_TRUE(has(controlled_outcomes(walk, ground), {1, 1}));
  const std::array steep{surface(-half, half)};
  EXPECT_FALSE(has(controlled_outcomes(walk, steep), {1, 1}));
  // The horizontal part that presses in dies, and what falls slides: (0, -0.5) less its part along the normal.
  EXPECT_TRUE(has(controlled_outcomes(walk, steep), {-0.25, -0.25}));
}

TEST(ControlledLaw, steering_holds_no_fall) {
  const std::array steep{surface(-half, half)};
  const SteeredVelocity uphill{{1, -2}, {0, -2}};
  const SteeredVelocity idle{{0, -2}, {0, -2}};
  EXPECT_TRUE(has(controlled_outcomes(uphill, steep), {-1, -1}));
  EXPECT_TRUE(has(controlled_outcomes(idle, steep), {-1, -1}));
  EXPECT_FALSE(has(controlled_outcomes(uphill, steep), {-0.5, -0.5}));
}

TEST(ControlledLaw, ends_between_ground_and_a_steep_surface) {
  const std::array corner{surface(-half, half), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{1, -0.5}, {0, -0.5}}, corner), {0, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{1, -0.5}, {0, -0.5}}, corner), {1, 0}));
}

TEST(ControlledLaw, a_rise_ends_under_a_ceiling) {
  const std::array ceiling{surface(0, -1)};
  EXPECT_TRUE(has(controlled_outcomes({{1, 3}, {1, 3}}, ceiling), {1, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{1, 3}, {1, 3}}, ceiling), {1, 3}));
}

TEST(ControlledLaw, a_slide_ends_on_the_floor_that_it_comes_to) {
  const std::array foot{surface(half, half), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{0, -4}, {0, -4}}, foot), {2, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{0, -4}, {0, -4}}, foot), {2, 2}));
}

TEST(ControlledLaw, steering_that_a_wall_took_is_there_again_when_the_wall_is_left) {
  const std::array past{surface(1, 0), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{-1, -4}, {0, -4}}, past), {-1, 0}));
  EXPECT_TRUE(has(controlled_outcomes({{-1, -4}, {0, -4}}, past), {0, 0})) << "beside the wall";
}

TEST(ControlledLaw, what_is_only_touched_where_the_step_ends_takes_nothing) {
  std::array floor{surface(0, 1, true)};
  floor[0].at_end = true;
  EXPECT_TRUE(has(controlled_outcomes({{1, -3}, {1, -3}}, floor), {1, -3}));
  EXPECT_TRUE(has(controlled_outcomes({{1, -3}, {1, -3}}, floor), {1, 0})) << "ground is followed";
}

}  // namespace
}  // namespace paperproof::compare
