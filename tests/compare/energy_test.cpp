/// Energy and jitter on made-up traces with known answers.
#include "metrics/energy.hpp"
#include "metrics/jitter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

constexpr double dt = 1.0 / 64;
const Vec2d gravity(0, -10);

TraceHeader header() {
  TraceHeader made;
  made.contender = "octagon_sweep";
  made.scalar = "double";
  made.scenery.colliders.push_back({.points = {{0, 0}, {1, 0}, {1, 1}}});
  made.ids = {"floor"};
  return made;
}

/// What happens to one character, by its positions and velocities.
class Motion {
 public:
  Motion() : energy_(header(), gravity) {}

  /// As it is wanted without input, unless `wanted` is given.
  Motion& to(const Vec2d& position, const Vec2d& velocity, bool grounded = false, std::optional<Vec2d> wanted = {},
             const std::vector<Vec2d>& touched = {}) {
    TraceStep step;
    step.path = {{position_, 0}, {position, 1}};
    step.requested = wanted.value_or(velocity_ + gravity * dt) * dt;
    step.velocity = velocity;
    step.grounded = grounded;
    for (const Vec2d& normal : touched) step.contacts.emplace_back().normal = normal;
    energy_.add(step, dt);
    position_ = position;
    velocity_ = velocity;
    return *this;
  }
  Motion& falls(int steps) {
    for (int n = 0; n < steps; ++n) {
      const Vec2d velocity = velocity_ + gravity * dt;
      to(position_ + velocity * dt, velocity);
    }
    return *this;
  }
  [[nodiscard]] Row row() const {
    Row made;
    energy_.write(made);
    return made;
  }
  [[nodiscard]] double gained() const { return row().energy_gained_j_kg.value(); }

 private:
  Energy energy_;
  Vec2d position_{0, 0};
  Vec2d velocity_{0, 0};
};

TEST(EnergyGained, is_none_in_free_flight_which_loses_half_of_g_h_squared_a_step) {
  EXPECT_EQ(Motion().to({0, 0}, {3, 20}).falls(100).gained(), 0);
}

TEST(EnergyGained, is_the_rise_above_the_least_since_something_was_put_in) {
  // 0.5 m up for nothing, 10 m/s² · 0.5 m; then down, and 1 m up.
  EXPECT_DOUBLE_EQ(Motion().to({0, 0}, {0, 0}).to({0, 0.5}, {0, 0}).gained(), 5);
  EXPECT_DOUBLE_EQ(Motion().to({0, 0}, {0, 0}).to({0, -2}, {0, 0}).to({0, -1}, {0, 0}).gained(), 10);
  // From 0 to 3 m/s, 9/2.
  EXPECT_DOUBLE_EQ(Motion().to({0, 0}, {0, 0}).to({0, 0}, {3, 0}).gained(), 4.5);
  // Little by little is no less.
  Motion creep;
  creep.to({0, 0}, {0, 0});
  for (int n = 1; n <= 100; ++n) creep.to({0, 0.001 * n}, {0, 0});
  EXPECT_NEAR(creep.gained(), 1, 1e-12);
}

TEST(EnergyGained, counts_no_jump_and_no_steering_but_what_follows) {
  const Vec2d jump(0, 8);
  EXPECT_EQ(Motion().to({0, 0}, {0, 0}, true).to(jump * dt, jump, false, jump).falls(30).gained(), 0);
  EXPECT_DOUBLE_EQ(Motion().to({0, 0}, {0, 0}, true).to(jump * dt, jump, false, jump).to(jump * dt, {0, 9}).gained(),
                   81. / 2 - 64. / 2);
  EXPECT_EQ(Motion().to({0, 0}, {0, 0}, true).to({0.1, 0}, {6, 0}, true, Vec2d(6, -0.1)).gained(), 0);
  // It ends a step on the ground, still falling; and jumps up less fast than it fell. Unasked it is a gain.
  const Vec2d fall(0, -9);
  EXPECT_EQ(Motion().to({0, 0}, fall, true).to(jump * dt, jump, false, jump).gained(), 0);
  EXPECT_DOUBLE_EQ(Motion().to({0, 0}, fall, true).to({0, 1}, {0, 9}).gained(), 10);
}

TEST(EnergyGained, of_who_walks_uphill_is_what_the_horizontal_speed_grows_by) {
  Motion uphill;
  uphill.to({0, 0}, {6, 0}, true, Vec2d(6, 0));
  for (int n = 1; n <= 10; ++n) uphill.to({0.1 * n, 0.1 * n}, {6, 6}, true);
  EXPECT_EQ(uphill.gained(), 0);
  uphill.to({1.2, 1.1}, {7, 6}, true);
  EXPECT_DOUBLE_EQ(uphill.gained(), 49. / 2 - 36. / 2);
  // Over the top of a slope within a step: it is walked on, and neither the beginning nor the end is grounded.
  const auto over = [](const Vec2d& normal) {
    return Motion().to({0, 0}, {6, -3}).to({0.1, 0.1}, {6, 5}, false, {}, {normal}).gained();
  };
  EXPECT_EQ(over({-std::sqrt(0.5), std::sqrt(0.5)}), 0);
  EXPECT_DOUBLE_EQ(over({-0.8, 0.6}), (25. - 9) / 2 + 1) << "steeper than 50 degrees";
  // A frictionless slope turns a fall into horizontal speed, and takes energy: no gain.
  EXPECT_EQ(Motion().to({0, 0}, {0, -6}).to({0.05, -0.05}, {3, -3}, true).gained(), 0);
}

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

TEST(Jitter, how_a_fall_settles_is_no_hop_at_a_seam) {
  const TraceHeader made = header();
  Smoothness walk(made.scenery);
  double x = 0;
  const auto hop_after = [&](const std::vector<double>& heights) {
    for (const double height : heights) {
      TraceStep step;
      step.path = {{Vec2d(x, height), 0}, {Vec2d(x + 0.1, height), 1}};
      x += 0.1;
      step.requested = {0.1, -0.001};
      step.grounded = true;
      step.contacts.emplace_back().normal = Vec2d(0, 1);
      walk.add(step, dt);
    }
    Row row;
    walk.write(row);
    return row.seam_hop_m.value();
  };
  EXPECT_NEAR(hop_after({0.02, 0.018, 0.017}), 2e-3, 1e-12) << "who never rests is not excused";
  EXPECT_EQ(hop_after({0.017}), 0);
  EXPECT_NEAR(hop_after({0.0175, 0.017}), 5e-4, 1e-12);
}

}  // namespace
}  // namespace paperproof::compare
