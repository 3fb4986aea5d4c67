/// A state outlives the scenery that its indices are of: the level was read again, and has other colliders.
#include "controller/together.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace paperproof {
namespace {

using namespace stepping;
using test::Random;

/// A floor, a lift, a press that can come down to 1 m above the floor, and a wall.
std::vector<ColliderDef> level(bool moves = true) {
  return {box(-4, -1, 4, 0), box(1, -0.25, 2, 0, moves ? 0 : no_mover), box(-1, 3, 1, 4, moves ? 1 : no_mover),
          box(3, 0, 4, 8)};
}
constexpr ColliderIndex press = 2;

/// Any index, mostly a small one.
ColliderIndex any_index(Random& random) {
  if (random.chance(0.2)) return Ride::none - static_cast<ColliderIndex>(random.integer(0, 3));
  return static_cast<ColliderIndex>(random.chance(0.3) ? random.integer(0, 1 << 30) : random.integer(0, 40));
}

void garble(CharacterState& state, Random& random) {
  state.ride.ground = any_index(random);
  state.crushed = random.chance(0.8);
  state.crushers.clear();
  for (int i = random.integer(0, 8); i > 0; --i)
    state.crushers.push_back(
        {.collider = any_index(random), .last_free = random.point(2), .displacement = random.point(2)});
}

/// The lift goes up and down, the press between 3 m and 1 m above the floor.
std::array<Vec2d, 2> offsets(int step) {
  const double down = step % 20 < 10 ? step % 10 : 10 - step % 10;
  return {Vec2d{0, 0.05 * down}, Vec2d{0, -0.2 * down}};
}

TEST(StaleIndices, of_any_kind_are_survived_by_every_technique) {
  int walked = 0;
  for (const std::string_view kind : technique_names()) {
    for (const bool moves : {true, false}) {
      std::optional<Stepper> walker;
      try {
        walker.emplace(level(moves), CharacterDef{}, kind);
      } catch (const NotExpressible&) {
        continue;
      }
      ++walked;
      for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        walker->at(random.between(-1.5, 1.5), half_height + 0.1);
        for (int step = 0; step < 20; ++step) {
          garble(walker->state, random);
          for (std::size_t k = 0; k < walker->movers.size(); ++k)
            walker->movers[k] = {walker->movers[k].to, offsets(step)[k]};
          EXPECT_NE(walker->step({.move = random.integer(-1, 1)}), StepStatus::invalid_input) << kind << " " << seed;
          EXPECT_TRUE(walker->state.position.allFinite()) << kind << " " << seed;
          if (kind != "octagon_sweep") continue;
          EXPECT_GE(walker->state.position.y(), half_height) << "stays out of the floor, seed " << seed;
          EXPECT_LE(walker->state.position.x(), 3 - half_width) << "and of the wall, seed " << seed;
        }
      }
    }
  }
  EXPECT_GE(walked, 12) << "not every technique knows movers";
}

TEST(StaleIndices, of_any_kind_are_survived_by_several) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    Together all = standing({-1.2, 0, 1.2}, level());
    for (int step = 0; step < 20; ++step) {
      for (CharacterState& state : all.states) garble(state, random);
      for (Input& input : all.inputs) input.move = random.integer(-1, 1);
      for (std::size_t k = 0; k < 2; ++k) all.movers[k] = {all.movers[k].to, offsets(step)[k]};
      all.step();
      for (const StepReport& report : all.reports) ASSERT_FALSE(is_refused(report.status)) << "seed " << seed;
      for (const CharacterState& state : all.states)
        ASSERT_TRUE(state.position.allFinite() && state.position.y() >= half_height) << "seed " << seed;
    }
  }
}

/// The press has come down into the character, which stands on the floor.
Stepper crushed_by_the_press() {
  Stepper pressed(level());
  pressed.gravity = {0, 0};
  pressed.at(0, half_height + 5e-7);
  pressed.movers[1] = {{0, 0}, {0, -1.5}};
  EXPECT_EQ(pressed.step(), StepStatus::moved);
  pressed.movers[1] = {{0, -1.5}, {0, -2}};
  EXPECT_EQ(pressed.step(), StepStatus::crushed);
  EXPECT_EQ(pressed.state.crushers[0].collider, press);
  pressed.movers[1].from = pressed.movers[1].to;
  return pressed;
}

TEST(StaleIndices, of_what_does_not_move_here_are_forgotten) {
  Stepper clean = crushed_by_the_press();
  clean.step();
  for (const ColliderIndex stale : {ColliderIndex{0}, ColliderIndex{3}, ColliderIndex{4}, ColliderIndex{1} << 31,
                                    std::numeric_limits<ColliderIndex>::max()}) {
    Stepper pressed = crushed_by_the_press();
    pressed.state.crushers.push_back({.collider = stale});
    pressed.step();
    EXPECT_EQ(pressed.state, clean.state) << stale;
  }
}

TEST(StaleIndices, a_ride_into_a_level_where_nothing_moves_keeps_its_speed) {
  for (const MoverIndex mover : {no_mover, MoverIndex{0}}) {
    Stepper rider({box(-40, -1, 40, 0), box(100, 0, 101, 1, mover)});
    rider.at(0, 5).with_velocity(3, 0);
    rider.state.ride = {.ground = 7, .velocity = {3, 0}};
    rider.dt = 0.1;
    ASSERT_EQ(rider.step(), StepStatus::moved);
    EXPECT_EQ(rider.state.velocity, Vec2d(3, -1)) << mover;
    EXPECT_NEAR(rider.state.position.x(), 0.3, 1e-12) << mover;
    EXPECT_EQ(rider.state.ride.ground, Ride::none);
  }
}

}  // namespace
}  // namespace paperproof
