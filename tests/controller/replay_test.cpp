/// A step depends on its arguments and on nothing else: not on scratch memory, other threads or what ran before. And it
/// takes no memory.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/saved_state.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

namespace paperproof::stepping {
namespace {

using test::all_terrains;
using test::Terrain;

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

  Walk(Terrain family, std::string_view kind)
      : scenery(test::random_terrain(family, random, {0, 0})),
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
bool expresses(std::string_view kind, Terrain family) {
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
int expect_no_allocation(Terrain family, std::string_view kind) {
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
    for (const Terrain family : all_terrains) {
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
  for (const Terrain family : all_terrains)
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
  for (const Terrain family : all_terrains)
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
  for (const Terrain family : all_terrains)
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

/// All members of a state with values that differ from those of a fresh one.
template <class Scalar>
CharacterState<Scalar> filled() {
  CharacterState<Scalar> state;
  Scalar next = 1;
  const auto fill = [&](Vec2<Scalar>& v) {
    v = {next, next + Scalar(0.5)};
    next += 1;
  };
  fill(state.position);
  fill(state.velocity);
  fill(state.last_free);
  fill(state.technique_memory);
  fill(state.ride.place);
  fill(state.ride.velocity);
  fill(state.ground.normal);
  fill(state.ground.velocity);
  state.coyote_left = Scalar(0.25);
  state.pending_left = Scalar(0.125);
  state.ride.ground = 7;
  state.ground.collider = 8;
  state.ground.state = GroundState::wedge;
  state.stuck_steps = 9;
  state.has_last_free = state.jumping = state.jump_pending = state.wall_right = true;
  state.crushed = true;
  for (ColliderIndex i = 0; i < 3; ++i) {
    Crusher<Scalar> crusher{i, {}, {}, i == 1};
    fill(crusher.last_free);
    fill(crusher.displacement);
    state.crushers.push_back(crusher);
  }
  return state;
}

template <class Scalar>
class SavedStates : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SavedStates, Scalars);

TYPED_TEST(SavedStates, are_restored_whole) {
  const CharacterState<TypeParam> state = filled<TypeParam>();
  EXPECT_EQ(restored(save(state)), state);
  EXPECT_EQ(restored(save(CharacterState<TypeParam>())), CharacterState<TypeParam>());
}

TYPED_TEST(SavedStates, have_the_bytes_of_equal_states_and_no_others) {
  const auto same_bytes = [](const CharacterState<TypeParam>& a, const CharacterState<TypeParam>& b) {
    const SavedState<TypeParam> one = save(a);
    const SavedState<TypeParam> other = save(b);
    return std::memcmp(&one, &other, sizeof one) == 0;
  };
  const CharacterState<TypeParam> state = filled<TypeParam>();
  CharacterState<TypeParam> other = state;
  EXPECT_TRUE(same_bytes(state, other));
  other.crushers[2].has_side = true;
  EXPECT_FALSE(same_bytes(state, other));
  other = state;
  other.crushers.pop_back();
  EXPECT_FALSE(same_bytes(state, other));
  other = state;
  other.wall_left = true;
  EXPECT_FALSE(same_bytes(state, other));
  CharacterState<TypeParam> zero;
  CharacterState<TypeParam> negative_zero;
  negative_zero.velocity = {TypeParam(-0.0), TypeParam(0)};
  EXPECT_TRUE(same_bytes(zero, negative_zero));
}

TEST(SavedBytes, of_any_kind_give_a_state_that_is_are_refused_or_stepped) {
  test::Random random(seed);
  const Walk<double> walk(Terrain::tiles, "octagon_sweep");
  Scratch<double> scratch = walk.controller.make_scratch();
  StepReport<double> report;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    SavedState<double> noise = save(filled<double>());
    auto* bytes = reinterpret_cast<unsigned char*>(&noise);
    const int changed = random.integer(1, 30);
    for (int k = 0; k < changed; ++k) {
      const int place = random.integer(0, static_cast<int>(sizeof noise) - 1);
      bytes[place] = static_cast<unsigned char>(random.integer(0, 255));
    }
    CharacterState<double> state = restored(noise);
    refused += walk.controller.step(state, {}, {{0, -10}, 1.0 / 60}, scratch, report) == StepStatus::invalid_input;
  }
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace paperproof::stepping
