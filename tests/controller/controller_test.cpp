/// What is common to every technique: how a character jumps, and what is refused. How it falls, walks and jumps by
/// formulas is in tests/situations/motion.json.
#include "campaign/shapes.hpp"
#include "controller/states.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

using compare::box;

constexpr double dt = 1.0 / 64;
constexpr double gravity = 32;  // half a metre per second in each step: no rounding

Stepper without_rounding(std::vector<ColliderDef> colliders, const CharacterDef& character) {
  Stepper stepper(std::move(colliders), character);
  stepper.dt = dt;
  stepper.gravity = {0, -gravity};
  return stepper;
}

/// Stands on a floor whose top is y = 0.
Stepper standing(const CharacterDef& character = {}) {
  Stepper stepper = without_rounding({box(-100, -1, 100, 0)}, character);
  stepper.at(0, half_height + px).steps(20);
  EXPECT_TRUE(stepper.state.grounded);
  return stepper;
}

Input walking(double move) { return {.move = move}; }
Input jumping(std::optional<double> move = {}) { return {.move = move, .jump = true}; }

TEST(Walking, takes_a_deflection_for_at_most_one) {
  Stepper walker = standing();
  walker.steps(100, walking(-7));
  EXPECT_EQ(walker.state.velocity.x(), -6);
}

/// It was slowed as a climb is, when the key was released.
TEST(Walking, brakes_no_launch_from_the_ground) {
  Stepper walker = standing();
  walker.steps(90, walking(1));
  walker.state.velocity.y() = 9;  // steeper than walkable ground: 9 / 6 against tan 50 degrees
  walker.step(walking(0));
  EXPECT_EQ(walker.state.velocity.y(), 9 - gravity * dt);
}

/// Steps on which the character leaves the ground with its jumping speed.
int take_offs(Stepper& jumper, int steps, const Input& input) {
  int count = 0;
  for (int n = 0; n < steps; ++n) {
    const bool jumped_before = jumper.state.jumping;
    jumper.step(input);
    if (!jumped_before && jumper.state.jumping) ++count;
  }
  return count;
}

TEST(Jumping, is_allowed_for_a_while_after_the_edge) {
  const CharacterDef character{.coyote_time = 6.5 * dt};
  for (const int late : {0, 6, 7}) {
    Stepper walker = without_rounding({box(-9, -1, 0, 0)}, character);
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
  Stepper faller({box(-9, -1, 0, 0)}, character);
  EXPECT_EQ(take_offs(faller.at(0, 5), 5, jumping()), 0) << "a character that never stood may not jump";
}

TEST(Jumping, does_not_use_up_a_press_while_crushed) {
  Stepper crushed({box(-9, -1, 9, 0), box(-1, 2, 1, 3, 0)}, {.coyote_time = 0.2});
  crushed.at(0, half_height + 1e-3).steps(5);
  for (int step = 0; step < 4; ++step) crushed.step_with_mover_by(0, -0.3, {.move = {}, .jump = step > 2});
  ASSERT_TRUE(crushed.state.crushed);
  EXPECT_FALSE(crushed.state.jumping);
  EXPECT_TRUE(crushed.state.jump_pending);
  for (int step = 0; step < 4; ++step) crushed.step_with_mover_by(0, 2, jumping());
  EXPECT_TRUE(crushed.state.jumping);
}

TEST(Jumping, waits_for_the_ground_as_long_as_its_buffer) {
  struct Press {
    bool buffered;
    bool held;
    int early;
    bool jumps;
  };
  for (const auto& [buffered, held, early, jumps] :
       {Press{true, true, 6, true}, Press{true, true, 7, false}, Press{true, false, 1, true},
        Press{true, false, 6, true}, Press{true, false, 7, false}, Press{false, true, 30, true},
        Press{false, false, 30, false}}) {
    Stepper faller = standing({.jump_buffer = buffered ? std::optional(6.5 * dt) : std::nullopt});
    faller.at(0, 3).with_velocity(0, 0).state.grounded = false;
    const CharacterState in_air = faller.state;
    int steps_to_land = 0;
    for (; !faller.state.grounded; ++steps_to_land) faller.step();
    faller.state = in_air;
    faller.steps(steps_to_land - early);
    faller.step(jumping());
    ASSERT_FALSE(faller.state.jumping);
    EXPECT_EQ(take_offs(faller, early + 1, held ? jumping() : Input{}), jumps) << early << " steps early, " << held;
  }
}

TEST(Jumping, is_lower_when_the_button_is_released) {
  CharacterDef character{.jump_cut = 0.5};
  Stepper jumper = standing(character);
  jumper.step(jumping());
  const double rising = jumper.state.velocity.y();
  jumper.step();
  EXPECT_EQ(jumper.state.velocity.y(), 0.5 * rising - gravity * dt);
  jumper.step();
  EXPECT_EQ(jumper.state.velocity.y(), 0.5 * rising - 2 * gravity * dt) << "once for a release";
  character.jump_buffer = 1;
  Stepper early = standing(character);
  early.state.grounded = false;
  early.step(jumping());
  ASSERT_TRUE(early.state.grounded && early.state.jump_pending);
  early.step();
  EXPECT_EQ(early.state.velocity.y(), 0.5 * character.jump_speed - gravity * dt) << "released before the jump";
  Stepper thrown = standing(character);
  thrown.with_velocity(0, 8).step(jumping());
  thrown.state.jumping = false;
  const double thrown_up = thrown.state.velocity.y();
  thrown.step();
  EXPECT_EQ(thrown.state.velocity.y(), thrown_up - gravity * dt) << "a rise that is no jump";
}

TEST(Refusals, change_nothing_for_input_that_is_no_number) {
  struct Case {
    CharacterState state = busy();
    Input input{.move = 0.5};
    StepContext context{{0, -10}, 1.0 / 60};
  };
  std::vector<Case> cases;
  const auto add = [&cases]() -> Case& { return cases.emplace_back(); };
  for (const double bad : {infinity - infinity, infinity, -infinity}) {
    for (const Eigen::Index axis : {0, 1}) {
      for (Vec2d CharacterState::*field : {&CharacterState::position, &CharacterState::velocity,
                                           &CharacterState::technique_memory, &CharacterState::last_free})
        (add().state.*field)[axis] = bad;
      for (Vec2d Ride::*field : {&Ride::place, &Ride::velocity}) (add().state.ride.*field)[axis] = bad;
      add().context.gravity[axis] = bad;
    }
    add().input.move = bad;
    add().context.dt = bad;
  }
  for (const double bad : {0.0, -0.0, -1e-9, -1.0}) add().context.dt = bad;
  for (const std::string_view kind : technique_names()) {
    Stepper stepper({box(-9, -9, 9, 0)}, {}, kind);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      CharacterState state = cases[i].state;
      EXPECT_EQ(stepper.controller.step(state, cases[i].input, cases[i].context, stepper.scratch, stepper.report),
                StepStatus::invalid_input)
          << kind << ", case " << i;
      EXPECT_EQ(stepper.report.status, StepStatus::invalid_input);
      EXPECT_TRUE(same_bits(state, cases[i].state)) << kind << ", case " << i;
    }
  }
  Stepper anywhere({box(-9, -9, 9, 0)});
  anywhere.state.last_free.x() = infinity;
  EXPECT_EQ(anywhere.at(0, 3).step(), StepStatus::moved) << "a last free position that is not valid";
  EXPECT_THROW(Stepper({}, {.walk_speed = -1}), InvalidCharacter);
}

/// The wall is 0.3 m away. A press stays pending, so each reach begins anew.
TEST(Jumps, toward_a_wall_are_refused_as_far_away_as_the_character_says) {
  const Scenery scenery(SceneryDef{{box(-9, -1, 9, 0), box(half_width + 0.3, 0, 9, 4)}});
  for (const auto& [reach, jumped] : {std::pair{0.29, true}, {0.31, false}}) {
    const Controller controller(scenery, {.no_jump_toward_wall = true, .wall_reach = reach});
    Scratch scratch = controller.make_scratch();
    StepReport report;
    CharacterState state;
    state.position = {0, half_height + 1e-6};
    const StepContext context{{0, -10}, 1.0 / 60};
    controller.step(state, {}, context, scratch, report);
    ASSERT_TRUE(state.grounded);
    controller.step(state, jumping(1), context, scratch, report);
    EXPECT_EQ(state.jumping, jumped) << reach;
  }
}

TEST(Refusals, change_nothing_for_a_step_that_leaves_the_range) {
  const double range = Tolerances{}.range;
  for (const std::string_view kind : technique_names()) {
    Stepper stepper({box(-9, -9, 9, 0)}, {}, kind);
    for (const Vec2d& velocity :
         {Vec2d(1.3 * range, 0), Vec2d(0, 1.3 * range), Vec2d(0, -1.3 * range), Vec2d(1e300, 0)}) {
      stepper.state = busy();
      stepper.state.crushed = false;
      stepper.state.crushers.clear();
      stepper.state.velocity = velocity;
      const CharacterState before = stepper.state;
      EXPECT_EQ(stepper.controller.step(stepper.state, jumping(), {{0, 0}, 1}, stepper.scratch, stepper.report),
                StepStatus::out_of_range)
          << kind;
      EXPECT_TRUE(same_bits(stepper.state, before) && stepper.state == before) << kind;
    }
  }
}

TEST(Refusals, change_nothing_for_a_step_that_takes_too_long_to_search) {
  for (const std::string_view kind :
       {"wind_back", "penetration_resolution", "speculative_march", "pixel_colour", "pixel_tile", "mask"}) {
    Stepper stepper({box(-9, -9, 9, 0)}, {}, kind);
    // A million units of a pixel are 31,250 m.
    for (const double metres : {31'249.0, 31'251.0}) {
      stepper.state = {};
      const CharacterState before = stepper.at(0, 20).with_velocity(metres, 0).state;
      stepper.fly(metres, 0);
      EXPECT_EQ(stepper.report.status, metres < 31'250 ? StepStatus::moved : StepStatus::refused) << kind;
      EXPECT_EQ(same_bits(stepper.state, before), metres > 31'250) << kind;
    }
  }
}

}  // namespace
}  // namespace paperproof::stepping
