/// Studies of time: what a step costs for its error, and among how many pieces.
#include "studies/work_precision.hpp"

#include "compare/scene_runs.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"
#include "studies/scale.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace paperproof::compare {
namespace {

TEST(SlopeWithinARegime, is_that_of_the_finest_points_on_a_line) {
  using Points = std::vector<std::optional<std::pair<double, double>>>;
  EXPECT_DOUBLE_EQ(slope_within_a_regime(Points{{{0, 1}}, {{1, 3}}, {{2, 5}}})->value, 2);
  EXPECT_FALSE(slope_within_a_regime(Points{{{0, 1}}, {{1, 3}}})) << "two points lie on any line";
  EXPECT_FALSE(slope_within_a_regime(Points{{{0, 1}}, {{1, 3}}, {}, {{3, 7}}, {{4, 9}}})) << "one does not count";
  // Flat over four points, a jump, a slope of one over three, and one that fails.
  EXPECT_DOUBLE_EQ(
      slope_within_a_regime(Points{{{7, 5}}, {{6, 5}}, {{5, 5}}, {{4, 5}}, {{3, 0}}, {{2, -1}}, {{1, -2}}, {}})->value,
      1);
  EXPECT_FALSE(slope_within_a_regime(Points{{{0, 0}}, {{1, 3}}, {{2, -1}}, {{3, 4}}})) << "on no line";
  // Off the line y = x by e, -2 e, e: 6 e² with one degree of freedom over a sum of squares of 2; t is 12.706.
  const double off = 0.005;
  const auto near = slope_within_a_regime(Points{{{0, off}}, {{1, 1 - 2 * off}}, {{2, 2 + off}}});
  EXPECT_NEAR(near->value, 1, 1e-12);
  EXPECT_NEAR(near->within, 12.7062 * std::sqrt(6 * off * off / 2), 1e-5);
}

constexpr double root_3 = 1.7320508075688772;

/// The motions at t = n h, but for `level`. The lead of steps is h: each first adds gravity to the velocity and then
/// moves, so that n steps of an acceleration a lead a t (t + h) / 2 far. With a lead of 0 they are as described.
Vec2d formula(std::string_view name, double t, double lead) {
  const double t_squared = t * (t + lead);
  if (name == "flight") return {3 * t, 8 * t - 5 * t_squared};
  if (name == "rest") return {0, std::max(2 - 5 * t_squared, 0.0)};
  if (name == "slide") return Vec2d(0.5, -root_3 / 2) * (5 * root_3 / 2 * t_squared);
  return {0, 0};  // nothing accelerates the others
}

/// The law of steps errs by its steps alone, and a contender from it by the gap that it keeps: at most 1e-6 m times
/// 1 + 1 / sin 50° (see continuous_test.cpp), or Box2D's 15 mm. Of `level`, for which there is no formula, the error
/// falls as the step does; Box2D takes other ways through it.
TEST(WorkPrecision, steps_err_by_the_formula_and_contenders_from_them_by_their_gap) {
  const WorkPrecision found = study_work_precision({}, {"octagon_sweep", "box2d"}, {});
  int seen = 0;
  int decided_by_gap = 0;
  for (const Row& row : found.points) {
    if (row.parameters.size() > 1) continue;
    if (is_guaranteed(row)) decided_by_gap += row.error_law_max_m.value() > 2.31e-6;
    if (row.scene == "level") continue;
    const double h = row.parameters.front().second;
    // Its time of impact is within a quarter of its slop of 5 mm; it goes no more than 2 m a step.
    if (row.contender == "box2d" && row.scene != "bullet") {
      EXPECT_NEAR(row.error_law_max_m.value(), row.scene == "flight" ? 0 : box2d::rest_gap, 0.002) << row.scene << h;
    }
    if (row.contender != law_of_steps) continue;
    double error = 0;
    double squares = 0;
    for (int n = 1; n <= row.steps; ++n) {
      const double now = (formula(row.scene, n * h, h) - formula(row.scene, n * h, 0)).norm();
      error = std::max(error, now);
      squares += now * now;
    }
    EXPECT_NEAR(row.error_max_m.value(), error, 1e-9) << row.scene << h;
    EXPECT_NEAR(row.error_rms_m.value(), std::sqrt(squares / row.steps), 1e-9) << row.scene << h;
    ++seen;
  }
  EXPECT_EQ(seen, 8 * 6);
  EXPECT_EQ(decided_by_gap, 1) << "at 1/480 s a step of level ends on a crest";
  for (const Row& curve : found.curves)
    if (curve.curve == "dt_s" && curve.scene == "level" && curve.scalar == "double") {
      EXPECT_NEAR(curve.slope.value(), 1, 0.1) << curve.contender;
    }
  EXPECT_TRUE(
      std::any_of(found.points.begin(), found.points.end(), [](const Row& row) { return row.on_front == true; }));
  EXPECT_THROW((void)study_work_precision({"fligt"}, {}, {}), std::invalid_argument);
}

/// A frame of four substeps is four steps of a quarter: bit for bit.
TEST(Substeps, are_steps_of_their_own_within_one_of_the_scene) {
  const Motion& level = motions().back();
  ASSERT_EQ(level.name, "level");
  const auto run = [&](double dt, const std::vector<KnobSetting>& knobs, std::size_t every) {
    const Scene scene = scene_of(level, dt);
    const Scenery scenery(scene.scenery);
    const auto contender = make_contender("box2d", ScalarKind::binary32, scene, scenery, {.knobs = knobs});
    std::vector<TraceStep> records(1);
    const std::vector<Vec2d> way =
        way_of(*contender, scene, [&](const StepInput& now, std::size_t) { contender->step(now, records); });
    std::vector<Vec2d> places;
    for (std::size_t step = every - 1; step < way.size(); step += every) places.push_back(way[step]);
    return places;
  };
  const std::vector<Vec2d> coarse = run(1.0 / 60, {{"substeps", "4"}}, 1);
  EXPECT_EQ(coarse, run(1.0 / 60 / 4, {}, 4));
  EXPECT_NE(coarse, run(1.0 / 60, {}, 1));
}

TEST(StudyScale, tells_times_that_another_clock_has_seen_pass_with_a_tree_and_without_and_that_both_move_alike) {
  constexpr int repeats = 9;
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<ScalePoint> points = study_scale({100, 300}, {});
  const double elapsed = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const ScalePoint& p) { return p.pieces == 300; }), 2);
  ASSERT_EQ(points.size(), 4U);
  double least = 0;
  double most = 0;
  for (const ScalePoint& point : points) {
    EXPECT_TRUE(point.same_bits) << name_of(point.search) << " " << point.pieces;
    least += repeats * point.steps * point.ns_per_step_min;
    most += repeats * point.steps * point.ns_per_step_max;
  }
  EXPECT_LE(least, elapsed);
  // The total also holds one untimed run and the building of 400 tiles.
  EXPECT_GE(most, elapsed / 4);
}

TEST(StudyScale, growth_is_from_the_fewest_pieces_to_the_most) {
  const std::vector<ScalePoint> points{{.search = PieceSearch::grid, .pieces = 1000, .ns_per_step_min = 60},
                                       {.search = PieceSearch::grid, .pieces = 100, .ns_per_step_min = 50},
                                       {.search = PieceSearch::one_by_one, .pieces = 10000, .ns_per_step_min = 9},
                                       {.search = PieceSearch::grid, .pieces = 500, .ns_per_step_min = 900}};
  EXPECT_DOUBLE_EQ(growth(points, PieceSearch::grid), 60.0 / 50);
  EXPECT_DOUBLE_EQ(growth(points, PieceSearch::one_by_one), 1);
}

}  // namespace
}  // namespace paperproof::compare
