/// Starts inside a solid under octagon_sweep: by where it was free last, how long it is stuck, without allocating.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

constexpr double largest_gap = 1e-6;

TEST(StartInside, goes_out_to_the_side_of_the_last_free_position) {
  struct Row {
    const char* words;
    ColliderDef block;
    Vec2d from;
    Vec2d last_free;
    double out;
  };
  for (const Row& row :
       {Row{"the farther side", rectangle(-0.5, -50, 0.5, 50), {0.2, 0}, {-1, 0}, -0.5 - half_width},
        Row{"past its upper right corner, not down", rectangle(-2, -1, 2, 1), {1.5, -0.9}, {4, 2}, 2 + half_width},
        Row{"nothing but the left is seen", rectangle(-2, -50, 2, 50), {1.5, -0.9}, {-4, 2}, -2 - half_width}}) {
    Stepper<double> stepper({row.block});
    stepper.gravity = {0, 0};
    stepper.at(row.from.x(), row.from.y());
    stepper.state.last_free = row.last_free;
    stepper.state.has_last_free = true;
    EXPECT_EQ(stepper.step(), StepStatus::moved) << row.words;
    EXPECT_NEAR(stepper.state.position.x(), row.out, largest_gap) << row.words;
    EXPECT_GT(std::abs(stepper.state.position.x()), std::abs(row.out)) << row.words;
    EXPECT_NEAR(stepper.state.position.y(), row.from.y(), largest_gap) << row.words;
  }
}

TEST(StartInside, of_hundreds_of_solids_at_once_does_not_allocate) {
  std::vector<ColliderDef> colliders;
  for (int k = 0; k < 300; ++k)
    colliders.push_back(rectangle(-1 - k * 0.01, -1 - k * 0.01, 1 + k * 0.01, 1 + k * 0.01));
  Stepper<double> stepper(colliders);
  stepper.gravity = {0, 0};
  stepper.at(0.1, 0.3);
  const std::size_t before = tests::allocations();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_NEAR(stepper.state.position.x(), 3.99 + half_width, largest_gap);
}

TEST(StartInside, without_a_way_out_counts_the_steps_as_far_as_a_byte_goes) {
  Stepper<double> stepper({rectangle(-2, -2, 2, 2), rectangle(-3, -3, -2.5, 3), rectangle(2.5, -3, 3, 3),
                           rectangle(-2.5, -3, 2.5, -2.5), rectangle(-2.5, 2.5, 2.5, 3)});
  stepper.at(0.5, 1);
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
  }
}

}  // namespace
}  // namespace paperproof::stepping
