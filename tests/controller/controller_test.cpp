/// What is common to every technique: what is refused, and what no situation can say of a walk. How a character falls,
/// walks and jumps is in tests/situations/motion.json and jumps.json.
#include "campaign/shapes.hpp"
#include "controller/states.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

using compare::box;

/// Stands on a floor. Gravity is half a metre per second in each step: nothing is rounded.
Stepper standing() {
  Stepper stepper({box(-100, -1, 100, 0)});
  stepper.dt = 1.0 / 64;
  stepper.gravity = {0, -32};
  stepper.at(0, half_height + px).steps(20);
  EXPECT_TRUE(stepper.state.grounded);
  return stepper;
}

TEST(Walking, takes_a_deflection_for_at_most_one) {
  Stepper walker = standing();
  walker.steps(100, {.move = -7});
  EXPECT_EQ(walker.state.velocity.x(), -6);
}

/// It was slowed as a climb is, when the key was released.
TEST(Walking, brakes_no_launch_from_the_ground) {
  Stepper walker = standing();
  walker.steps(90, {.move = 1});
  walker.state.velocity.y() = 9;  // steeper than walkable ground: 9 / 6 against tan 50 degrees
  walker.step({.move = 0});
  EXPECT_EQ(walker.state.velocity.y(), 9 - 0.5);
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
    const StepContext context{{0, -10}, frame};
    controller.step(state, {}, context, scratch, report);
    ASSERT_TRUE(state.grounded);
    controller.step(state, {.move = 1, .jump = true}, context, scratch, report);
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
      EXPECT_EQ(stepper.controller.step(stepper.state, {.jump = true}, {{0, 0}, 1}, stepper.scratch, stepper.report),
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
