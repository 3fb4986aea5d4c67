#include "scenes/mover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

namespace paperproof::compare {
namespace {

using Loop = MoverDef::Loop;

/// From (1, 0) at 0.5 s by way of (1, 3) at 2.5 s to (0.1, 3) at 2.75 s: times and places that no product hits by luck.
MoverDef crooked(Loop loop) {
  return {.id = "crooked",
          .path = {{.time = 0.5, .at = {1, 0}}, {.time = 2.5, .at = {1, 3}}, {.time = 2.75, .at = {0.1, 3}}},
          .loop = loop};
}

TEST(MoverOffset, is_the_waypoint_at_its_time_exactly_linear_between_and_still_before_the_first) {
  for (const Loop loop : {Loop::once, Loop::loop, Loop::ping_pong}) {
    EXPECT_EQ(offset_at(crooked(loop), 0), Vec2d(1, 0));
    EXPECT_EQ(offset_at(crooked(loop), 0.4999), Vec2d(1, 0));
    EXPECT_EQ(offset_at(crooked(loop), 0.5), Vec2d(1, 0));
    EXPECT_EQ(offset_at(crooked(loop), 1), Vec2d(1, 3 * (1 - 0.5) / (2.5 - 0.5)));
    EXPECT_EQ(offset_at(crooked(loop), 2.5), Vec2d(1, 3));
    const MoverDef parked{.id = "parked", .path = {{.time = 1, .at = {4, 5}}}, .loop = loop};
    for (const double time : {0.0, 1.0, 7.25}) EXPECT_EQ(offset_at(parked, time), Vec2d(4, 5));
  }
  for (const double time : {2.75, 3.0, 1e9}) EXPECT_EQ(offset_at(crooked(Loop::once), time), Vec2d(0.1, 3));
}

TEST(MoverOffset, of_a_loop_repeats_with_its_length_to_the_bit) {
  const double length = 2.75 - 0.5;
  for (const double time : {0.5, 0.75, 1.1, 2.5, 2.6}) {
    // Multiples of 1/64 s are exact, and so is every sum of them.
    const double exact = std::round(time * 64) / 64;
    for (const double rounds : {1.0, 2.0, 1000.0, 1e6})
      EXPECT_EQ(offset_at(crooked(Loop::loop), exact + rounds * length), offset_at(crooked(Loop::loop), exact));
  }
}

TEST(MoverOffset, of_a_ping_pong_comes_back_the_same_way) {
  const MoverDef mover = crooked(Loop::ping_pong);
  for (const double before_the_end : {0.0, 0.125, 0.25, 1.0, 2.25}) {
    EXPECT_EQ(offset_at(mover, 2.75 + before_the_end), offset_at(mover, 2.75 - before_the_end));
    EXPECT_EQ(offset_at(mover, 2.75 + before_the_end + 1e6 * 4.5), offset_at(mover, 2.75 - before_the_end));
  }
}

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

TEST(MoverAngle, goes_on_from_round_to_round_and_comes_back_in_a_ping_pong) {
  MoverDef mover{.id = "fan", .path = {{}}, .turns = {{.time = 0, .at = 1}, {.time = 2, .at = 4}}};
  EXPECT_EQ(angle_at(crooked(Loop::loop), 3), 0) << "without turns";
  EXPECT_EQ(angle_at(mover, 1), 2.5);
  EXPECT_EQ(angle_at(mover, 5), 4);
  mover.loop = Loop::loop;
  EXPECT_EQ(angle_at(mover, 2), 4);  // the end of the first round is the beginning of the second
  EXPECT_EQ(angle_at(mover, 5), 1 + 2 * 3 + 1.5);
  mover.loop = Loop::ping_pong;
  EXPECT_EQ(angle_at(mover, 3), 2.5);
  EXPECT_EQ(angle_at(mover, 4), 1);
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
