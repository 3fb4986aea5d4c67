/// A character whose input does not change comes to rest, bit for bit, under a gravity up to 60 degrees off up: in
/// corners, notches and funnels, and at walls. The campaign judges the way there: slanted.
#include "campaign/draw.hpp"
#include "controller/stepping.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::test {
namespace {

using compare::PlayLevel;

/// Some jump over the walls.
bool is_in_hall(const CharacterState& state) { return state.position.cwiseAbs().maxCoeff() < 50; }

/// In a notch of a steep and a walkable side a fall meets the steep one first, slides along it, and goes up the other
/// one by as much, in each step: for less than a millimetre.
int most_restless(PlayLevel level) { return level == PlayLevel::sawtooth ? sampled(6) : 0; }

class SlantedGravity : public ::testing::TestWithParam<PlayLevel> {};

TEST_P(SlantedGravity, brings_to_rest_who_is_steered_alike_for_long) {
  constexpr int most_steps = 60 * 60;
  constexpr int rest = 60;  // so many steps without a change
  const std::uint64_t first = 40'000'003 * (1 + static_cast<std::uint64_t>(GetParam()));
  int rested = 0;
  int restless = 0;
  for (std::uint64_t seed = first; seed < first + sampled(std::uint64_t{1000}); ++seed) {
    const compare::RandomRun run = draw_slanted(GetParam(), seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    if (std::abs(run.scene.gravity.x()) < 1) continue;  // it takes minutes to the wall
    stepping::Stepper player(run.scene.scenery.colliders, run.scene.character);
    player.gravity = run.scene.gravity;
    player.dt = run.scene.dt;
    CharacterState& state = player.state;
    state.position = run.scene.start.position;
    Input input;
    // With the key at 0 it is braked in each step, and pulled again: it creeps, by gravity times dt.
    if (seed % 3 > 0) input.move = seed % 3 == 1 ? -1 : 1;
    int unchanged = 0;
    for (int step = 0; step < most_steps && unchanged < rest && is_in_hall(state); ++step) {
      const CharacterState before = state;
      player.step(input);
      unchanged = state == before ? unchanged + 1 : 0;
    }
    if (!is_in_hall(state)) continue;
    if (unchanged == rest) {
      ++rested;
      EXPECT_TRUE(state.grounded);
    } else if (++restless > most_restless(GetParam())) {
      ADD_FAILURE() << "still goes by (" << state.velocity.transpose() << ") m/s at (" << state.position.transpose()
                    << ")";
    }
  }
  EXPECT_GT(rested, sampled(700));
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, SlantedGravity, ::testing::ValuesIn(test::all_play_levels),
                         [](const auto& level) { return name_of(level.param); });

}  // namespace
}  // namespace paperproof::test
