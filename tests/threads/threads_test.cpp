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
constexpr MoverIndex movers = 4;
constexpr double dt = 1.0 / 60;
const Vec2d gravity{0, -30};

/// A lift, and planks that turn.
std::vector<MoverMotion> motions_in(int step) {
  const double begin = step * dt;
  const double end = (step + 1) * dt;
  std::vector<MoverMotion> motions{{{0, 2 * std::sin(begin)}, {0, 2 * std::sin(end)}}};
  for (MoverIndex mover = 1; mover < movers; ++mover) {
    const Vec2d place{8.0 * mover - 16, -9};
    motions.push_back({place, place, begin * mover, end * mover});
  }
  return motions;
}

/// Every state of a character, with keys held for a while each, drawn by its number.
std::vector<CharacterState> states_of(int character, const Controller& controller, bool among_movers) {
  Random random(static_cast<std::uint64_t>(character));
  Scratch scratch = controller.make_scratch();
  StepReport report;
  Input input{.move = 0.0};
  std::vector<CharacterState> states(1);
  states[0].position = {character - 0.5 * characters, 12};
  for (int step = 0; step < steps; ++step) {
    if (random.chance(0.05)) input = {.move = random.integer(-1, 1), .jump = random.chance(0.4)};
    const std::vector<MoverMotion> motions = among_movers ? motions_in(step) : std::vector<MoverMotion>();
    states.push_back(states.back());
    controller.step(states.back(), input, {gravity, dt, motions}, scratch, report);
  }
  return states;
}

/// @param walk every state of the character with a number.
void expect_the_same_in_threads(const auto& walk) {
  std::vector<std::vector<CharacterState>> in_threads(characters);
  {
    std::vector<std::jthread> threads;
    for (int k = 0; k < characters; ++k)
      threads.emplace_back([&walk, &states = in_threads[static_cast<std::size_t>(k)], k] { states = walk(k); });
  }  // waits for all
  for (int k = 0; k < characters; ++k) {
    const std::vector<CharacterState> alone = walk(k);
    EXPECT_EQ(in_threads[static_cast<std::size_t>(k)], alone);
    EXPECT_GT((alone.back().position - alone.front().position).norm(), 3) << "who stays where it is shows nothing";
  }
}

TEST(SharedController, gives_each_thread_what_it_gives_one_alone) {
  Random random(7);
  const Scenery scenery(play_level(PlayLevel::kerbs, random));
  const Controller controller(scenery, {.step_height = 0.3});
  expect_the_same_in_threads([&](int character) { return states_of(character, controller, false); });
}

TEST(SharedLevel, gives_each_thread_what_it_gives_one_alone) {
  Random random(8);
  Level level;
  for (const ColliderDef& collider : play_level(PlayLevel::platforms, random).colliders) level.add(collider);
  for (MoverIndex mover = 0; mover < movers; ++mover) level.add(compare::box(-3, -0.1, 3, 0.1, mover));
  expect_the_same_in_threads([&](int character) { return states_of(character, Controller(level, {}), true); });
}

}  // namespace
}  // namespace paperproof::test
