/// A state outlives the scenery that its indices are of: the level was read again, and has other colliders.
#include "controller/passenger.hpp"
#include "controller/together.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace paperproof {
namespace {

using namespace stepping;
using article_tests::of_mover;
using test::Random;

/// A floor, a lift, a press that can come down to 1 m above the floor, and a wall.
std::vector<ColliderDef> level() {
  return {rectangle(-4, -1, 4, 0), of_mover(rectangle(1, -0.25, 2, 0), 0), of_mover(rectangle(-1, 3, 1, 4), 1),
          rectangle(3, 0, 4, 8)};
}
constexpr ColliderIndex press = 2;

/// Any index, mostly a small one.
ColliderIndex any_index(Random& random) {
  if (random.chance(0.2)) return Ride<double>::none - static_cast<ColliderIndex>(random.integer(0, 3));
  return static_cast<ColliderIndex>(random.chance(0.3) ? random.integer(0, 1 << 30) : random.integer(0, 40));
}

template <class Scalar>
void garble(CharacterState<Scalar>& state, Random& random) {
  state.ride.ground = any_index(random);
  state.crushed = random.chance(0.8);
  state.crushers.clear();
  for (int i = random.integer(0, 8); i > 0; --i) {
    Crusher<Scalar> crusher;
    crusher.collider = any_index(random);
    crusher.last_free.x() = static_cast<Scalar>(random.between(-2, 2));
    crusher.displacement.y() = static_cast<Scalar>(random.between(-2, 2));
    state.crushers.push_back(crusher);
  }
}

/// The press goes down and up between 3 m and 1 m above the floor, the lift up and down.
std::vector<Vec2d> ways_of_step(int step) {
  const double down = (step / 10) % 2 == 0 ? -0.2 : 0.2;
  return {Vec2d{0, -down / 4}, Vec2d{0, down}};
}

/// Steps with garbage in every index.
template <class Scalar>
void walk(Stepper<Scalar>& walker, std::uint64_t seed) {
  Random random(seed);
  walker.at(random.between(-1.5, 1.5), half_height + 0.1);
  for (int step = 0; step < 20; ++step) {
    garble(walker.state, random);
    const std::vector<Vec2d> ways = ways_of_step(step);
    for (std::size_t k = 0; k < walker.movers.size(); ++k)
      walker.movers[k] = {walker.movers[k].to, walker.movers[k].to + ways[k].cast<Scalar>()};
    const StepStatus status = walker.step({.move = random.integer(-1, 1)});
    ASSERT_NE(status, StepStatus::invalid_input);
    ASSERT_TRUE(walker.state.position.allFinite());
  }
}

template <class Scalar>
void walk_by_every_technique() {
  int walked = 0;
  for (const std::string_view kind : technique_names()) {
    for (const bool moves : {true, false}) {
      std::vector<ColliderDef> colliders = level();
      if (!moves)
        for (ColliderDef& collider : colliders) collider.mover = no_mover;
      try {
        Stepper<Scalar> walker(colliders, {}, kind);
        for (std::uint64_t seed = 0; seed < 40; ++seed) walk(walker, seed);
        ++walked;
      } catch (const NotExpressible&) {
        continue;
      } catch (const std::invalid_argument&) {
        continue;
      }
    }
  }
  EXPECT_GE(walked, 12) << "not every technique knows movers";
}

TEST(StaleIndices, of_any_kind_are_survived_by_every_technique) {
  walk_by_every_technique<double>();
  walk_by_every_technique<float>();
}

TEST(StaleIndices, leave_octagon_sweep_outside_of_what_stands_still) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stepper<double> walker(level());
    walk(walker, seed);
    EXPECT_GE(walker.state.position.y(), half_height);
    EXPECT_LE(walker.state.position.x(), 3 - half_width);
  }
}

TEST(StaleIndices, of_any_kind_are_survived_by_a_crowd) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    Together all({{-1.2, half_height + 0.1}, {0, half_height + 0.1}, {1.2, half_height + 0.1}}, level());
    all.gravity = {0, -30};
    all.dt = 1.0 / 60;
    for (int step = 0; step < 20; ++step) {
      for (std::size_t i = 0; i < all.states.size(); ++i) {
        garble(all.states[i], random);
        all.inputs[i].move = random.integer(-1, 1);
      }
      ASSERT_EQ(all.step_with_movers_by(ways_of_step(step)), StepStatus::moved);
      for (const CharacterState<double>& state : all.states) {
        ASSERT_TRUE(state.position.allFinite());
        ASSERT_GE(state.position.y(), half_height);
      }
    }
  }
}

/// The press has come down into the character, which stands on the floor.
Stepper<double> crushed_by_the_press() {
  Stepper<double> pressed(level());
  pressed.gravity = {0, 0};
  pressed.at(0, half_height + 5e-7);
  for (const double down : {1.5, 2.0}) {
    pressed.movers[1] = {pressed.movers[1].to, {0, -down}};
    EXPECT_EQ(pressed.step(), down > 1.75 ? StepStatus::crushed : StepStatus::moved);
  }
  EXPECT_EQ(pressed.state.crushers.size(), 1U);
  EXPECT_EQ(pressed.state.crushers[0].collider, press);
  pressed.movers[1].from = pressed.movers[1].to;
  return pressed;
}

TEST(StaleIndices, of_what_does_not_move_here_are_forgotten) {
  Stepper<double> clean = crushed_by_the_press();
  clean.step();
  for (const ColliderIndex stale : {ColliderIndex{0}, ColliderIndex{3}, ColliderIndex{4}, ColliderIndex{1} << 31,
                                    std::numeric_limits<ColliderIndex>::max()}) {
    Stepper<double> pressed = crushed_by_the_press();
    Crusher<double> crusher;
    crusher.collider = stale;
    pressed.state.crushers.push_back(crusher);
    pressed.step();
    EXPECT_EQ(pressed.state, clean.state) << stale;
  }
}

TEST(StaleIndices, a_ride_into_a_level_where_nothing_moves_keeps_its_speed) {
  for (const bool has_mover : {false, true}) {
    SceneryDef def{.colliders = {rectangle(-40, -1, 40, 0)}};
    if (has_mover) def.colliders.push_back(of_mover(rectangle(100, 0, 101, 1), 0));
    const Scenery<double> scenery(def);
    const Controller<double> controller(scenery, CharacterDef{});
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    CharacterState<double> state;
    state.position = {0, 5};
    state.velocity = state.ride.velocity = {3, 0};
    state.ride.ground = 7;
    const std::vector<MoverMotion<double>> movers(scenery.mover_count());
    ASSERT_EQ(controller.step(state, Input{}, {{0, -10}, 0.1, movers}, scratch, report), StepStatus::moved);
    EXPECT_EQ(state.velocity, Vec2d(3, -1)) << has_mover;
    EXPECT_NEAR(state.position.x(), 0.3, 1e-12) << has_mover;
    EXPECT_EQ(state.ride.ground, Ride<double>::none);
  }
}

}  // namespace
}  // namespace paperproof
