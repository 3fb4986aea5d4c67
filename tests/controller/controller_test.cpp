/// What is common to every technique: what is refused (input, movers that no step can begin with, scratch memory of
/// another), and what no situation can say of a walk. How a character falls, walks and jumps is in
/// tests/situations/motion.json and jumps.json.
#include "controller/states.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace paperproof::stepping {
namespace {

/// Some techniques are for scenery that stands still.
bool knows_movers(std::string_view kind) {
  const auto make = [kind] { (void)Stepper({box(0, 0, 1, 1, 0)}, {}, kind); };
  return refusal_by<NotExpressible>(make).empty();
}

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
    Vec2d gravity{0, -10};
    double dt = frame;
    std::optional<MoverMotion> motion{};  ///< Of a block beside it.
  };
  std::vector<Case> cases;
  const auto add = [&cases]() -> Case& { return cases.emplace_back(); };
  for (const double bad : {infinity - infinity, infinity, -infinity}) {
    for (const Eigen::Index axis : {0, 1}) {
      for (Vec2d CharacterState::*field : {&CharacterState::position, &CharacterState::velocity,
                                           &CharacterState::technique_memory, &CharacterState::last_free})
        (add().state.*field)[axis] = bad;
      for (Vec2d Ride::*field : {&Ride::place, &Ride::velocity}) (add().state.ride.*field)[axis] = bad;
      add().gravity[axis] = bad;
    }
    add().input.move = bad;
    add().dt = bad;
  }
  for (const double bad : {0.0, -0.0, -1e-9, -1.0}) add().dt = bad;
  const double range = Tolerances{}.range;
  const double beyond = std::nextafter(range, infinity);
  for (const auto& [from, to] : std::initializer_list<std::pair<Vec2d, Vec2d>>{{{nan, 0}, {0, 0}},
                                                                               {{0, 0}, {0, nan}},
                                                                               {{infinity, 0}, {infinity, 0}},
                                                                               {{-1.5e308, 0}, {1.5e308, 0}},
                                                                               {{0, beyond}, {0, 0}},
                                                                               {{0, 0}, {-beyond, 0}}})
    add().motion = {from, to};
  Case& no_speed = add();
  no_speed.motion = {{0, 0}, {1e6, 0}};
  no_speed.dt = 1e-303;
  for (const std::string_view kind : technique_names()) {
    const bool moves = knows_movers(kind);
    Stepper stepper({box(-9, -9, 9, 0), box(-1, 3, 1, 4, moves ? 0 : no_mover)}, {}, kind);
    const auto step = [&](const Case& each) {
      stepper.state = each.state;
      stepper.gravity = each.gravity;
      stepper.dt = each.dt;
      if (moves) stepper.movers = {each.motion.value_or(MoverMotion{})};
      return stepper.step(each.input);
    };
    EXPECT_NE(step({}), StepStatus::invalid_input);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      SCOPED_TRACE(testing::Message() << kind << ", case " << i);
      if (cases[i].motion && !moves) continue;
      EXPECT_EQ(step(cases[i]), StepStatus::invalid_input);
      EXPECT_EQ(stepper.report.status, StepStatus::invalid_input);
      EXPECT_TRUE(same_bits(stepper.state, cases[i].state));
    }
  }
  Stepper anywhere({box(-9, -9, 9, 0)});
  anywhere.state.last_free.x() = infinity;
  EXPECT_EQ(anywhere.at(0, 3).step(), StepStatus::moved) << "a last free position that is not valid";
  EXPECT_THROW(Stepper({}, {.walk_speed = -1}), InvalidCharacter);
  Stepper far({box(-9, -9, 9, 0), box(-1, 3, 1, 4, 0)});
  far.movers = {{{-range, range}, {range, range}}};
  EXPECT_EQ(far.at(0, 1).step(), StepStatus::moved) << "as far away as a character may be";
}

/// The wall is 0.3 m away. A press stays pending, so each reach begins anew. `make_controller` would set the reach.
TEST(Jumps, toward_a_wall_are_refused_as_far_away_as_the_character_says) {
  for (const auto& [reach, jumped] : {std::pair{0.29, true}, {0.31, false}}) {
    const CharacterDef character{.no_jump_toward_wall = true, .wall_reach = reach};
    Stepper walker(std::make_unique<Scenery>(SceneryDef{{box(-9, -1, 9, 0), box(half_width + 0.3, 0, 9, 4)}}),
                   [&](const Scenery& level) { return TechniqueController(Controller(level, character)); });
    walker.at(0, half_height + 1e-6).step();
    ASSERT_TRUE(walker.state.grounded);
    walker.step({.move = 1, .jump = true});
    EXPECT_EQ(walker.state.jumping, jumped) << reach;
  }
}

TEST(Refusals, change_nothing_for_a_step_that_leaves_the_range) {
  const double range = Tolerances{}.range;
  for (const std::string_view kind : technique_names()) {
    Stepper stepper({box(-9, -9, 9, 0)}, {}, kind);
    stepper.gravity = {0, 0};
    stepper.dt = 1;
    for (const Vec2d& velocity :
         {Vec2d(1.3 * range, 0), Vec2d(0, 1.3 * range), Vec2d(0, -1.3 * range), Vec2d(1e300, 0)}) {
      stepper.state = busy();
      stepper.state.crushed = false;
      stepper.state.crushers.clear();
      stepper.state.velocity = velocity;
      const CharacterState before = stepper.state;
      EXPECT_EQ(stepper.step({.jump = true}), StepStatus::out_of_range) << kind;
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

/// A level of so many tiles with everything that takes scratch memory.
std::vector<ColliderDef> level(int tiles, std::string_view kind = "octagon_sweep") {
  std::vector<ColliderDef> colliders;
  if (knows_movers(kind)) colliders = {chain({{-2, 2}, {2, 2}}, Vec2d{0, 1}), box(-2, 4, 2, 5, 0)};
  for (int i = 0; i < tiles; ++i) {
    colliders.push_back(box(i - 2, -1, i - 1, 0));
    colliders.push_back(box(i - 2, 0, i - 1, 1));
    colliders.back().sensor = true;
  }
  return colliders;
}

/// A step through the whole level, with what would be asked for in it.
void expect_refused(Stepper& stepper, Scratch& scratch, const char* what) {
  stepper.with_velocity(300, -20);
  const CharacterState before = stepper.state;
  const Input input{.move = 1.0, .jump = true, .drop = true};
  EXPECT_EQ(stepper.controller.step(stepper.state, input, stepper.context(), scratch, stepper.report),
            StepStatus::invalid_input)
      << what;
  EXPECT_EQ(stepper.report.status, StepStatus::invalid_input) << what;
  EXPECT_TRUE(same_bits(stepper.state, before)) << what;
}

TEST(ScratchMemory, of_anybody_else_is_refused_by_every_technique) {
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    Stepper small(level(3, kind), {}, kind);
    Stepper large(level(300, kind), {}, kind);
    large.at(250, 0.7).step();  // remembers candidates that the small level does not have
    Scratch none;
    small.at(-1, 1.5);
    expect_refused(small, none, "nobody's");
    expect_refused(small, large.scratch, "a larger level's");
    expect_refused(large, small.scratch, "a smaller level's");
    Scratch taken = std::move(small.scratch);
    expect_refused(small, small.scratch, "moved from");
    small.scratch = std::move(taken);
    EXPECT_NE(small.step(), StepStatus::invalid_input) << "its own, moved";
  }
}

TEST(ScratchMemory, goes_along_with_its_controller_and_is_not_the_next_ones_in_the_same_place) {
  const Scenery large(SceneryDef{level(300)});
  const Scenery small(SceneryDef{level(3)});
  const std::vector<MoverMotion> movers(1);
  std::optional<Controller> controller;
  StepReport report;
  for (int i = 0; i < 100; ++i) {
    controller.emplace(large, CharacterDef{});
    Scratch scratch = controller->make_scratch();
    const Controller moved = std::move(*controller);
    CharacterState state;
    state.position = {250, 0.7};
    ASSERT_EQ(moved.step(state, {}, {{0, -10}, frame, movers}, scratch, report), StepStatus::moved);
    controller.emplace(small, CharacterDef{});
    ASSERT_EQ(controller->step(state, {}, {{0, -10}, frame, movers}, scratch, report), StepStatus::invalid_input);
  }
}

}  // namespace
}  // namespace paperproof::stepping
