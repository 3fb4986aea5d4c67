/// Movers that turn, and sensors on them. Who stands on them or is pushed by them is in tests/situations/turning.json.
#include "controller/played.hpp"
#include "geometry/pose.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace paperproof::test {
namespace {

using compare::box;

/// Turns a mover evenly.
MoverMotion turning(const Vec2d& position, double speed, int step) {
  return {position, position, speed * step * frame, speed * (step + 1) * frame};
}

/// Of a mover that turns evenly: the place about which, and how fast [rad/s].
using Spin = std::pair<Vec2d, double>;

std::vector<MoverMotion> in_step(const std::vector<Spin>& spins, int step) {
  std::vector<MoverMotion> motions;
  for (const auto& [middle, speed] : spins) motions.push_back(turning(middle, speed, step));
  return motions;
}

/// A room of 16 m, where random things turn.
const SceneryDef room{{box(-8, -1, 8, 0), box(-9, -1, -8, 9), box(8, -1, 9, 9)}};

/// Bars and discs that turn over a character which stands, walks, and jumps.
TEST(SensorsThatTurn, report_each_visit_and_are_known_at_the_end_of_each_step) {
  const int wanted = steps_wanted("PAPERPROOF_SENSOR_STEPS", 6000);
  int steps = 0;
  int events = 0;
  int events_at_rest = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    SceneryDef def = room;
    std::vector<Spin> spins;
    std::vector<SceneryDef> alone;  // each as a solid
    for (int i = random.integer(1, 3); i > 0; --i) {
      const auto mover = static_cast<MoverIndex>(spins.size());
      const double off = random.between(-1, 1);
      const double half = random.between(0.3, 3);
      const double thin = random.between(0.05, 0.5);
      alone.push_back({{random.chance(0.2) ? compare::circle({off, 0}, thin, mover)
                                           : box(off - half, -thin, off + half, thin, mover)}});
      def.colliders.push_back(alone.back().colliders[0]);
      def.colliders.back().sensor = true;
      spins.push_back({Vec2d{random.between(-6, 6), random.between(0, 2)}, random.either_sign_log_between(0.1, 20)});
    }
    if (random.chance(0.5)) {  // a solid that turns as well
      def.colliders.push_back(box(-1, -0.1, 1, 0.1, static_cast<MoverIndex>(spins.size())));
      spins.push_back({Vec2d{random.between(-5, 5), 1}, random.either_sign_log_between(0.1, 3)});
    }
    Played played(def, {random.between(-7, 7), 5});
    std::set<ColliderIndex> inside;
    Input input;
    for (int step = 0; step < 100; ++step, ++steps) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
      if (step % 20 == 0) input = random.chance(0.5) ? Input{} : random_input(random);
      played.movers = in_step(spins, step);
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
      std::vector<MoverMotion> there = played.movers;
      for (MoverMotion& motion : there) motion = {motion.to, motion.to, motion.to_angle, motion.to_angle};
      for (std::size_t i = 0; i < alone.size(); ++i) {
        const Level solid(alone[i]);
        const Controller other(solid, {});
        Scratch scratch = other.make_scratch();
        const std::size_t count = *other.overlaps(played.state.position, {{0, 0}, frame, there}, scratch);
        ASSERT_EQ(count > 0, inside.contains(static_cast<ColliderIndex>(room.colliders.size() + i)));
      }
    }
  }
  EXPECT_GT(events, steps / 60);
  EXPECT_GT(events_at_rest, steps / 1000);
}

TEST(LevelTurning, a_step_out_of_range_changes_nothing_and_says_so) {
  Played played({{box(-3, -0.1, 3, 0.1, 0)}}, {999'999, 0.8});
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
    EXPECT_EQ(played.controller.overlaps({x, 0}, played.context(), played.scratch), std::nullopt);
}

/// See-saws, lifts that tilt and swings, up to 5 radians a second.
TEST(LevelTurning, a_one_way_plank_keeps_who_stands_on_it_and_who_jumps) {
  const int runs = steps_wanted("PAPERPROOF_ONE_WAY_RUNS", sampled(60));
  int grounded = 0;
  int in_the_air = 0;
  for (int run = 1; run <= runs; ++run) {
    Random random(static_cast<std::uint64_t>(run));
    ColliderDef plank = box(-2, -0.1, 2, 0.1, 0);
    plank.one_way = Vec2d(0, 1);
    Played played({{plank}}, {random.between(-1.2, 1.2), 0.8});
    played.gravity = {0, -20};
    const double swing = random.between(0.05, 0.6);
    const double pace = random.between(0.3, 8);
    const Vec2d reach{random.between(-1, 1), random.between(-1, 1)};
    const bool jumps = random.chance(0.5);
    for (int step = 0; step < 400; ++step) {
      const double share = std::sin(pace * std::max(0, step - 29) * frame);
      const Vec2d offset = reach * share;
      const double angle = swing * share;
      played.movers[0] = {played.movers[0].to, offset, played.movers[0].to_angle, angle};
      played.step({.jump = jumps && step > 30 && step % 40 < 20});
      const Vec2d from_above = geometry::Turn(-angle)(Vec2d(played.state.position - offset));
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
  Played played({{box(-2, -1, 2, 0), box(-3, -1, -2, 5), box(2, -1, 3, 5), box(-2, 0, 2, 1, 0), box(0, 3, 3, 3.1, 1)}});
  std::vector<MoverMotion>& movers = played.movers;
  movers[0].to = {0, 1.5};
  for (int i = 0; i < 60; ++i) {
    movers[0] = {movers[0].to, {0, std::max(0.5, 1.5 - 0.5 * i)}};
    movers[1] = turning({0, 0}, 1.0, i);
    played.step();
  }
  ASSERT_TRUE(played.state.crushed);
  played.level.replace(3, box(-2, 0.5, 2, 1.5));  // where it is
  movers[1] = turning({0, 0}, 1.0, 60);
  const StepStatus status = played.step();
  movers[1].from = movers[1].to;
  movers[1].from_angle = movers[1].to_angle;
  const std::optional<std::size_t> count =
      played.controller.overlaps(played.state.position, played.context(), played.scratch);
  EXPECT_EQ(count == 0U, status == StepStatus::moved);
}

}  // namespace
}  // namespace paperproof::test
