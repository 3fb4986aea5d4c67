/// One level and one controller, shared by threads: each character comes to what it comes to alone. `tests/run.sh`
/// builds this with the thread sanitizer as well.
#include "campaign/shapes.hpp"
#include "support/random_runs.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

namespace paperproof::test {
namespace {

constexpr int characters = 4;
constexpr int steps = 300;
constexpr double dt = 1.0 / 60;
const Vec2d gravity{0, -30};

/// Keys held for a while each, drawn by the character's number.
class Keys {
 public:
  explicit Keys(int character) : random_(static_cast<std::uint64_t>(character)) {}
  Input next() {
    if (random_.chance(0.05)) input_ = {.move = random_.integer(-1, 1), .jump = random_.chance(0.4)};
    return input_;
  }

 private:
  Random random_;
  Input input_{.move = 0.0};
};

/// Every state of every character, each in a thread of its own or one after the other.
/// @param make_stepper makes what steps one character; it is called for each where that walks.
std::vector<std::vector<CharacterState>> all_states(const auto& make_stepper, bool in_threads) {
  std::vector<std::vector<CharacterState>> all(characters);
  std::vector<std::jthread> threads;
  for (int k = 0; k < characters; ++k) {
    const auto walk = [&make_stepper, &states = all[static_cast<std::size_t>(k)], k] {
      auto step_once = make_stepper();
      Keys keys(k);
      states.emplace_back().position = {k - 0.5 * characters, 12};
      for (int step = 0; step < steps; ++step) {
        states.push_back(states.back());
        step_once(states.back(), keys.next(), step);
      }
    };
    if (in_threads)
      threads.emplace_back(walk);
    else
      walk();
  }
  threads.clear();  // waits for all
  return all;
}

void expect_the_same_in_threads(const auto& make_stepper) {
  const std::vector<std::vector<CharacterState>> alone = all_states(make_stepper, false);
  EXPECT_EQ(all_states(make_stepper, true), alone);
  int moved = 0;
  for (const std::vector<CharacterState>& states : alone)
    moved += (states.back().position - states.front().position).norm() > 3;
  EXPECT_EQ(moved, characters) << "who stays where it is shows nothing";
}

TEST(SharedController, gives_each_thread_what_it_gives_one_alone) {
  Random random(7);
  const Scenery scenery(play_level(PlayLevel::kerbs, random));
  CharacterDef character;
  character.step_height = 0.3;
  const Controller controller(scenery, character);
  expect_the_same_in_threads([&] {
    return [&, scratch = controller.make_scratch(), report = StepReport()](CharacterState& state, const Input& input,
                                                                           int) mutable {
      controller.step(state, input, {gravity, dt}, scratch, report);
    };
  });
}

/// A lift, and planks that turn.
std::vector<MoverMotion> motions_in(int step) {
  const double begin = step * dt;
  const double end = (step + 1) * dt;
  std::vector<MoverMotion> motions{{{0, 2 * std::sin(begin)}, {0, 2 * std::sin(end)}}};
  for (MoverIndex mover = 1; mover < 4; ++mover) {
    const Vec2d place{8.0 * mover - 16, -9};
    motions.push_back({place, place, begin * mover, end * mover});
  }
  return motions;
}

TEST(SharedLevel, gives_each_thread_what_it_gives_one_alone) {
  Random random(8);
  Level level;
  for (const ColliderDef& collider : play_level(PlayLevel::platforms, random).colliders) level.add(collider);
  for (MoverIndex mover = 0; mover < 4; ++mover) level.add(compare::box(-3, -0.1, 3, 0.1, mover));
  expect_the_same_in_threads([&] {
    return [controller = Controller(level, CharacterDef{}), scratch = Scratch(), report = StepReport()](
               CharacterState& state, const Input& input, int step) mutable {
      if (scratch.maker.expired()) scratch = controller.make_scratch();
      const std::vector<MoverMotion> motions = motions_in(step);
      controller.step(state, input, {gravity, dt, motions}, scratch, report);
    };
  });
}

}  // namespace
}  // namespace paperproof::test
