/// Stability: each predicate where it just holds and where it just does not, regions, borders.
#include "studies/stability.hpp"
#include "records/verdict.hpp"
#include "runs/body_energy.hpp"
#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace paperproof::compare {
namespace {

/// A run of octagon_sweep that holds in every respect.
Row held() {
  Row row;
  row.contender = "octagon_sweep";
  row.steps = 100;
  row.finite = true;
  row.tunnels = row.steps_ending_inside = row.hanging_steps = row.stuck_refuted = 0;
  row.rest_peak_to_peak_m = 0;
  row.energy_gained_j_kg = 0;
  row.energy_bound_j_kg = 1e-5;
  return row;
}

Row judged(const std::function<void(Row&)>& change, bool slides = false) {
  Row row = held();
  change(row);
  judge_stability(row, slides);
  return row;
}

using Predicate = std::optional<bool> Row::*;

/// A name, a change of the row, a predicate, and its value after the change; none: the predicate is not asked.
using Judged = std::tuple<const char*, std::function<void(Row&)>, Predicate, std::optional<bool>>;

void rests(Row& row, double drift, const char* contender, const char* scalar, double origin = 0) {
  row.contender = contender;
  row.scalar = scalar;
  row.parameters = {{"origin_m", origin}};
  row.rest_peak_to_peak_m = drift;
}

void bodies_gain(Row& row, double energy) {
  row.body_energy_gained_j = energy;
  row.body_energy_bound_j = 3;
}

TEST(StabilityPredicates, hold_up_to_their_bounds_and_no_further) {
  const Predicate drift = &Row::drift_ok;
  const Predicate energy = &Row::energy_ok;
  const Predicate penetration = &Row::penetration_ok;
  for (const auto& [of, change, predicate, expected] : std::vector<Judged>{
           {"what octagon_sweep promises", [](Row& r) { r.rest_peak_to_peak_m = 1e-6; }, drift, true},
           {"more than that", [](Row& r) { r.rest_peak_to_peak_m = 1.001e-6; }, drift, false},
           // An ulp there is 0.0625 m, and the bound two: 2 · 2^-23 · 1e6.
           {"float far out", [](Row& r) { rests(r, 0.2, "octagon_sweep", "float", 1e6); }, drift, true},
           {"more of float far out", [](Row& r) { rests(r, 0.25, "octagon_sweep", "float", 1e6); }, drift, false},
           {"double far out", [](Row& r) { rests(r, 1.1e-6, "octagon_sweep", "double", 1e6); }, drift, false},
           {"what is seen of others", [](Row& r) { rests(r, 1e-4, "box2d", "float"); }, drift, true},
           {"more than that of others", [](Row& r) { rests(r, 1.01e-4, "box2d", "float"); }, drift, false},
           {"who never rests", [](Row& r) { r.rest_peak_to_peak_m.reset(); }, drift, {}},
           {"whom others push", [](Row& r) { r.characters = r.rest_peak_to_peak_m.emplace(2); }, drift, {}},
           {"its bound", [](Row& r) { r.energy_gained_j_kg = 1e-5; }, energy, true},
           {"more than its bound", [](Row& r) { r.energy_gained_j_kg = 1.001e-5; }, energy, false},
           {"the bound of bodies", [](Row& r) { bodies_gain(r, 3); }, energy, true},
           {"more than that", [](Row& r) { bodies_gain(r, 3.01); }, energy, false},
           {"no number", [](Row& r) { bodies_gain(r, std::nan("")); }, energy, false},
           {"a tunnel", [](Row& r) { r.tunnels = 1; }, penetration, false},
           {"a step inside", [](Row& r) { r.steps_ending_inside = 1; }, penetration, false},
           {"5 mm of bodies", [](Row& r) { r.body_max_penetration_m = 0.005; }, penetration, true},
           {"more of bodies", [](Row& r) { r.body_max_penetration_m = 0.0051; }, penetration, false},
           {"a tunnel of a body", [](Row& r) { r.body_tunnels = 1; }, penetration, false},
           {"a step that hangs", [](Row& r) { r.hanging_steps = 1; }, &Row::hanging_ok, false},
           {"a step stuck in nothing", [](Row& r) { r.stuck_refuted = 1; }, &Row::hanging_ok, false},
           {"no replica", [](Row&) {}, &Row::events_ok, {}},
           {"what did not run", [](Row& r) { r.verdict = Verdict::failed; }, penetration, {}}}) {
    EXPECT_EQ(judged(change).*predicate, expected) << of;
  }
  EXPECT_FALSE(judged([](Row& r) { rests(r, 1, "box2d", "float"); }, true).drift_ok) << "no friction on slopes";
}

TEST(StabilityPredicates, decide_the_verdict) {
  const Row holds = judged([](Row&) {});
  EXPECT_EQ(holds.verdict, Verdict::holds) << holds.reason;
  for (const Predicate each : {&Row::penetration_ok, &Row::drift_ok, &Row::energy_ok, &Row::hanging_ok})
    EXPECT_EQ(holds.*each, true);
  const auto of_rest = [](const char* scalar) {
    return judged([&](Row& r) { rests(r, 1, "octagon_sweep", scalar); }).verdict;
  };
  EXPECT_EQ(of_rest("double"), Verdict::violates) << "at rest its position does not change";
  EXPECT_EQ(of_rest("float"), Verdict::flagged) << "nothing is promised of float";
  EXPECT_EQ(judged([](Row& r) { bodies_gain(r, 4); }).verdict, Verdict::flagged);
  EXPECT_EQ(judged([](Row& r) { r.verdict = Verdict::failed; }).verdict, Verdict::failed);
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

TEST(StabilityParts, have_cases_on_every_grid_and_more_on_a_larger_one) {
  const auto count = [](GridSize size) {
    std::size_t cases = 0;
    for (const StudyPart& part : stability_parts(size, {})) {
      EXPECT_NO_THROW(check(part.sweep)) << part.title;
      EXPECT_EQ(part.sweep.axes.size(), part.sweep.border ? 0U : 2U) << part.title;
      cases += part.sweep.size();
    }
    return cases;
  };
  EXPECT_LT(count(GridSize::quick), count(GridSize::standard));
  EXPECT_LT(count(GridSize::standard), count(GridSize::full));
}

TEST(StabilityParts, run_box2d_once_and_all_others_in_double_and_in_float) {
  for (const StudyPart& part : stability_parts(GridSize::quick, {}))
    for (const NamedContender& contender : part.sweep.contenders)
      EXPECT_EQ(part.sweep.scalars.size(), contender.name == "box2d" ? 1U : 2U) << part.title << " " << contender.name;
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
