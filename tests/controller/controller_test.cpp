/// What is common to every technique: how a character falls, walks and jumps, against formulas.
#include "campaign/shapes.hpp"
#include "controller/states.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::stepping {
namespace {

using compare::box;

constexpr double dt = 1.0 / 64;
constexpr double gravity = 32;  // half a metre per second in each step: no rounding

Stepper without_rounding(std::vector<ColliderDef> colliders, const CharacterDef& character = {},
                         std::string_view kind = "octagon_sweep") {
  Stepper stepper(std::move(colliders), character, kind);
  stepper.dt = dt;
  stepper.gravity = {0, -gravity};
  return stepper;
}

/// Stands on a floor whose top is y = 0.
Stepper standing(const CharacterDef& character = {}, std::vector<ColliderDef> more = {}) {
  more.insert(more.begin(), box(-100, -1, 100, 0));
  Stepper stepper = without_rounding(std::move(more), character);
  stepper.at(0, half_height + px).steps(20);
  EXPECT_TRUE(stepper.state.grounded);
  return stepper;
}

Input walking(double move) { return {.move = move}; }
Input jumping(std::optional<double> move = {}) { return {.move = move, .jump = true}; }

TEST(Falling, is_no_faster_than_the_limit) {
  Stepper faller = without_rounding({box(50, -100, 51, 100)}, {.max_fall_speed = 5.25});
  for (int n = 1; n <= 40; ++n) {
    const double before = faller.state.position.y();
    faller.step();
    ASSERT_EQ(faller.state.velocity.y(), -std::min(gravity * dt * n, 5.25)) << "step " << n;
    ASSERT_EQ(faller.state.position.y(), before + faller.state.velocity.y() * dt);
  }
  faller.with_velocity(0, 9).step();
  EXPECT_EQ(faller.state.velocity.y(), 9 - gravity * dt) << "a rise has no limit";
}

TEST(Walking, approaches_the_walking_speed_by_the_acceleration) {
  Stepper walker = standing({.walk_speed = 6, .acceleration = 24});
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
  walker.steps(50);
  EXPECT_EQ(walker.state.velocity.x(), -3) << "without steering it keeps its speed";
  walker.steps(100, walking(-7));
  EXPECT_EQ(walker.state.velocity.x(), -6) << "a deflection is at most one";
  walker.steps(100, walking(0));
  EXPECT_EQ(walker.state.velocity.x(), 0) << "letting go brakes";
}

TEST(Walking, is_steered_in_the_air_by_the_air_acceleration) {
  for (const std::optional<double> in_the_air : {std::optional(8.0), std::optional<double>()}) {
    Stepper walker = standing({.acceleration = 64, .air_acceleration = in_the_air});
    walker.step(jumping(1));
    EXPECT_EQ(walker.state.velocity.x(), 64 * dt) << "the step that leaves the ground still pushes off";
    walker.step(jumping(1));
    EXPECT_EQ(walker.state.velocity.x(), 64 * dt + in_the_air.value_or(64) * dt) << "without one: as on the ground";
  }
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

TEST(Jumping, reaches_the_semi_implicit_apex_once_for_one_press) {
  Stepper jumper = standing({.jump_speed = 16});
  const double floor = jumper.state.position.y();
  double highest = 0;
  int jumps = 0;
  for (int n = 0; n < 300; ++n) {
    jumps += take_offs(jumper, 1, jumping());
    highest = std::max(highest, jumper.state.position.y() - floor);
  }
  EXPECT_NEAR(highest, 16.0 * 16 / (2 * gravity) - 16 * dt / 2, 1e-13) << "short of v²/2g by v dt / 2";
  EXPECT_EQ(jumps, 1) << "held through several landings";
  EXPECT_EQ(take_offs(jumper, 1, {}), 0);
  EXPECT_EQ(take_offs(jumper, 1, jumping()), 1) << "pressed anew";
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

/// At rest between walls at x = -2 and x = 2, as far from one of them as it is said.
Stepper beside_a_wall(std::string_view kind, double gap, double toward, bool rule) {
  Stepper jumper = without_rounding({box(-100, -1, 100, 0), box(2, 0, 3, 9), box(-3, 0, -2, 9)},
                                    {.no_jump_toward_wall = rule}, kind);
  jumper.at(toward * (2 - half_width - gap), half_height).steps(40);
  return jumper;
}

TEST(JumpingRules, refuse_a_jump_together_with_the_direction_after_standing_idle_or_walking_by_every_technique) {
  for (const std::string_view kind : technique_names()) {
    for (const double toward : {1.0, -1.0}) {
      const auto jumps = [&](double gap, std::optional<double> move, int walks = 0, bool rule = true) {
        Stepper jumper = beside_a_wall(kind, gap, toward, rule);
        EXPECT_FALSE(jumper.state.wall_right || jumper.state.wall_left) << kind << ": nothing was wanted sideways";
        jumper.steps(walks, walking(toward));
        return take_offs(jumper, 4, jumping(move));
      };
      EXPECT_EQ(jumps(px / 2, toward), 0) << kind;
      EXPECT_EQ(jumps(px / 2, toward, 0, false), 1) << kind << ": without the rule";
      EXPECT_EQ(jumps(px / 2, -toward), 1) << kind;
      EXPECT_EQ(jumps(px / 2, {}), 1) << kind;
      // Beside is the next square, whole.
      EXPECT_TRUE(kind == "grid" || jumps(3 * px, toward) == 1) << kind;
      // It sticks to the floor before it comes to the wall.
      for (int walks = 60; walks < 80 && kind != "wind_back"; ++walks)
        EXPECT_EQ(jumps(0.4, toward, walks), 0) << kind << walks;
    }
  }
}

TEST(Refusals, change_nothing_for_input_that_is_no_number) {
  struct Case {
    CharacterState state = busy();
    Input input{.move = 0.5};
    StepContext context{{0, -10}, 1.0 / 60};
  };
  const double infinity = std::numeric_limits<double>::infinity();
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
