/// What is overlapped and passed, how deep, and how far away it is.
#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

/// Concave rings, and triangles on a grid where much only touches.
TEST(ExactOverlap, agrees_with_the_area_left_by_clipping) {
  Random random(20);
  constexpr int rounds = 2000;
  for (const bool on_grid : {false, true}) {
    int overlaps = 0;
    int touches = 0;
    for (int i = 0; i < rounds; ++i) {
      const Vec2d centre = random.point(1);
      std::vector<Vec2d> ring = star(random, centre, 1.2, 3 + random.below(9));
      if (on_grid) ring = {random.grid_point(6), random.grid_point(6), random.grid_point(6)};
      if (cross(exact(ring[0]), exact(ring[1]), exact(ring[2])) == 0) continue;
      const Vec2d position = on_grid ? random.grid_point(8) : random.point(1.2);
      const ExactScenery there = world({polygon(ring)});
      const bool expected = area_within(ring, octagon_at(exact(position))) > 0;
      ASSERT_EQ(!there.overlapped(position).empty(), expected) << "round " << i;
      overlaps += expected;
      touches += !expected && there.separation(position, 0) == 0;
    }
    EXPECT_NEAR(overlaps, 0.6 * rounds, 0.3 * rounds);
    EXPECT_EQ(touches > rounds / 100, on_grid);
  }
}

TEST(ExactOverlap, is_right_within_an_ulp_of_touching_where_the_filter_gives_up) {
  Random random(26);
  int overlaps = 0;
  int rounds = 0;
  std::uint64_t exact_decisions = 0;
  constexpr int impacts = 800;
  for (int i = 0; i < impacts; ++i) {
    const double scale = i % 2 == 0 ? 1 : 1e6;
    const Vec2d origin = random.point(scale);
    const std::vector<Vec2d> triangle{origin + random.point(1), origin + random.point(1), origin + random.point(1)};
    const ExactScenery there = world({polygon(triangle)});
    const Vec2d from = origin + 3 * random.point(1);
    const Vec2d way = 2 * (origin - from);
    const std::optional<ExactImpact> impact = there.first_impact(from, way);
    if (!impact) continue;
    const Vec2d touch = from + static_cast<double>(impact->fraction) * way;
    for (int k = -2; k <= 2; ++k) {
      const Vec2d near(touch.x(), touch.y() + k * (one_ulp_up(std::abs(touch.y())) - std::abs(touch.y())));
      const bool expected = area_within(triangle, octagon_at(exact(near))) > 0;
      ASSERT_EQ(there.overlaps(near, 0), expected) << "round " << i << " ulps " << k;
      ASSERT_EQ(there.penetration(near, 0) > 0, expected) << "round " << i << " ulps " << k;
      overlaps += expected;
      ++rounds;
    }
    exact_decisions += there.rational_decisions();
  }
  EXPECT_NEAR(overlaps, 0.5 * rounds, 0.2 * rounds);
  EXPECT_GT(exact_decisions, static_cast<std::uint64_t>(impacts / 8))
      << "otherwise this says nothing about the exact path";
}

TEST(ExactPassage, a_one_way_polygon_blocks_as_the_lines_that_face_one_way_and_is_never_overlapped) {
  const std::vector<Vec2d> bowl{{-4, -1}, {4, -1}, {4, 2}, {3, 2.5}, {2, 0}, {-2, 0}, {-3, 2}, {-4, 2}};
  const std::vector<Vec2d> clockwise(bowl.rbegin(), bowl.rend());
  // The right rim slopes, and so do the sides inside: all of those face up, from the right to the left.
  const ExactScenery lines = world({one_way(chain({{4, 2}, {3, 2.5}, {2, 0}, {-2, 0}, {-3, 2}, {-4, 2}}))});
  const ExactScenery solids = world({one_way(polygon(bowl)), one_way(polygon(clockwise))});
  int met = 0;
  int count = 0;
  for (double x = -6; x <= 6; x += 0.5)
    for (double y = -4; y <= 4; y += 0.5) {
      EXPECT_EQ(solids.overlapped({x, y}), Colliders{});
      for (const Vec2d& way : {Vec2d{0, -5}, Vec2d{0, 5}, Vec2d{4, 0}, Vec2d{-4, -1}, Vec2d{3, -3}}) {
        const Place to(Vec2d(Vec2d(x, y) + way));
        const bool expected = lines.meets({x, y}, to, 0);
        for (const ColliderIndex winding : {0U, 1U})
          EXPECT_EQ(solids.meets({x, y}, to, winding), expected) << x << " " << y << " by " << way.transpose();
        met += expected;
        ++count;
      }
    }
  EXPECT_NEAR(met, 0.5 * count, 0.4 * count);
}

TEST(ExactDepth, leaving_by_it_along_the_normal_of_an_overlap_frees) {
  Random random(25);
  int overlaps = 0;
  constexpr int rounds = 1000;
  for (int i = 0; i < rounds; ++i) {
    const std::vector<Vec2d> triangle{random.point(1), random.point(1), random.point(1)};
    const ExactScenery there = world({polygon(triangle)});
    const Vec2d position = random.point(1);
    const double depth = there.penetration(position, 0);
    const bool overlap = area_within(triangle, octagon_at(exact(position))) > 0;
    ASSERT_EQ(depth > 0, overlap) << "round " << i;
    if (!overlap) continue;
    ++overlaps;
    const ExactImpact out = there.time_of_impact(position, {1, 0}, 0).value();
    EXPECT_EQ(out.fraction, 0);
    EXPECT_FALSE(there.overlaps(position + (depth + 1e-12) * out.normal, 0)) << "round " << i;
    for (int k = 0; k < 32; ++k)
      EXPECT_TRUE(there.overlaps(position + (depth - 1e-12) * towards(k * std::numbers::pi / 16), 0))
          << "a shorter way out: round " << i;
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
}

TEST(ExactDepth, of_many_parts_is_that_of_the_nearest_or_deepest_segment) {
  Random random(27);
  int outside = 0;
  constexpr int rounds = 400;
  for (int i = 0; i < rounds; ++i) {
    std::vector<Vec2d> points{random.point(3)};
    std::vector<ColliderDef> segments;
    for (int k = 1; k < 12; ++k) {
      points.push_back(random.point(3));
      segments.push_back(chain({points[points.size() - 2], points.back()}));
    }
    const ExactScenery parts = world(segments);
    const Vec2d position = random.point(5);
    double nearest = std::numeric_limits<double>::infinity();
    for (ColliderIndex k = 0; k < segments.size(); ++k) nearest = std::min(nearest, parts.separation(position, k));
    ASSERT_EQ(world({chain(points)}).separation(position, 0), nearest) << "round " << i;
    outside += nearest > 0;
  }
  EXPECT_NEAR(outside, 0.6 * rounds, 0.3 * rounds);
}

TEST(ExactScenery, near_finds_the_boxes_within_reach) {
  const ExactScenery there = world({box(-4, -1, 4, 0), box(10, 0, 11, 1)});
  EXPECT_EQ(there.near({0, 1}, {0, 1}, 0.375), Colliders{0});
  EXPECT_EQ(there.near({0, 1}, {0, 1}, 0.37), Colliders{});
  EXPECT_EQ(there.near({0, 1}, {9, 1}, 1), (Colliders{0, 1}));
}

}  // namespace
}  // namespace paperproof::compare::test
