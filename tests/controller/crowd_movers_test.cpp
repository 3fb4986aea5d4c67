/// Characters against characters among movers, where the answer is a formula. See also the scenes two_on_a_lift and
/// pressed_in_a_row.
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace paperproof {
namespace {

using namespace stepping;
using compare::box;

/// A lift that is wide and, at offset zero, has its surface at zero.
ColliderDef lift() { return box(-20, -0.25, 20, 0, 0); }

ColliderDef belt(ColliderDef def, double speed) {
  def.surface_speed = speed;
  return def;
}

/// There and back again, a wave with corners [m].
Vec2d there_and_back(const Vec2d& by, int step) {
  const int phase = step % 120;
  return by * ((phase < 60 ? phase : 120 - phase) / 60.0);
}

/// One above the other [m].
double gap_above(const Together& all, std::size_t lower, std::size_t upper) {
  return all.states[upper].position.y() - all.states[lower].position.y() - 2 * half_height;
}

TEST(CrowdAmongMovers, on_a_lift_each_keeps_its_place_to_one_ulp_also_where_neighbours_begin_without_a_gap) {
  const double touching = 2 * half_width;
  for (const Vec2d& by : {Vec2d{0, 3.1}, Vec2d{4.3, 0}, Vec2d{-1.9, 1.3}}) {
    Together all = standing({0, touching, 2 * touching + 0.3, 3 * touching + 0.3 + rest_gap}, {lift()});
    std::vector<Vec2d> places;
    for (int step = 0; step < 1200; ++step) {
      all.movers[0] = {there_and_back(by, step), there_and_back(by, step + 1)};
      ASSERT_EQ(all.step(), StepStatus::moved);
      for (std::size_t i = 0; i < 4; ++i) {
        const CharacterState<double>& state = all.states[i];
        ASSERT_TRUE(state.grounded) << step;
        if (step == 0) places.push_back(state.ride.place);
        ASSERT_EQ(state.ride.place, places[i]) << i << " in step " << step;
        // Rounded once: p - m is within one ulp of the place.
        ASSERT_EQ(state.position, Vec2d(all.movers[0].to + places[i])) << i << " in step " << step;
      }
      ASSERT_GT(all.gap(0, 1), 0);
    }
    EXPECT_NEAR(places[1].x() - places[0].x(), touching, 1e-6);
  }
}

/// @param crushed who crushes each of the two, in the first step without room.
void expect_crush(Together two, const std::vector<Vec2d>& ways, int steps_with_room,
                  const std::array<std::vector<ColliderIndex>, 2>& crushed) {
  for (int step = 1; step <= steps_with_room + 1; ++step) {
    two.step_with_movers_by(ways);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& by = two.report.members[i].step.move.crushed;
      EXPECT_EQ(std::vector(by.begin(), by.end()), step > steps_with_room ? crushed[i] : std::vector<ColliderIndex>())
          << i << " in step " << step;
    }
    EXPECT_GT(std::max(two.gap(0, 1), gap_above(two, 0, 1)), 0) << step;
  }
}

TEST(CrowdAmongMovers, are_crushed_in_the_step_that_the_formula_gives) {
  const double head = 2 * half_height;
  // Two presses come from both sides; a ceiling comes down on one, and leaves its neighbour alone; a lift presses two
  // that stand on each other under a ceiling.
  expect_crush(standing({0, 1}, {floor_at_zero(), box(-2, 0, -1, 8, 0), box(2, 0, 3, 8, 1), box(-20, 1.3, 20, 2)}),
               {{0.03, 0}, {-0.03, 0}}, static_cast<int>((3 - 4 * half_width) / 0.06), {{{1}, {2}}});
  expect_crush(
      standing({0, 2 * half_width + 0.1}, {floor_at_zero(), box(-2, head + 0.5, half_width + 0.05, head + 1.5, 0)}),
      {{0, -0.04}}, static_cast<int>(0.5 / 0.04), {{{1}, {}}});
  expect_crush(under_gravity({{0, half_height + rest_gap}, {0, 3 * half_height + 2 * rest_gap}},
                             {lift(), box(-20, 2 * head + 0.5, 20, 2 * head + 1.5)}),
               {{0, 0.04}}, static_cast<int>(0.5 / 0.04), {{{0}, {}}});
}

TEST(CrowdAmongMovers, who_stands_on_another_goes_up_and_down_with_the_lift_under_both) {
  for (const Vec2d& by : {Vec2d{0, 3}, Vec2d{0, -3}}) {
    Together all = under_gravity({{0, half_height + rest_gap}, {0, 3 * half_height + 2 * rest_gap}}, {lift()});
    for (int step = 0; step < 240; ++step) {
      all.movers[0] = {there_and_back(by, step), there_and_back(by, step + 1)};
      all.step();
      ASSERT_EQ(all.report.members[1].step.status, StepStatus::moved) << step;
      ASSERT_TRUE(all.states[0].grounded) << step;
      ASSERT_NEAR(all.states[0].position.y(), all.movers[0].to.y() + half_height, 1e-6) << step;
      ASSERT_GT(gap_above(all, 0, 1), 0) << step;
      // Where the lift turns downwards, at 6 m/s, the upper one falls behind it for a while.
      const bool rises = step % 120 < 60 ? by.y() > 0 : by.y() < 0;
      ASSERT_TRUE(!rises || step % 60 <= 30 || gap_above(all, 0, 1) < 1e-6) << step;
    }
  }
}

TEST(CrowdAmongMovers, who_is_carried_into_one_who_stands_slides_on_its_ground_and_pushes_nobody) {
  const double other = 2;
  const double speed = 0.02;  // per step
  Together all = standing({0, other}, {box(-8, -0.25, 1, 0, 0), box(1.5, -1, 8, 0)});
  for (int step = 1; step <= 90; ++step) {
    all.step_with_movers_by({{speed, 0}});
    EXPECT_NEAR(all.states[0].position.x(), std::min(speed * step, other - 2 * half_width), 1e-6) << step;
    EXPECT_EQ(all.states[1].position, Vec2d(other, half_height + rest_gap)) << step;
    EXPECT_EQ(all.report.members[0].step.status, StepStatus::moved) << step;
    ASSERT_TRUE(all.states[0].grounded) << step;
  }
}

TEST(CrowdAmongMovers, a_belt_carries_a_row_as_it_carries_one) {
  Together all = standing({0, 2 * half_width + rest_gap, 4 * half_width + 0.5}, {belt(floor_at_zero(), 2)});
  all.step();
  const std::vector<CharacterState<double>> before = all.states;
  all.steps(60);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.states[i].position.x() - before[i].position.x(), 2, 1e-9) << i;
    EXPECT_NEAR(all.states[i].velocity.x(), 2, 1e-12) << i;
  }
}

TEST(CrowdAmongMovers, a_belt_down_a_slope_keeps_those_who_land_on_it) {
  // 3-4-5: the right foot, at (5, -20) px, comes down on the line y = 3/4 x.
  const double speed = -5;
  const auto above = [](double x) { return Vec2d{x, half_height + 0.75 * (x + 5 * px) + 0.05}; };
  Together all({above(0), above(2)}, {belt(polygon({{-80, -65}, {80, 55}, {80, 60}, {-80, -60}}), speed)});
  all.gravity = {0, -10};
  all.dt = 1.0 / 60;
  for (Input& input : all.inputs) input.move = 0;
  all.steps(10);  // 0.05 m take 0.1 s
  for (int step = 0; step < 120; ++step) {
    all.step();
    for (const CharacterState<double>& state : all.states) {
      ASSERT_TRUE(state.grounded) << step;
      ASSERT_LE((state.velocity - speed * Vec2d{0.8, 0.6}).norm(), 1e-12) << step;
    }
  }
}

TEST(CrowdAmongMovers, who_meets_nobody_moves_as_by_the_controller_to_the_last_bit_with_snap_and_without_movers_too) {
  CharacterDef character;
  character.snap = 0.25;
  for (const MoverIndex mover : {no_mover, MoverIndex{0}}) {
    const std::vector<ColliderDef> colliders{box(-40, -3, 40, -2), box(-20, -0.25, 20, 0, mover),
                                             box(-6, 0.1, -5, 2, mover), polygon({{6, -0.5}, {10, -0.5}, {10, 2}})};
    Stepper<double> alone(colliders, character);
    Together all = under_gravity({{-3, 1}, {5, 1}, {12, 1}}, colliders, character);
    std::vector<CharacterState<double>> states = all.states;
    for (int step = 0; step < 200; ++step) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int turn = 20 + 10 * static_cast<int>(i);
        all.inputs[i] = {.move = step % turn < 10 ? 0.3 : -0.3, .jump = step % 50 > 45};
      }
      all.step_with_movers_by({there_and_back({0.1, 0.05}, step) * 0.5});
      for (std::size_t i = 0; i < 3; ++i) {
        alone.controller.step(states[i], all.inputs[i], {all.gravity, all.dt, all.movers}, alone.scratch, alone.report);
        ASSERT_TRUE(same_step(all.states[i], all.report.members[i].step, states[i], alone.report)) << i << ", " << step;
      }
      ASSERT_EQ(all.report.impacts, 0U);
    }
  }
}

TEST(CrowdAmongMovers, a_sensor_is_entered_once_also_where_an_impact_cuts_the_way_in_two) {
  ColliderDef sensor = box(0.5, -2, 0.7, 2);
  sensor.sensor = true;
  // 0 meets 1, which stands, after half a metre, and is then in the sensor.
  Together all({{0, 0}, {2 * half_width + 0.5, 0}}, {sensor, box(30, 0, 31, 1, 0)});
  all.states[0].velocity = {2, 0.25};
  all.step();
  ASSERT_EQ(all.report.members[0].met.size(), 1U);
  EXPECT_NEAR(all.report.members[0].met[0].fraction, 0.25, 1e-12);
  ASSERT_EQ(all.report.members[0].step.sensors.size(), 1U);
  EXPECT_NEAR(all.report.members[0].step.sensors[0].fraction, (0.5 - half_width) / 2, 1e-9);
  EXPECT_NEAR(all.states[0].position.y(), 0.25, 1e-12);
}

}  // namespace
}  // namespace paperproof
