/// The times of steps, and scenery at a time. Where a mover is at a time: mover_way_test.cpp.
#include "scenes/mover.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

namespace paperproof::compare {
namespace {

TEST(StepTimes, one_step_begins_when_the_one_before_ends_round_after_round) {
  const StepTimes times(1, {0.1, 0.2, 0.3, 1e-9, 7});
  for (int step = 1; step < 1000; ++step) EXPECT_EQ(times.begin(step), times.end(step - 1)) << step;
  EXPECT_EQ(times.begin(0), 0);
  EXPECT_EQ(times.length(7), 0.3);
  EXPECT_EQ(times.shortest(), 1e-9);
  EXPECT_EQ(times.longest(), 7);
}

TEST(StepTimes, are_sums_without_the_error_of_adding_up) {
  // A plain sum loses every one of the small lengths.
  std::vector<double> lengths(1001, 1e-13);
  lengths[0] = 1e4;
  const StepTimes times(1, lengths);
  EXPECT_EQ(times.end(1000), 1e4 + 1e-10);
  EXPECT_EQ(times.end(2001), 2 * (1e4 + 1e-10));
  const StepTimes even(0.1, {});
  EXPECT_EQ(even.begin(3), 3 * 0.1);
}

TEST(SceneryAt, turns_about_the_origin_of_the_shape_and_then_moves) {
  Scene scene;
  scene.scenery.colliders = {
      {.points = {{0, 0}, {1, 0}, {0, 1}}},
      {.shape = ColliderDef::Shape::chain, .points = {{0, 0}, {2, 0}}, .one_way = Vec2d{0, 1}, .mover = 0}};
  scene.movers = {{.id = "door",
                   .path = {{.time = 0, .at = {5, 6}}},
                   .turns = {{.time = 0, .at = 0}, {.time = 1, .at = std::numbers::pi / 2}}}};
  EXPECT_EQ(scenery_at(scene, 0).colliders[1].points[1], Vec2d(7, 6));
  const SceneryDef turned = scenery_at(scene, 1);
  EXPECT_EQ(turned.colliders[0].points, scene.scenery.colliders[0].points);
  EXPECT_EQ(turned.colliders[1].mover, no_mover);
  EXPECT_EQ(turned.colliders[1].points[0], Vec2d(5, 6));
  EXPECT_LE((turned.colliders[1].points[1] - Vec2d(5, 8)).norm(), 1e-15);
  EXPECT_LE((*turned.colliders[1].one_way - Vec2d(-1, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace paperproof::compare
