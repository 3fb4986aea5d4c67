#include "studies/work_precision.hpp"

#include "runs/contestant.hpp"
#include "runs/input_cursor.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"

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

/// octagon_sweep comes to every motion as the step becomes small, down to the gap it keeps, and with it Box2D to that
/// of its own law, down to its skin.
TEST(WorkPrecision, each_side_comes_to_the_motion_of_its_own_law) {
  const WorkPrecision found = study_work_precision({}, {"octagon_sweep", "box2d"}, {});
  for (const Motion& motion : motions()) {
    double least = 1;
    double least_of_box2d = 1;
    for (const Row& row : found.points) {
      if (row.scene != motion.name || row.scalar != (row.contender == "box2d" ? "float" : "double")) continue;
      double& of = row.contender == "box2d" ? least_of_box2d : least;
      of = std::min(of, row.error_max_m.value_or(1));
    }
    EXPECT_LT(least, 0.03) << motion.name;
    if (motion.name != "level") {
      EXPECT_LT(least_of_box2d, 0.04) << motion.name;
    }
  }
  for (const Row& curve : found.curves)
    if (curve.scene == "level" && curve.contender == "octagon_sweep" && curve.scalar == "double" &&
        curve.curve == "dt_s") {
      EXPECT_NEAR(curve.slope.value(), 1, 0.1);
    }
}

/// The formulas of the descriptions, up to the gap of 1e-6 m at the start and rounding.
TEST(Motions, are_those_of_their_formulas) {
  const double root_3 = std::sqrt(3.0);
  const auto formula = [&](std::string_view name, double t) -> Vec2d {
    if (name == "flight") return {3 * t, 8 * t - 5 * t * t};
    if (name == "rest") return {0, std::max(2 - 5 * t * t, 0.0)};
    if (name == "slide") return Vec2d(0.5, -root_3 / 2) * (5 * root_3 / 2 * t * t);
    if (name == "corridor") return {std::min(6 * t, 2.0), 2 * t};
    if (name == "bullet") return {0, std::max(10 - 200 * t, 0.0)};
    if (name == "lift") return {0, 1.5 * t};
    return Vec2d(4 * t, 4 * t / root_3);  // walk, uphill
  };
  for (const Motion& motion : motions()) {
    if (motion.name == "level") continue;
    const Scene scene = scene_of(motion, 1.0 / 480);
    const std::vector<Vec2d> places = continuous_places(scene, continuous::Law::octagon_sweep);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(scene.steps));
    const Vec2d origin = scene.start.position - formula(motion.name, 0);
    for (int step = 1; step <= scene.steps; ++step)
      EXPECT_LT((places[static_cast<std::size_t>(step - 1)] - origin - formula(motion.name, step * scene.dt)).norm(),
                4e-6)
          << motion.name << " at the end of step " << step;
  }
}

/// Uphill nothing steers, and a body without friction loses g sin cos of its speed across: 5 sin(30) cos(30) t².
TEST(Motions, without_friction_uphill_is_another_motion) {
  const auto uphill =
      std::find_if(motions().begin(), motions().end(), [](const Motion& m) { return m.name == "uphill"; });
  const Scene scene = scene_of(*uphill, 1.0 / 60);
  const Vec2d end = continuous_places(scene, continuous::Law::frictionless).back();
  EXPECT_NEAR(end.x(), 4 - 5 * std::sqrt(3.0) / 4, 4e-6);
}

TEST(Front, is_who_has_less_error_for_less_time) {
  const auto row = [](const char* who, double dt, double error, double ns) {
    Row made;
    made.contender = who;
    made.parameters = {{"dt_s", dt}};
    made.error_max_m = error;
    made.ns_per_step = ns;
    return made;
  };
  // Times per second of motion: 1000, 2000, 4000, 4000, and one that has no time.
  std::vector<Row> rows{row("mask", 0.1, 0.5, 100), row("octagon_sweep", 0.1, 0.5, 200),
                        row("discrete", 0.05, 0.1, 200), row("wind_back", 0.05, 0.2, 200), row("grid", 0.1, 0, 0)};
  rows.back().ns_per_step.reset();
  mark_front(rows);
  EXPECT_EQ(rows[0].on_front, true);
  EXPECT_EQ(rows[1].on_front, false);
  EXPECT_EQ(rows[2].on_front, true);
  EXPECT_EQ(rows[3].on_front, false);
  EXPECT_FALSE(rows[4].on_front);
  EXPECT_EQ(
      words_of_front("fall", rows),
      "fall: on the front: mask, discrete. octagon_sweep is not: where its error is least, 0.5 m, mask has 0.5 m in "
      "50 % of the time. Both make the same motion there, and a step without the sweep of the whole octagon costs "
      "less (100 ns against 200 ns).");
}

/// A frame of four substeps is four steps of a quarter: bit for bit.
TEST(Substeps, are_steps_of_their_own_within_one_of_the_scene) {
  const Motion& level = motions().back();
  ASSERT_EQ(level.name, "level");
  const auto run = [&](double dt, const std::vector<KnobSetting>& knobs, int every) {
    const Scene scene = scene_of(level, dt);
    const Script script = script_of(scene);
    const Scenery<double> scenery(scene.scenery);
    const auto contestant = make_contestant("box2d", ScalarKind::binary32, scene, scenery, {.knobs = knobs});
    InputCursor cursor(scene, script);
    std::vector<TraceStep> records(1);
    std::vector<Vec2d> places;
    for (int step = 0; step < scene.steps; ++step) {
      records.front() = {};
      contestant->step(cursor.at(step), records);
      const std::vector<PathPoint<double>>& path = records.front().path;
      EXPECT_EQ(path.front().fraction, 0);
      EXPECT_EQ(path.back().fraction, 1);
      EXPECT_TRUE(std::is_sorted(path.begin(), path.end(),
                                 [](const auto& a, const auto& b) { return a.fraction < b.fraction; }));
      if (step % every == every - 1) places.push_back(path.back().position);
    }
    return places;
  };
  const std::vector<Vec2d> coarse = run(1.0 / 60, {{"substeps", "4"}}, 1);
  EXPECT_EQ(coarse, run(1.0 / 60 / 4, {}, 4));
  EXPECT_NE(coarse, run(1.0 / 60, {}, 1));
}

}  // namespace
}  // namespace paperproof::compare
