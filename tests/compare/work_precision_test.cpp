#include "studies/work_precision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

TEST(SlopeOf, is_that_of_a_line_and_none_of_a_point) {
  using Point = std::pair<double, double>;
  const std::vector<Point> line{{0, 1}, {1, 3}, {2, 5}};
  EXPECT_DOUBLE_EQ(slope_of(line).value(), 2);
  EXPECT_FALSE(slope_of(std::vector<Point>{{1, 1}}));
  EXPECT_FALSE(slope_of(std::vector<Point>{{1, 1}, {1, 2}}));
}

/// In flight every contender makes the same step, whose error is known: after n steps of h the fall is 5 h² n (n + 1)
/// instead of 5 (h n)², so 5 h t too far.
TEST(WorkPrecision, in_flight_the_error_is_that_of_the_step_and_its_slope_one) {
  const WorkPrecision found = study_work_precision({"flight"}, {"octagon_sweep", "box2d", "mask"}, {});
  int seen = 0;
  for (const Row& row : found.points) {
    ASSERT_EQ(row.verdict, Verdict::holds) << row.contender << " " << row.reason;
    if (row.parameters.size() > 1 || row.scalar == "float") continue;
    const double dt = row.parameters.front().second;
    EXPECT_NEAR(row.error_max_m.value(), 5 * dt * 1.5, 0.05 * 5 * dt * 1.5 + (row.contender == "mask" ? 0.04 : 0));
    EXPECT_GT(row.ns_per_step.value(), 0);
    ++seen;
  }
  EXPECT_EQ(seen, 12);
  for (const Row& row : found.curves)
    if (row.curve == "dt_s" && row.contender != "mask") {
      EXPECT_NEAR(row.slope.value(), 1, 0.02) << row.contender;
    }
  EXPECT_TRUE(
      std::any_of(found.points.begin(), found.points.end(), [](const Row& row) { return row.on_front == true; }));
  EXPECT_THROW((void)study_work_precision({"fligt"}, {}, {}), std::invalid_argument);
}

/// Every closed form is the motion: octagon_sweep comes to it as the step becomes small, down to the gap it keeps.
TEST(WorkPrecision, octagon_sweep_comes_to_every_closed_form) {
  const WorkPrecision found = study_work_precision({}, {"octagon_sweep"}, {});
  for (const KnownMotion& motion : known_motions()) {
    double least = 1;
    for (const Row& row : found.points)
      if (row.scene == motion.name && row.scalar == "double") least = std::min(least, row.error_max_m.value_or(1));
    EXPECT_LT(least, 0.02) << motion.name;
  }
}

}  // namespace
}  // namespace paperproof::compare
