/// The law of motion in random scenes: steering never holds or slows a fall. That mirror images behave alike is in
/// tests/agreement/equalities_test.cpp.
#include "controller/stepping.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::stepping {
namespace {

using test::Random;

/// One character among scenery that stands still.
struct Player : Stepper {
  Player(const SceneryDef& def, const CharacterDef& character) : Stepper(def.colliders, character) {
    gravity = {0, -30};
  }
  /// @param move absent: no steering.
  void play(std::optional<double> move, double seconds, bool jump = false) {
    dt = seconds;
    step({.move = move, .jump = jump});
  }
  /// The last step met ground that is walked on.
  [[nodiscard]] bool landed() const {
    const double least_up = sweep().character().walkable_cosine();
    return state.grounded || std::any_of(report.move.contacts.begin(), report.move.contacts.end(),
                                         [&](const Contact& met) { return met.normal.y() >= least_up; });
  }
};

// Plays until something is touched in the air, then takes the same step with the key to the left, to the right, at 0
// and without a key. Walkable ground ends a fall, and is no part of the promise.
TEST(Steering, neither_holds_nor_slows_a_fall_from_any_touching_state) {
  const int wanted = test::steps_wanted("PAPERPROOF_LAW_STATES", test::sampled(20000));
  int states = 0;
  int falling = 0;
  for (std::uint64_t seed = 1; states < wanted; ++seed) {
    Random random(seed);
    const auto level = test::all_play_levels[seed % test::all_play_levels.size()];
    const SceneryDef scenery = test::play_level(level, random);
    const double dt = 1 / std::array{60.0, 240.0, 1000.0, 10000.0}[seed % 4];
    Player player(scenery, of_shape(test::play_shape(random.integer(0, 2))));
    player.state.position = {random.between(-25, 25), 12};
    double move = 0;
    for (int i = 0; i < 600 && states < wanted; ++i) {
      if (random.chance(0.03)) move = random.integer(-1, 1);
      player.play(move, std::max(dt, 1 / 240.0), random.chance(0.02));
      if (player.state.grounded || player.report.move.contacts.empty()) continue;
      ++states;
      const CharacterState touching = player.state;
      player.play(std::nullopt, dt);
      const double fall = player.state.position.y() - touching.position.y();
      const bool falls = player.report.requested.y() < 0;
      bool landed = player.landed();
      double highest = fall;
      for (const double key : {-1.0, 0.0, 1.0}) {
        player.state = touching;
        player.play(key, dt);
        landed = landed || player.landed();
        highest = std::max(highest, player.state.position.y() - touching.position.y());
      }
      player.state = touching;
      if (landed || !falls || fall >= 0) continue;
      ++falling;
      // To the order of dt: what steering changes on the way to a surface, and the gap that is kept there.
      const double allowed = 0.5 * std::abs(fall) + 2 * Tolerances{}.touch;
      ASSERT_LE(highest - fall, allowed) << test::name_of(level) << ", seed " << seed << ", step " << i
                                         << ": without a key " << fall << " m, with one " << highest << " m";
    }
  }
  EXPECT_GE(falling, states / 4);
}

TEST(DeadEnds, bring_a_walk_to_rest) {
  const int cases = test::steps_wanted("PAPERPROOF_DEAD_ENDS", test::sampled(400));
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases); ++seed) {
    Random random(seed);
    const double rate = std::array{60.0, 240.0, 1000.0}[seed % 3];
    const double slope = random.between(1, 49.9) * degree;
    const double length = random.between(1, 4);
    const double height = length * std::tan(slope);
    const double lean = random.between(-35, 35) * degree;  // of the wall, over the slope or away from it
    const Vec2d foot{length, height};
    const Vec2d top{length + (14 - height) * std::tan(lean), 14};
    std::vector<ColliderDef> scenery{rectangle(-20, -2, length, 0), polygon({{0, 0}, {length, 0}, foot}),
                                     polygon({{length, -2}, {length + 20, -2}, {length + 20, 14}, top, foot})};
    if (random.chance(0.3)) scenery.push_back(rectangle(-20, height + 1.5, length + 3, height + 3));
    CharacterDef character = of_shape(test::play_shape(static_cast<int>(seed % 2)));
    if (random.chance(0.5)) character.snap = 0.3;
    Player player({scenery}, character);
    player.state.position = {-2, 0.7};
    int rest = 0;  // the number of steps after which nothing changed any more
    for (int i = 0; i < 5 * rate; ++i) {
      const Vec2d before = player.state.position;
      const bool grounded = player.state.grounded;
      player.play(1, 1 / rate);
      if (player.state.position != before || player.state.grounded != grounded) rest = i + 1;
    }
    ASSERT_LT(rest, 4 * rate) << "seed " << seed << ", slope " << slope / degree << ", wall leans " << lean / degree;
    ASSERT_TRUE(player.state.grounded) << "seed " << seed << ", slope " << slope / degree << ", wall leans "
                                       << lean / degree;
  }
}

/// On a slope of a whole number in a whole number, whose limit in degrees is what a designer computes.
/// @param less of the limit than what it is exactly [radians].
bool is_climbed(std::uint64_t seed, double less) {
  Random random(seed);
  Vec2d along;
  do {
    along = {static_cast<double>(random.integer(1, 64)), static_cast<double>(random.integer(1, 64))};
    if (random.chance(0.2)) along.y() = along.x();
  } while (along.y() < 0.1 * along.x() || along.y() > 4 * along.x());
  const double sign = random.chance(0.5) ? 1 : -1;
  const double sixteenths = random.integer(1, 400) / 16.0;
  const Vec2d far{random.integer(-16000, 16000) / 16.0, random.integer(-16000, 16000) / 16.0};
  const Vec2d foot = random.chance(0.3) ? Vec2d(0, 0) : far;
  // At least 6 m wide, and exact.
  const Vec2d top = foot + (sixteenths + std::ceil(6 / along.x())) * Vec2d(sign * along.x(), along.y());
  CharacterDef character;
  character.max_climb_degrees =
      along.x() == along.y() && less == 0 ? 45 : (std::atan2(along.y(), along.x()) - less) * 180 / std::numbers::pi;
  const double behind = foot.x() - sign * 20;
  Player player({{polygon({foot, top, {top.x(), foot.y() - 1}, {behind, foot.y() - 1}, {behind, foot.y()}})}},
                character);
  player.state.position = foot + Vec2d{-sign, 0.7};
  player.steps(60, {.move = sign});
  return player.state.position.y() > foot.y() + half_height + 0.1;
}

TEST(ClimbLimit, includes_itself_on_exact_slopes_of_every_place_and_size_and_nothing_steeper) {
  constexpr double microradian = 1e-6;
  const std::uint64_t cases = test::sampled(10000U);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    ASSERT_TRUE(is_climbed(seed, 0)) << "seed " << seed;
    ASSERT_FALSE(is_climbed(seed, microradian)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace paperproof::stepping
