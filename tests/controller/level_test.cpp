/// A level that changes between steps, against scenery that is built at once; and movers that turn.
#include <paperproof/level.hpp>

#include "campaign/shapes.hpp"
#include "level/poses.hpp"
#include "level/turn.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>

namespace paperproof::test {
namespace {

constexpr double frame = 1.0 / 60;
constexpr double pi = std::numbers::pi;

using compare::box;

Input random_input(Random& random) {
  return {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
}

TEST(LevelIds, count_from_zero_and_never_name_another_collider) {
  Level level;
  EXPECT_EQ(level.add(box(0, 0, 1, 1)), 0U);
  EXPECT_EQ(level.add(box(1, 0, 2, 1)), 1U);
  std::vector<ColliderIndex> stale;
  for (int i = 0; i < 1000; ++i) {
    const ColliderIndex id = level.add(box(2, 0, 3 + i, 1));
    EXPECT_EQ(std::find(stale.begin(), stale.end(), id), stale.end());
    EXPECT_TRUE(level.remove(id));
    stale.push_back(id);
  }
  level.add(box(2, 0, 3, 1));
  for (const ColliderIndex id : stale) {
    EXPECT_EQ(level.find(id), nullptr);
    EXPECT_FALSE(level.remove(id));
    EXPECT_FALSE(level.replace(id, box(0, 0, 1, 1)));
  }
  EXPECT_EQ(level.size(), 3U);
  EXPECT_EQ(level.find(no_collider), nullptr);
}

TEST(LevelEdits, what_is_refused_changes_nothing) {
  Level level(SceneryDef{{box(0, 0, 1, 1)}});
  const std::uint64_t edit = level.last_edit();
  EXPECT_THROW(level.add({.points = {{0, 0}, {1, 0}}}), InvalidScenery);
  EXPECT_THROW(level.add({.points = {{0, 0}, {1, 0}, {2, 0}}}), InvalidScenery);
  EXPECT_THROW(level.add({.points = {{0, 0}, {std::nan(""), 0}, {2, 1}}}), InvalidScenery);
  EXPECT_THROW(level.add({.points = {{0, 0}, {3e6, 0}, {2, 1}}}), InvalidScenery);
  EXPECT_THROW(level.add(box(0, 0, 1, 1, 65'536)), InvalidScenery);
  EXPECT_THROW(level.replace(0, {.points = {{0, 0}, {1, 0}}}), InvalidScenery);
  EXPECT_EQ(level.last_edit(), edit);
  EXPECT_EQ(level.size(), 1U);
  try {
    const Level refused(SceneryDef{{box(0, 0, 1, 1), {.points = {{0, 0}}}}});
    FAIL();
  } catch (const InvalidScenery& reason) {
    EXPECT_EQ(reason.collider(), 1U);
  }
}

TEST(LevelSteps, are_refused_without_a_pose_for_each_mover) {
  Level level(SceneryDef{{box(0, 0, 1, 1, 1)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  StepReport<double> report;
  std::vector<PoseMotion> movers(1);
  EXPECT_EQ(controller.step(state, {}, {{0, -30}, frame, movers}, report), StepStatus::invalid_input);
  movers.resize(2);
  movers[1].to.angle = std::nan("");
  EXPECT_EQ(controller.step(state, {}, {{0, -30}, frame, movers}, report), StepStatus::invalid_input);
  movers[1] = {};
  EXPECT_EQ(controller.step(state, {}, {{0, -30}, -frame, movers}, report), StepStatus::invalid_input);
  EXPECT_EQ(controller.step(state, {}, {{0, -30}, frame, movers}, report), StepStatus::moved);
}

TEST(LevelSteps, allocate_nothing_while_what_is_near_stays) {
  Level level(SceneryDef{{box(-10, -1, 10, 0), box(-2, 0, 2, 0.5, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 1.2};
  StepReport<double> report;
  std::size_t before = 0;
  for (int i = 0; i < 90; ++i) {
    if (i == 30) before = tests::allocations();
    const PoseMotion lift{{{0, 0.01 * i}, 0}, {{0, 0.01 * (i + 1)}, 0}};
    controller.step(state, {}, {{0, -30}, frame, {&lift, 1}}, report);
  }
  ASSERT_EQ(state.ride.ground, 1U);
  EXPECT_EQ(tests::allocations(), before);
}

/// A hall of tiles, some of them edited in each step.
TEST(LevelEdits, give_the_bits_of_a_level_that_was_built_at_once) {
  const int edits_wanted = steps_wanted("PAPERPROOF_LEVEL_EDITS", 20'000);
  int edits = 0;
  int changed_under_foot = 0;
  for (std::uint64_t seed = 1; edits < edits_wanted; ++seed) {
    Random random(seed);
    Level edited(SceneryDef{{box(-1, -1, 41, 0), box(-1, 0, 0, 30), box(40, 0, 41, 30)}});
    std::map<std::pair<int, int>, ColliderIndex> tiles;
    CharacterDef character;
    LevelController controller(edited, character);
    CharacterState<double> state;
    state.position = {20.5, 20};
    StepReport<double> report;
    Input input;
    for (int step = 0; step < 200; ++step) {
      if (step % 20 == 0) input = random_input(random);
      for (int i = 0; i < 20; ++i, ++edits) {
        const int x = random.integer(0, 39);
        const int y = random.integer(0, 9);
        const auto known = tiles.find({x, y});
        const double height = random.chance(0.2) ? 0.5 : 1;
        const ColliderDef tile = box(x, y, x + 1, y + height);
        if (known == tiles.end()) {
          tiles[{x, y}] = edited.add(tile);
        } else if (random.chance(0.2)) {
          ASSERT_TRUE(edited.replace(known->second, tile));
        } else {
          ASSERT_TRUE(edited.remove(known->second));
          tiles.erase(known);
        }
      }
      Level fresh(SceneryDef{{box(40, 0, 41, 30), box(-1, 0, 0, 30), box(-1, -1, 41, 0)}});
      for (auto tile = tiles.rbegin(); tile != tiles.rend(); ++tile) fresh.add(*edited.find(tile->second));
      CharacterState<double> other = state;
      StepReport<double> other_report;
      LevelController(fresh, character).step(other, input, {{0, -30}, frame}, other_report);
      const bool stood = state.grounded;
      controller.step(state, input, {{0, -30}, frame}, report);
      other.ground.collider = state.ground.collider;  // other ids
      ASSERT_EQ(state, other) << "seed " << seed << ", step " << step;
      changed_under_foot += stood && !state.grounded && !input.jump;
    }
  }
  EXPECT_GE(changed_under_foot, 1);
}

TEST(LevelEdits, a_level_that_is_assigned_is_read_anew) {
  for (const bool moved : {false, true}) {
    Level level(SceneryDef{{box(-2, -1, 2, 0)}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {0, 0.7};
    StepReport<double> report;
    Level saved = level;
    for (int i = 0; i < 30; ++i) controller.step(state, {}, {{0, -30}, frame}, report);
    if (moved) {
      level = std::move(saved);
    } else {
      for (int i = 0; i < 100; ++i) level.add(box(10 + i, 0, 11 + i, 1));  // its memory moves
      level = saved;
    }
    for (int i = 0; i < 30; ++i) controller.step(state, {}, {{0, -30}, frame}, report);
    EXPECT_TRUE(state.grounded);
  }
}

TEST(LevelEdits, a_rider_of_a_removed_collider_falls_in_that_step) {
  Level level(SceneryDef{{box(-2, -1, 2, 0, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 0.7};
  StepReport<double> report;
  PoseMotion lift;
  for (int i = 0; i < 60; ++i) {
    lift = {lift.to, {lift.to.position + Vec2d(0.01, 0.02), 0}};
    controller.step(state, {}, {{0, -30}, frame, {&lift, 1}}, report);
  }
  ASSERT_TRUE(state.grounded);
  ASSERT_EQ(state.ride.ground, 0U);
  const Vec2d before = state.position;
  level.remove(0);
  level.add(box(-2, -100, 2, -99, 0));  // takes the slot
  controller.step(state, {}, {{0, -30}, frame, {&lift, 1}}, report);
  EXPECT_FALSE(state.grounded);
  EXPECT_EQ(state.ride.ground, no_collider);
  EXPECT_LT(state.position.y(), before.y() + 0.02);
}

TEST(LevelEdits, a_rider_stays_on_a_collider_that_is_replaced) {
  Level level(SceneryDef{{box(-2, -1, 2, 0, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 0.7};
  StepReport<double> report;
  PoseMotion lift;
  for (int i = 0; i < 120; ++i) {
    if (i == 60) level.replace(0, box(-1, -1, 1, 0, 0));
    lift = {lift.to, {lift.to.position + Vec2d(0.05, 0.02), 0}};
    controller.step(state, {}, {{0, -30}, frame, {&lift, 1}}, report);
    ASSERT_EQ(state.ride.ground, i > 30 ? 0U : state.ride.ground) << i;
  }
  EXPECT_NEAR(state.position.x(), lift.to.position.x(), 0.2);
}

// What turns.

/// Turns a mover evenly.
PoseMotion turning(const Vec2d& position, double speed, int step) {
  return {{position, speed * step * frame}, {position, speed * (step + 1) * frame}};
}

TEST(LevelTurning, a_plank_carries_its_rider) {
  Level level(SceneryDef{{box(-3, -0.1, 3, 0.1, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {2, 0.75};
  StepReport<double> report;
  PoseMotion plank;
  for (int i = 0; i < 30; ++i) controller.step(state, {}, {{0, -30}, frame, {&plank, 1}}, report);
  ASSERT_TRUE(state.grounded);
  const double foot = 2 + 10.0 / 32;  // the right one, which the plank lifts
  for (int i = 0; i < 60; ++i) {
    plank = turning({0, 0}, 0.5, i);
    controller.step(state, {}, {{0, -30}, frame, {&plank, 1}}, report);
    ASSERT_TRUE(state.grounded) << i;
    ASSERT_EQ(state.ride.ground, 0U) << i;
    ASSERT_EQ(report.status, StepStatus::moved);
  }
  EXPECT_NEAR(state.position.x(), 2 - foot * (1 - std::cos(0.5)), 0.1);
  EXPECT_GT(state.position.y(), 0.75 + 1.8 * std::sin(0.5));
}

/// Where a place that goes straight between instants is at a time.
template <class PlaceOf, class InstantOf>
Vec2d place_at(double time, std::size_t count, const InstantOf& instant, const PlaceOf& place) {
  std::size_t k = 0;
  while (k + 2 < count && instant(k + 1) <= time) ++k;
  const double length = instant(k + 1) - instant(k);
  const double share = length > 0 ? std::clamp((time - instant(k)) / length, 0.0, 1.0) : 1.0;
  return place(k) + (place(k + 1) - place(k)) * share;
}

/// On which side of a paper a character is: 1 or -1; 0 where it reaches beyond an end of it; nothing where the paper is
/// in it. @param first,last ends of the paper.
std::optional<int> side_of_paper(const Vec2d& first, const Vec2d& last, const Vec2d& position,
                                 std::span<const Vec2d> hull) {
  const Vec2d along = (last - first).normalized();
  const Vec2d normal{-along.y(), along.x()};
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  bool is_beside = true;
  for (const Vec2d& corner : hull) {
    const Vec2d from = position + corner - first;
    low = std::min(low, from.dot(normal));
    high = std::max(high, from.dot(normal));
    is_beside = is_beside && from.dot(along) > 0 && from.dot(along) < (last - first).norm();
  }
  if (!is_beside) return 0;
  if (low < -1e-9 && high > 1e-9) return std::nullopt;
  return low + high > 0 ? 1 : -1;
}

/// A revolving door of paper, faster and faster: the character is always on its own side, or crushed.
TEST(LevelTurning, paper_that_turns_pushes_and_never_passes) {
  for (const double speed : {0.5, 2.0, 8.0, 30.0, 120.0, 600.0}) {
    Level level(SceneryDef{{box(-10, -1, 10, 0), box(-3, -1e-6, 3, 1e-6, 0)}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {1.5, 0.7};
    StepReport<double> report;
    for (int i = 0; i < 30; ++i) {
      const PoseMotion stands = {{{0, 2}, 0}, {{0, 2}, 0}};
      controller.step(state, {}, {{0, -30}, frame, {&stands, 1}}, report);
    }
    int crushed = 0;
    int moved = 0;
    int beside = 0;              // moments in which it is beside the paper and not crushed
    int side = 0;                // of the paper, the last that is known
    constexpr int moments = 32;  // between two instants of the paper
    for (int i = 0; i < 120; ++i) {
      const PoseMotion door = turning({0, 2}, -speed, i);
      const Vec2d before = state.position;
      controller.step(state, {}, {{0, -30}, frame, {&door, 1}}, report);
      crushed += report.status == StepStatus::crushed;
      moved += (state.position - before).norm() > 1e-3;
      if (state.crushed || report.status != StepStatus::moved || controller.turned().empty()) {
        side = 0;
        continue;
      }
      const TurnedCollider& way = controller.turned()[0];
      ASSERT_EQ(way.instants.front(), 0);
      ASSERT_EQ(way.instants.back(), 1);
      ASSERT_TRUE(std::is_sorted(way.instants.begin(), way.instants.end()));
      ASSERT_EQ(way.vertices.size(), way.instants.size());
      std::vector<double> times = way.instants;
      for (const PathPoint<double>& corner : report.move.path) times.push_back(corner.fraction);
      for (std::size_t k = 1; k < way.instants.size(); ++k)
        for (int part = 1; part < moments; ++part)
          times.push_back(way.instants[k - 1] + (way.instants[k] - way.instants[k - 1]) * part / moments);
      std::sort(times.begin(), times.end());
      const auto vertex_at = [&](double time, std::size_t vertex) {
        return place_at(
            time, way.instants.size(), [&](std::size_t k) { return way.instants[k]; },
            [&](std::size_t k) { return way.vertices[k][vertex]; });
      };
      const auto& path = report.move.path;
      for (const double time : times) {
        const Vec2d here = place_at(
            time, path.size(), [&](std::size_t k) { return path[k].fraction; },
            [&](std::size_t k) { return path[k].position; });
        const std::optional<int> now =
            side_of_paper(vertex_at(time, 0), vertex_at(time, 1), here, controller.character().shape.hull());
        ASSERT_TRUE(now) << "speed " << speed << ", step " << i << ", at " << time << " the paper is in it";
        ASSERT_NE(*now * side, -1) << "speed " << speed << ", step " << i << ", passed before " << time;
        side = *now;
        beside += side != 0;
      }
    }
    std::printf("%g rad/s: %d moments beside the paper, %d steps with motion, %d crushed\n", speed, beside, moved,
                crushed);
    EXPECT_GT(beside, 100) << speed;
    EXPECT_GT(crushed + moved, 0) << speed;
  }
}

TEST(LevelTurning, a_wall_that_turns_pushes_at_once) {
  Level level(SceneryDef{{box(-10, -1, 10, 0), box(0, 0, 0.1, 4, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {-10.0 / 32 - 1e-6, 20.0 / 32 + 5e-7};
  StepReport<double> report;
  for (int i = 0; i < 40; ++i) {
    const PoseMotion wall = turning({0, 0}, 0.3, i);
    controller.step(state, {}, {{0, -30}, frame, {&wall, 1}}, report);
    ASSERT_NE(report.status, StepStatus::crushed);
    const double arm =
        state.position.x() + 10.0 / 32;  // the wall, over the foot of the character, is at its arm or head
    EXPECT_LT(arm, 0) << i;
  }
  EXPECT_LT(state.position.x(), -0.4);
}

/// Blades, wheels and frames of sensors that turn over a character which stands, walks, and jumps.
TEST(SensorsThatTurn, report_each_visit_and_are_known_at_the_end_of_each_step) {
  const int wanted = steps_wanted("PAPERPROOF_SENSOR_STEPS", 6000);
  int steps = 0;
  int events = 0;
  int events_at_rest = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    SceneryDef def{{box(-8, -1, 8, 0), box(-9, -1, -8, 9), box(8, -1, 9, 9)}};
    const int sensors = random.integer(1, 3);
    std::vector<std::pair<Vec2d, double>> courses;
    for (int i = 0; i < sensors; ++i) {
      const double off = random.between(-1, 1);
      const Vec2d half{random.between(0.3, 3), random.between(0.05, 0.5)};
      ColliderDef sensor = box(off - half.x(), -half.y(), off + half.x(), half.y(), static_cast<MoverIndex>(i));
      if (random.chance(0.2)) {
        sensor.shape = ColliderDef::Shape::circle;
        sensor.points = {{off, 0}};
        sensor.radius = half.y();
      }
      sensor.sensor = true;
      def.colliders.push_back(sensor);
      Vec2d middle{random.between(-6, 6), 0};
      middle.y() = random.between(0, 2);
      courses.emplace_back(middle, random.either_sign_log_between(0.1, 20));
    }
    if (random.chance(0.5)) {  // a solid that turns as well
      def.colliders.push_back(box(-1, -0.1, 1, 0.1, static_cast<MoverIndex>(courses.size())));
      courses.emplace_back(Vec2d{random.between(-5, 5), 1}, random.either_sign_log_between(0.1, 3));
    }
    const Level level(def);
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {random.between(-7, 7), 5};
    StepReport<double> report;
    std::set<ColliderIndex> inside;
    Input input;
    const auto pose = [&](std::size_t i, int step) -> Pose {
      return {courses[i].first, courses[i].second * step * frame};
    };
    for (int step = 0; step < 100; ++step, ++steps) {
      if (step % 20 == 0) input = random.chance(0.5) ? Input{} : random_input(random);
      std::vector<PoseMotion> movers;
      for (std::size_t i = 0; i < courses.size(); ++i) movers.push_back({pose(i, step), pose(i, step + 1)});
      const Vec2d before = state.position;
      controller.step(state, input, {{0, -30}, frame, movers}, report);
      double last = 0;
      for (const SensorEvent<double>& event : report.sensors) {
        ASSERT_GE(event.fraction, last) << "seed " << seed << ", step " << step;
        last = event.fraction;
        const bool enters = event.change == SensorEvent<double>::Change::enter;
        ASSERT_EQ(enters, !inside.contains(event.sensor)) << "seed " << seed << ", step " << step;
        if (enters)
          inside.insert(event.sensor);
        else
          inside.erase(event.sensor);
        ++events;
        events_at_rest += before == state.position;
      }
      // As a character that is put there without knowing anything would find it: the sensors as solids.
      SceneryDef solid;
      for (const ColliderDef& each : def.colliders) {
        if (!each.sensor) continue;
        solid.colliders.push_back(each);
        solid.colliders.back().sensor = false;
      }
      for (std::size_t i = 0; i < solid.colliders.size(); ++i) {
        const Level alone(SceneryDef{{solid.colliders[i]}});
        std::vector<PoseMotion> there(movers.size());
        for (std::size_t k = 0; k < movers.size(); ++k) there[k] = {movers[k].to, movers[k].to};
        const std::size_t count = *LevelController(alone, {}).overlaps(state.position, {{0, 0}, frame, there});
        ASSERT_EQ(count > 0, inside.contains(static_cast<ColliderIndex>(i + 3)))
            << "seed " << seed << ", step " << step;
      }
    }
  }
  EXPECT_GT(events, steps / 60);
  EXPECT_GT(events_at_rest, steps / 1000);
}

TEST(LevelTurning, a_wheel_that_does_not_carry_lets_its_belt_alone_carry) {
  for (const double belt : {0.0, 1.5}) {
    ColliderDef wheel{.shape = ColliderDef::Shape::circle, .points = {{0, 0}}, .mover = 0};
    wheel.surface_speed = belt;
    wheel.radius = 50;
    wheel.carries = false;
    Level level(SceneryDef{{wheel}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {0, 50.7};
    StepReport<double> report;
    for (int i = 0; i < 120; ++i) {
      const double x = 0.01 * i;
      const PoseMotion motion{{{x, 0}, 0.002 * i}, {{x + 0.01, 0}, 0.002 * (i + 1)}};
      controller.step(state, {}, {{0, -30}, frame, {&motion, 1}}, report);
      if (i < 60) state.velocity.x() = 0;
      if (i == 59) state.position.x() = 0.6;
    }
    EXPECT_NEAR(state.position.x() - 0.6, belt, 0.06) << "a second on a belt of " << belt << " m/s";
  }
}

TEST(LevelTurning, a_step_out_of_range_changes_nothing_and_says_so) {
  Level level(SceneryDef{{box(-3, -0.1, 3, 0.1, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {999'999, 0.8};
  state.velocity = {1e9, 0};
  const CharacterState<double> before = state;
  StepReport<double> report;
  const PoseMotion plank{{{999'999, 0}, 0}, {{999'999, 0}, 0.01}};
  EXPECT_EQ(controller.step(state, {}, {{0, -30}, frame, {&plank, 1}}, report), StepStatus::out_of_range);
  EXPECT_EQ(state, before);
  EXPECT_EQ(report.move.status, MoveStatus::out_of_range);
  ASSERT_GE(report.move.path.size(), 1U);
  EXPECT_EQ(report.move.path.back().position, before.position);
  EXPECT_EQ(report.move.position, before.position);
  EXPECT_EQ(controller.overlaps({1e12, 0}, {{0, 0}, frame, {&plank, 1}}), std::nullopt);
  EXPECT_EQ(controller.overlaps({std::nan(""), 0}, {{0, 0}, frame, {&plank, 1}}), std::nullopt);
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
    const Level level(SceneryDef{{plank}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {random.between(-1.2, 1.2), 0.8};
    StepReport<double> report;
    const double swing = random.between(0.05, 0.6);
    const double pace = random.between(0.3, 8);
    const Vec2d reach{random.between(-1, 1), random.between(-1, 1)};
    const bool jumps = random.chance(0.5);
    const auto pose = [&](int step) -> Pose {
      const double share = std::sin(pace * std::max(0, step - 30) * frame);
      return {reach * share, swing * share};
    };
    for (int step = 0; step < 400; ++step) {
      const PoseMotion motion{pose(step), pose(step + 1)};
      const Input input{.jump = jumps && step > 30 && step % 40 < 20};
      controller.step(state, input, {{0, -20}, frame, {&motion, 1}}, report);
      const Vec2d from_above = level::rotated(Vec2d(state.position - motion.to.position), -motion.to.angle);
      if (std::abs(from_above.x()) > 1.6) break;  // it went over the end
      ASSERT_GT(from_above.y(), 0.1) << "run " << run << ", step " << step;
      (state.grounded ? grounded : in_the_air) += 1;
    }
  }
  EXPECT_GT(grounded, runs * 50);
  EXPECT_GT(in_the_air, runs * 10);
}

TEST(LevelTurning, states_may_be_restored) {
  Random random(3);
  Level level(SceneryDef{{box(-10, -1, 10, 0), box(-3, -0.1, 3, 0.1, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {1, 3};
  StepReport<double> report;
  std::vector<CharacterState<double>> first;
  std::vector<Input> inputs;
  for (int i = 0; i < 300; ++i) {
    const PoseMotion plank = turning({0, 1.5}, 1.0, i);
    inputs.push_back(i % 20 == 0 ? random_input(random) : inputs.back());
    first.push_back(state);
    controller.step(state, inputs.back(), {{0, -30}, frame, {&plank, 1}}, report);
  }
  LevelController other(level, {});
  for (int i = 100; i < 299; ++i) {
    CharacterState<double> again = first[static_cast<std::size_t>(i)];
    const PoseMotion plank = turning({0, 1.5}, 1.0, i);
    other.step(again, inputs[static_cast<std::size_t>(i)], {{0, -30}, frame, {&plank, 1}}, report);
    ASSERT_EQ(again, first[static_cast<std::size_t>(i) + 1]) << i;
  }
}

/// A press comes down on the character, which stands on the floor.
TEST(LevelTurning, what_crushed_and_stands_now_is_a_solid_to_leave) {
  Level level(
      SceneryDef{{box(-2, -1, 2, 0), box(-3, -1, -2, 5), box(2, -1, 3, 5), box(-2, 0, 2, 1, 0), box(0, 3, 3, 3.1, 1)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 0.63};
  StepReport<double> report;
  std::array<PoseMotion, 2> movers{};
  movers[0].to.position = {0, 1.5};
  for (int i = 0; i < 60; ++i) {
    movers[0] = {movers[0].to, {{0, std::max(0.5, 1.5 - 0.5 * i)}, 0}};
    movers[1] = turning({0, 0}, 1.0, i);
    controller.step(state, {}, {{0, -30}, frame, movers}, report);
  }
  ASSERT_TRUE(state.crushed);
  level.replace(3, box(-2, 0.5, 2, 1.5));  // where it is
  movers[1] = turning({0, 0}, 1.0, 60);
  const LevelContext context{{0, -30}, frame, movers};
  const StepStatus status = controller.step(state, {}, context, report);
  movers[1].from = movers[1].to;
  EXPECT_EQ(controller.overlaps(state.position, context) == 0U, status == StepStatus::moved);
}

TEST(LevelEdits, an_assigned_level_is_another_level) {
  Level level(SceneryDef{{box(-10, -1, 10, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 0.63};
  StepReport<double> report;
  for (int i = 0; i < 30; ++i) controller.step(state, {}, {{0, -30}, frame}, report);
  ASSERT_TRUE(state.grounded);
  level = Level(SceneryDef{{box(-10, -6, 10, -5)}});
  controller.step(state, {}, {{0, -30}, frame}, report);
  EXPECT_FALSE(state.grounded);
}

/// Planks and wheels over a floor, for random play.
struct Turners {
  explicit Turners(Random& random) {
    level.add(box(-8, -1, 8, 0));
    level.add(box(-9, -1, -8, 9));
    level.add(box(8, -1, 9, 9));
    const int count = random.integer(1, 4);
    for (int i = 0; i < count; ++i) {
      const double half = random.between(0.5, 2);
      level.add(box(-half, -0.1, half, 0.1, static_cast<MoverIndex>(i)));
      places.push_back({random.between(-5, 5), 0});
      places.back().y() = random.between(0.5, 4);
      speeds.push_back(random.between(-4, 4));
    }
  }
  [[nodiscard]] std::vector<PoseMotion> motions(int step) const {
    std::vector<PoseMotion> all;
    for (std::size_t i = 0; i < places.size(); ++i) all.push_back(turning(places[i], speeds[i], step));
    return all;
  }

  Level level;
  std::vector<Vec2d> places;
  std::vector<double> speeds;
};

TEST(LevelTurning, a_step_depends_on_its_state_alone) {
  int pushed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Turners turners(random);
    LevelController controller(turners.level, {});
    CharacterState<double> state;
    state.position = {random.between(-5, 5), 6};
    Input input;
    StepReport<double> report;
    for (int i = 0; i < 120; ++i) {
      if (i % 20 == 0) input = random_input(random);
      const std::vector<PoseMotion> motions = turners.motions(i);
      const LevelContext context{{0, -30}, frame, motions};
      CharacterState<double> other = state;
      StepReport<double> other_report;
      LevelController(turners.level, {}).step(other, input, context, other_report);
      static_cast<void>(controller.overlaps({random.between(-8, 8), 3}, context));
      controller.step(state, input, context, report);
      ASSERT_EQ(state, other) << "seed " << seed << ", step " << i;
      ASSERT_EQ(report.move.path.size(), other_report.move.path.size()) << "seed " << seed << ", step " << i;
      pushed += controller.turned().empty() ? 0 : 1;
    }
  }
  EXPECT_GE(pushed, 300);
}

TEST(LevelTurning, what_the_filter_leaves_out_changes_nothing) {
  Level with(SceneryDef{{box(-10, -1, 10, 0), box(-1, 1.5, 1, 1.6, 0)}});
  ColliderDef other_kind = *with.find(1);
  other_kind.filter.category = 2;
  with.replace(1, other_kind);
  const Level without(SceneryDef{{box(-10, -1, 10, 0)}});
  LevelController controller(with, {});
  LevelController other(without, {});
  CharacterState<double> state;
  state.position = {0, 0.7};
  CharacterState<double> other_state = state;
  const ColliderFilter filter{Filter{.mask = 1}};
  StepReport<double> report;
  for (int i = 0; i < 120; ++i) {
    const PoseMotion spinner = turning({0, 0}, 6, i);
    const Input input{.move = 0.1, .jump = i % 40 > 30};
    controller.step(state, input, {{0, -30}, frame, {&spinner, 1}, &filter}, report);
    other.step(other_state, input, {{0, -30}, frame}, report);
    ASSERT_EQ(state, other_state) << i;
  }
}

TEST(LevelTurning, a_room_that_turns_crushes_nobody) {
  for (const double speed : {0.5, 1.0, 2.0, 3.0}) {
    ColliderDef room = box(-3, -3, 3, 3, 0);
    room.holes = {box(-2.8, -2.8, 2.8, 2.8).points};
    const Level level(SceneryDef{{room}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {0, -1};
    StepReport<double> report;
    for (int i = 0; i < 600; ++i) {
      const PoseMotion motion = turning({0, 0}, speed, i);
      ASSERT_EQ(controller.step(state, {.move = 0.0}, {{0, -30}, frame, {&motion, 1}}, report), StepStatus::moved)
          << speed << " rad/s, step " << i;
      ASSERT_LT(state.position.norm(), 4) << speed << " rad/s, step " << i;
    }
  }
}

/// A wedge that closes would squeeze out a rigid body at any speed.
TEST(LevelTurning, a_plank_that_closes_on_the_floor_flings_nobody) {
  for (const double speed : {3.0, 5.0, 7.0, 10.0, 20.0}) {
    const Level level(SceneryDef{{box(-100, -1, 100, 0), box(-1.5, -0.05, 1.5, 0.05, 0)}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {-4, 0.63};
    StepReport<double> report;
    for (int i = 0; i < 120; ++i) {
      const PoseMotion motion = turning({0, 1.2}, speed, i);
      controller.step(state, {.move = 1.0}, {{0, -30}, frame, {&motion, 1}}, report);
      EXPECT_LE(std::abs(state.velocity.x()), 1.5 * speed + CharacterDef{}.walk_speed + 0.01)
          << speed << ", step " << i;
    }
  }
}

/// The id of the ground was taken for an index of what is near: memory beyond it was read.
TEST(LevelStep, that_is_refused_changes_nothing_however_large_the_id_of_its_ground) {
  Level level;
  for (int i = 0; i < 20'000; ++i) level.add(box(i, -1, i + 1, 0));
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {19'900.5, 0.7};
  StepReport<double> report;
  const LevelContext context{.gravity = {0, -20}, .dt = frame};
  for (int i = 0; i < 30; ++i) controller.step(state, {.move = 0.0}, context, report);
  ASSERT_GT(state.ground.collider, 10'000U);
  const CharacterState<double> before = state;
  EXPECT_EQ(controller.move(state, {3e6, 0}, context, report), StepStatus::out_of_range);
  EXPECT_EQ(state, before);
}

/// The place of a ground that is none was read from a restored state, and named memory beyond the ids.
TEST(LevelStep, reads_no_ground_of_a_state_that_stands_on_none) {
  const Level level(SceneryDef{{box(-10, -1, 10, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 5};
  state.ground.collider = 4'000'000'000;
  StepReport<double> report;
  EXPECT_EQ(controller.step(state, {.move = 0.0}, {{0, -20}, frame}, report), StepStatus::moved);
}

TEST(LevelEdits, a_level_that_was_moved_from_is_empty_for_its_controllers) {
  Level level(SceneryDef{{box(-10, -1, 10, 0)}});
  LevelController controller(level, {});
  CharacterState<double> state;
  state.position = {0, 0.63};
  StepReport<double> report;
  for (int i = 0; i < 30; ++i) controller.step(state, {.move = 0.0}, {{0, -20}, frame}, report);
  ASSERT_TRUE(state.grounded);
  const Level other = std::move(level);
  controller.step(state, {.move = 0.0}, {{0, -20}, frame}, report);
  EXPECT_FALSE(state.grounded);
  EXPECT_EQ(other.size(), 1U);
}

TEST(LocalControllerWait, is_stuck_in_what_stands_and_crushed_by_what_comes) {
  LocalController controller({});
  const ColliderDef wall = box(-1, -1, 1, 1);
  const auto wait = [&](MoverIndex mover, const Vec2d& from) {
    const auto find = [&](const Box2<double>&, std::vector<NearCollider>& found) {
      found.push_back({.id = 0, .version = 1, .def = &wall, .mover = mover, .motion = {{from}, {}}});
    };
    CharacterState<double> state;
    StepReport<double> report;
    return controller.wait(state, {.dt = frame}, find, report);
  };
  EXPECT_EQ(wait(no_mover, {0, 0}), StepStatus::stuck);
  EXPECT_EQ(wait(0, {0, 9}), StepStatus::crushed);
  EXPECT_EQ(wait(0, {0, 0}), StepStatus::stuck);
}

/// A collider that no scenery can be made of made scenery anew in every step.
TEST(LocalControllerStep, costs_the_same_beside_a_mover_that_is_unusable) {
  LocalController controller({});
  const ColliderDef floor = box(-5, -1, 5, 0);
  const ColliderDef nothing{.shape = ColliderDef::Shape::chain, .points = {{1, 1}, {1, 1}}};
  const auto find = [&](const Box2<double>&, std::vector<NearCollider>& found) {
    found.push_back({.id = 0, .version = 1, .def = &floor, .mover = no_mover, .motion = {}});
    found.push_back({.id = 1, .version = 1, .def = &nothing, .mover = 0, .motion = {}});
  };
  CharacterState<double> state;
  state.position = {0, 0.63};
  StepReport<double> report;
  const auto step = [&] { controller.step(state, {.move = 0.0}, {.gravity = {0, -20}, .dt = frame}, find, report); };
  for (int i = 0; i < 30; ++i) step();
  ASSERT_EQ(controller.unusable().size(), 1U);
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(tests::allocations(), before);
}

TEST(LevelEdits, colliders_at_one_place_have_an_order_of_their_own) {
  ColliderDef right = box(-10, -1, 10, 0);
  right.surface_speed = 2;
  ColliderDef left = right;
  left.surface_speed = -3;
  std::vector<double> ends;
  for (const auto& pair : {std::array{right, left}, std::array{left, right}}) {
    const Level level(SceneryDef{{pair[0], pair[1]}});
    LevelController controller(level, {});
    CharacterState<double> state;
    state.position = {0, 0.63};
    StepReport<double> report;
    for (int i = 0; i < 60; ++i) controller.step(state, {}, {{0, -30}, frame}, report);
    ends.push_back(state.position.x());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

// The proof.

using level::PieceWay;
using level::stay_apart;

const std::vector<Vec2d> unit_box{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

std::vector<Vec2d> shifted(std::vector<Vec2d> points, const Vec2d& by) {
  for (Vec2d& point : points) point += by;
  return points;
}

std::vector<Vec2d> rotated(std::vector<Vec2d> points, double angle) {
  for (Vec2d& point : points)
    point = {point.x() * std::cos(angle) - point.y() * std::sin(angle),
             point.x() * std::sin(angle) + point.y() * std::cos(angle)};
  return points;
}

TEST(ProofOfTurns, knows_ways_that_pass_and_ways_that_meet) {
  // Side by side, with a gap of 1e-6 m and of 1e-10 m.
  EXPECT_TRUE(stay_apart({unit_box, {0, 0}, {0, 5}},
                         {shifted(unit_box, {1 + 1e-6, 0}), shifted(unit_box, {1 + 1e-6, 3})}, 1e-9));
  EXPECT_FALSE(stay_apart({unit_box, {0, 0}, {0, 5}},
                          {shifted(unit_box, {1 + 1e-10, 0}), shifted(unit_box, {1 + 1e-10, 3})}, 1e-9));
  // Through each other within the time, apart at both ends.
  EXPECT_FALSE(stay_apart({unit_box, {0, 0}, {0, 0}}, {shifted(unit_box, {-2, 0}), shifted(unit_box, {2, 0})}, 1e-9));
  // A paper turns past a corner: it ends 1 mm before the corner, or 1 mm behind it.
  const std::vector<Vec2d> paper{{0, 0}, {2, 0}};
  for (const double gap : {1e-3, -1e-3}) {
    const Vec2d corner = rotated({{1, 0}}, 0.2)[0] + rotated({{0, 1}}, 0.2)[0] * gap;
    const PieceWay turn{paper, rotated(paper, 0.2)};
    const Vec2d at = corner + Vec2d(-0.5, 0.5);  // it is the lower right corner of the box
    EXPECT_EQ(stay_apart({unit_box, at, at}, turn, 1e-9), gap > 0) << gap;
  }
}

/// Against a twin that looks at many moments.
TEST(ProofOfTurns, agrees_with_many_moments) {
  int apart = 0;
  int meet = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const int corners = random.integer(2, 7);
    std::vector<Vec2d> piece;
    for (int i = 0; i < corners; ++i) piece.push_back(rotated({{1, 0}}, 2 * pi * i / corners)[0]);
    const double size = random.log_between(1e-3, 3);
    for (Vec2d& point : piece) point *= size;
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

}  // namespace
}  // namespace paperproof::test
