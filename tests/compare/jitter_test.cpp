/// Jitter on made-up traces whose answers are known.
#include "metrics/jitter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

template <class Function>
std::vector<double> made(std::size_t count, const Function& function) {
  std::vector<double> positions;
  for (std::size_t k = 0; k < count; ++k) positions.push_back(function(static_cast<double>(k)));
  return positions;
}

/// 30 Hz at 60 steps per second: up in one step, down in the next.
const std::vector<double> flutter = made(120, [](double k) { return 1e-3 * (static_cast<int>(k) % 2); });
const std::vector<double> drift = made(120, [](double k) { return 1e-4 * k; });
const std::vector<double> slow = made(128, [](double k) { return std::sin(2 * std::numbers::pi * k * 3 / 128); });

TEST(SignChanges, are_all_of_a_flutter_none_of_a_drift_two_per_wave) {
  EXPECT_DOUBLE_EQ(sign_changes(flutter), 1000.0 * 118 / 119);
  EXPECT_DOUBLE_EQ(sign_changes(drift), 0);
  EXPECT_DOUBLE_EQ(sign_changes(slow), 1000.0 * 6 / 127);
  EXPECT_DOUBLE_EQ(sign_changes(made(50, [](double k) { return 1e-13 * (static_cast<int>(k) % 2); })), 0) << "rounding";
  // A toggle that stays in between: up, still, down, still.
  EXPECT_DOUBLE_EQ(sign_changes(std::vector<double>{0, 1, 1, 0, 0, 1, 1, 0, 0}), 1000.0 * 3 / 8);
  EXPECT_DOUBLE_EQ(sign_changes(std::vector<double>{1, 2}), 0);
}

TEST(UpperBandShare, is_one_for_a_flutter_none_for_a_drift_and_nothing_for_a_slow_wave) {
  EXPECT_NEAR(upper_band_share(flutter).value(), 1, 1e-3);
  EXPECT_FALSE(upper_band_share(drift)) << "a line leaves nothing";
  EXPECT_NEAR(upper_band_share(slow).value(), 0, 0.01);
  EXPECT_FALSE(upper_band_share(std::vector<double>(100, 0.625)));
  EXPECT_FALSE(upper_band_share(std::vector<double>{0, 1, 0}));
  // Two waves of which one has twice the amplitude: 4/5 of the power.
  const auto both = made(64, [](double k) {
    return 2 * std::cos(2 * std::numbers::pi * k * 24 / 64) + std::cos(2 * std::numbers::pi * k * 8 / 64);
  });
  EXPECT_NEAR(upper_band_share(both).value(), 0.8, 2e-3);
}

TEST(LogDimensionlessJerk, of_a_cubic_is_worked_out_by_hand_and_has_no_unit) {
  // x = t³ from 0 to 1: jerk 6, largest speed that of the last step.
  const auto cubic = [](double length, double duration) {
    std::vector<Vec2d> positions;
    for (int k = 0; k <= 1000; ++k) positions.emplace_back(length * std::pow(k / 1000.0, 3), 0);
    return log_dimensionless_jerk(positions, duration / 1000).value();
  };
  const double fastest = (1 - std::pow(0.999, 3)) * 1000;
  EXPECT_NEAR(cubic(1, 1), -std::log(36 * 0.998 / (fastest * fastest)), 1e-3);
  EXPECT_NEAR(cubic(1, 1), cubic(1000, 1), 1e-6);
  EXPECT_NEAR(cubic(1, 1), cubic(1, 60), 1e-6);
  EXPECT_FALSE(log_dimensionless_jerk(std::vector<Vec2d>(100, Vec2d(1, 2)), 0.01));
  EXPECT_FALSE(log_dimensionless_jerk(std::vector<Vec2d>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, 1)) << "evenly";
}

TraceStep walking(double from, double to, double height) {
  TraceStep step;
  step.path = {{{from, height}, 0}, {{to, height}, 1}};
  step.requested = {0.1, -0.01};
  step.grounded = true;
  Contact<double> floor;
  floor.normal = {0, 1};
  step.contacts = {floor};
  return step;
}

TEST(SeamHop, is_the_largest_jump_of_speed_and_height_between_two_steps_on_level_ground) {
  SceneryDef scenery;
  scenery.colliders.push_back({.points = {{0, -1}, {9, -1}, {9, 0}, {0, 0}}});
  Smoothness even(scenery);
  for (int k = 0; k < 20; ++k) even.add(walking(0.125 * k, 0.125 * (k + 1), 0.625), 1.0 / 60);
  Row row;
  even.write(row);
  EXPECT_EQ(row.seam_hop_share, 0);
  EXPECT_EQ(row.seam_hop_m, 0);
  Smoothness snags(scenery);
  snags.add(walking(0, 0.1, 0.625), 1.0 / 60);
  snags.add(walking(0.1, 0.15, 0.635), 1.0 / 60);
  TraceStep airborne = walking(0.15, 9, 3);
  airborne.grounded = false;
  snags.add(airborne, 1.0 / 60);
  snags.add(walking(9, 9.1, 0.625), 1.0 / 60);
  Row second;
  snags.write(second);
  EXPECT_NEAR(second.seam_hop_share.value(), 0.5, 1e-9);
  EXPECT_NEAR(second.seam_hop_m.value(), 0.01, 1e-9);
}

}  // namespace
}  // namespace paperproof::compare
