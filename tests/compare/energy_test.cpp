/// Energy and jitter on made-up traces with known answers.
#include "metrics/energy.hpp"
#include "compare/table_file.hpp"
#include "metrics/jitter.hpp"
#include "records/collider_json.hpp"
#include "scenes/formula.hpp"

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

/// The energy that a character gains by the moves of a row of energy.json (tables/README.md) [J/kg].
double gained(const Json& moves) {
  Energy energy(header(), gravity);
  Vec2d position(0, 0);
  Vec2d velocity(0, 0);
  for (const Json& move : moves) {
    for (int n = move.value("falls", 1); n > 0; --n) {
      const Vec2d fallen = velocity + gravity * dt;
      TraceStep step;
      step.path = {{position, 0}, {position, 1}};
      step.requested = (move.contains("wanted") ? point_of(move["wanted"]) : fallen) * dt;
      velocity = move.contains("falls") ? fallen : point_of(move.value("at", Json{0, 0}));
      position = move.contains("falls") ? Vec2d(position + velocity * dt) : point_of(move.at("to"));
      step.path.back().position = position;
      step.velocity = velocity;
      step.grounded = move.value("grounded", false);
      if (move.contains("touched")) step.contacts.emplace_back().normal = point_of(move["touched"]);
      energy.add(step, dt);
    }
  }
  Row row;
  energy.write(row);
  return row.energy_gained_j_kg.value();
}

TEST(EnergyGained, is_what_no_jump_no_steering_and_no_walk_put_in) {
  Values values = constants();
  values["dt"] = dt;
  const Json file = read_table("energy.json");
  for (const Json& row : computed(file, values)) {
    const double expected = row.at("gained");
    if (row.contains("within"))
      EXPECT_NEAR(gained(row.at("moves")), expected, row["within"].get<double>()) << row.at("what");
    else
      EXPECT_DOUBLE_EQ(gained(row.at("moves")), expected) << row.at("what");
  }
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
