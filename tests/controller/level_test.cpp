/// A level that changes between steps, against scenery that is built at once; and movers that turn. Who stands on them
/// or is pushed by them is in tests/situations/turning.json.
#include "controller/played.hpp"
#include "geometry/exact.hpp"
#include "geometry/pose.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/same_bits.hpp"
#include "support/steps_wanted.hpp"
#include "turning/proof.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace paperproof::test {
namespace {

constexpr double pi = std::numbers::pi;

using compare::box;

Input random_input(Random& random) {
  return {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
}

TEST(LevelIds, count_from_zero_and_never_name_another_collider) {
  Level level;
  EXPECT_EQ(level.add(box(0, 0, 1, 1)), 0U);
  EXPECT_EQ(level.add(box(1, 0, 2, 1)), 1U);
  std::set<ColliderIndex> stale;
  for (int i = 0; i < 1000; ++i) {
    const ColliderIndex id = level.add(box(2, 0, 3 + i, 1));
    EXPECT_TRUE(stale.insert(id).second);
    EXPECT_TRUE(level.remove(id));
  }
  level.add(box(2, 0, 3, 1));
  for (const ColliderIndex id : stale) {
    EXPECT_FALSE(level.find(id));
    EXPECT_FALSE(level.remove(id));
    EXPECT_FALSE(level.replace(id, box(0, 0, 1, 1)));
  }
  EXPECT_EQ(level.size(), 3U);
  EXPECT_FALSE(level.find(no_collider));
}

TEST(LevelEdits, what_is_refused_changes_nothing) {
  Level level(SceneryDef{{box(0, 0, 1, 1)}});
  const std::uint64_t edit = level.edits().count();
  const ColliderDef line{.points = {{0, 0}, {1, 0}}};
  ColliderDef box_with_a_radius = box(0, 0, 1, 1);
  box_with_a_radius.radius = 1;
  for (const ColliderDef& bad :
       {line, ColliderDef{.points = {{0, 0}, {1, 0}, {2, 0}}},
        ColliderDef{.points = {{0, 0}, {std::nan(""), 0}, {2, 1}}}, ColliderDef{.points = {{0, 0}, {3e6, 0}, {2, 1}}},
        box(0, 0, 1, 1, 65'536), compare::circle({0, 0}, 0), box_with_a_radius})
    EXPECT_THROW(level.add(bad), InvalidScenery);
  EXPECT_THROW(level.replace(0, line), InvalidScenery);
  EXPECT_EQ(level.edits().count(), edit);
  EXPECT_EQ(level.size(), 1U);
}

TEST(LevelSteps, are_refused_without_a_pose_for_each_mover) {
  Played played({{box(0, 0, 1, 1, 1)}});
  const auto step = [&](double dt) {
    return played.controller.step(played.state, {}, {{0, -30}, dt, played.movers}, played.scratch, played.report);
  };
  played.movers.resize(1);
  EXPECT_EQ(step(frame), StepStatus::invalid_input);
  played.movers.resize(2);
  played.movers[1].to_angle = std::nan("");
  EXPECT_EQ(step(frame), StepStatus::invalid_input);
  played.movers[1] = {};
  EXPECT_EQ(step(-frame), StepStatus::invalid_input);
  EXPECT_EQ(step(frame), StepStatus::moved);
}

TEST(LevelSteps, allocate_nothing_while_what_is_near_stays) {
  Played played({{box(-10, -1, 10, 0), box(-2, 0, 2, 0.5, 0)}}, {0, 1.2});
  for (int i = 0; i < 30; ++i) played.step_by({0, 0.01});
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 60; ++i) played.step_by({0, 0.01});
  ASSERT_EQ(played.state.ride.ground, 1U);
  EXPECT_EQ(tests::allocations(), before);
}

/// Of every kind that a step looks at in its own way.
ColliderDef random_tile(Random& random, int x, int y) {
  ColliderDef tile = box(x, y, x + 1, y + 1);
  switch (random.integer(0, 7)) {
    case 0:
      tile.points = {{x + 0.0, y + 0.0}, {x + 1.0, y + 0.0}, {x + 1.0, y + 1.0}};
      break;
    case 1:
      tile = compare::circle({x + 0.5, y + 0.5}, 0.5);
      break;
    case 2:
      tile = {.shape = ColliderDef::Shape::chain, .points = {{x + 0.0, y + 0.5}, {x + 1.0, y + 0.5}}};
      tile.one_way = Vec2d{0, 1};
      break;
    case 3:
      tile.sensor = true;
      break;
    case 4:
      tile.mover = static_cast<MoverIndex>(random.integer(0, 1));
      break;
    case 5:
      tile.surface_speed = 1;
      break;
    default:
      break;
  }
  return tile;
}

TEST(LevelEdits, a_controller_with_one_scratch_steps_as_through_a_level_that_was_built_at_once) {
  const int steps = steps_wanted("PAPERPROOF_LEVEL_EDITS", 20'000) / 5;
  int met = 0;
  int sensed = 0;
  int ridden = 0;
  for (std::uint64_t seed = 1; static_cast<int>(seed) * 100 <= steps; ++seed) {
    Random random(seed);
    Level level({{box(-1, -1, 13, 0), box(-1, 0, 0, 30), box(12, 0, 13, 30)}});
    const Controller controller(level, CharacterDef{});
    Scratch scratch = controller.make_scratch();
    StepReport report;
    CharacterState state;
    state.position = {6.5, 12};
    std::map<std::pair<int, int>, ColliderIndex> tiles;
    Input input;
    for (int step = 0; step < 100; ++step) {
      if (step % 10 == 0) input = random_input(random);
      for (int edits = random.integer(0, 3); edits > 0; --edits) {
        const int x = random.integer(0, 11);
        const int y = random.integer(0, 5);
        const auto known = tiles.find({x, y});
        if (known == tiles.end()) {
          tiles[{x, y}] = level.add(random_tile(random, x, y));
        } else if (random.chance(0.5)) {
          ASSERT_TRUE(level.replace(known->second, random_tile(random, x, y)));
        } else {
          ASSERT_TRUE(level.remove(known->second));
          tiles.erase(known);
        }
      }
      std::vector<MoverMotion> movers;
      for (int mover = 0; mover < 2; ++mover) movers.push_back({random.point(0.02), random.point(0.02)});
      SceneryDef built = level.as_run();
      std::reverse(built.colliders.begin(), built.colliders.end());
      const Level fresh(built);
      const Controller other(fresh, CharacterDef{});
      Scratch of_other = other.make_scratch();
      StepReport from_other;
      CharacterState expected = state;
      expected.crushers.clear();  // ids differ
      expected.ride = {};
      state.crushers.clear();
      state.ride = {};
      state.crushed = expected.crushed = false;
      const auto context = [&](const Level& where) -> StepContext {
        return {{0, -30}, frame, std::span(movers).first(where.mover_count())};
      };
      if (random.chance(0.5)) (void)controller.overlaps(state.position, context(level), scratch);
      other.step(expected, input, context(fresh), of_other, from_other);
      controller.step(state, input, context(level), scratch, report);
      ASSERT_TRUE(same_bits(state.position, expected.position)) << "seed " << seed << ", step " << step;
      ASSERT_TRUE(same_bits(state.velocity, expected.velocity)) << "seed " << seed << ", step " << step;
      ASSERT_EQ(report.status, from_other.status) << "seed " << seed << ", step " << step;
      ASSERT_EQ(report.move.contacts.size(), from_other.move.contacts.size()) << "seed " << seed << ", step " << step;
      ASSERT_EQ(report.sensors.size(), from_other.sensors.size()) << "seed " << seed << ", step " << step;
      met += !report.move.contacts.empty();
      sensed += !report.sensors.empty();
      ridden += state.ride.ground != Ride::none;
    }
  }
  EXPECT_GE(met, steps / 8);
  EXPECT_GE(sensed, steps / 200);
  EXPECT_GE(ridden, steps / 100);
}

TEST(LevelEdits, a_level_that_is_assigned_or_moved_from_is_read_anew) {
  const auto stands_after = [](const auto& change) -> bool {
    Played played({{box(-10, -1, 10, 0)}});
    played.steps(30);
    EXPECT_TRUE(played.state.grounded);
    change(played.level);
    played.step();
    const bool stands = played.state.grounded;
    played.steps(30);
    EXPECT_EQ(played.state.grounded, stands);
    return stands;
  };
  EXPECT_TRUE(stands_after([](Level& level) -> void {
    const Level saved = level;
    for (int i = 0; i < 100; ++i) level.add(box(10 + i, 0, 11 + i, 1));  // its memory moves
    level = saved;
  }));
  EXPECT_TRUE(stands_after([](Level& level) -> void {
    Level saved = level;
    level = std::move(saved);
  }));
  EXPECT_FALSE(stands_after([](Level& level) -> void { level = Level(SceneryDef{{box(-10, -9, 10, -8)}}); }));
  EXPECT_FALSE(stands_after([](Level& level) -> void { EXPECT_EQ(Level(std::move(level)).size(), 1U); }));
}

TEST(LevelEdits, a_rider_stays_on_what_is_replaced_and_falls_in_the_step_in_which_it_is_removed) {
  Played played({{box(-2, -1, 2, 0, 0)}}, {0, 0.7});
  for (int i = 0; i < 120; ++i) {
    if (i == 60) played.level.replace(0, box(-1, -1, 1, 0, 0));
    played.step_by({0.05, 0.02});
    ASSERT_TRUE(i <= 30 || played.state.ride.ground == 0) << i;
  }
  EXPECT_NEAR(played.state.position.x(), played.movers[0].to.x(), 0.2);
  const Vec2d before = played.state.position;
  played.level.remove(0);
  played.level.add(box(-2, -100, 2, -99, 0));  // takes the slot
  played.step();
  EXPECT_FALSE(played.state.grounded);
  EXPECT_EQ(played.state.ride.ground, no_collider);
  EXPECT_LT(played.state.position.y(), before.y() + 0.02);
}

// What turns.

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

/// What is made turned needs no angle. Sensors, one-way colliders and questions among them.
TEST(LevelTurning, a_mover_that_keeps_its_angle_is_as_one_that_was_made_turned) {
  const int runs = steps_wanted("PAPERPROOF_KEPT_ANGLES", sampled(400));
  int ridden = 0;
  int sensed = 0;
  int asked = 0;
  int dropped = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    SceneryDef as_given = room;
    SceneryDef made_turned = room;
    std::vector<double> angles;
    for (MoverIndex mover = 0; mover < 3; ++mover) {
      angles.push_back(random.angle());
      const geometry::Turn turn(angles.back());
      const int colliders = random.integer(1, 2);
      for (int i = 0; i < colliders; ++i) {
        const double half = random.between(0.2, 2);
        const double x = random.between(-1, 1);
        const double thick = random.between(0.1, 0.4);
        ColliderDef def = box(x - half, -thick, x + half, thick, mover);
        if (random.chance(0.4)) def.points.erase(def.points.begin());
        if (random.chance(0.2)) def.sensor = true;
        if (!def.sensor && random.chance(0.3)) def.one_way = geometry::Turn(-angles.back())(Vec2d(0, 1));
        // In a wedge of two equal slopes the order of what is made decides which of them carries.
        if (!def.sensor && colliders == 1) def.surface_speed = random.between(-2, 2);
        as_given.colliders.push_back(def);
        for (Vec2d& point : def.points) point = turn(point);
        if (def.one_way) def.one_way = turn(*def.one_way);
        made_turned.colliders.push_back(def);
      }
    }
    Played one(as_given, {random.between(-5, 5), 6});
    Played other(made_turned, one.state.position);
    std::vector<Vec2d> places;
    std::vector<Vec2d> ways;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      places.emplace_back(random.between(-5, 5), random.between(1, 3));
      ways.push_back(random.point(1));
    }
    const auto ridden_by = [](const Played& played) {
      const ColliderIndex ground = played.state.ride.ground;
      return ground == Ride::none ? no_mover : played.level.collider(ground).mover;
    };
    Input input;
    for (int step = 0; step < 150; ++step) {
      if (step % 15 == 0) input = random_input(random);
      input.drop = random.chance(0.1);
      for (std::size_t i = 0; i < angles.size(); ++i) {
        const Vec2d there = places[i] + ways[i] * std::sin(0.03 * (step + 1));
        one.movers[i] = {step == 0 ? there : one.movers[i].to, there, angles[i], angles[i]};
        other.movers[i] = {one.movers[i].from, there};
      }
      one.step(input);
      other.step(input);
      const auto where = [&] { return "seed " + std::to_string(seed) + ", step " + std::to_string(step); };
      ASSERT_TRUE(same_bits(one.state.position, other.state.position)) << where();
      ASSERT_TRUE(same_bits(one.state.velocity, other.state.velocity)) << where();
      ASSERT_EQ(one.report.status, other.report.status) << where();
      ASSERT_EQ(ridden_by(one), ridden_by(other)) << where();
      ASSERT_EQ(one.report.move.contacts.size(), other.report.move.contacts.size()) << where();
      ASSERT_EQ(one.report.dropped_through, other.report.dropped_through) << where();
      ASSERT_EQ(one.report.sensors.size(), other.report.sensors.size()) << where();
      const Vec2d beside = one.state.position + random.point(1);
      const Vec2d way = random.point(3);
      const auto hit = one.controller.cast(beside, way, one.context(), one.scratch);
      const auto expected = other.controller.cast(beside, way, other.context(), other.scratch);
      ASSERT_EQ(hit.has_value(), expected.has_value()) << where();
      ASSERT_TRUE(!hit || hit->fraction == expected->fraction) << where() << hit->fraction << " " << expected->fraction;
      ASSERT_EQ(one.controller.overlaps(beside, one.context(), one.scratch),
                other.controller.overlaps(beside, other.context(), other.scratch))
          << where();
      std::array<ColliderIndex, 8> inside{};
      ASSERT_EQ(one.controller.sensors_at(beside, one.context(), one.scratch, inside),
                other.controller.sensors_at(beside, other.context(), other.scratch, inside))
          << where();
      asked += hit.has_value();
      ridden += one.state.ride.ground != Ride::none;
      sensed += !one.report.sensors.empty();
      dropped += !one.report.dropped_through.empty();
    }
  }
  EXPECT_GE(ridden, runs);
  EXPECT_GE(sensed, runs / 10);
  EXPECT_GE(asked, runs * 10);
  EXPECT_GE(dropped, runs / 20);
}

/// The id of the ground was taken for an index of what is near: memory beyond it was read.
TEST(LevelStep, that_is_refused_changes_nothing_however_large_the_id_of_its_ground) {
  SceneryDef tiles;
  for (int i = 0; i < 20'000; ++i) tiles.colliders.push_back(box(i, -1, i + 1, 0));
  Played played(tiles, {19'900.5, 0.7});
  played.steps(30);
  ASSERT_GT(played.state.ground.collider, 10'000U);
  const CharacterState before = played.state;
  EXPECT_EQ(played.controller.move(played.state, {3e6, 0}, played.context(), played.scratch, played.report),
            StepStatus::out_of_range);
  EXPECT_EQ(played.state, before);
}

/// The place of a ground that is none was read from a restored state, and named memory beyond the ids.
TEST(LevelStep, reads_no_ground_of_a_state_that_stands_on_none) {
  Played played({{box(-10, -1, 10, 0)}}, {0, 5});
  played.state.ground.collider = 4'000'000'000;
  EXPECT_EQ(played.step(), StepStatus::moved);
}

TEST(LevelEdits, colliders_at_one_place_have_an_order_of_their_own) {
  for (const bool move : {false, true}) {
    ColliderDef right = box(-10, -1, 10, 0);
    right.surface_speed = 2;
    ColliderDef left = right;
    left.surface_speed = -3;
    const auto end_on = [&](ColliderDef first, ColliderDef second) {
      if (move) {  // movers that go alike
        first.mover = 0;
        second.mover = 1;
      }
      Played played({{first, second}});
      played.steps(60);
      return played.state.position;
    };
    EXPECT_EQ(end_on(right, left), end_on(left, right));
    EXPECT_GT(end_on(right, left).norm(), 1) << "on either belt";
  }
}

// The proof.

using turning::PieceWay;
using turning::stay_apart;

const std::vector<Vec2d> unit_box{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

std::vector<Vec2d> shifted(std::vector<Vec2d> points, const Vec2d& by) {
  for (Vec2d& point : points) point += by;
  return points;
}

std::vector<Vec2d> rotated(std::vector<Vec2d> points, double angle) {
  for (Vec2d& point : points) point = geometry::Turn(angle)(point);
  return points;
}

TEST(ProofOfTurns, knows_ways_that_pass_and_ways_that_meet) {
  for (const double gap : {1e-6, 1e-10}) {
    const PieceWay beside{shifted(unit_box, {1 + gap, 0}), shifted(unit_box, {1 + gap, 3})};
    EXPECT_EQ(stay_apart({unit_box, {0, 0}, {0, 5}}, beside, 1e-9), gap > 1e-9) << gap;
  }
  // Through each other within the time, apart at both ends.
  EXPECT_FALSE(stay_apart({unit_box, {0, 0}, {0, 0}}, {shifted(unit_box, {-2, 0}), shifted(unit_box, {2, 0})}, 1e-9));
  // A paper turns past a corner: it ends 1 mm before the corner, or 1 mm behind it.
  const std::vector<Vec2d> paper{{0, 0}, {2, 0}};
  for (const double gap : {1e-3, -1e-3}) {
    const Vec2d corner = geometry::Turn(0.2)(Vec2d(1, gap));
    const Vec2d at = corner + Vec2d(-0.5, 0.5);  // it is the lower right corner of the box
    EXPECT_EQ(stay_apart({unit_box, at, at}, {paper, rotated(paper, 0.2)}, 1e-9), gap > 0) << gap;
  }
}

/// Against a twin that looks at many moments.
TEST(ProofOfTurns, agrees_with_many_moments) {
  int apart = 0;
  int meet = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const int corners = random.integer(2, 7);
    const double size = random.log_between(1e-3, 3);
    std::vector<Vec2d> piece;
    for (int i = 0; i < corners; ++i) piece.push_back(size * compare::towards(2 * pi * i / corners));
    const double first_angle = random.angle();
    const double turn = random.between(-0.3, 0.3);
    const Vec2d at{random.between(-2, 2), random.between(-2, 2)};
    const Vec2d by{random.between(-1, 1), random.between(-1, 1)};
    const Vec2d way{random.between(-1, 1), random.between(-1, 1)};
    const PieceWay moving{shifted(rotated(piece, first_angle), at),
                          shifted(rotated(piece, first_angle + turn), at + by)};
    const bool proved = stay_apart({unit_box, {0, 0}, way}, moving, 1e-9);
    bool overlaps = false;
    for (int i = 0; i <= 500 && !overlaps; ++i) {
      const double share = i / 500.0;
      std::vector<Vec2d> here = moving.from;
      for (std::size_t k = 0; k < here.size(); ++k) here[k] += (moving.to[k] - moving.from[k]) * share;
      overlaps = !stay_apart({unit_box, way * share, way * share}, {here, here}, -1e-9);
    }
    ASSERT_FALSE(proved && overlaps) << "seed " << seed;
    if (!proved && !overlaps) continue;  // less than the moments show
    (proved ? apart : meet) += 1;
  }
  EXPECT_GE(apart, 500);
  EXPECT_GE(meet, 500);
  EXPECT_GE(apart + meet, 3960);
}

/// The corner of a box is just inside of a long side, or outside, that has a corner which is flat but for 1e-12 m. So
/// far from the origin rounding turns that corner inside out.
TEST(ProofOfTurns, believes_no_edge_with_its_own_piece_beyond_it) {
  int apart = 0;
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const double edge = random.log_between(1e-3, 0.1);
    const double angle = random.angle();
    const Vec2d at{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
    const auto piece = shifted(rotated({{0, 0}, {edge, -1e-12}, {edge + 3, 0}, {1.5, 2}}, angle), at);
    const double depth = random.log_between(1e-10, 1e-6) * (random.chance(0.5) ? 1 : -1);
    const Vec2d touched = at + geometry::Turn(angle)(Vec2d(edge + random.between(1, 2.5), depth));
    const Vec2d up = geometry::Turn(angle)(Vec2d(0, 1));
    const Vec2d corner{std::copysign(0.5, up.x()), std::copysign(0.5, up.y())};
    const auto is_left = [&](std::size_t i, std::size_t j) {
      return geometry::orientation_sign_of_sum(piece[i], piece[j], std::array{Vec2d(touched - corner), corner}) > 0;
    };
    const bool overlaps = is_left(0, 2) && is_left(2, 3) && is_left(3, 0);
    const bool proved = stay_apart({unit_box, touched - corner, touched - corner}, {piece, piece}, 1e-9);
    ASSERT_FALSE(proved && overlaps) << "seed " << seed;
    apart += proved;
    inside += overlaps;
  }
  EXPECT_GE(apart, 1000);
  EXPECT_GE(inside, 1000);
}

}  // namespace
}  // namespace paperproof::test
