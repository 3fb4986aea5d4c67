#include "studies/scale.hpp"

#include <paperproof/plan.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace paperproof::compare {
namespace {

TEST(StudyScale, every_broad_phase_moves_the_character_alike_at_every_size) {
  const std::vector<ScalePoint> points = study_scale({100, 300}, {});
  ASSERT_EQ(points.size(), 6U);
  for (const ScalePoint& point : points)
    EXPECT_TRUE(point.same_bits) << name_of(point.broad_phase) << " " << point.pieces;
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const ScalePoint& p) { return p.pieces == 300; }), 3);
}

TEST(StudyScale, tells_times_that_another_clock_has_seen_pass) {
  constexpr int repeats = 9;
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<ScalePoint> points = study_scale({300}, {});
  const double elapsed = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
  double least = 0;
  double most = 0;
  for (const ScalePoint& point : points) {
    least += repeats * point.steps * point.ns_per_step_min;
    most += repeats * point.steps * point.ns_per_step_max;
  }
  EXPECT_LE(least, elapsed);
  // Beside the repeats there is one run untimed, and what it takes to build 300 tiles.
  EXPECT_GE(most, elapsed / 4);
}

TEST(StudyScale, refuses_a_number_of_pieces_that_is_no_floor) {
  EXPECT_THROW((void)study_scale({0}, {}), std::invalid_argument);
  EXPECT_THROW((void)study_scale({100, 150}, {}), std::invalid_argument);
  EXPECT_THROW((void)study_scale({100, most_tiles + tiles_per_floor}, {}), std::invalid_argument);
}

TEST(StudyScale, growth_is_from_the_fewest_pieces_to_the_most) {
  const std::vector<ScalePoint> points{{.broad_phase = BroadPhaseKind::tree, .pieces = 1000, .ns_per_step_min = 60},
                                       {.broad_phase = BroadPhaseKind::tree, .pieces = 100, .ns_per_step_min = 50},
                                       {.broad_phase = BroadPhaseKind::buckets, .pieces = 10000, .ns_per_step_min = 9},
                                       {.broad_phase = BroadPhaseKind::tree, .pieces = 500, .ns_per_step_min = 900}};
  EXPECT_DOUBLE_EQ(growth(points, BroadPhaseKind::tree), 60.0 / 50);
  EXPECT_DOUBLE_EQ(growth(points, BroadPhaseKind::buckets), 1);
}

}  // namespace
}  // namespace paperproof::compare
