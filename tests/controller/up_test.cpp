/// Up of a character: any unit vector. And the calls that put a character elsewhere, or knock it back. That a run which
/// is turned by quarters has the same bits is in tests/agreement/equalities_test.cpp, and any up in its campaign.
#include "agreement/saying.hpp"
#include "controller/stepping.hpp"
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

/// With gravity along -up.
StepStatus step_with(Stepper& stepper, const Vec2d& up) {
  stepper.up = up;
  stepper.gravity = -30 * up;
  return stepper.step();
}

CharacterDef box_shaped(double half_width, double bottom, double top) {
  return of_shape(CharacterShape(box(-half_width, bottom, half_width, top).points));
}

TEST(Up, that_is_no_unit_vector_is_refused) {
  Stepper stepper({box(-9, -1, 9, 0)});
  stepper.at(0, 3);
  const CharacterState before = stepper.state;
  for (const Vec2d& up : {Vec2d{0, 0}, Vec2d{0, 1.0001}, Vec2d{nan, 1}, Vec2d{0, nan}, Vec2d{infinity, 0}, Vec2d{1, 1},
                          Vec2d{0, 1 + 1e-14}}) {
    EXPECT_EQ(step_with(stepper, up), StepStatus::invalid_input) << up.transpose();
    EXPECT_EQ(stepper.sweep().move(stepper.state, {1, 0}, stepper.context(), stepper.scratch, stepper.report),
              StepStatus::invalid_input);
    EXPECT_FALSE(stepper.sweep().cast({0, 3}, {0, -9}, {.up = up}, stepper.scratch));
    EXPECT_EQ(stepper.state, before);
  }
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(step_with(stepper, Vec2d{7 * std::cos(i), 7 * std::sin(i)}.normalized()), StepStatus::moved) << i;
  Stepper boxed({box(-9, -1, 9, 0)}, {}, "bounding_box");
  EXPECT_EQ(step_with(boxed, {0, 1}), StepStatus::moved);
  EXPECT_EQ(step_with(boxed, {0, -1}), StepStatus::invalid_input) << "of another technique";
}

TEST(Up, decides_how_fast_a_fall_may_be) {
  Stepper faller({box(-9, -99, 9, -98)}, {.max_fall_speed = 5});
  const Vec2d up{0.6, 0.8};
  for (int step = 0; step < 60; ++step) step_with(faller, up);
  EXPECT_NEAR(faller.state.velocity.dot(up), -5, 1e-12);
  EXPECT_NEAR(faller.state.velocity.dot(Vec2d{0.8, -0.6}), 0, 1e-12);
}

TEST(Up, decides_the_sides_of_questions) {
  Stepper stepper({box(-9, -1, 9, 0)});
  const auto side_below = [&](const Vec2d& up) {
    return stepper.sweep().nearest({0, 1}, 2, {.up = up}, stepper.scratch)->side;
  };
  EXPECT_EQ(side_below({0, 1}), Side::bottom);
  EXPECT_EQ(side_below({0, -1}), Side::top);
  EXPECT_EQ(side_below({1, 0}), Side::right);
  EXPECT_EQ(side_below({-1, 0}), Side::left) << "its right is up in the world";
}

/// Nobody comes to stand on two heads: the order in which they are found decides which of the two carries.
TEST(Up, of_several_turns_with_the_scene) {
  const SceneryDef walls{
      {box(-6, -6, 6, -5), box(5, -6, 6, 6), box(-6, 5, 6, 6), box(-6, -6, -5, 6), box(-2, -5, 0, -3)}};
  std::array<test::Saying, 4> turned;
  std::vector<Together> scenes;
  for (test::Saying& saying : turned) {
    if (&saying != &turned[0]) saying.vector << -(&saying - 1)->vector.row(1), (&saying - 1)->vector.row(0);
    std::vector<Vec2d> starts{{-4, 3.75}, {-2.5, -0.75}, {-1, 2.5}, {0.5, 2.25}, {2, 1}, {3.5, -0.25}};
    for (Vec2d& start : starts) start = saying.of(start);
    Together& scene = scenes.emplace_back(starts, saying.of(walls).colliders, box_shaped(0.5, -0.5, 0.5));
    scene.up = saying.of(Vec2d(0, 1));
    scene.gravity = -30 * scene.up;
    scene.dt = frame;
  }
  std::size_t met = 0;
  for (int step = 0; step < 240; ++step) {
    std::vector<Input> inputs;
    for (int i = 0; i < 6; ++i) inputs.push_back({.move = (step / 40 + i) % 3 - 1, .jump = (step + 9 * i) % 50 < 4});
    for (std::size_t quarters = 0; quarters < 4; ++quarters) {
      Together& scene = scenes[quarters];
      scene.inputs = inputs;
      scene.step();
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_EQ(difference(scenes[0].reports[i], scene.reports[i], turned[quarters], 0), "") << step << ", " << i;
        ASSERT_EQ(turned[quarters].of(scenes[0].states[i]), scene.states[i]) << step << ", " << i;
        met += scene.met(i).size();
      }
    }
  }
  EXPECT_GT(met, 100U);
}

TEST(Teleport, keeps_velocity_and_button_and_forgets_the_place) {
  const ColliderDef lift = box(-3, -1, 3, 0, 0);
  Stepper rider({lift, box(-1, 2, 1, 3), box(40, -1, 50, 0)}, {.coyote_time = 0.1});
  rider.at(0, half_height + 1e-3).steps(10);
  rider.step_with_mover_by(0.1, 0);
  ASSERT_NE(rider.state.ride.ground, no_collider);
  rider.state.jump_held = true;
  const Vec2d velocity = rider.state.velocity;
  teleport(rider.state, {45, 3});
  CharacterState expected;
  expected.position = {45, 3};
  expected.velocity = velocity;
  expected.jump_held = true;
  EXPECT_EQ(rider.state, expected);
  EXPECT_NEAR(velocity.x(), 6, 1e-9) << "that of the lift";
}

TEST(KnockBack, leaves_the_ground_and_what_carries) {
  Stepper rider({box(-3, -1, 3, 0, 0)}, {.coyote_time = 0.1, .jump_cut = 0.25, .snap = 0.5});
  rider.gravity = {0, -30};
  rider.at(0, half_height + 1e-3).steps(10);
  rider.step_with_mover_by(0.05, 0);
  knock_back(rider.state, {1, 3});
  EXPECT_EQ(rider.state.ride.ground, no_collider);
  rider.step_with_mover_by(0.05, 0, {.move = {}, .jump = true});
  EXPECT_FALSE(rider.state.jumping) << "no jump in the air";
  EXPECT_FALSE(rider.state.grounded);
  EXPECT_NEAR(rider.state.velocity.x(), 1 + 0.05 / rider.dt, 1e-9) << "the lift's as well";
  EXPECT_NEAR(rider.state.velocity.y(), 3 - 30 * rider.dt, 1e-9);
  rider.step();
  EXPECT_NEAR(rider.state.velocity.y(), 3 - 60 * rider.dt, 1e-9) << "released, but that does not cut the rise";
}

TEST(Shape, may_change_between_steps) {
  // A lift carries the character below a bar, and out again.
  const std::vector<ColliderDef> level{box(-3, -1, 9, 0, 0), box(2, 1, 4, 2)};
  Stepper standing(level, box_shaped(0.3, -0.4, 1.2));
  Stepper crouching(level, box_shaped(0.3, -0.4, 0.4));
  standing.gravity = crouching.gravity = {0, -30};
  CharacterState state;
  state.position = {0, 0.401};
  int crouched = 0;
  bool is_low = false;
  for (int step = 0; step < 120; ++step) {
    is_low = state.position.x() > 1 && state.position.x() < 2.5;  // the button to crouch
    standing.movers[0] = crouching.movers[0] = {{0.05 * step, 0}, {0.05 * (step + 1), 0}};
    is_low =
        is_low || standing.sweep().overlaps(state.position, standing.context(), standing.scratch) != std::size_t{0};
    Stepper& now = is_low ? crouching : standing;
    now.state = state;
    ASSERT_EQ(now.step(), StepStatus::moved) << step;
    state = now.state;
    crouched += is_low;
    ASSERT_EQ(state.stuck_steps, 0);
    if (step < 2) continue;
    ASSERT_EQ(state.ride.ground, 0U) << step;
    ASSERT_TRUE(state.grounded && !state.wall_left && !state.wall_right) << step;
    ASSERT_EQ(state.last_free, state.position);
    ASSERT_NEAR(state.position.x(), 0.05 * (step + 1), 0.1);
  }
  EXPECT_GT(crouched, 60) << "also where the button is up, but the bar is above";
  EXPECT_FALSE(is_low) << "stands again";
}

}  // namespace
}  // namespace paperproof::stepping
