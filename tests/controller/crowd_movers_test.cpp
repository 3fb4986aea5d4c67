/// Characters against characters among movers, where the answer is a formula.
#include "controller/passenger.hpp"
#include "controller/together.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace paperproof {
namespace {

using namespace stepping;
using article_tests::conveyor;
using article_tests::of_mover;

/// A lift that is wide and, at offset zero, has its surface at zero.
ColliderDef lift() { return of_mover(rectangle(-20, -0.25, 20, 0)); }

/// There and back again, a wave with corners [m].
Vec2d there_and_back(const Vec2d& by, int step) {
  const int phase = step % 120;
  return by * ((phase < 60 ? phase : 120 - phase) / 60.0);
}

std::vector<ColliderIndex> crushed(const Together& all, std::size_t i) {
  const auto& colliders = all.report.members[i].step.move.crushed;
  return {colliders.begin(), colliders.end()};
}

/// One above the other [m].
double gap_above(const Together& all, std::size_t lower, std::size_t upper) {
  return all.states[upper].position.y() - all.states[lower].position.y() - 2 * half_height;
}

TEST(CrowdAmongMovers, on_a_lift_each_keeps_its_place_to_one_ulp_also_where_neighbours_begin_without_a_gap) {
  const double touching = 2 * half_width;
  for (const Vec2d& by : {Vec2d{0, 3.1}, Vec2d{0, -2.7}, Vec2d{4.3, 0}, Vec2d{-1.9, 1.3}}) {
    Together all = standing({0, touching, 2 * touching + 0.3, 3 * touching + 0.3 + rest_gap}, {lift()});
    std::vector<Vec2d> places;
    for (int step = 0; step < 1200; ++step) {
      all.movers[0] = {there_and_back(by, step), there_and_back(by, step + 1)};
      ASSERT_EQ(all.step(), StepStatus::moved);
      for (std::size_t i = 0; i < 4; ++i) {
        const CharacterState<double>& state = all.states[i];
        ASSERT_EQ(all.report.members[i].step.status, StepStatus::moved) << step;
        ASSERT_TRUE(state.grounded) << step;
        if (step == 0) places.push_back(state.ride.place);
        ASSERT_EQ(state.ride.place, places[i]) << i << " in step " << step;
        // Rounded once: p - m is within one ulp of the place.
        ASSERT_EQ(state.position, Vec2d(all.movers[0].to + places[i])) << i << " in step " << step;
      }
      EXPECT_GT(all.gap(0, 1), 0);
    }
    EXPECT_NEAR(places[1].x() - places[0].x(), touching, 1e-6);
  }
}

TEST(CrowdAmongMovers, they_walk_into_each_other_on_a_lift_as_they_do_on_the_ground) {
  for (const Vec2d& by : {Vec2d{0.05, 0}, Vec2d{-0.08, 0}, Vec2d{0, 0.05}, Vec2d{0, -0.02}}) {
    Together on_ground = standing({-1.5, 1, 3}, {floor_at_zero()});
    Together on_lift = standing({-1.5, 1, 3}, {lift()});
    for (int step = 0; step < 90; ++step) {
      for (Together* all : {&on_ground, &on_lift}) {
        all->inputs[0].move = step < 5 ? 0 : 1;
        all->inputs[1].move = step < 20 ? 0 : -1;
        all->inputs[2].move = step < 5 ? 0 : -0.5;
      }
      on_ground.step();
      on_lift.step_with_movers_by({by});
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2d place = on_lift.states[i].position - on_lift.movers[0].to;
        ASSERT_LE((place - on_ground.states[i].position).cwiseAbs().maxCoeff(), 2e-6) << i << " in step " << step;
        ASSERT_TRUE(on_lift.states[i].grounded) << i << " in step " << step;
      }
    }
    EXPECT_TRUE(gap_of_a_contact(on_lift.gap(0, 1)));
    EXPECT_TRUE(gap_of_a_contact(on_lift.gap(1, 2)));
  }
}

TEST(CrowdAmongMovers, a_press_pushes_one_into_another_and_both_go_on_before_it) {
  const double face = -1;
  const double speed = 0.04;  // per step
  Together all = standing({0, 1.5}, {floor_at_zero(), of_mover(rectangle(face - 1, 0.1, face, 3))});
  for (int step = 1; step <= 60; ++step) {
    all.step_with_movers_by({{speed, 0}});
    const double pushed = face + speed * step + half_width;
    EXPECT_NEAR(all.states[0].position.x(), std::max(0.0, pushed), 2e-6) << step;
    EXPECT_NEAR(all.states[1].position.x(), std::max(1.5, pushed + 2 * half_width), 4e-6) << step;
    EXPECT_GT(all.gap(0, 1), 0);
    EXPECT_TRUE(crushed(all, 0).empty() && crushed(all, 1).empty()) << step;
  }
  EXPECT_NEAR(all.states[0].velocity.x(), speed / all.dt, 1e-9);
  EXPECT_NEAR(all.states[1].velocity.x(), speed / all.dt, 1e-9);
}

TEST(CrowdAmongMovers, pressed_against_a_wall_through_another_the_one_beside_the_press_is_crushed_by_it) {
  const double face = -1;
  const double speed = 0.04;
  const double wall = 2.3;
  Together all = standing({0, 1.5}, {floor_at_zero(), of_mover(rectangle(face - 1, 0, face, 8)),
                                     rectangle(wall, 0, wall + 1, 8), rectangle(-20, 1.3, 20, 2)});
  const int last_with_room = static_cast<int>((wall - face - 4 * half_width) / speed);
  for (int step = 1; step <= last_with_room + 3; ++step) {
    all.step_with_movers_by({{speed, 0}});
    if (step <= last_with_room + 1) {
      const std::vector<ColliderIndex> expected(step <= last_with_room ? 0 : 1, 1);
      ASSERT_EQ(crushed(all, 0), expected) << step;
    }
    EXPECT_TRUE(crushed(all, 1).empty()) << "its neighbour is between";
    EXPECT_GT(all.gap(0, 1), 0) << step;
    EXPECT_LE(all.states[1].position.x() + half_width, wall) << step;
  }
  EXPECT_EQ(all.report.members[0].step.status, StepStatus::stuck) << "the press is still on it";
}

TEST(CrowdAmongMovers, two_presses_against_each_other_crush_both_in_the_step_that_the_formula_gives) {
  const double left = -1;
  const double right = 2;
  const double speed = 0.03;  // of each
  Together all = standing({0, 1}, {floor_at_zero(), of_mover(rectangle(left - 1, 0, left, 8), 0),
                                   of_mover(rectangle(right, 0, right + 1, 8), 1), rectangle(-20, 1.3, 20, 2)});
  const int last_with_room = static_cast<int>((right - left - 4 * half_width) / (2 * speed));
  for (int step = 1; step <= last_with_room + 1; ++step) {
    all.step_with_movers_by({{speed, 0}, {-speed, 0}});
    EXPECT_GT(all.gap(0, 1), 0) << step;
    EXPECT_EQ(crushed(all, 0).empty(), step <= last_with_room) << step;
    EXPECT_EQ(crushed(all, 1).empty(), step <= last_with_room) << step;
  }
  EXPECT_EQ(crushed(all, 0), std::vector<ColliderIndex>{1});
  EXPECT_EQ(crushed(all, 1), std::vector<ColliderIndex>{2});
}

TEST(CrowdAmongMovers, a_ceiling_that_comes_down_on_one_leaves_its_neighbour_alone) {
  const double gap = 0.5;
  const double speed = 0.04;
  const double head = 2 * half_height;
  Together all = standing({0, 2 * half_width + 0.1},
                          {floor_at_zero(), of_mover(rectangle(-2, head + gap, half_width + 0.05, head + gap + 1))});
  // The way out to the left is farther than the ceiling goes.
  const int last_with_room = static_cast<int>(gap / speed);
  for (int step = 1; step <= last_with_room + 1; ++step) {
    all.step_with_movers_by({{0, -speed}});
    EXPECT_EQ(crushed(all, 0).empty(), step <= last_with_room) << step;
    EXPECT_TRUE(crushed(all, 1).empty()) << step;
    EXPECT_EQ(all.states[1].position, Vec2d(2 * half_width + 0.1, half_height + rest_gap)) << step;
  }
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
      if (rises && step % 60 > 30) {
        ASSERT_LT(gap_above(all, 0, 1), 1e-6) << step;
      }
    }
  }
}

TEST(CrowdAmongMovers, a_lift_that_presses_two_under_a_ceiling_crushes_the_lower_one) {
  const double room = 0.5;
  const double speed = 0.04;
  Together all = under_gravity({{0, half_height + rest_gap}, {0, 3 * half_height + 2 * rest_gap}},
                               {lift(), rectangle(-20, 4 * half_height + room, 20, 4 * half_height + room + 1)});
  const int last_with_room = static_cast<int>(room / speed);
  for (int step = 1; step <= last_with_room + 1; ++step) {
    all.step_with_movers_by({{0, speed}});
    EXPECT_EQ(crushed(all, 0).empty(), step <= last_with_room) << step;
    EXPECT_TRUE(crushed(all, 1).empty()) << step;
    EXPECT_GT(gap_above(all, 0, 1), 0) << step;
    EXPECT_LT(all.states[1].position.y() + half_height, 4 * half_height + room) << step;
  }
  EXPECT_EQ(crushed(all, 0), std::vector<ColliderIndex>{0});
}

TEST(CrowdAmongMovers, who_is_carried_into_one_who_stands_slides_on_its_ground_and_pushes_nobody) {
  const double other = 2;
  Together all = under_gravity({{0, half_height + rest_gap}, {other, half_height + rest_gap}},
                               {of_mover(rectangle(-8, -0.25, 1, 0)), rectangle(1.5, -1, 8, 0)});
  const double speed = 0.02;  // per step
  for (int step = 1; step <= 90; ++step) {
    all.step_with_movers_by({{speed, 0}});
    EXPECT_NEAR(all.states[0].position.x(), std::min(speed * step, other - 2 * half_width), 1e-6) << step;
    EXPECT_EQ(all.states[1].position, Vec2d(other, half_height + rest_gap)) << step;
    EXPECT_TRUE(crushed(all, 0).empty()) << step;
    ASSERT_TRUE(all.states[0].grounded) << step;
  }
}

TEST(CrowdAmongMovers, a_belt_carries_a_row_as_it_carries_one) {
  Together all = standing({0, 2 * half_width + rest_gap, 4 * half_width + 0.5}, {conveyor(floor_at_zero(), 2)});
  all.step();
  const std::vector<CharacterState<double>> before = all.states;
  for (int step = 0; step < 60; ++step) all.step();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all.states[i].position.x() - before[i].position.x(), 2, 1e-9) << i;
    EXPECT_NEAR(all.states[i].velocity.x(), 2, 1e-12) << i;
  }
}

TEST(CrowdAmongMovers, a_belt_down_a_slope_keeps_those_who_land_on_it) {
  // 3-4-5: the right foot, at (5, -20) px, comes down on the line y = 3/4 x.
  ColliderDef belt = polygon({{-80, -65}, {80, 55}, {80, 60}, {-80, -60}});
  const double speed = -5;
  const auto above = [](double x) { return Vec2d{x, half_height + 0.75 * (x + 5 * px) + 0.05}; };
  Together all({above(0), above(2)}, {conveyor(belt, speed)});
  all.gravity = {0, -10};
  all.dt = 1.0 / 60;
  for (Input& input : all.inputs) input.move = 0;
  const int falling = 10;  // 0.05 m take 0.1 s
  all.steps(falling);
  for (int step = 0; step < 120; ++step) {
    all.step();
    for (const CharacterState<double>& state : all.states) {
      ASSERT_TRUE(state.grounded) << step;
      ASSERT_LE((state.velocity - speed * Vec2d{0.8, 0.6}).norm(), 1e-12) << step;
    }
  }
}

TEST(CrowdAmongMovers, who_meets_nobody_moves_as_by_the_controller_to_the_last_bit) {
  const std::vector<ColliderDef> colliders{rectangle(-40, -3, 40, -2), lift(), of_mover(rectangle(-6, 0.1, -5, 2), 1)};
  const Scenery<double> scenery(SceneryDef{colliders});
  const Controller<double> controller(scenery, CharacterDef{});
  Scratch<double> scratch = controller.make_scratch();
  Together all = standing({-3, 5, 12}, colliders);
  std::vector<CharacterState<double>> alone = all.states;
  StepReport<double> report;
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int turn = 20 + 10 * static_cast<int>(i);
      all.inputs[i] = {.move = step % turn < 10 ? 0.3 : -0.3, .jump = step % 50 > 45, .drop = false};
    }
    all.step_with_movers_by({there_and_back({0.1, 0.05}, step) * 0.5, {0.03, 0}});
    for (std::size_t i = 0; i < 3; ++i) {
      controller.step(alone[i], all.inputs[i], {all.gravity, all.dt, all.movers}, scratch, report);
      ASSERT_TRUE(same_bits(all.states[i], alone[i])) << i << " in step " << step;
      ASSERT_EQ(all.states[i].ride, alone[i].ride) << i << " in step " << step;
      ASSERT_EQ(all.report.members[i].step.move.contacts.size(), report.move.contacts.size());
    }
  }
}

TEST(CrowdAmongMovers, a_sensor_is_entered_once_also_where_an_impact_cuts_the_way_in_two) {
  ColliderDef sensor = rectangle(0.5, -2, 0.7, 2);
  sensor.sensor = true;
  // 0 meets 1, which stands, after half a metre, and is then in the sensor.
  Together all({{0, 0}, {2 * half_width + 0.5, 0}}, {sensor, of_mover(rectangle(30, 0, 31, 1))});
  all.states[0].velocity = {2, 0.25};
  all.step();
  ASSERT_EQ(all.report.members[0].met.size(), 1U);
  EXPECT_NEAR(all.report.members[0].met[0].fraction, 0.25, 1e-12);
  ASSERT_EQ(all.report.members[0].step.sensors.size(), 1U);
  EXPECT_NEAR(all.report.members[0].step.sensors[0].fraction, (0.5 - half_width) / 2, 1e-9);
  EXPECT_NEAR(all.states[0].position.y(), 0.25, 1e-12);
}

TEST(CrowdAmongMovers, motions_that_are_missing_or_not_finite_are_refused_and_change_nothing) {
  Together all = standing({0, 2}, {lift()});
  const std::vector<CharacterState<double>> before = all.states;
  const auto refused = [&](StepStatus status) {
    EXPECT_EQ(status, StepStatus::invalid_input);
    EXPECT_EQ(all.states, before);
  };
  refused(all.crowd.step(all.states, all.inputs, {all.gravity, all.dt}, all.scratch, all.report));
  all.movers[0].to.x() = std::numeric_limits<double>::quiet_NaN();
  refused(all.step());
  all.movers[0].to.x() = std::numeric_limits<double>::infinity();
  refused(all.step());
  all.movers[0].to.x() = 0;
  all.states[1].velocity.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(all.step(), StepStatus::invalid_input);
  EXPECT_EQ(all.states[0], before[0]);
}

TEST(CrowdAmongMovers, a_step_allocates_nothing) {
  std::vector<double> at;
  for (int i = 0; i < 10; ++i) at.push_back(i * 0.7);
  Together all = standing(at, {lift(), of_mover(rectangle(-4, 0.1, -3, 3), 1)});
  std::size_t impacts = 0;
  const std::size_t before = tests::allocations();
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < all.inputs.size(); ++i)
      all.inputs[i] = {.move = (step / 20 + static_cast<int>(i)) % 3 - 1, .jump = step % 40 > 35, .drop = false};
    for (MoverMotion<double>& mover : all.movers) mover.from = mover.to;
    all.movers[0].to.y() += 0.02;
    all.movers[1].to.x() += 0.02;
    all.movers[1].to.y() += 0.02;
    all.step();
    impacts += all.report.impacts;
  }
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_GT(impacts, 100U);
}

}  // namespace
}  // namespace paperproof
