/// The distance from continuous motion in rows of a comparison.
#include "compare/scene_runs.hpp"
#include "runs/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

std::vector<Row> rows_of(const char* scene, Mode mode = Mode::free, bool continuous = true) {
  RunOptions options;
  options.contenders = {"octagon_sweep"};
  options.mode = mode;
  options.measure_cost = false;
  options.continuous = continuous;
  return run_scene(built_in(scene), options).rows;
}

/// After n steps of h a fall has gone g h² n (n + 1) / 2 instead of g (h n)² / 2: g h² n / 2 too far.
TEST(ContinuousError, of_a_fall_is_that_of_the_formula) {
  for (const char* name : {"fall_dt_1", "fall_dt_1e-1", "fall_dt_1e-2"}) {
    const Scene scene = built_in(name);
    const double one = -scene.gravity.y() * scene.dt * scene.dt / 2;
    const double n = scene.steps;
    const std::vector<Row> rows = rows_of(name);
    ASSERT_EQ(rows.size(), 2) << "octagon_sweep and box2d";
    for (const Row& row : rows) {
      if (row.verdict != Verdict::holds) continue;  // the fall in one step exceeds Box2D's cap
      const double rounding = row.scalar == "float" ? 1e-4 : 1e-12;
      EXPECT_NEAR(row.error_max_m.value(), one * n, rounding) << name << " " << row.contender;
      EXPECT_NEAR(row.error_rms_m.value(), one * std::sqrt((n + 1) * (2 * n + 1) / 6), rounding) << name;
    }
  }
}

TEST(ContinuousError, is_absent_where_there_is_no_law_no_course_or_nobody_asks) {
  for (const Row& row : rows_of("conveyor")) EXPECT_FALSE(row.error_max_m) << row.contender;
  for (const Row& row : rows_of("fall_dt_1e-1", Mode::lockstep)) EXPECT_FALSE(row.error_max_m) << row.contender;
  for (const Row& row : rows_of("fall_dt_1e-1", Mode::free, false)) EXPECT_FALSE(row.error_max_m) << row.contender;
}

}  // namespace
}  // namespace paperproof::compare
