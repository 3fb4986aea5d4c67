/// A step depends on its arguments and on nothing else: not on scratch memory, other threads or what ran before. And it
/// takes memory only where something comes near for the first time.
#include "controller/states.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/saved_state.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

namespace paperproof::stepping {
namespace {

using test::Terrain;

constexpr std::uint64_t seed = 20;
constexpr std::size_t steps = 240;

/// What the grid expresses.
std::vector<ColliderDef> whole_squares(Random& random) {
  std::vector<ColliderDef> squares{box(-12, -2, 12, -1)};
  for (int i = 0; i < 30; ++i) {
    const int x = random.integer(-12, 11);
    const int y = random.integer(-1, 7);
    if (x != 0 || y != 3) squares.push_back(box(x, y, x + 1, y + 1));
  }
  return squares;
}

/// A character in a random level.
Stepper walker_in(Terrain family, std::string_view kind) {
  Random random(seed);
  return {kind == "grid" ? whole_squares(random) : test::random_terrain(family, random, {0, 0}).colliders, {}, kind};
}

/// It is thrown now and then.
void take(std::size_t step, const TechniqueController& controller, CharacterState& state, Scratch& scratch,
          StepReport& report) {
  Random keys(step / 10);
  if (step % 60 == 30) state.velocity = keys.point(300);
  // What fell out of the level comes in again.
  if (state.position.cwiseAbs().maxCoeff() > 12) state.position = {0, 3};
  const Input input{.move = keys.integer(-1, 1), .jump = keys.chance(0.5)};
  controller.step(state, input, {{0, -30}, frame}, scratch, report);
}

/// @return whether the steps after this one come to the same states from a copy of its state.
bool goes_on(std::size_t after, const TechniqueController& controller, const std::vector<CharacterState>& all,
             bool fresh_scratch) {
  CharacterState state = all[after];
  Scratch scratch = controller.make_scratch();
  StepReport report;
  for (std::size_t i = after + 1; i < all.size(); ++i) {
    if (fresh_scratch) scratch = controller.make_scratch();
    take(i, controller, state, scratch, report);
    if (!same_bits(state, all[i]) || state != all[i]) return false;
  }
  return true;
}

/// @return steps with contact; nothing where the technique does not express the level.
std::optional<int> expect_replays(Terrain family, std::string_view kind) {
  std::optional<Stepper> walker;
  try {
    walker.emplace(walker_in(family, kind));
  } catch (const NotExpressible&) {  // a picture and a one-way chain, for example
    return {};
  }
  SCOPED_TRACE(testing::Message() << test::name_of(family) << ", " << kind << ", seed " << seed);
  std::vector<CharacterState> all(steps);
  int contacts = 0;
  const auto walk_all = [&] {
    walker->state = {};
    walker->at(0, 3);
    contacts = 0;
    for (std::size_t i = 0; i < steps; ++i) {
      take(i, walker->controller, walker->state, walker->scratch, walker->report);
      all[i] = walker->state;
      contacts += !walker->report.move.contacts.empty();
    }
  };
  walk_all();
  const std::size_t before = tests::allocations();
  walk_all();
  EXPECT_EQ(tests::allocations(), before) << "a step takes no memory where the scratch knows all that is near";
  bool elsewhere = false;
  {
    const std::jthread thread([&] { elsewhere = goes_on(steps / 2, walker->controller, all, true); });
    EXPECT_TRUE(goes_on(steps / 2, walker->controller, all, false));
  }
  EXPECT_TRUE(elsewhere) << "in another thread";
  return contacts;
}

// Two threads share the controller; one of them has new scratch memory in each step.
TEST(Replay, from_a_copied_state_gives_the_same_bits) {
  const std::size_t before = tests::allocations();
  const auto probe = std::make_unique<int>(1);
  [[maybe_unused]] int* volatile kept = probe.get();  // or a compiler may leave it out
  ASSERT_EQ(tests::allocations(), before + 1) << "allocations are counted";
  for (const std::string_view kind : technique_names()) {
    int contacts = 0;
    bool walked = false;
    for (const Terrain family : test::all_terrains) {
      const std::optional<int> touched = expect_replays(family, kind);
      walked = walked || touched;
      contacts += touched.value_or(0);
    }
    EXPECT_TRUE(walked) << kind;
    EXPECT_GT(contacts, 300) << "the walks must meet something: " << kind;
  }
}

TEST(SavedStates, are_restored_whole_and_have_the_bytes_of_equal_states_and_no_others) {
  const auto same_bytes = [](const CharacterState& a, const CharacterState& b) {
    const SavedState one = save(a);
    const SavedState other = save(b);
    return std::memcmp(&one, &other, sizeof one) == 0;
  };
  const CharacterState state = busy();
  CharacterState more_crushed = state;
  more_crushed.crushers[2].has_side = true;
  CharacterState less_crushed = state;
  less_crushed.crushers.pop_back();
  CharacterState free_on_the_left = state;
  free_on_the_left.wall_left = false;
  for (const CharacterState& other : {state, CharacterState(), more_crushed, less_crushed, free_on_the_left}) {
    EXPECT_EQ(restored(save(other)), other);
    EXPECT_EQ(same_bytes(state, other), state == other);
  }
  CharacterState negative_zero;
  negative_zero.velocity.x() = -0.0;
  EXPECT_TRUE(same_bytes(CharacterState(), negative_zero));
}

TEST(SavedBytes, of_any_kind_give_a_state_that_is_refused_or_stepped) {
  Random random(seed);
  Stepper walker = walker_in(Terrain::tiles, "octagon_sweep");
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    SavedState noise = save(busy());
    auto* bytes = reinterpret_cast<unsigned char*>(&noise);
    for (int changes = random.integer(1, 30); changes > 0; --changes) {
      const int place = random.below(static_cast<int>(sizeof noise));
      bytes[place] = static_cast<unsigned char>(random.below(256));
    }
    walker.state = restored(noise);
    const bool cannot = is_refused(walker.step());
    EXPECT_TRUE(cannot || walker.state.position.allFinite());
    refused += cannot;
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace paperproof::stepping
