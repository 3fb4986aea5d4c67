/// Scratch memory that is not the controller's, and movers that no step can begin with: refused, and nothing changes.
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace paperproof::stepping {
namespace {

/// Some techniques are for scenery that stands still.
bool knows_movers(std::string_view kind) {
  ColliderDef lift = rectangle(0, 0, 1, 1);
  lift.mover = 0;
  const Scenery<double> scenery(SceneryDef{{lift}});
  try {
    (void)make_controller(scenery, CharacterDef{}, {.name = kind});
  } catch (const NotExpressible&) {
    return false;
  }
  return true;
}

/// A level of so many tiles with everything that takes scratch memory.
std::vector<ColliderDef> level(int tiles, std::string_view kind = "octagon_sweep") {
  std::vector<ColliderDef> colliders;
  if (knows_movers(kind)) {
    colliders = {chain({{-2, 2}, {2, 2}}, Vec2d{0, 1}), rectangle(-2, 4, 2, 5)};
    colliders[1].mover = 0;
  }
  for (int i = 0; i < tiles; ++i) {
    colliders.push_back(rectangle(i - 2, -1, i - 1, 0));
    colliders.push_back(rectangle(i - 2, 0, i - 1, 1));
    colliders.back().sensor = true;
  }
  return colliders;
}

/// A step through the whole level, with what would be asked for in it.
template <class Scalar>
void expect_refused(Stepper<Scalar>& stepper, Scratch<Scalar>& scratch, const char* whose) {
  stepper.at(-1, 1.5).with_velocity(300, -20);
  const CharacterState<Scalar> before = stepper.state;
  const Input input{.move = 1.0, .jump = true, .drop = true};
  const StepStatus status = stepper.controller.step(stepper.state, input, {stepper.gravity, stepper.dt, stepper.movers},
                                                    scratch, stepper.report);
  EXPECT_EQ(status, StepStatus::invalid_input) << whose;
  EXPECT_EQ(stepper.report.status, StepStatus::invalid_input) << whose;
  EXPECT_TRUE(same_bits(stepper.state, before)) << whose;
}

template <class Scalar>
void expect_only_its_own_is_taken(std::string_view kind) {
  SCOPED_TRACE(kind);
  Stepper<Scalar> small(level(3, kind), {}, kind);
  Stepper<Scalar> large(level(300, kind), {}, kind);
  large.at(250, 0.7).step();  // remembers candidates that the small level does not have
  Scratch<Scalar> none;
  expect_refused(small, none, "nobody's");
  expect_refused(small, large.scratch, "a larger level's");
  expect_refused(large, small.scratch, "a smaller level's");
  Scratch<Scalar> technique_only = small.controller.technique().make_scratch();
  expect_refused(small, technique_only, "the technique's alone");
  Scratch<Scalar> taken = std::move(small.scratch);
  expect_refused(small, small.scratch, "moved from");
  EXPECT_EQ(small.controller.step(small.state, {}, {small.gravity, small.dt, small.movers}, taken, small.report),
            small.report.status);
  EXPECT_NE(small.report.status, StepStatus::invalid_input) << "its own, moved";
}

TEST(ScratchMemory, of_anybody_else_is_refused_by_every_technique) {
  for (const std::string_view kind : technique_names()) {
    expect_only_its_own_is_taken<double>(kind);
    expect_only_its_own_is_taken<float>(kind);
  }
}

TEST(ScratchMemory, of_a_controller_that_is_gone_is_not_the_next_ones_in_the_same_place) {
  const Scenery<double> large(SceneryDef{level(300)});
  const Scenery<double> small(SceneryDef{level(3)});
  const std::vector<MoverMotion<double>> movers(1);
  std::optional<Controller<double>> controller;
  StepReport<double> report;
  for (int i = 0; i < 100; ++i) {
    controller.emplace(large, CharacterDef{});
    Scratch<double> scratch = controller->make_scratch();
    CharacterState<double> state;
    state.position = {250, 0.7};
    ASSERT_EQ(controller->step(state, {}, {{0, -10}, 1.0 / 60, movers}, scratch, report), StepStatus::moved);
    controller.emplace(small, CharacterDef{});
    ASSERT_EQ(controller->step(state, {}, {{0, -10}, 1.0 / 60, movers}, scratch, report), StepStatus::invalid_input);
  }
}

TEST(ScratchMemory, goes_along_with_a_controller_that_is_moved) {
  const Scenery<double> scenery(SceneryDef{level(3)});
  const std::vector<MoverMotion<double>> movers(1);
  Controller<double> first(scenery, CharacterDef{});
  Scratch<double> scratch = first.make_scratch();
  const Controller<double> second = std::move(first);
  CharacterState<double> state;
  state.position = {0, 0.7};
  StepReport<double> report;
  EXPECT_EQ(second.step(state, {}, {{0, -10}, 1.0 / 60, movers}, scratch, report), StepStatus::moved);
}

/// @param technique by which the crowd moves; each has memory of its own.
void expect_crowd_takes_only_its_own(std::string_view kind, const std::vector<ColliderDef>& colliders) {
  SCOPED_TRACE(kind);
  Together all({{-1, 1}, {1, 1}}, colliders, {}, {.name = kind});
  Together others({{-1, 1}, {1, 1}}, colliders, {}, {.name = kind});
  const Scenery<float> scenery(SceneryDef{colliders});
  const Crowd<float> of_floats = make_crowd(scenery, CharacterDef{}, {.name = kind});
  const auto expect_refused = [&](CrowdScratch& scratch, const char* whose) {
    const std::vector<CharacterState<double>> before = all.states;
    EXPECT_EQ(all.crowd.step(all.states, all.inputs, {{0, -10}, 0.1, all.movers}, scratch, all.report),
              StepStatus::invalid_input)
        << whose;
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_TRUE(same_bits(all.states[i], before[i])) << whose;
  };
  CrowdScratch none;
  none.most_characters = 2;
  expect_refused(none, "nobody's");
  expect_refused(others.scratch, "another's");
  CrowdScratch floats = of_floats.make_scratch(2);
  expect_refused(floats, "of another scalar");
  CrowdScratch taken = std::move(all.scratch);
  expect_refused(all.scratch, "moved from");
  EXPECT_EQ(all.crowd.step(all.states, all.inputs, {{0, -10}, 0.1, all.movers}, taken, all.report), StepStatus::moved);
}

TEST(ScratchMemory, of_another_crowd_is_refused) {
  const std::vector<ColliderDef> still{rectangle(-9, -9, 9, 0)};
  std::vector<ColliderDef> moving = still;
  moving.push_back(rectangle(20, 0, 21, 1));
  moving.back().mover = 0;
  expect_crowd_takes_only_its_own("octagon_sweep", still);
  expect_crowd_takes_only_its_own("octagon_sweep", moving);
  expect_crowd_takes_only_its_own("discrete", moving);
}

struct BadMover {
  const char* what;
  MoverMotion<double> motion;
  double dt = 0.1;
};

std::vector<BadMover> bad_movers() {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double beyond = std::nextafter(Tolerances<double>{}.range, infinity);
  return {{"not a number", {{nan, 0}, {0, 0}}},
          {"not a number at the end", {{0, 0}, {0, nan}}},
          {"infinite", {{infinity, 0}, {infinity, 0}}},
          {"a way that is no number", {{-1.5e308, 0}, {1.5e308, 0}}},
          {"out of range", {{0, beyond}, {0, 0}}},
          {"goes out of range", {{0, 0}, {-beyond, 0}}},
          {"a speed that is no number", {{0, 0}, {1e6, 0}}, 1e-303}};
}

TEST(MoversThatNoStepCanBeginWith, are_refused_by_every_technique) {
  std::vector<ColliderDef> colliders{rectangle(-9, -9, 9, 0), rectangle(-1, 3, 1, 4)};
  colliders[1].mover = 0;
  for (const std::string_view kind : technique_names()) {
    if (!knows_movers(kind)) continue;
    Stepper<double> stepper(colliders, {}, kind);
    for (const BadMover& bad : bad_movers()) {
      stepper.at(0, 1);
      stepper.movers = {bad.motion};
      stepper.dt = bad.dt;
      const CharacterState<double> before = stepper.state;
      EXPECT_EQ(stepper.step({.move = 1.0, .jump = true}), StepStatus::invalid_input) << kind << ", " << bad.what;
      EXPECT_TRUE(same_bits(stepper.state, before)) << kind << ", " << bad.what;
    }
  }
}

TEST(MoversThatNoStepCanBeginWith, are_refused_by_crowds) {
  std::vector<ColliderDef> colliders{rectangle(-9, -9, 9, 0), rectangle(-1, 3, 1, 4)};
  colliders[1].mover = 0;
  for (const std::string_view kind : {"octagon_sweep", "discrete"}) {
    Together all({{-3, 1}, {3, 1}}, colliders, {}, {.name = kind});
    for (const BadMover& bad : bad_movers()) {
      all.movers = {bad.motion};
      all.dt = bad.dt;
      const std::vector<CharacterState<double>> before = all.states;
      EXPECT_EQ(all.step(), StepStatus::invalid_input) << kind << ", " << bad.what;
      for (std::size_t i = 0; i < before.size(); ++i) EXPECT_TRUE(same_bits(all.states[i], before[i])) << bad.what;
    }
  }
}

TEST(Movers, may_be_as_far_away_as_a_character) {
  const double range = Tolerances<double>{}.range;
  std::vector<ColliderDef> colliders{rectangle(-9, -9, 9, 0), rectangle(-1, 3, 1, 4)};
  colliders[1].mover = 0;
  Stepper<double> stepper(colliders);
  stepper.movers = {{{-range, range}, {range, range}}};
  EXPECT_EQ(stepper.at(0, 1).step(), StepStatus::moved);
}

}  // namespace
}  // namespace paperproof::stepping
