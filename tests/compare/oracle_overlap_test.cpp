#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

Exact area_inside(const std::vector<Vec2d>& ring, const std::vector<Vec2d>& points, const Vec2d& position) {
  std::vector<ExactPoint> clip;
  for (const Vec2d& o : points) clip.push_back(exact(position) + exact(o));
  return area_within(ring, clip);
}

TEST(ExactOverlap, touching_is_not_overlapping_and_one_ulp_more_is) {
  const ExactScenery world(scenery({box(-4, -1, 4, 0), box(1, 0, 2, 5)}), octagon());
  EXPECT_TRUE(world.overlapped({0, 0.625}).empty());
  EXPECT_EQ(world.overlapped({0, one_ulp_down(0.625)}), std::vector<ColliderIndex>{0});
  EXPECT_TRUE(world.overlapped({0, one_ulp_up(0.625)}).empty());
  EXPECT_TRUE(world.overlapped({0.6875, 0.625}).empty());
  EXPECT_EQ(world.overlapped({one_ulp_up(0.6875), 0.625}), std::vector<ColliderIndex>{1});
}

TEST(ExactOverlap, agrees_with_the_area_left_by_clipping_concave_rings) {
  constexpr std::uint64_t seed = 20;
  Random random(seed);
  int overlaps = 0;
  constexpr int rounds = paperproof::test::sampled(2000);
  for (int i = 0; i < rounds; ++i) {
    const Vec2d centre = random.point(1);
    const std::vector<Vec2d> ring = star(random, centre, 1.2, 3 + random.below(9));
    const Vec2d position = random.point(1.2);
    const ExactScenery world(scenery({polygon(ring)}), octagon());
    const bool expected = area_inside(ring, octagon(), position) > 0;
    ASSERT_EQ(!world.overlapped(position).empty(), expected) << "seed " << seed << " round " << i;
    overlaps += expected;
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
  EXPECT_LT(overlaps, rounds * 9 / 10);
}

TEST(ExactOverlap, agrees_with_the_hull_of_differences_on_a_grid_where_much_only_touches) {
  constexpr std::uint64_t seed = 21;
  Random random(seed);
  int overlaps = 0;
  int touches = 0;
  constexpr int rounds = paperproof::test::sampled(2000);
  for (int i = 0; i < rounds; ++i) {
    std::vector<Vec2d> triangle{random.grid_point(6), random.grid_point(6), random.grid_point(6)};
    if (cross(exact(triangle[0]), exact(triangle[1]), exact(triangle[2])) == 0) continue;
    const Vec2d position = random.grid_point(8);
    const ExactScenery world(scenery({polygon(triangle)}), octagon());
    const bool expected = in_minkowski_difference(triangle, octagon(), position);
    ASSERT_EQ(!world.overlapped(position).empty(), expected) << "seed " << seed << " round " << i;
    overlaps += expected;
    touches += !expected && std::abs(world.separation(position, 0)) == 0;
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
  EXPECT_LT(overlaps, rounds * 9 / 10);
  EXPECT_GT(touches, rounds / 100);
}

TEST(ExactOverlap, a_chain_of_zero_thickness_is_overlapped_and_a_one_way_chain_never) {
  const ExactScenery world(scenery({chain({{-1, 0}, {1, 0}}), chain({{-1, 0}, {1, 0}}, Vec2d(0, 1))}), octagon());
  EXPECT_EQ(world.overlapped({0, 0.25}), std::vector<ColliderIndex>{0});
  EXPECT_TRUE(world.overlapped({0, 0.625}).empty());
  EXPECT_EQ(world.overlapped({0, one_ulp_down(0.625)}), std::vector<ColliderIndex>{0});
}

TEST(ExactOverlap, inside_a_hole_is_free_and_deep_inside_a_polygon_is_not) {
  ColliderDef frame = box(-10, -10, 10, 10);
  frame.holes = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const ExactScenery world(scenery({frame}), octagon());
  EXPECT_TRUE(world.overlapped({0, 0}).empty());
  EXPECT_TRUE(world.overlapped({0.6875, 0.375}).empty());
  EXPECT_FALSE(world.overlapped({one_ulp_up(0.6875), 0.375}).empty());
  EXPECT_FALSE(world.overlapped({5, 5}).empty());
  EXPECT_TRUE(world.overlapped({11, 0}).empty());
}

TEST(ExactOverlap, is_as_sharp_a_million_metres_away) {
  for (const double origin : {0.0, 1e3, 1e6, -1e6}) {
    const ExactScenery world(scenery({box(origin - 4, -1, origin + 4, 0)}), octagon());
    EXPECT_TRUE(world.overlapped({origin, 0.625}).empty());
    EXPECT_FALSE(world.overlapped({origin, one_ulp_down(0.625)}).empty());
    EXPECT_TRUE(world.overlapped({origin + 4.3125, 0.5}).empty());
    EXPECT_FALSE(world.overlapped({one_ulp_down(origin + 4.3125), 0.25}).empty());
  }
}

TEST(ExactOverlap, does_not_change_when_everything_moves_by_a_power_of_two) {
  constexpr std::uint64_t seed = 22;
  Random random(seed);
  int overlaps = 0;
  constexpr int rounds = 1000;
  for (int i = 0; i < rounds; ++i) {
    // Multiples of 2^-20 stay exact when 2^20 is added.
    const auto snapped = [](const Vec2d& v) {
      return Vec2d(std::round(v.x() * 0x1p20) * 0x1p-20, std::round(v.y() * 0x1p20) * 0x1p-20);
    };
    std::vector<Vec2d> ring;
    for (const Vec2d& v : star(random, random.point(1), 1.2, 7)) ring.push_back(snapped(v));
    const Vec2d position = snapped(random.point(1.2));
    const Vec2d shift(0x1p20, -0x1p20);
    std::vector<Vec2d> shifted;
    for (const Vec2d& v : ring) shifted.push_back(v + shift);
    const bool here = ExactScenery(scenery({polygon(ring)}), octagon()).overlaps(position, 0);
    ASSERT_EQ(ExactScenery(scenery({polygon(shifted)}), octagon()).overlaps(position + shift, 0), here)
        << "seed " << seed << " round " << i;
    overlaps += here;
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
  EXPECT_LT(overlaps, rounds * 9 / 10);
}

TEST(ExactOverlap, is_right_within_an_ulp_of_touching_where_the_filter_gives_up) {
  constexpr std::uint64_t seed = 26;
  Random random(seed);
  int overlaps = 0;
  int rounds = 0;
  std::uint64_t exact_decisions = 0;
  constexpr int impacts = paperproof::test::sampled(800);
  for (int i = 0; i < impacts; ++i) {
    const double scale = i % 2 == 0 ? 1 : 1e6;
    const Vec2d origin = random.point(scale);
    const std::vector<Vec2d> triangle{origin + random.point(1), origin + random.point(1), origin + random.point(1)};
    const ExactScenery world(scenery({polygon(triangle)}), octagon());
    const Vec2d from = origin + 3 * random.point(1);
    const Vec2d way = 2 * (origin - from);
    const std::optional<ExactImpact> impact = world.first_impact(from, way);
    if (!impact) continue;
    Vec2d touch = from + static_cast<double>(impact->fraction) * way;
    for (int k = -2; k <= 2; ++k) {
      const Vec2d near(touch.x(), touch.y() + k * (one_ulp_up(std::abs(touch.y())) - std::abs(touch.y())));
      const bool expected = in_minkowski_difference(triangle, octagon(), near);
      ASSERT_EQ(world.overlaps(near, 0), expected) << "seed " << seed << " round " << i << " ulps " << k;
      ASSERT_EQ(world.penetration(near, 0) > 0, expected) << "seed " << seed << " round " << i << " ulps " << k;
      overlaps += expected;
      ++rounds;
    }
    exact_decisions += world.rational_decisions();
  }
  EXPECT_GT(overlaps, rounds * 3 / 10);
  EXPECT_LT(overlaps, rounds * 7 / 10);
  EXPECT_GT(exact_decisions, static_cast<std::uint64_t>(impacts / 8))
      << "otherwise this says nothing about the exact path";
}

TEST(ExactPassage, paper_of_any_thickness_is_met_when_both_ends_are_free) {
  for (const double thickness : {0.1, 1e-3, 1e-9, 5e-324, 0.0}) {
    const ColliderDef paper = thickness > 0 ? box(-4, 0, 4, thickness) : chain({{-4, 0}, {4, 0}});
    const ExactScenery world(scenery({paper}), octagon());
    EXPECT_EQ(world.met({0, 50}, {0, -50}), std::vector<ColliderIndex>{0}) << thickness;
    EXPECT_EQ(world.met({0, -1e6}, {0.5, 1e6}), std::vector<ColliderIndex>{0}) << thickness;
    EXPECT_TRUE(world.met({0, 50}, {0, 1}).empty());
    EXPECT_TRUE(world.met({-50, one_ulp_up(0.625 + thickness)}, {50, one_ulp_up(0.625 + thickness)}).empty())
        << "sliding along is free";
    EXPECT_TRUE(world.met({4.3125, 50}, {4.3125, -50}).empty()) << "sliding past the end is free";
    EXPECT_FALSE(world.met({one_ulp_down(4.3125), 50}, {one_ulp_down(4.3125), -50}).empty());
  }
}

TEST(ExactPassage, agrees_with_dense_sampling_of_overlap) {
  constexpr std::uint64_t seed = 23;
  Random random(seed);
  int met = 0;
  constexpr int rounds = 600;
  for (int i = 0; i < rounds; ++i) {
    const ExactScenery world(scenery({polygon(star(random, random.point(1), 0.8, 5))}), octagon());
    const Vec2d from = random.point(2);
    const Vec2d to = random.point(2);
    bool sampled = false;
    constexpr int samples = 200;
    for (int k = 0; k <= samples; ++k) {
      const double t = k / static_cast<double>(samples);
      sampled = sampled || world.overlaps(from + t * (to - from), 0);
    }
    const bool answer = world.meets(from, to, 0);
    // A sample may lie beside the exact way by rounding, and a short meeting may fall between two samples; both are
    // shallow: 0.02 m of motion between samples.
    if (sampled != answer) {
      double deepest = 0;
      for (int k = 0; k <= samples * 100; ++k) {
        deepest = std::max(deepest, world.penetration(from + k / (samples * 100.0) * (to - from), 0));
      }
      EXPECT_LT(deepest, 0.02) << "seed " << seed << " round " << i;
      EXPECT_TRUE(answer) << "seed " << seed << " round " << i;
    }
    met += answer;
  }
  EXPECT_GT(met, rounds * 3 / 10);
  EXPECT_LT(met, rounds * 9 / 10);
}

TEST(ExactPassage, a_one_way_segment_blocks_only_from_its_side_and_against_its_normal) {
  const ExactScenery world(scenery({chain({{-4, 0}, {4, 0}}, Vec2d(0, 1))}), octagon());
  EXPECT_EQ(world.met({0, 1}, {0, -1}), std::vector<ColliderIndex>{0});
  EXPECT_EQ(world.met({0, 0.625}, {0, 0.5}), std::vector<ColliderIndex>{0}) << "touching counts as on its side";
  EXPECT_TRUE(world.met({0, one_ulp_down(0.625)}, {0, -1}).empty()) << "a part was below when the leg began";
  EXPECT_TRUE(world.met({0, -1}, {0, 1}).empty());
  EXPECT_TRUE(world.met({0, 1}, {9, 1}).empty());
  const ExactScenery along(scenery({chain({{0, -4}, {0, 4}}, Vec2d(0, 1))}), octagon());
  EXPECT_TRUE(along.met({-1, 0}, {1, 0}).empty()) << "a segment along one_way blocks nothing";
}

TEST(ExactPassage, a_one_way_polygon_blocks_as_the_lines_that_face_one_way_and_is_never_overlapped) {
  const std::vector<Vec2d> bowl{{-4, -1}, {4, -1}, {4, 2}, {3, 2.5}, {2, 0}, {-2, 0}, {-3, 2}, {-4, 2}};
  std::vector<Vec2d> clockwise = bowl;
  std::reverse(clockwise.begin(), clockwise.end());
  // The right rim slopes, and so do the sides inside: all of those face up, from the right to the left.
  const ExactScenery lines(scenery({chain({{4, 2}, {3, 2.5}, {2, 0}, {-2, 0}, {-3, 2}, {-4, 2}}, Vec2d(0, 1))}),
                           octagon());
  const ExactScenery there(scenery({{.points = bowl, .one_way = Vec2d(0, 1)}}), octagon());
  const ExactScenery back(scenery({{.points = clockwise, .one_way = Vec2d(0, 1)}}), octagon());
  int met = 0;
  int count = 0;
  for (double x = -6; x <= 6; x += 0.5)
    for (double y = -4; y <= 4; y += 0.5) {
      EXPECT_TRUE(there.overlapped({x, y}).empty());
      for (const Vec2d& way : {Vec2d{0, -5}, Vec2d{0, 5}, Vec2d{4, 0}, Vec2d{-4, -1}, Vec2d{3, -3}}) {
        const Place to(Vec2d(Vec2d(x, y) + way));
        const bool expected = lines.meets({x, y}, to, 0);
        EXPECT_EQ(there.meets({x, y}, to, 0), expected) << x << " " << y << " by " << way.transpose();
        EXPECT_EQ(back.meets({x, y}, to, 0), expected) << x << " " << y << " by " << way.transpose();
        met += expected;
        ++count;
      }
    }
  EXPECT_GT(met, count / 10);
  EXPECT_LT(met, count * 9 / 10);
}

}  // namespace
}  // namespace paperproof::compare
