/// octagon_sweep: what no situation of tests/situations can say. What its report calls the ground, and starts inside a
/// solid.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

/// Two floors, and a step down to a third one.
TEST(Ground, names_the_collider_that_is_stood_on) {
  Stepper walker({rectangle(-4, -1, 0, 0), rectangle(0, -1, 2, 0), rectangle(2, -1, 9, -0.05)}, {.snap = 0.5});
  walker.at(-1, half_height + 0.01).steps(20);
  std::vector<ColliderIndex> grounds;
  for (int step = 0; step < 50; ++step) {
    walker.step({.move = 1});
    ASSERT_TRUE(walker.state.grounded) << step;
    if (grounds.empty() || grounds.back() != walker.report.move.ground.collider)
      grounds.push_back(walker.report.move.ground.collider);
  }
  EXPECT_EQ(grounds, (std::vector<ColliderIndex>{0, 1, 2}));
  walker.step({.move = {}, .jump = true});
  EXPECT_EQ(walker.report.move.ground.state, GroundState::air);
}

TEST(Ground, is_air_walkable_or_steep) {
  // A slope of 60 degrees that ends on a floor.
  const double rise = 4 * std::tan(60 * degree);
  Stepper faller({rectangle(-1, -1, 20, 0), rectangle(-1, 0, 0, rise), polygon({{0, rise}, {0, 0}, {4, 0}})});
  faller.gravity = {0, -30};
  faller.at(2, rise).step();
  EXPECT_EQ(faller.report.move.ground.state, GroundState::air);
  int slides = 0;
  for (int step = 0; step < 200 && !faller.state.grounded; ++step) {
    faller.step();
    if (faller.report.move.ground.state != GroundState::steep) continue;
    ++slides;
    ASSERT_EQ(faller.report.move.ground.collider, ColliderIndex{2});
    ASSERT_NEAR(faller.report.move.ground.normal.y(), 0.5, 1e-12);
  }
  EXPECT_GT(slides, 5);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::walkable);
  EXPECT_EQ(faller.report.move.ground.normal, Vec2d(0, 1));
  EXPECT_EQ(faller.report.move.ground.velocity, Vec2d(0, 0));
}

TEST(Ground, is_a_wedge_between_two_steep_faces) {
  Stepper faller({polygon({{0, 0}, {2, 5}, {3, 5}, {3, -1}, {-3, -1}, {-3, 5}, {-2, 5}})});
  faller.at(0.01, 3).steps(240);
  EXPECT_TRUE(faller.state.grounded);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::wedge);
  EXPECT_EQ(faller.report.move.ground.collider, ColliderIndex{0});
}

TEST(StartInside, of_hundreds_of_solids_at_once_does_not_allocate) {
  std::vector<ColliderDef> colliders;
  for (int k = 0; k < 300; ++k)
    colliders.push_back(rectangle(-1 - k * 0.01, -1 - k * 0.01, 1 + k * 0.01, 1 + k * 0.01));
  Stepper stepper(colliders);
  stepper.gravity = {-30, 0};  // back to them: the step touches something, too
  stepper.at(0.1, 0.3);
  stepper.sweep().reserve({{-5, -5}, {5, 5}}, stepper.scratch);
  stepper.report.reserve(400);
  const std::size_t before = tests::allocations();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(stepper.report.move.contacts.empty());
  EXPECT_NEAR(stepper.state.position.x(), 3.99 + half_width, 1e-6);
}

TEST(StartInside, without_a_way_out_counts_the_steps_as_far_as_a_byte_goes) {
  Stepper stepper({rectangle(-2, -2, 2, 2), rectangle(-3, -3, -2.5, 3), rectangle(2.5, -3, 3, 3),
                   rectangle(-2.5, -3, 2.5, -2.5), rectangle(-2.5, 2.5, 2.5, 3)});
  stepper.at(0.5, 1);
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
  }
}

}  // namespace
}  // namespace paperproof::stepping
