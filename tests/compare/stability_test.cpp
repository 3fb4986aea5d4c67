/// Stability: each predicate where it just holds and where it just does not, regions, borders.
#include "studies/stability.hpp"
#include "records/verdict.hpp"
#include "runs/body_energy.hpp"
#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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

Row judged(const std::function<void(Row&)>& change) {
  Row row = held();
  change(row);
  judge_stability(row);
  return row;
}

TEST(StabilityPredicates, hold_of_a_run_that_holds) {
  const Row row = judged([](Row&) {});
  EXPECT_EQ(row.verdict, Verdict::holds) << row.reason;
  for (const auto& predicate : {row.penetration_ok, row.drift_ok, row.energy_ok, row.hanging_ok})
    EXPECT_EQ(predicate, true);
  EXPECT_FALSE(row.events_ok) << "it is no replica";
}

TEST(StabilityPredicates, drift_is_what_is_promised_or_seen_or_two_ulp_of_where_it_is) {
  EXPECT_EQ(judged([](Row& row) { row.rest_peak_to_peak_m = 1e-6; }).drift_ok, true);
  const Row beyond = judged([](Row& row) { row.rest_peak_to_peak_m = 1.001e-6; });
  EXPECT_EQ(beyond.drift_ok, false);
  EXPECT_EQ(beyond.verdict, Verdict::violates) << "at rest its position does not change";
  const auto far = [](double drift, const char* scalar) {
    return judged([&](Row& row) {
      row.scalar = scalar;
      row.parameters = {{"origin_m", 1e6}};
      row.rest_peak_to_peak_m = drift;
    });
  };
  EXPECT_EQ(far(0.2, "float").drift_ok, true) << "an ulp there is 0.0625 m, and the bound 2 · 2^-23 · 1e6";
  EXPECT_EQ(far(0.25, "float").drift_ok, false);
  EXPECT_EQ(far(0.25, "float").verdict, Verdict::flagged) << "nothing is promised of float";
  EXPECT_EQ(far(1.1e-6, "double").drift_ok, false);
  const auto others = [](double drift) {
    return judged([&](Row& row) {
      row.contender = "box2d";
      row.scalar = "float";
      row.rest_peak_to_peak_m = drift;
    });
  };
  EXPECT_EQ(others(1e-4).drift_ok, true);
  EXPECT_EQ(others(1.01e-4).drift_ok, false);
  EXPECT_FALSE(judged([](Row& row) { row.rest_peak_to_peak_m.reset(); }).drift_ok) << "nothing rests";
  EXPECT_FALSE(judged([](Row& row) {
                 row.characters = 2;
                 row.rest_peak_to_peak_m = 1;
               }).drift_ok)
      << "others push";
  Row sliding = others(0);
  sliding.rest_peak_to_peak_m = 1;
  sliding.drift_ok.reset();
  judge_stability(sliding, true);
  EXPECT_FALSE(sliding.drift_ok) << "Box2D has no friction on slopes";
}

TEST(StabilityPredicates, energy_is_within_its_bound_of_the_character_and_of_bodies) {
  EXPECT_EQ(judged([](Row& row) { row.energy_gained_j_kg = 1e-5; }).energy_ok, true);
  EXPECT_EQ(judged([](Row& row) { row.energy_gained_j_kg = 1.001e-5; }).energy_ok, false);
  const auto bodies = [](double gained) {
    return judged([&](Row& row) {
      row.body_energy_gained_j = gained;
      row.body_energy_bound_j = 3;
    });
  };
  EXPECT_EQ(bodies(3).energy_ok, true);
  EXPECT_EQ(bodies(3.01).energy_ok, false);
  EXPECT_EQ(bodies(3.01).verdict, Verdict::flagged);
  EXPECT_EQ(bodies(std::nan("")).energy_ok, false);
}

TEST(StabilityPredicates, penetration_is_none_and_of_bodies_five_millimetres) {
  EXPECT_EQ(judged([](Row& row) { row.tunnels = 1; }).penetration_ok, false);
  EXPECT_EQ(judged([](Row& row) { row.steps_ending_inside = 1; }).penetration_ok, false);
  EXPECT_EQ(judged([](Row& row) { row.body_max_penetration_m = 0.005; }).penetration_ok, true);
  EXPECT_EQ(judged([](Row& row) { row.body_max_penetration_m = 0.0051; }).penetration_ok, false);
  EXPECT_EQ(judged([](Row& row) { row.body_tunnels = 1; }).penetration_ok, false);
}

TEST(StabilityPredicates, hanging_is_no_step) {
  EXPECT_EQ(judged([](Row& row) { row.hanging_steps = 1; }).hanging_ok, false);
  EXPECT_EQ(judged([](Row& row) { row.stuck_refuted = 1; }).hanging_ok, false);
}

TEST(StabilityPredicates, are_not_asked_of_what_did_not_run) {
  const Row failed = judged([](Row& row) {
    row.verdict = Verdict::failed;
    row.finite = false;
  });
  EXPECT_FALSE(failed.penetration_ok);
  EXPECT_EQ(failed.verdict, Verdict::failed);
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

TEST(Plank, on_springs_gains_nothing_and_carries_up_to_the_nyquist_frequency) {
  for (const char* stiffness : {"250", "2000", "710612"}) {  // the last one is m (pi / dt)²
    Case one;
    one.scene = "plank_on_springs";
    one.parameters = {{"stiffness", stiffness}};
    for (const char* contender : {"octagon_sweep", "box2d"}) {
      one.contender = contender;
      StabilityRegion region;
      region.sweep.scene = one.scene;
      region.sweep.set = one.parameters;
      region.sweep.contenders = {{contender}};
      const Row row = run_at(region, 0);
      EXPECT_EQ(row.verdict, Verdict::holds) << stiffness << " " << contender << ": " << row.reason;
      EXPECT_EQ(row.body_energy_gained_j.has_value(), contender == std::string("box2d"));
    }
  }
}

TEST(StabilityRegions, have_cases_on_every_grid_and_more_on_a_larger_one) {
  const auto count = [](const char* grid) {
    std::size_t cases = 0;
    for (const StabilityRegion& region : stability_regions({}, grid)) {
      EXPECT_NO_THROW(check(region.sweep)) << region.name;
      EXPECT_EQ(region.sweep.axes.size(), 2U) << region.name;
      cases += region.sweep.size();
    }
    return cases;
  };
  EXPECT_LT(count("quick"), count("standard"));
  EXPECT_LT(count("standard"), count("full"));
  for (const StabilityBorder& border : stability_borders({})) EXPECT_NO_THROW(check(border.sweep)) << border.name;
}

TEST(StabilityRegions, compare_the_events_of_replicas_with_the_first) {
  for (const StabilityRegion& region : stability_regions({"octagon_sweep"})) {
    if (region.name != "perturbed start") continue;
    for (std::size_t index = 0; index < region.sweep.size(); ++index) {
      const Row row = run_at(region, index);
      EXPECT_EQ(row.events_ok, true) << row.command << ": " << row.reason;
      EXPECT_GT(row.events.value_or(0), 4) << "touches, jumps, lands, walks on, meets the wall";
    }
    return;
  }
  FAIL() << "there is no such region";
}

TEST(StabilityRegions, tell_where_the_events_are_others) {
  StabilityRegion region;
  region.sweep.scene = "ramp";
  region.sweep.axes = {parse_axis("angle=10,70")};
  region.sweep.contenders = {{"octagon_sweep"}};
  region.replicas_along = "angle";
  EXPECT_EQ(run_at(region, 0).events_ok, true);
  const Row other = run_at(region, 1);
  EXPECT_EQ(other.events_ok, false) << "a steep slope is no support";
  EXPECT_EQ(other.verdict, Verdict::flagged);
}

}  // namespace
}  // namespace paperproof::compare
