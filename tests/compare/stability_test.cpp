/// Stability: each predicate where it just holds and where it just does not, regions, borders.
#include "studies/stability.hpp"
#include "compare/table.hpp"
#include "records/rows_json.hpp"
#include "records/verdict.hpp"
#include "runs/body_energy.hpp"
#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// A run of octagon_sweep that holds in every respect, but for what a row of the table says.
void check_stability(const Json& row) {
  Json changed = row.at("row");
  for (const auto& [key, value] : row.at("row").items())
    if (value.is_null()) changed.erase(key);
  Row judged = row_of(changed);
  judge_stability(judged, row.value("slides", false));
  const Json found = row_json(judged);
  for (const auto& [key, value] : row.at("is").items()) EXPECT_EQ(found.value(key, Json()), value) << key << found;
}

const bool table = table_tests("stability.json", " row is slides ", check_stability);

TEST(StabilityPredicates, take_no_number_for_no_energy_that_is_within_its_bound) {
  Row row;
  row.body_energy_gained_j = std::nan("");
  row.body_energy_bound_j = 3;
  judge_stability(row, false);
  EXPECT_EQ(row.energy_ok, false);
}

/// A body of 2 kg on a spring of 100 N/m, 1 m long, under 10 m/s².
Scene on_a_spring() {
  Scene scene;
  scene.gravity = {0, -10};
  scene.dt = 1.0 / 64;
  scene.movers = {{.id = "body", .path = {{}}, .body = Body{.mass = 2}}};
  scene.joints = {{.id = "spring", .point = {0, 1}, .end = {0, 0}, .length = 1, .stiffness = 100}};
  return scene;
}

Row energy_of(const Scene& scene, const std::vector<double>& heights) {
  BodyEnergy energy(scene);
  for (std::size_t k = 1; k < heights.size(); ++k) {
    TraceStep step;
    step.movers = {{{0, heights[k - 1]}, {0, heights[k]}}};
    energy.add(step);
  }
  Row row;
  energy.write(row);
  return row;
}

TEST(BodyEnergyGained, is_that_of_motion_height_and_springs) {
  const Scene scene = on_a_spring();
  // At rest at 0, then at rest 0.5 m lower: 2 · 10 · -0.5 + 100 · 0.25 / 2 = 2.5 J.
  const Row row = energy_of(scene, {0, 0, -0.5, -0.5});
  const double speed = 0.5 * 64;
  EXPECT_DOUBLE_EQ(*row.body_energy_gained_j, 2.5 + 2 * speed * speed / 2);
  // 1 % of what is turned over, and rounding; nothing for its weight, as a joint holds it.
  EXPECT_NEAR(*row.body_energy_bound_j, 0.01 * (12.5 + speed * speed), 0.02);
  // At rest it is rounding alone: of the spring, k u² with u = 2 · 2^-23 m.
  EXPECT_NEAR(*energy_of(scene, {0, 0, 0}).body_energy_bound_j, 100 * std::pow(2, -44), 1e-15);
  EXPECT_EQ(energy_of(scene, {-0.2, -0.2, -0.2}).body_energy_gained_j, 0);
  Scene loose = on_a_spring();
  loose.joints.clear();
  EXPECT_NEAR(*energy_of(loose, {1, 1, 1}).body_energy_bound_j, 2 * 10 * 0.02, 1e-4);
  Scene lifted = on_a_spring();
  lifted.movers.push_back({.id = "lift", .path = {{}}});
  EXPECT_FALSE(energy_of(lifted, {0, 0}).body_energy_gained_j);
}

TEST(StabilityParts, run_box2d_once_and_all_others_in_double_and_in_float) {
  for (const StudyPart& part : stability_parts(GridSize::quick, {})) {
    EXPECT_EQ(part.sweep.axes.size(), part.sweep.border ? 0U : 2U) << part.title;
    for (const NamedContender& contender : part.sweep.contenders)
      EXPECT_EQ(part.sweep.scalars.size(), contender.name == "box2d" ? 1U : 2U) << part.title << " " << contender.name;
  }
}

TEST(StabilityParts, hold_for_octagon_sweep_in_their_first_cases_and_every_replica) {
  int replicas = 0;
  for (const StudyPart& part : stability_parts(GridSize::quick, {"octagon_sweep"})) {
    if (part.sweep.border) continue;
    std::size_t cases = 1;
    for (std::size_t k = 0; k < cases; ++k) {
      if (part.sweep.at(k).scalar != "double") continue;
      const Row row = part.run(part.sweep, k);
      EXPECT_EQ(row.verdict, Verdict::holds) << part.title << ", case " << k << ": " << row.reason;
      if (!row.events_ok) continue;
      EXPECT_TRUE(*row.events_ok) << part.title << ", case " << k;
      cases = part.sweep.size();
      ++replicas;
    }
  }
  EXPECT_GT(replicas, 2);
}

TEST(RunStable, tells_where_the_events_are_others) {
  Sweep sweep;
  sweep.scene = "ramp";
  sweep.axes = {parse_axis("angle=10,70")};
  sweep.contenders = {{"octagon_sweep"}};
  EXPECT_EQ(run_stable(sweep, 0, "angle").events_ok, true);
  const Row other = run_stable(sweep, 1, "angle");
  EXPECT_EQ(other.events_ok, false) << "a steep slope is no support";
  EXPECT_EQ(other.verdict, Verdict::flagged);
}

}  // namespace
}  // namespace paperproof::compare
