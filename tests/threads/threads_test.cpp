/// One level and one controller, shared by threads: each character comes to what it comes to alone. `tests/run.sh`
/// builds this with the thread sanitizer as well.
#include "campaign/shapes.hpp"
#include "support/random_runs.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/level.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>
#include <vector>

namespace paperproof::test {
namespace {

using State = CharacterState<double>;

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

State start_of(int character) {
  State state;
  state.position = {character - 0.5 * characters, 12};
  return state;
}

/// Every state of every character, each in a thread of its own or one after the other.
using Walk = std::function<std::vector<State>(int character)>;
std::vector<std::vector<State>> all_states(const Walk& walk, bool in_threads) {
  std::vector<std::vector<State>> all(characters);
  std::vector<std::jthread> threads;
  for (int k = 0; k < characters; ++k) {
    const auto take = [&walk, &all, k] { all[static_cast<std::size_t>(k)] = walk(k); };
    if (in_threads)
      threads.emplace_back(take);
    else
      take();
  }
  threads.clear();  // waits for all
  return all;
}

void expect_the_same_in_threads(const Walk& walk) {
  const std::vector<std::vector<State>> alone = all_states(walk, false);
  EXPECT_EQ(all_states(walk, true), alone);
  int moved = 0;
  for (const std::vector<State>& states : alone) moved += (states.back().position - states.front().position).norm() > 3;
  EXPECT_EQ(moved, characters) << "who stays where it is shows nothing";
}

TEST(SharedController, gives_each_thread_what_it_gives_one_alone) {
  Random random(7);
  const Scenery<double> scenery(play_level(PlayLevel::kerbs, random));
  CharacterDef character;
  character.step_height = 0.3;
  const Controller<double> controller(scenery, character);
  expect_the_same_in_threads([&](int k) {
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    Keys keys(k);
    std::vector<State> states{start_of(k)};
    for (int step = 0; step < steps; ++step) {
      states.push_back(states.back());
      controller.step(states.back(), keys.next(), {gravity, dt}, scratch, report);
    }
    return states;
  });
}

/// A lift, and planks that turn.
std::vector<PoseMotion> poses_in(int step) {
  const auto pose = [](MoverIndex mover, double time) -> Pose {
    if (mover == 0) return {{0, 2 * std::sin(time)}, 0};
    return {{8.0 * mover - 16, -9}, time * mover};
  };
  std::vector<PoseMotion> poses;
  for (MoverIndex mover = 0; mover < 4; ++mover)
    poses.push_back({pose(mover, step * dt), pose(mover, (step + 1) * dt)});
  return poses;
}

TEST(SharedLevel, gives_each_thread_what_it_gives_one_alone) {
  Random random(8);
  Level level;
  for (const ColliderDef& collider : play_level(PlayLevel::platforms, random).colliders) level.add(collider);
  for (MoverIndex mover = 0; mover < 4; ++mover) level.add(compare::box(-3, -0.1, 3, 0.1, mover));
  expect_the_same_in_threads([&](int k) {
    LevelController controller(level, CharacterDef{});
    StepReport<double> report;
    Keys keys(k);
    std::vector<State> states{start_of(k)};
    for (int step = 0; step < steps; ++step) {
      states.push_back(states.back());
      const std::vector<PoseMotion> poses = poses_in(step);
      controller.step(states.back(), keys.next(), {gravity, dt, poses}, report);
    }
    return states;
  });
}

}  // namespace
}  // namespace paperproof::test
