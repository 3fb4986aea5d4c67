/// A level that changes between steps, against scenery that is built at once.
#include "controller/played.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/same_bits.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace paperproof::test {
namespace {

using compare::box;

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

}  // namespace
}  // namespace paperproof::test
