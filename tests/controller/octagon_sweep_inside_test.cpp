/// Starts inside a solid under octagon_sweep: the shortest way out that can be reached, or stuck.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::stepping {
namespace {

constexpr double largest_gap = 1e-6;

/// Gravity and velocity are zero: whatever moves, it is the way out.
Stepper<double> inside(std::vector<ColliderDef> colliders, double x, double y) {
  Stepper<double> stepper(std::move(colliders));
  stepper.gravity = {0, 0};
  return std::move(stepper.at(x, y));
}

TEST(StartInside, goes_out_by_the_shortest_way) {
  struct Row {
    Vec2d from;
    Vec2d to;
  };
  // A box of 4 m by 3 m around the origin; out is where the octagon just touches it.
  const double x_out = 2 + half_width;
  const double y_out = 1.5 + half_height;
  for (const Row& row : {Row{{0.3, 1.4}, {0.3, y_out}}, Row{{-0.7, -1.2}, {-0.7, -y_out}},
                         Row{{1.8, 0.2}, {x_out, 0.2}}, Row{{-1.5, -0.1}, {-x_out, -0.1}},
                         Row{{0, std::nextafter(y_out, 0.0)}, {0, y_out}}, Row{{0, y_out - 0.005}, {0, y_out}}}) {
    Stepper<double> stepper = inside({rectangle(-2, -1.5, 2, 1.5)}, row.from.x(), row.from.y());
    EXPECT_EQ(stepper.step(), StepStatus::moved) << row.from.transpose();
    const Vec2d off = stepper.state.position - row.to;
    const Vec2d outward = row.to - row.from;
    EXPECT_GT(off.dot(outward), 0) << row.from.transpose() << ": out, not only to the edge";
    EXPECT_LE(off.cwiseAbs().maxCoeff(), largest_gap) << row.from.transpose();
    EXPECT_EQ(stepper.state.stuck_steps, 0);
  }
}

TEST(StartInside, goes_out_of_a_corner_over_the_bevel_of_the_octagon) {
  // Near the corner the arm's slanted side is the nearest facet of the octagon: from (10, -10) to (5, -20) px, along
  // (2, -1) / sqrt(5). Sunk by 1 cm along it into a box's upper left corner at the origin.
  const Vec2d n = Vec2d{2, -1} / std::sqrt(5.0);
  const Vec2d middle{7.5 * px, -15 * px};
  const Vec2d touching = -middle;
  const Vec2d from = touching + n * 0.01;
  Stepper<double> stepper = inside({rectangle(0, -3, 3, 0)}, from.x(), from.y());
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  const Vec2d off = stepper.state.position - touching;
  EXPECT_LE(off.norm(), largest_gap);
  EXPECT_LT(off.dot(n), 0);
}

TEST(StartInside, goes_out_to_the_side_of_the_last_free_position) {
  for (const bool came_from_the_left : {true, false}) {
    Stepper<double> stepper = inside({rectangle(-0.5, -50, 0.5, 50)}, 0.2, 0);
    if (came_from_the_left) {
      stepper.state.last_free = {-1, 0};
      stepper.state.has_last_free = true;
    }
    EXPECT_EQ(stepper.step(), StepStatus::moved);
    const double side = came_from_the_left ? -1 : 1;
    EXPECT_NEAR(stepper.state.position.x(), side * (0.5 + half_width), largest_gap) << came_from_the_left;
    EXPECT_GT(side * stepper.state.position.x(), 0.5 + half_width) << came_from_the_left;
  }
}

TEST(StartInside, of_one_solid_never_passes_another) {
  // Up would be nearest, but paper is there; down is further than right.
  const std::vector<ColliderDef> colliders{rectangle(-2, -1.5, 2, 1.5), chain({{-9, 2}, {9, 2}})};
  Stepper<double> stepper = inside(colliders, 1.1, 1.3);
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.x(), 2 + half_width, largest_gap);
  EXPECT_LT(stepper.state.position.y(), 2 - half_height);
  // Without the paper it is up.
  Stepper<double> alone = inside({colliders[0]}, 1.1, 1.3);
  alone.step();
  EXPECT_NEAR(alone.state.position.y(), 1.5 + half_height, largest_gap);
}

TEST(StartInside, of_tiles_passes_the_tiles_it_is_inside_of) {
  // Across the seam of two tiles: their common edge is no way out.
  std::vector<ColliderDef> tiles;
  for (int i = -3; i < 3; ++i) tiles.push_back(rectangle(i, -1, i + 1, 0));
  Stepper<double> stepper = inside(tiles, 0.05, 0.2);
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.x(), 0.05, largest_gap);
  EXPECT_NEAR(stepper.state.position.y(), half_height, largest_gap);
}

TEST(StartInside, of_tiles_does_not_pass_tiles_it_is_not_inside_of) {
  // Three deep in a field of them: every way out of its own two tiles leads into others.
  std::vector<ColliderDef> tiles;
  for (int i = -4; i < 4; ++i)
    for (int j = -8; j < 0; ++j) tiles.push_back(rectangle(i, j, i + 1, j + 1));
  Stepper<double> stepper = inside(tiles, 0.5, -4);
  EXPECT_EQ(stepper.step(), StepStatus::stuck);
  EXPECT_EQ(stepper.state.position, Vec2d(0.5, -4));
}

TEST(StartInside, goes_to_the_side_of_the_last_free_position_although_another_is_nearer) {
  // Nearest is down. The last free position, above to the right, sees past the block's upper right corner.
  Stepper<double> stepper = inside({rectangle(-2, -1, 2, 1)}, 1.5, -0.9);
  stepper.state.last_free = {4, 2};
  stepper.state.has_last_free = true;
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.x(), 2 + half_width, largest_gap);
  EXPECT_NEAR(stepper.state.position.y(), -0.9, largest_gap);
  // From the left nothing but the left is seen, and what is above or below the block.
  stepper = inside({rectangle(-2, -50, 2, 50)}, 1.5, -0.9);
  stepper.state.last_free = {-4, 2};
  stepper.state.has_last_free = true;
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.x(), -2 - half_width, largest_gap);
}

TEST(StartInside, of_hundreds_of_solids_at_once_leaves_them_all_without_allocating) {
  // Blocks around one place, each a little larger than the last, and a crate above.
  std::vector<ColliderDef> colliders;
  constexpr int blocks = 300;
  for (int k = 0; k < blocks; ++k) {
    const double r = 1 + k * 0.01;
    colliders.push_back(rectangle(-r, -r, r, r));
  }
  colliders.push_back(rectangle(-8, 4.5, 8, 5));
  Stepper<double> stepper = inside(colliders, 0.1, 0.3);
  const std::size_t before = tests::allocations();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  const double side = 1 + (blocks - 1) * 0.01;
  EXPECT_NEAR(stepper.state.position.x(), side + half_width, largest_gap);
  EXPECT_NEAR(stepper.state.position.y(), 0.3, largest_gap);
}

TEST(StartInside, deep_in_a_large_solid_goes_out_however_far_that_is) {
  Stepper<double> stepper = inside({rectangle(-100, -100, 100, 100)}, 1, 2);
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.y(), 100 + half_height, largest_gap);
  EXPECT_EQ(stepper.state.position.x(), 1);
}

TEST(StartInside, with_no_way_out_is_reported_and_moves_nothing) {
  // In a block that the four around it leave no room beside.
  std::vector<ColliderDef> colliders{rectangle(-2, -2, 2, 2), rectangle(-3, -3, -2.5, 3), rectangle(2.5, -3, 3, 3),
                                     rectangle(-2.5, -3, 2.5, -2.5), rectangle(-2.5, 2.5, 2.5, 3)};
  Stepper<double> stepper = inside(colliders, 0.5, 1);
  stepper.gravity = {0, -10};
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
    ASSERT_FALSE(stepper.state.grounded);
  }
  EXPECT_EQ(stepper.state.position, Vec2d(0.5, 1));
  EXPECT_EQ(stepper.state.velocity, Vec2d(0, 0)) << "nothing grows while stuck";
}

TEST(StartInside, ends_within_64_steps_wherever_a_way_out_is_near) {
  // Every place of a lattice over a hollow room, its walls, and what stands in it.
  std::vector<ColliderDef> colliders{rectangle(-4, -4, 4, -3), rectangle(-4, 3, 4, 4), rectangle(-4, -3, -3, 3),
                                     rectangle(3, -3, 4, 3), polygon({{-1, -3}, {1, -3}, {0, -1}})};
  colliders.push_back(chain({{-3, 1}, {-1, 1}}));
  int began_inside = 0;
  for (int i = -14; i <= 14; ++i)
    for (int j = -14; j <= 14; ++j) {
      Stepper<double> stepper = inside(colliders, i * 0.25 + 0.01, j * 0.25 + 0.02);
      const Vec2d from = stepper.state.position;
      int steps = 1;
      while (stepper.step() == StepStatus::stuck && steps < 64) ++steps;
      ASSERT_LT(steps, 64) << "from " << from.transpose();
      began_inside += stepper.state.position != from;
      const Vec2d out = stepper.state.position;
      // Once out it stays: nothing is left to be resolved.
      ASSERT_EQ(stepper.step(), StepStatus::moved);
      ASSERT_EQ(stepper.state.position, out) << "from " << from.transpose();
    }
  EXPECT_GT(began_inside, 29 * 29 * 3 / 10);
  EXPECT_LT(began_inside, 29 * 29 * 7 / 10);
}

}  // namespace
}  // namespace paperproof::stepping
