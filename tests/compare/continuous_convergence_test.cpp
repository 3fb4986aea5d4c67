/// That octagon_sweep comes to the continuous reference as its steps become short: both ways a test of the other.
#include "continuous_scenes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace paperproof::compare::continuous {
namespace {

/// Steps from 1/64 s to 1/4096 s. Below, the motion of one step towards a surface, g dt² or a dt² (6e-7 m here at
/// least), falls below 4e-7 m, which lie between where octagon_sweep stops and where it hits: then the gap decides.
constexpr std::array halvings{1, 2, 3, 4, 5, 6, 7};

double slope_of_errors(const std::array<double, halvings.size()>& errors) {
  double above = 0;
  double below = 0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double x = static_cast<double>(k) - (static_cast<double>(errors.size()) - 1) / 2;
    above -= x * std::log2(errors[k]);
    below += x * x;
  }
  return above / below;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Semi-implicit Euler is of order one. A scene's own errors scatter about that line, because an impact falls anywhere
/// into a step, and a long step may miss a ledge, or land too late for a jump, and go another way altogether: that is
/// what the share is for. All scenes together have slope 1; and no scene stays away from its reference.
TEST(ContinuousReference, octagon_sweep_comes_to_it_with_the_first_power_of_the_step) {
  constexpr int scenes = test::sampled(200);
  std::array<std::vector<double>, halvings.size()> all;
  int of_order_one = 0;
  int elsewhere = 0;
  int impacts = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const Scene scene = random_scene(static_cast<std::uint64_t>(seed));
    const Course<Number<50>> course = course_of<Number<50>>(scene, scene.input, Law::octagon_sweep);
    impacts += static_cast<int>(course.impacts.size());
    std::array<double, halvings.size()> errors{};
    for (std::size_t k = 0; k < halvings.size(); ++k) {
      errors[k] = error_of(refined(scene, halvings[k]), course);
      all[k].push_back(errors[k]);
    }
    const double slope = slope_of_errors(errors);
    of_order_one += slope >= 0.8 && slope <= 1.2 ? 1 : 0;
    elsewhere += *std::min_element(errors.end() - 3, errors.end()) > 0.1 ? 1 : 0;
    if (slope < 0.4 || slope > 2.5) RecordProperty("seed_" + std::to_string(seed), std::to_string(slope));
  }
  std::array<double, halvings.size()> medians{};
  for (std::size_t k = 0; k < halvings.size(); ++k) medians[k] = median(all[k]);
  EXPECT_NEAR(slope_of_errors(medians), 1, 0.05);
  EXPECT_GE(of_order_one, scenes * 85 / 100);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_GT(impacts, 4 * scenes);
}

}  // namespace
}  // namespace paperproof::compare::continuous
