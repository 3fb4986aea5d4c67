/// octagon_sweep over a million steps, an hour, and a thousand kilometres: what must not change does not.
#include "controller/stepping_in_float.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

const int a_million = test::sampled(1'000'000);
const int an_hour = test::sampled(216'000);

/// Steps until position and velocity repeat, then a given number of steps more, on which nothing may change.
void expect_rest(Stepper& stepper, int steps) {
  CharacterState before;
  int settling = 0;
  do {
    before = stepper.state;
    stepper.step();
    ASSERT_LT(++settling, 600) << "does not come to rest";
  } while (!same_bits(before, stepper.state));
  ASSERT_TRUE(stepper.state.grounded);
  ASSERT_FALSE(stepper.report.move.contacts.empty());
  const std::size_t contacts = stepper.report.move.contacts.size();
  for (int n = 0; n < steps; ++n) {
    stepper.step();
    const bool same = same_bits(before.position, stepper.state.position) &&
                      same_bits(before.velocity, stepper.state.velocity) && stepper.state.grounded &&
                      stepper.report.move.contacts.size() == contacts;
    ASSERT_TRUE(same) << "step " << n << ": moved by " << (stepper.state.position - before.position).transpose();
  }
}

TEST(Rest, on_flat_ground_and_a_thousand_kilometres_away_changes_no_bit_in_a_million_steps) {
  for (const double far : {0.0, 1e6 - 8}) {
    Stepper stepper({rectangle(far - 4, far - 1, far + 4, far)});
    expect_rest(stepper.at(far + 0.3, far + half_height + 0.25), a_million);
  }
}

TEST(Rest, in_float_changes_no_bit_either) {
  Stepper flat = in_float({rectangle(-4, -1, 4, 0)});
  expect_rest(flat.at(0.3, half_height + 0.25), 100'000);
  Stepper one_way = in_float({chain({{-4, 0}, {4, 0}}, Vec2d{0, 1})});
  expect_rest(one_way.at(0.3, half_height + 0.25), 100'000);
}

/// Distance to the next double.
double ulp(double value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

/// Walks over tiles into a wall and jumps, beside an origin.
std::vector<Vec2d> journey(double origin) {
  std::vector<ColliderDef> colliders;
  for (int i = 0; i < 14; ++i) colliders.push_back(rectangle(origin + i - 1, origin - 1, origin + i, origin));
  colliders.push_back(rectangle(origin + 12, origin, origin + 13, origin + 12));
  Stepper walker(colliders);
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
    double furthest = 0;
    for (std::size_t n = 0; n < here.size(); ++n)
      furthest = std::max(furthest, (there[n] - here[n]).cwiseAbs().maxCoeff());
    // Every step is a multiple of 2^-11 m and adds without rounding, wherever it is. What is rounded is where a motion
    // stops at a gap, once at the landing, once at the wall and once at the landing after the jump.
    EXPECT_LE(furthest, 3 * ulp(origin)) << origin;
  }
}

/// Where a lift is that goes to and fro, 97 steps each way.
Vec2d ping_pong(const Vec2d& by, int step) {
  constexpr int steps_each_way = 97;
  const int phase = step % (2 * steps_each_way);
  const int along = phase <= steps_each_way ? phase : 2 * steps_each_way - phase;
  return by * (static_cast<double>(along) / steps_each_way);
}

class Lift : public ::testing::TestWithParam<Vec2d> {};

TEST_P(Lift, carries_for_an_hour_without_a_step_of_difference) {
  ColliderDef lift = rectangle(-1.5, -0.25, 1.5, 0);
  lift.mover = 0;
  Stepper rider({lift});
  rider.gravity = {0, -30};
  rider.at(0.1, half_height + Tolerances{}.stop).step();
  const Vec2d start = rider.state.position;
  double furthest_off_in_ulps = 0;
  for (int step = 1; step <= an_hour; ++step) {
    rider.movers[0] = {rider.movers[0].to, ping_pong(GetParam(), step)};
    rider.step();
    ASSERT_TRUE(rider.state.grounded && rider.report.move.contacts.size() == 1) << step;
    const Vec2d& by = rider.movers[0].to;
    for (const Eigen::Index i : {0, 1}) {
      const double off = std::abs((rider.state.position[i] - by[i]) - start[i]);
      const double larger = std::max({std::abs(rider.state.position[i]), std::abs(by[i]), std::abs(start[i])});
      furthest_off_in_ulps = std::max(furthest_off_in_ulps, off / ulp(larger));
    }
  }
  EXPECT_LE(furthest_off_in_ulps, 1);
}

INSTANTIATE_TEST_SUITE_P(UpDownAndSideways, Lift,
                         ::testing::Values(Vec2d{0, 7.3}, Vec2d{-3.3, 2.7}, Vec2d{400.1, -300.7}));

/// A belt of tiles 8 km long, which stands, or is a lift that goes up and down.
class Belt : public ::testing::TestWithParam<double> {};

TEST_P(Belt, carries_for_an_hour_without_a_toggle) {
  std::vector<ColliderDef> tiles;
  for (int i = -1; i < 8000; ++i) {
    ColliderDef tile = rectangle(i, -1, i + 1, 0);
    tile.surface_speed = 2;
    if (GetParam() != 0) tile.mover = 0;
    tiles.push_back(tile);
  }
  Stepper rider(tiles);
  rider.gravity = {0, -30};
  rider.at(0, half_height + Tolerances{}.stop).step();
  const Vec2d start = rider.state.position;
  int toggles = 0;
  double furthest_off = 0;
  for (int step = 1; step <= an_hour; ++step) {
    for (MoverMotion& lift : rider.movers) lift = {lift.to, ping_pong({0, GetParam()}, step)};
    rider.step();
    toggles += !rider.state.grounded || rider.state.ride.ground == Ride::none;
    const Vec2d lift = rider.movers.empty() ? Vec2d(0, 0) : rider.movers[0].to;
    furthest_off = std::max(furthest_off, (rider.state.position - lift - start - Vec2d(step / 30.0, 0)).norm());
  }
  EXPECT_EQ(toggles, 0);
  EXPECT_LE(furthest_off, an_hour * ulp(7200)) << "each step rounds once along the belt";
}

INSTANTIATE_TEST_SUITE_P(StandingAndMoving, Belt, ::testing::Values(0, 7.3));

}  // namespace
}  // namespace paperproof::stepping
