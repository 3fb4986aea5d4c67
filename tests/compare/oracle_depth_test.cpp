#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

TEST(ExactDepth, is_the_shortest_way_out_of_a_convex_polygon) {
  const ExactScenery world(scenery({box(-4, -1, 4, 0)}), octagon());
  EXPECT_EQ(world.penetration({0, 0.625}, 0), 0);
  EXPECT_EQ(world.penetration({0, 0.5}, 0), 0.125);
  EXPECT_EQ(world.penetration({4.25, 0}, 0), 0.0625);
  EXPECT_EQ(world.separation({0, 0.75}, 0), 0.125);
  EXPECT_EQ(world.separation({0, one_ulp_down(0.625)}, 0), one_ulp_down(0.625) - 0.625);
  const ExactScenery thread(scenery({chain({{-4, 0}, {4, 0}})}), octagon());
  EXPECT_EQ(thread.penetration({0, -0.5}, 0), 0.125);
  EXPECT_EQ(thread.penetration({0, 0}, 0), 0.625);
}

TEST(ExactDepth, leaving_by_it_along_the_normal_of_an_overlap_frees) {
  constexpr std::uint64_t seed = 25;
  Random random(seed);
  int overlaps = 0;
  constexpr int rounds = paperproof::test::sampled(1000);
  for (int i = 0; i < rounds; ++i) {
    std::vector<Vec2d> triangle{random.point(1), random.point(1), random.point(1)};
    const ExactScenery world(scenery({polygon(triangle)}), octagon());
    const Vec2d position = random.point(1);
    const double depth = world.penetration(position, 0);
    const bool overlap = in_minkowski_difference(triangle, octagon(), position);
    ASSERT_EQ(depth > 0, overlap) << "seed " << seed << " round " << i;
    if (!overlap) continue;
    ++overlaps;
    const std::optional<ExactImpact> out = world.time_of_impact(position, {1, 0}, 0);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->fraction, 0);
    EXPECT_FALSE(world.overlaps(position + (depth + 1e-12) * out->normal, 0)) << "seed " << seed << " round " << i;
    for (int k = 0; k < 32; ++k) {
      const double angle = k * 3.14159265358979 / 16;
      const Vec2d way = (depth - 1e-12) * Vec2d(std::cos(angle), std::sin(angle));
      EXPECT_TRUE(world.overlaps(position + way, 0)) << "a shorter way out: seed " << seed << " round " << i;
    }
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
}

TEST(ExactDepth, of_many_parts_is_that_of_the_nearest_or_deepest_segment) {
  constexpr std::uint64_t seed = 27;
  Random random(seed);
  int outside = 0;
  constexpr int rounds = 400;
  for (int i = 0; i < rounds; ++i) {
    std::vector<Vec2d> points;
    for (int k = 0; k < 12; ++k) points.push_back(random.point(3));
    std::vector<ColliderDef> segments;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) segments.push_back(chain({points[k], points[k + 1]}));
    const ExactScenery whole(scenery({chain(points)}), octagon());
    const ExactScenery parts(scenery(segments), octagon());
    const Vec2d position = random.point(5);
    double nearest = std::numeric_limits<double>::infinity();
    for (ColliderIndex k = 0; k < segments.size(); ++k) nearest = std::min(nearest, parts.separation(position, k));
    ASSERT_EQ(whole.separation(position, 0), nearest) << "seed " << seed << " round " << i;
    outside += nearest > 0;
  }
  EXPECT_GT(outside, rounds * 3 / 10);
  EXPECT_LT(outside, rounds * 9 / 10);
}

TEST(ExactDepth, is_exact_where_products_underflow) {
  // All lengths times 2^-540: products of two fall below the smallest double.
  constexpr double scale = 0x1p-540;
  std::vector<Vec2d> small = octagon();
  for (Vec2d& point : small) point *= scale;
  const ExactScenery world(scenery({box(-4 * scale, -scale, 4 * scale, 0)}), small);
  EXPECT_TRUE(world.overlapped({0, 0.625 * scale}).empty());
  EXPECT_FALSE(world.overlapped({0, one_ulp_down(0.625 * scale)}).empty());
  EXPECT_GT(world.rational_decisions(), 0U);
  const std::optional<ExactImpact> impact = world.first_impact({0, scale}, {0, -scale});
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, Exact(3, 8));
}

TEST(ExactScenery, near_finds_the_boxes_within_reach) {
  const ExactScenery world(scenery({box(-4, -1, 4, 0), box(10, 0, 11, 1)}), octagon());
  EXPECT_EQ(world.near({0, 1}, {0, 1}, 0.375), std::vector<ColliderIndex>{0});
  EXPECT_TRUE(world.near({0, 1}, {0, 1}, 0.37).empty());
  EXPECT_EQ(world.near({0, 1}, {9, 1}, 1), (std::vector<ColliderIndex>{0, 1}));
}

TEST(ExactScenery, pixel_positions_need_no_exact_arithmetic) {
  const ExactScenery world(scenery({box(0, -1, 1, 0), box(1, -1, 2, 0), box(2, -1, 3, 0)}), octagon());
  for (int i = 0; i < 64; ++i) EXPECT_TRUE(world.overlapped({i / 32.0, 0.625}).empty());
  EXPECT_EQ(world.rational_decisions(), 0U);
}
}  // namespace
}  // namespace paperproof::compare
