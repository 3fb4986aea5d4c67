/// octagon_sweep carries for an hour. What stands still at rest is in tests/situations/rest.json.
#include "controller/stepping.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

const int an_hour = test::sampled(216'000);

/// Distance to the next double.
double ulp(double value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

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
