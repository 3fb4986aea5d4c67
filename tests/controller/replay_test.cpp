/// A step depends on its arguments and on nothing else: not on scratch memory, other threads or what ran before. And it
/// takes no memory.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace paperproof::stepping {
namespace {

using test::all_families;
using test::Family;

constexpr std::uint64_t seed = 20;

/// What a player does in one step; now and then the character is thrown.
struct Step {
  Input input;
  std::optional<Vec2d> launch;
};
std::vector<Step> script_of(int steps) {
  test::Random dice(seed);
  std::vector<Step> all;
  Input input;
  for (int i = 0; i < steps; ++i) {
    if (dice.chance(0.1)) input.move = dice.integer(-1, 1);
    if (dice.chance(0.1)) input.jump = !input.jump;
    Step step{input, {}};
    if (dice.chance(0.05)) step.launch = Vec2d{dice.between(-300, 300), dice.between(-300, 300)};
    all.push_back(step);
  }
  return all;
}

/// A random level and a character in it.
template <class Scalar>
struct Walk {
  test::Random random{seed};
  Scenery<Scalar> scenery;
  Controller<Scalar> controller;

  Walk(Family family, std::string_view kind)
      : scenery(test::random_scenery(family, random, {0, 0})),
        controller(make_controller(scenery, CharacterDef{}, {.name = kind})) {}

  static CharacterState<Scalar> start() {
    CharacterState<Scalar> state;
    state.position = {0, 3};
    return state;
  }

  void take(const Step& step, CharacterState<Scalar>& state, Scratch<Scalar>& scratch,
            StepReport<Scalar>& report) const {
    if (step.launch) state.velocity = step.launch->template cast<Scalar>();
    // What fell out of the level comes in again.
    if (state.position.cwiseAbs().maxCoeff() > 12) state.position = start().position;
    controller.step(state, step.input, {{0, -30}, Scalar(1) / 60}, scratch, report);
  }

  [[nodiscard]] std::vector<CharacterState<Scalar>> states(const std::vector<Step>& steps, bool fresh_scratch) const {
    std::vector<CharacterState<Scalar>> all;
    CharacterState<Scalar> state = start();
    Scratch<Scalar> scratch = controller.make_scratch();
    StepReport<Scalar> report;
    for (const Step& step : steps) {
      if (fresh_scratch) scratch = controller.make_scratch();
      take(step, state, scratch, report);
      all.push_back(state);
    }
    return all;
  }
};

/// A picture and a one-way chain, for example, do not go together.
bool expresses(std::string_view kind, Family family) {
  try {
    return Walk<double>(family, kind).controller.technique().name() == kind;
  } catch (const NotExpressible&) {
    return false;
  }
}

template <class Scalar>
::testing::AssertionResult same(const std::vector<CharacterState<Scalar>>& a,
                                const std::vector<CharacterState<Scalar>>& b) {
  if (a.size() != b.size()) return ::testing::AssertionFailure() << a.size() << " and " << b.size() << " states";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same_bits(a[i], b[i]))
      return ::testing::AssertionFailure() << "seed " << seed << ": other bits from step " << i << " on";
  return ::testing::AssertionSuccess();
}

/// @return steps with contact.
template <class Scalar>
int expect_no_allocation(Family family, std::string_view kind) {
  const Walk<Scalar> walk(family, kind);
  const auto script = script_of(300);
  CharacterState<Scalar> state = Walk<Scalar>::start();
  Scratch<Scalar> scratch = walk.controller.make_scratch();
  StepReport<Scalar> report;
  int contacts = 0;
  const std::size_t before = tests::allocations();
  for (const auto& step : script) {
    walk.take(step, state, scratch, report);
    contacts += !report.move.contacts.empty();
  }
  EXPECT_EQ(tests::allocations(), before) << test::name_of(family) << ", " << kind;
  return contacts;
}

TEST(Memory, is_not_allocated_while_stepping) {
  const std::size_t before = tests::allocations();
  const auto probe = std::make_unique<int>(1);
  [[maybe_unused]] int* volatile kept = probe.get();  // or a compiler may leave it out
  ASSERT_EQ(tests::allocations(), before + 1) << "allocations are counted";
  for (const std::string_view kind : technique_names()) {
    int contacts = 0;
    bool walked = false;
    for (const Family family : all_families) {
      if (!expresses(kind, family)) continue;
      walked = true;
      contacts += expect_no_allocation<double>(family, kind);
      contacts += expect_no_allocation<float>(family, kind);
    }
    // No family is made of whole squares: see grid_test.
    EXPECT_TRUE(walked || kind == "grid") << kind;
    EXPECT_GT(contacts, walked ? 400 : -1) << "the walks must meet something: " << kind;
  }
}

TEST(Replay, from_a_copied_state_gives_the_same_bits) {
  for (const Family family : all_families)
    for (const std::string_view kind : technique_names()) {
      if (!expresses(kind, family)) continue;
      const Walk<double> walk(family, kind);
      const auto script = script_of(240);
      const auto all = walk.states(script, false);
      CharacterState<double> state = all[119];
      Scratch<double> scratch = walk.controller.make_scratch();
      StepReport<double> report;
      for (std::size_t i = 120; i < script.size(); ++i) {
        walk.take(script[i], state, scratch, report);
        ASSERT_TRUE(same_bits(state, all[i])) << test::name_of(family) << ", " << kind << ", step " << i;
      }
    }
}

TEST(Replay, with_fresh_scratch_memory_gives_the_same_bits) {
  for (const Family family : all_families)
    for (const std::string_view kind : technique_names()) {
      if (!expresses(kind, family)) continue;
      const auto script = script_of(test::sampled(240));
      const Walk<double> walk(family, kind);
      EXPECT_TRUE(same(walk.states(script, true), walk.states(script, false))) << test::name_of(family) << ", " << kind;
      const Walk<float> in_float(family, kind);
      EXPECT_TRUE(same(in_float.states(script, true), in_float.states(script, false)))
          << test::name_of(family) << ", " << kind << ", float";
    }
}

TEST(Replay, in_two_threads_that_share_a_controller_gives_the_same_bits) {
  for (const Family family : all_families)
    for (const std::string_view kind : technique_names()) {
      if (!expresses(kind, family)) continue;
      const Walk<double> walk(family, kind);
      const auto script = script_of(test::sampled(240));
      const auto alone = walk.states(script, false);
      std::vector<CharacterState<double>> first;
      std::vector<CharacterState<double>> second;
      {
        std::jthread one([&] { first = walk.states(script, false); });
        std::jthread two([&] { second = walk.states(script, true); });
      }
      EXPECT_TRUE(same(first, alone)) << test::name_of(family) << ", " << kind;
      EXPECT_TRUE(same(second, alone)) << test::name_of(family) << ", " << kind;
    }
}

}  // namespace
}  // namespace paperproof::stepping
