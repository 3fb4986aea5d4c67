/// Movers that turn, and sensors on them. Who stands on them or is pushed by them is in tests/situations/turning.json.
#include "controller/stepping.hpp"
#include "geometry/pose.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace paperproof::stepping {
namespace {

/// Bars and discs that turn over a character which stands, walks, and jumps in a room of 16 m.
TEST(SensorsThatTurn, report_each_visit_and_are_known_at_the_end_of_each_step) {
  constexpr int wanted = 6000;
  int steps = 0;
  int events = 0;
  int events_at_rest = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    std::vector<ColliderDef> colliders{box(-8, -1, 8, 0), box(-9, -1, -8, 9), box(8, -1, 9, 9)};
    const auto first_sensor = static_cast<ColliderIndex>(colliders.size());
    std::vector<ColliderDef> as_solids;
    std::vector<std::pair<Vec2d, double>> spins;  // of each mover: about which place, and how fast [rad/s]
    for (int i = random.integer(1, 3); i > 0; --i) {
      const auto mover = static_cast<MoverIndex>(spins.size());
      const double off = random.between(-1, 1);
      const double half = random.between(0.3, 3);
      const double thin = random.between(0.05, 0.5);
      as_solids.push_back(random.chance(0.2) ? compare::circle({off, 0}, thin, mover)
                                             : box(off - half, -thin, off + half, thin, mover));
      colliders.push_back(as_solids.back());
      colliders.back().sensor = true;
      spins.push_back({Vec2d{random.between(-6, 6), random.between(0, 2)}, random.either_sign_log_between(0.1, 20)});
    }
    if (random.chance(0.5)) {  // a solid that turns as well
      colliders.push_back(box(-1, -0.1, 1, 0.1, static_cast<MoverIndex>(spins.size())));
      spins.push_back({Vec2d{random.between(-5, 5), 1}, random.either_sign_log_between(0.1, 3)});
    }
    Stepper played = player_in(colliders, {random.between(-7, 7), 5});
    Stepper solids(as_solids);
    std::set<ColliderIndex> inside;
    Input input;
    for (int step = 0; step < 100; ++step, ++steps) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
      if (step % 20 == 0)
        input = random.chance(0.5) ? Input{} : Input{.move = random.integer(-1, 1), .jump = random.chance(0.4)};
      for (std::size_t k = 0; k < spins.size(); ++k) {
        const auto& [middle, speed] = spins[k];
        played.movers[k] = {middle, middle, speed * step * frame, speed * (step + 1) * frame};
      }
      const Vec2d before = played.state.position;
      played.step(input);
      double last = 0;
      for (const SensorEvent& event : played.report.sensors) {
        ASSERT_GE(event.fraction, last);
        last = event.fraction;
        const bool enters = event.change == SensorEvent::Change::enter;
        ASSERT_TRUE(enters ? inside.insert(event.sensor).second : inside.erase(event.sensor) == 1);
        ++events;
        events_at_rest += before == played.state.position;
      }
      // As a character that is put there without knowing anything would find it.
      for (std::size_t k = 0; k < solids.movers.size(); ++k)
        solids.movers[k] = {spins[k].first, spins[k].first, played.movers[k].to_angle, played.movers[k].to_angle};
      std::array<ColliderIndex, 3> found{};
      const std::size_t count =
          *solids.sweep().overlaps(played.state.position, solids.context(), solids.scratch, found);
      std::set<ColliderIndex> expected;
      for (std::size_t i = 0; i < count; ++i) expected.insert(first_sensor + found.at(i));
      ASSERT_EQ(inside, expected);
    }
  }
  EXPECT_GT(events, steps / 60);
  EXPECT_GT(events_at_rest, steps / 1000);
}

TEST(LevelTurning, a_step_out_of_range_changes_nothing_and_says_so) {
  Stepper played = player_in({box(-3, -0.1, 3, 0.1, 0)}, {999'999, 0.8});
  played.state.velocity = {1e9, 0};
  const CharacterState before = played.state;
  played.movers = {{{999'999, 0}, {999'999, 0}, 0, 0.01}};
  EXPECT_EQ(played.step(), StepStatus::out_of_range);
  EXPECT_EQ(played.state, before);
  const MoveResult& move = played.report.move;
  EXPECT_EQ(move.status, StepStatus::out_of_range);
  ASSERT_GE(move.path.size(), 1U);
  EXPECT_EQ(move.path.back().position, before.position);
  EXPECT_EQ(move.position, before.position);
  for (const double x : {1e12, std::nan("")})
    EXPECT_EQ(played.sweep().overlaps({x, 0}, played.context(), played.scratch), std::nullopt);
}

/// See-saws, lifts that tilt and swings, up to 5 radians a second.
TEST(LevelTurning, a_one_way_plank_keeps_who_stands_on_it_and_who_jumps) {
  const int runs = test::sampled(60);
  int grounded = 0;
  int in_the_air = 0;
  for (int run = 1; run <= runs; ++run) {
    Random random(static_cast<std::uint64_t>(run));
    ColliderDef plank = box(-2, -0.1, 2, 0.1, 0);
    plank.one_way = Vec2d(0, 1);
    Stepper played = player_in({plank}, {random.between(-1.2, 1.2), 0.8});
    played.gravity = {0, -20};
    const double swing = random.between(0.05, 0.6);
    const double pace = random.between(0.3, 8);
    const Vec2d reach{random.between(-1, 1), random.between(-1, 1)};
    const bool jumps = random.chance(0.5);
    for (int step = 0; step < 400; ++step) {
      const double share = std::sin(pace * std::max(0, step - 29) * frame);
      MoverMotion& motion = played.movers[0];
      motion = {motion.to, reach * share, motion.to_angle, swing * share};
      played.step({.jump = jumps && step > 30 && step % 40 < 20});
      const Vec2d from_above = geometry::Turn(-motion.to_angle)(Vec2d(played.state.position - motion.to));
      if (std::abs(from_above.x()) > 1.6) break;  // it went over the end
      ASSERT_GT(from_above.y(), 0.1) << "run " << run << ", step " << step;
      (played.state.grounded ? grounded : in_the_air) += 1;
    }
  }
  EXPECT_GT(grounded, runs * 50);
  EXPECT_GT(in_the_air, runs * 10);
}

/// A press comes down on the character, which stands on the floor.
TEST(LevelTurning, what_crushed_and_stands_now_is_a_solid_to_leave) {
  Stepper played =
      player_in({box(-2, -1, 2, 0), box(-3, -1, -2, 5), box(2, -1, 3, 5), box(-2, 0, 2, 1, 0), box(0, 3, 3, 3.1, 1)});
  std::vector<MoverMotion>& movers = played.movers;
  movers[0].to = {0, 1.5};
  for (int i = 0; i < 60; ++i) {
    movers[0] = {movers[0].to, {0, std::max(0.5, 1.5 - 0.5 * i)}};
    movers[1] = {{0, 0}, {0, 0}, i * frame, (i + 1) * frame};
    played.step();
  }
  ASSERT_TRUE(played.state.crushed);
  played.scenery->replace(3, box(-2, 0.5, 2, 1.5));  // where it is
  movers[1] = {{0, 0}, {0, 0}, 60 * frame, 61 * frame};
  const StepStatus status = played.step();
  movers[1].from = movers[1].to;
  movers[1].from_angle = movers[1].to_angle;
  const std::optional<std::size_t> count =
      played.sweep().overlaps(played.state.position, played.context(), played.scratch);
  EXPECT_EQ(count == 0U, status == StepStatus::moved);
}

}  // namespace
}  // namespace paperproof::stepping
