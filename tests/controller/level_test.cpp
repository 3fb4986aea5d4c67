/// A level that changes between steps. That it gives the bits of scenery that is built at once is in
/// tests/agreement/equalities_test.cpp.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace paperproof::stepping {
namespace {

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
  Stepper played = player_in({box(0, 0, 1, 1, 1)});
  played.movers.resize(1);
  EXPECT_EQ(played.step(), StepStatus::invalid_input);
  played.movers.resize(2);
  played.movers[1].to_angle = nan;
  EXPECT_EQ(played.step(), StepStatus::invalid_input);
  played.movers[1] = {};
  played.dt = -frame;
  EXPECT_EQ(played.step(), StepStatus::invalid_input);
  played.dt = frame;
  EXPECT_EQ(played.step(), StepStatus::moved);
}

TEST(LevelSteps, allocate_nothing_while_what_is_near_stays) {
  Stepper played = player_in({box(-10, -1, 10, 0), box(-2, 0, 2, 0.5, 0)}, {0, 1.2});
  for (int i = 0; i < 30; ++i) played.step_with_mover_by(0, 0.01);
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 60; ++i) played.step_with_mover_by(0, 0.01);
  ASSERT_EQ(played.state.ride.ground, 1U);
  EXPECT_EQ(tests::allocations(), before);
}

TEST(LevelEdits, a_level_that_is_assigned_or_moved_from_is_read_anew) {
  const auto stands_after = [](const auto& change) -> bool {
    Stepper played = player_in({box(-10, -1, 10, 0)});
    played.steps(30);
    EXPECT_TRUE(played.state.grounded);
    change(*played.scenery);
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
  Stepper played = player_in({box(-2, -1, 2, 0, 0)}, {0, 0.7});
  for (int i = 0; i < 120; ++i) {
    if (i == 60) played.scenery->replace(0, box(-1, -1, 1, 0, 0));
    played.step_with_mover_by(0.05, 0.02);
    ASSERT_TRUE(i <= 30 || played.state.ride.ground == 0) << i;
  }
  EXPECT_NEAR(played.state.position.x(), played.movers[0].to.x(), 0.2);
  const Vec2d before = played.state.position;
  played.scenery->remove(0);
  played.scenery->add(box(-2, -100, 2, -99, 0));  // takes the slot
  played.step();
  EXPECT_FALSE(played.state.grounded);
  EXPECT_EQ(played.state.ride.ground, no_collider);
  EXPECT_LT(played.state.position.y(), before.y() + 0.02);
}

/// The id of the ground was taken for an index of what is near: memory beyond it was read.
TEST(LevelStep, that_is_refused_changes_nothing_however_large_the_id_of_its_ground) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 20'000; ++i) tiles.push_back(box(i, -1, i + 1, 0));
  Stepper played = player_in(tiles, {19'900.5, 0.7});
  played.steps(30);
  ASSERT_GT(played.state.ground.collider, 10'000U);
  const CharacterState before = played.state;
  EXPECT_EQ(played.sweep().move(played.state, {3e6, 0}, played.context(), played.scratch, played.report),
            StepStatus::out_of_range);
  EXPECT_EQ(played.state, before);
}

/// The place of a ground that is none was read from a restored state, and named memory beyond the ids.
TEST(LevelStep, reads_no_ground_of_a_state_that_stands_on_none) {
  Stepper played = player_in({box(-10, -1, 10, 0)}, {0, 5});
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
      Stepper played = player_in({first, second});
      played.steps(60);
      return played.state.position;
    };
    EXPECT_EQ(end_on(right, left), end_on(left, right));
    EXPECT_GT(end_on(right, left).norm(), 1) << "on either belt";
  }
}

}  // namespace
}  // namespace paperproof::stepping
