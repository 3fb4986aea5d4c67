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

TEST(ExactOverlap, a_chain_of_zero_thickness_is_overlapped_and_a_one_way_chain_never) {
  const ExactScenery there = world({chain({{-1, 0}, {1, 0}}), one_way(chain({{-1, 0}, {1, 0}}))});
  EXPECT_EQ(there.overlapped({0, 0.25}), Colliders{0});
  EXPECT_EQ(there.overlapped({0, 0.625}), Colliders{});
  EXPECT_EQ(there.overlapped({0, one_ulp_down(0.625)}), Colliders{0});
}

TEST(ExactOverlap, inside_a_hole_is_free_and_deep_inside_a_polygon_is_not) {
  ColliderDef frame = box(-10, -10, 10, 10);
  frame.holes = {square(1)};
  const ExactScenery there = world({frame});
  for (const Vec2d& free : {Vec2d(0, 0), Vec2d(0.6875, 0.375), Vec2d(11, 0)})
    EXPECT_EQ(there.overlapped(free), Colliders{}) << free.transpose();
  for (const Vec2d& inside : {Vec2d(one_ulp_up(0.6875), 0.375), Vec2d(5, 5)})
    EXPECT_EQ(there.overlapped(inside), Colliders{0}) << inside.transpose();
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

TEST(ExactPassage, paper_of_any_thickness_is_met_when_both_ends_are_free) {
  for (const double thickness : {0.1, 1e-3, 1e-9, 5e-324, 0.0}) {
    const ExactScenery there = world({thickness > 0 ? box(-4, 0, 4, thickness) : chain({{-4, 0}, {4, 0}})});
    EXPECT_EQ(there.met({0, 50}, {0, -50}), Colliders{0}) << thickness;
    EXPECT_EQ(there.met({0, -1e6}, {0.5, 1e6}), Colliders{0}) << thickness;
    EXPECT_EQ(there.met({0, 50}, {0, 1}), Colliders{});
    const double above = one_ulp_up(0.625 + thickness);
    EXPECT_EQ(there.met({-50, above}, {50, above}), Colliders{}) << "sliding along is free";
    EXPECT_EQ(there.met({4.3125, 50}, {4.3125, -50}), Colliders{}) << "sliding past the end is free";
    EXPECT_EQ(there.met({one_ulp_down(4.3125), 50}, {one_ulp_down(4.3125), -50}), Colliders{0});
  }
}

TEST(ExactPassage, a_one_way_segment_blocks_only_from_its_side_and_against_its_normal) {
  const ExactScenery there = world({one_way(chain({{-4, 0}, {4, 0}}))});
  EXPECT_EQ(there.met({0, 1}, {0, -1}), Colliders{0});
  EXPECT_EQ(there.met({0, 0.625}, {0, 0.5}), Colliders{0}) << "touching counts as on its side";
  EXPECT_EQ(there.met({0, one_ulp_down(0.625)}, {0, -1}), Colliders{}) << "a part was below when the leg began";
  EXPECT_EQ(there.met({0, -1}, {0, 1}), Colliders{});
  EXPECT_EQ(there.met({0, 1}, {9, 1}), Colliders{});
  EXPECT_EQ(world({one_way(chain({{0, -4}, {0, 4}}))}).met({-1, 0}, {1, 0}), Colliders{}) << "along one_way: nothing";
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

TEST(ExactDepth, is_the_shortest_way_out_of_a_convex_polygon) {
  const ExactScenery block = world({box(-4, -1, 4, 0), chain({{-4, 9}, {4, 9}})});
  EXPECT_EQ(block.penetration({0, 0.625}, 0), 0);
  EXPECT_EQ(block.penetration({0, 0.5}, 0), 0.125);
  EXPECT_EQ(block.penetration({4.25, 0}, 0), 0.0625);
  EXPECT_EQ(block.separation({0, 0.75}, 0), 0.125);
  EXPECT_EQ(block.separation({0, one_ulp_down(0.625)}, 0), one_ulp_down(0.625) - 0.625);
  EXPECT_EQ(block.penetration({0, 8.5}, 1), 0.125);
  EXPECT_EQ(block.penetration({0, 9}, 1), 0.625);
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

TEST(ExactDepth, is_exact_where_products_underflow) {
  // All lengths times 2^-540: products of two fall below the smallest double.
  constexpr double scale = 0x1p-540;
  std::vector<Vec2d> small = octagon();
  for (Vec2d& point : small) point *= scale;
  const ExactScenery there = world({box(-4 * scale, -scale, 4 * scale, 0)}, small);
  EXPECT_EQ(there.overlapped({0, 0.625 * scale}), Colliders{});
  EXPECT_EQ(there.overlapped({0, one_ulp_down(0.625 * scale)}), Colliders{0});
  EXPECT_GT(there.rational_decisions(), 0U);
  EXPECT_EQ(there.first_impact({0, scale}, {0, -scale}).value().fraction, 0.375);
}

TEST(ExactScenery, near_finds_the_boxes_within_reach) {
  const ExactScenery there = world({box(-4, -1, 4, 0), box(10, 0, 11, 1)});
  EXPECT_EQ(there.near({0, 1}, {0, 1}, 0.375), Colliders{0});
  EXPECT_EQ(there.near({0, 1}, {0, 1}, 0.37), Colliders{});
  EXPECT_EQ(there.near({0, 1}, {9, 1}, 1), (Colliders{0, 1}));
}

TEST(ExactScenery, pixel_positions_need_no_exact_arithmetic) {
  const ExactScenery there = world({box(0, -1, 1, 0), box(1, -1, 2, 0), box(2, -1, 3, 0)});
  for (int i = 0; i < 64; ++i) EXPECT_EQ(there.overlapped({i / 32.0, 0.625}), Colliders{});
  EXPECT_EQ(there.rational_decisions(), 0U);
}

}  // namespace
}  // namespace paperproof::compare::test
