/// What is common to every technique: how a character falls, walks and jumps, against formulas.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::stepping {
namespace {

constexpr double dt = 1.0 / 64;
constexpr double gravity = 32;  // half a metre per second in each step: no rounding

/// Stands on a floor whose top is y = 0.
Stepper<double> standing(const CharacterDef& character = {}, std::vector<ColliderDef> more = {}) {
  more.insert(more.begin(), rectangle(-100, -1, 100, 0));
  Stepper<double> stepper(more, character);
  stepper.dt = dt;
  stepper.gravity = {0, -gravity};
  stepper.at(0, half_height + px).steps(20);
  EXPECT_TRUE(stepper.state.grounded);
  return stepper;
}

Input walking(double move) { return {.move = move}; }
Input jumping(std::optional<double> move = {}) { return {.move = move, .jump = true}; }

TEST(Falling, follows_the_semi_implicit_parabola_with_every_technique_that_moves_freely) {
  for (const std::string_view kind : technique_names()) {
    if (kind == "grid") continue;  // by whole squares: see grid_test
    Stepper<double> faller({rectangle(50, -100, 51, 100)}, {}, kind);
    faller.at(0.1, 7).with_velocity(1.25, 0);
    for (int n = 1; n <= 120; ++n) {
      ASSERT_EQ(faller.step(), StepStatus::moved) << kind;
      // v_k = -g dt k, so that y_n = y_0 - g dt² (1 + 2 + ... + n).
      const double fallen = 10.0 / 3600 * n * (n + 1) / 2;
      ASSERT_NEAR(faller.state.position.y(), 7 - fallen, 1e-12) << kind << ", step " << n;
      ASSERT_NEAR(faller.state.position.x(), 0.1 + 1.25 / 60 * n, 1e-12) << kind;
      ASSERT_NEAR(faller.state.velocity.y(), -10.0 / 60 * n, 1e-12) << kind;
    }
    EXPECT_TRUE(faller.report.move.contacts.empty());
  }
}

TEST(Falling, is_no_faster_than_the_limit) {
  CharacterDef character;
  character.max_fall_speed = 5.25;
  Stepper<double> faller({rectangle(50, -100, 51, 100)}, character);
  faller.dt = dt;
  faller.gravity = {0, -gravity};
  for (int n = 1; n <= 40; ++n) {
    faller.step();
    ASSERT_EQ(faller.state.velocity.y(), -std::min(gravity * dt * n, 5.25)) << "step " << n;
  }
  const double before = faller.state.position.y();
  faller.step();
  EXPECT_EQ(faller.state.position.y(), before - 5.25 * dt);
  faller.with_velocity(0, 9).step();
  EXPECT_EQ(faller.state.velocity.y(), 9 - gravity * dt) << "a rise has no limit";
}

TEST(Walking, approaches_the_walking_speed_by_the_acceleration) {
  CharacterDef character;
  character.walk_speed = 6;
  character.acceleration = 24;
  Stepper<double> walker = standing(character);
  double travelled = 0;
  for (int n = 1; n <= 40; ++n) {
    walker.step(walking(1));
    const double speed = std::min(24 * dt * n, 6.0);
    travelled += speed * dt;
    ASSERT_EQ(walker.state.velocity.x(), speed) << "step " << n;
    ASSERT_NEAR(walker.state.position.x(), travelled, 1e-13) << "step " << n;
  }
  walker.step(walking(-0.5));
  EXPECT_EQ(walker.state.velocity.x(), 6 - 24 * dt) << "it turns with the same acceleration";
  walker.steps(100, walking(-0.5));
  EXPECT_EQ(walker.state.velocity.x(), -3) << "half a deflection is half the speed";
  walker.steps(100, walking(-7));
  EXPECT_EQ(walker.state.velocity.x(), -6) << "a deflection is at most one";
  walker.steps(100, walking(0));
  EXPECT_EQ(walker.state.velocity.x(), 0) << "letting go brakes";
}

TEST(Walking, without_steering_keeps_its_speed) {
  Stepper<double> walker = standing();
  walker.with_velocity(2.7, 0).steps(50);
  EXPECT_EQ(walker.state.velocity.x(), 2.7);
}

TEST(Walking, is_steered_in_the_air_by_the_air_acceleration) {
  CharacterDef character;
  character.acceleration = 64;
  character.air_acceleration = 8;
  Stepper<double> walker = standing(character);
  walker.step(walking(1));
  EXPECT_EQ(walker.state.velocity.x(), 64 * dt);
  walker.step(jumping(1));
  EXPECT_EQ(walker.state.velocity.x(), 2 * 64 * dt) << "the step that leaves the ground still pushes off";
  walker.step(jumping(1));
  EXPECT_EQ(walker.state.velocity.x(), 2 * 64 * dt + 8 * dt);

  character.air_acceleration.reset();
  Stepper<double> same = standing(character);
  same.at(0, 5).step(walking(1));
  same.step(walking(1));
  EXPECT_EQ(same.state.velocity.x(), 2 * 64 * dt) << "without one of its own the air is as the ground";
}

TEST(Jumping, reaches_the_semi_implicit_apex) {
  CharacterDef character;
  character.jump_speed = 16;
  Stepper<double> jumper = standing(character);
  const double floor = jumper.state.position.y();
  double expected = 0;
  for (double speed = 16 - gravity * dt; speed > 0; speed -= gravity * dt) expected += speed * dt;
  ASSERT_EQ(expected, 16.0 * 16 / (2 * gravity) - 16 * dt / 2) << "short of v²/2g by v dt / 2";
  double highest = 0;
  for (int n = 0; n < 120; ++n) {
    jumper.step(jumping());
    highest = std::max(highest, jumper.state.position.y() - floor);
  }
  EXPECT_NEAR(highest, expected, 1e-13);
  EXPECT_TRUE(jumper.state.grounded);
}

/// Steps on which the character leaves the ground with its jumping speed.
int take_offs(Stepper<double>& jumper, int steps, const Input& input) {
  int count = 0;
  for (int n = 0; n < steps; ++n) {
    const bool jumped_before = jumper.state.jumping;
    jumper.step(input);
    if (!jumped_before && jumper.state.jumping) ++count;
  }
  return count;
}

TEST(Jumping, gives_one_jump_for_one_press) {
  Stepper<double> jumper = standing();
  EXPECT_EQ(take_offs(jumper, 300, jumping()), 1) << "held through several landings";
  EXPECT_EQ(take_offs(jumper, 1, {}), 0);
  EXPECT_EQ(take_offs(jumper, 300, jumping()), 1) << "pressed anew";
}

TEST(Jumping, is_allowed_for_a_while_after_the_edge) {
  for (const int late : {0, 1, 6, 7}) {
    CharacterDef character;
    character.coyote_time = 6.5 * dt;
    Stepper<double> walker({rectangle(-9, -1, 0, 0)}, character);
    walker.dt = dt;
    walker.gravity = {0, -gravity};
    walker.at(-1, half_height + px).steps(20);
    ASSERT_TRUE(walker.state.grounded);
    while (walker.state.grounded) walker.step(walking(1));
    walker.steps(late, walking(1));
    walker.step(jumping(1));
    EXPECT_EQ(walker.state.jumping, late < 7) << late;
    EXPECT_EQ(walker.state.velocity.y() > 0, late < 7) << late;
    walker.steps(2, walking(1));
    EXPECT_EQ(take_offs(walker, 20, jumping(1)), 0) << "one jump, not two";
  }
  CharacterDef character;
  character.coyote_time = 1;
  Stepper<double> faller({rectangle(-9, -1, 0, 0)}, character);
  EXPECT_EQ(take_offs(faller.at(0, 5), 5, jumping()), 0) << "a character that never stood may not jump";
}

TEST(Jumping, does_not_use_up_a_press_while_crushed) {
  CharacterDef character;
  character.coyote_time = 0.2;
  ColliderDef press = rectangle(-1, 2, 1, 3);
  press.mover = 0;
  Stepper<double> crushed({rectangle(-9, -1, 9, 0), press}, character);
  crushed.at(0, half_height + 1e-3).steps(5);
  for (int step = 0; step < 4; ++step) crushed.step_with_mover_by(0, -0.3, {.move = {}, .jump = step > 2});
  ASSERT_TRUE(crushed.state.crushed);
  EXPECT_FALSE(crushed.state.jumping);
  EXPECT_TRUE(crushed.state.jump_pending);
  for (int step = 0; step < 4; ++step) crushed.step_with_mover_by(0, 2, {.move = {}, .jump = true});
  EXPECT_TRUE(crushed.state.jumping);
}

TEST(Jumping, waits_for_the_ground_as_long_as_its_buffer) {
  for (const bool held : {false, true}) {
    for (const int early : {1, 6, 7}) {
      CharacterDef character;
      character.jump_buffer = 6.5 * dt;
      Stepper<double> twin = standing(character);
      const CharacterState<double> in_air = twin.at(0, 2).with_velocity(0, 0).state;
      int steps_to_land = 0;
      for (twin.state.grounded = false; !twin.state.grounded; ++steps_to_land) twin.step();
      Stepper<double> faller = standing(character);
      faller.state = in_air;
      faller.state.grounded = false;
      faller.steps(steps_to_land - early);
      faller.step(jumping());
      EXPECT_EQ(take_offs(faller, early + 1, held ? jumping() : Input{}), early < 7 ? 1 : 0) << early << " steps early";
    }
  }
}

TEST(Jumping, is_lower_when_the_button_is_released) {
  CharacterDef character;
  character.jump_cut = 0.5;
  Stepper<double> jumper = standing(character);
  jumper.step(jumping());
  const double rising = jumper.state.velocity.y();
  jumper.step();
  EXPECT_EQ(jumper.state.velocity.y(), 0.5 * rising - gravity * dt);
  jumper.step();
  EXPECT_EQ(jumper.state.velocity.y(), 0.5 * rising - 2 * gravity * dt) << "once for a release";
  character.jump_buffer = 1;
  Stepper<double> early = standing(character);
  early.state.grounded = false;
  early.step(jumping());
  ASSERT_TRUE(early.state.grounded && early.state.jump_pending);
  early.step();
  EXPECT_EQ(early.state.velocity.y(), 0.5 * character.jump_speed - gravity * dt) << "released before the jump";
  Stepper<double> thrown = standing(character);
  thrown.with_velocity(0, 8).step(jumping());
  thrown.state.jumping = false;
  const double thrown_up = thrown.state.velocity.y();
  thrown.step();
  EXPECT_EQ(thrown.state.velocity.y(), thrown_up - gravity * dt) << "a rise that is no jump";
}

TEST(Jumping, waits_for_the_ground_while_the_button_is_held) {
  Stepper<double> jumper = standing();
  jumper.at(0, 3).with_velocity(0, 0).step();
  ASSERT_FALSE(jumper.state.grounded);
  int landed = -1;
  for (int n = 0; n < 200 && landed < 0; ++n) {
    jumper.step(jumping());
    ASSERT_FALSE(jumper.state.jumping);
    if (jumper.state.grounded) landed = n;
  }
  ASSERT_GE(landed, 1);
  jumper.step(jumping());
  EXPECT_TRUE(jumper.state.jumping);
  EXPECT_EQ(jumper.state.velocity.y(), jumper.controller.character().jump_speed - gravity * dt);
}

TEST(Jumping, forgets_a_press_that_was_let_go_in_the_air) {
  Stepper<double> jumper = standing();
  jumper.at(0, 3).with_velocity(0, 0).step(jumping());
  EXPECT_EQ(take_offs(jumper, 200, {}), 0);
  EXPECT_TRUE(jumper.state.grounded);
}

TEST(JumpingRules, refuse_a_jump_toward_a_wall_one_stands_beside) {
  const std::vector<ColliderDef> walls{rectangle(2, 0, 3, 9), rectangle(-3, 0, -2, 9)};
  for (const double toward : {1.0, -1.0}) {
    CharacterDef character;
    for (const bool rule : {false, true}) {
      character.no_jump_toward_wall = rule;
      Stepper<double> jumper = standing(character, walls);
      jumper.steps(100, walking(toward));
      ASSERT_EQ(jumper.state.wall_right, toward > 0);
      ASSERT_EQ(jumper.state.wall_left, toward < 0);
      EXPECT_EQ(take_offs(jumper, 30, jumping(toward)), rule ? 0 : 1) << "rule " << rule;
    }
    Stepper<double> away = standing(character, walls);
    away.steps(100, walking(toward));
    EXPECT_EQ(take_offs(away, 30, jumping(-toward)), 1) << "away from it is allowed";
    Stepper<double> still = standing(character, walls);
    still.steps(100, walking(toward));
    EXPECT_EQ(take_offs(still, 30, jumping()), 1) << "and straight up";
  }
}

/// Beside a wall at x = 2, as far from it as it is said, at rest; with every technique.
Stepper<double> beside_a_wall(std::string_view kind, double gap) {
  CharacterDef character;
  character.no_jump_toward_wall = true;
  Stepper<double> jumper({rectangle(-100, -1, 100, 0), rectangle(2, 0, 3, 9)}, character, kind);
  jumper.dt = dt;
  jumper.gravity = {0, -gravity};
  jumper.at(2 - half_width - gap, half_height).steps(40);
  return jumper;
}

TEST(JumpingRules, refuse_a_jump_that_is_pressed_together_with_the_direction_after_standing_idle) {
  for (const std::string_view kind : technique_names()) {
    Stepper<double> toward = beside_a_wall(kind, px / 2);
    ASSERT_FALSE(toward.state.wall_right) << kind << ": nothing was wanted to the right";
    EXPECT_EQ(take_offs(toward, 30, jumping(1)), 0) << kind;
    Stepper<double> away = beside_a_wall(kind, px / 2);
    EXPECT_EQ(take_offs(away, 30, jumping(-1)), 1) << kind;
    Stepper<double> upwards = beside_a_wall(kind, px / 2);
    EXPECT_EQ(take_offs(upwards, 30, jumping()), 1) << kind;
    if (kind == "grid") continue;  // beside is the next square, whole
    Stepper<double> farther = beside_a_wall(kind, 3 * px);
    EXPECT_EQ(take_offs(farther, 1, jumping(1)) + take_offs(farther, 3, jumping(1)), 1) << kind;
  }
}

TEST(JumpingRules, refuse_a_jump_at_any_time_while_the_key_is_held_toward_the_wall) {
  for (const std::string_view kind : technique_names()) {
    if (kind == "wind_back") continue;  // sticks to the floor before it comes to the wall
    for (int waits = 60; waits < 80; ++waits) {
      Stepper<double> jumper = beside_a_wall(kind, 0.4);
      jumper.steps(waits, walking(1));
      EXPECT_EQ(take_offs(jumper, 30, jumping(1)), 0) << kind << ", pressed after " << waits << " steps";
    }
  }
}

TEST(JumpingRules, end_a_rise_at_the_side_of_something) {
  CharacterDef character;
  for (const bool rule : {false, true}) {
    character.side_hit_ends_rise = rule;
    Stepper<double> jumper = standing(character, {rectangle(1, 0, 2, 9)});
    jumper.step(jumping(1));
    double before = jumper.state.velocity.y();
    int steps = 0;
    while (!jumper.touched(Side::right) && ++steps < 40) {
      before = jumper.state.velocity.y();
      jumper.step(jumping(1));
    }
    ASSERT_GT(before, 2) << "it meets the wall while rising";
    EXPECT_EQ(jumper.state.velocity.y(), rule ? 0 : before - gravity * dt);
  }
}

/// A state in the middle of things, whose every field differs from its default.
CharacterState<double> busy() {
  return {.position = {1, 2},
          .velocity = {3, -4},
          .last_free = {1, 2.5},
          .has_last_free = true,
          .grounded = true,
          .jumping = true,
          .jump_held = true,
          .jump_pending = true,
          .wall_left = true,
          .wall_right = true,
          .stuck_steps = 3,
          .ride = {.ground = 4, .place = {1, 1.5}, .velocity = {0.5, 0}}};
}

TEST(Refusals, change_nothing_for_input_that_is_no_number) {
  struct Case {
    CharacterState<double> state = busy();
    Input input{.move = 0.5};
    Vec2d gravity{0, -10};
    double dt = 1.0 / 60;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Case> cases;
  const auto with = [&cases](auto change) { change(cases.emplace_back()); };
  for (const double bad : {nan, infinity, -infinity}) {
    with([bad](Case& c) { c.state.position.x() = bad; });
    with([bad](Case& c) { c.state.position.y() = bad; });
    with([bad](Case& c) { c.state.velocity.x() = bad; });
    with([bad](Case& c) { c.state.velocity.y() = bad; });
    with([bad](Case& c) { c.state.technique_memory.x() = bad; });
    with([bad](Case& c) { c.state.technique_memory.y() = bad; });
    with([bad](Case& c) { c.state.ride.place.x() = bad; });
    with([bad](Case& c) { c.state.ride.place.y() = bad; });
    with([bad](Case& c) { c.state.ride.velocity.x() = bad; });
    with([bad](Case& c) { c.state.ride.velocity.y() = bad; });
    with([bad](Case& c) { c.state.last_free.x() = bad; });
    with([bad](Case& c) { c.state.last_free.y() = bad; });
    with([bad](Case& c) { c.input.move = bad; });
    with([bad](Case& c) { c.gravity.x() = bad; });
    with([bad](Case& c) { c.gravity.y() = bad; });
    with([bad](Case& c) { c.dt = bad; });
  }
  for (const double bad : {0.0, -0.0, -1e-9, -1.0}) with([bad](Case& c) { c.dt = bad; });

  for (const std::string_view kind : technique_names()) {
    Stepper<double> stepper({rectangle(-9, -9, 9, 0)}, {}, kind);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      CharacterState<double> state = cases[i].state;
      const StepStatus status = stepper.controller.step(state, cases[i].input, {cases[i].gravity, cases[i].dt},
                                                        stepper.scratch, stepper.report);
      EXPECT_EQ(status, StepStatus::invalid_input) << kind << ", case " << i;
      EXPECT_EQ(stepper.report.status, StepStatus::invalid_input);
      EXPECT_TRUE(same_bits(state, cases[i].state)) << kind << ", case " << i;
    }
  }
}

TEST(Refusals, a_last_free_position_that_is_not_valid_may_be_anything) {
  Stepper<double> stepper({rectangle(-9, -9, 9, 0)});
  stepper.at(0, 3).state.last_free.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
}

TEST(Refusals, spare_a_wish_that_float_cannot_hold_as_it_is_limited_to_one) {
  Stepper<float> wild({rectangle(-9, -9, 9, 0)});
  Stepper<float> full({rectangle(-9, -9, 9, 0)});
  wild.at(0, 3);
  full.at(0, 3);
  EXPECT_EQ(wild.step(walking(1e300)), StepStatus::moved);
  EXPECT_EQ(full.step(walking(1)), StepStatus::moved);
  EXPECT_TRUE(same_bits(wild.state, full.state));
}

TEST(Refusals, change_nothing_for_a_step_that_leaves_the_range) {
  const double range = Tolerances<double>{}.range;
  for (const std::string_view kind : technique_names()) {
    Stepper<double> stepper({rectangle(-9, -9, 9, 0)}, {}, kind);
    for (const Vec2d& velocity :
         {Vec2d{1.3 * range, 0}, Vec2d{0, 1.3 * range}, Vec2d{0, -1.3 * range}, Vec2d{1e300, 0}}) {
      CharacterState<double> state = busy();
      state.velocity = velocity;
      const CharacterState<double> before = state;
      EXPECT_EQ(
          stepper.controller.step(state, {.move = {}, .jump = true}, {Vec2d{0, 0}, 1}, stepper.scratch, stepper.report),
          StepStatus::out_of_range)
          << kind;
      EXPECT_TRUE(same_bits(state, before)) << kind;
    }
  }
}

TEST(Refusals, change_nothing_for_a_step_that_takes_too_long_to_search) {
  for (const std::string_view kind :
       {"wind_back", "penetration_resolution", "speculative_march", "pixel_colour", "pixel_tile", "mask"}) {
    Stepper<double> stepper({rectangle(-9, -9, 9, 0)}, {}, kind);
    // A million units of a pixel are 31,250 m.
    for (const auto& [metres, status] :
         {std::pair{31'249.0, StepStatus::moved}, std::pair{31'251.0, StepStatus::refused}}) {
      stepper.state = {};
      stepper.at(0, 20);
      const CharacterState<double> before = stepper.with_velocity(metres, 0).state;
      stepper.fly(metres, 0);
      EXPECT_EQ(stepper.report.status, status) << kind;
      EXPECT_EQ(same_bits(stepper.state, before), status != StepStatus::moved) << kind;
    }
  }
}

TEST(Refusals, a_character_that_cannot_be_is_named) {
  const Scenery<double> scenery(SceneryDef{});
  CharacterDef character;
  character.walk_speed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Controller<double>(scenery, character), InvalidCharacter);
}

}  // namespace
}  // namespace paperproof::stepping
