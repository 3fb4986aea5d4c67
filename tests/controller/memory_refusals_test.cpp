/// Scratch memory that is not the controller's, and movers that no step can begin with: refused, and nothing changes.
#include "campaign/shapes.hpp"
#include "controller/stepping.hpp"
#include "support/refusal.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace paperproof::stepping {
namespace {

using compare::box;

/// Some techniques are for scenery that stands still.
bool knows_movers(std::string_view kind) {
  const auto make = [kind] { (void)Stepper({box(0, 0, 1, 1, 0)}, {}, kind); };
  return test::refusal_by<NotExpressible>(make).empty();
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
  EXPECT_EQ(stepper.controller.step(stepper.state, input, {stepper.gravity, stepper.dt, stepper.movers}, scratch,
                                    stepper.report),
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
    ASSERT_EQ(moved.step(state, {}, {{0, -10}, 1.0 / 60, movers}, scratch, report), StepStatus::moved);
    controller.emplace(small, CharacterDef{});
    ASSERT_EQ(controller->step(state, {}, {{0, -10}, 1.0 / 60, movers}, scratch, report), StepStatus::invalid_input);
  }
}

TEST(Movers, that_no_step_can_begin_with_are_refused_by_every_technique) {
  const double range = Tolerances{}.range;
  const double beyond = std::nextafter(range, infinity);
  struct Bad {
    const char* what;
    MoverMotion motion;
    double dt = 0.1;
  };
  const std::vector<Bad> all_bad{{"not a number", {{nan, 0}, {0, 0}}},
                                 {"not a number at the end", {{0, 0}, {0, nan}}},
                                 {"infinite", {{infinity, 0}, {infinity, 0}}},
                                 {"a way that is no number", {{-1.5e308, 0}, {1.5e308, 0}}},
                                 {"out of range", {{0, beyond}, {0, 0}}},
                                 {"goes out of range", {{0, 0}, {-beyond, 0}}},
                                 {"a speed that is no number", {{0, 0}, {1e6, 0}}, 1e-303}};
  const std::vector<ColliderDef> colliders{box(-9, -9, 9, 0), box(-1, 3, 1, 4, 0)};
  for (const std::string_view kind : technique_names()) {
    if (!knows_movers(kind)) continue;
    SCOPED_TRACE(kind);
    Stepper stepper(colliders, {}, kind);
    stepper.at(0, 1);
    for (const auto& [what, motion, dt] : all_bad) {
      stepper.movers = {motion};
      stepper.dt = dt;
      expect_refused(stepper, stepper.scratch, what);
    }
  }
  Stepper far(colliders);
  far.movers = {{{-range, range}, {range, range}}};
  EXPECT_EQ(far.at(0, 1).step(), StepStatus::moved) << "as far away as a character may be";
}

}  // namespace
}  // namespace paperproof::stepping
