#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

TEST(ExactImpact, separates_before_and_meets_after) {
  Random random(24);
  int hits = 0;
  int rounds = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    const Vec2d centre = random.point(1);
    const ExactScenery there = world({polygon(star(random, centre, 0.8, 3 + random.below(7)))});
    const Vec2d from = random.point(2.5);
    const Vec2d displacement = 1.5 * (random.point(1.2) - from);
    if (there.overlaps(from, 0)) continue;
    ++rounds;
    const std::optional<ExactImpact> impact = there.time_of_impact(from, displacement, 0);
    // The displacement that the sweep took is the exact one; the nearest double end may differ by an ulp.
    if (!impact) {
      EXPECT_FALSE(there.meets(from, from + displacement * (1 - 1e-12), 0) &&
                   there.penetration(from + displacement, 0) > 1e-12);
      continue;
    }
    ++hits;
    const double t = static_cast<double>(impact->fraction);
    ASSERT_GE(t, 0);
    ASSERT_LT(t, 1);
    EXPECT_NEAR(there.separation(from + t * displacement, 0), 0, 1e-14);
    EXPECT_FALSE(there.meets(from, from + (t - 1e-9) * displacement, 0));
    EXPECT_TRUE(there.meets(from, from + (t + 1e-9) * displacement, 0));
    EXPECT_LT(impact->normal.dot(displacement), 0);
    EXPECT_NEAR(impact->normal.norm(), 1, 1e-15);
    // Along its normal the octagon is free of the place that it touches, a little back from there.
    EXPECT_FALSE(there.overlaps(from + t * displacement + 1e-9 * impact->normal, 0));
  }
  EXPECT_NEAR(hits, 0.5 * rounds, 0.2 * rounds);
}

TEST(ExactImpact, a_touching_start_hits_at_once_when_it_moves_in_and_never_when_it_slides) {
  const ExactScenery there = world({box(-4, -1, 4, 0)});
  const ExactImpact in = there.time_of_impact({0, 0.625}, {1, -1e-9}, 0).value();
  EXPECT_EQ(in.fraction, 0);
  EXPECT_EQ(in.normal, Vec2d(0, 1));
  EXPECT_FALSE(there.time_of_impact({0, 0.625}, {1, 0}, 0));
  EXPECT_FALSE(there.time_of_impact({0, 0.625}, {1, 5e-324}, 0));
  EXPECT_FALSE(there.time_of_impact({0, 1}, {0, -0.375}, 0)) << "ending in touch is no impact";
}

TEST(ExactImpact, the_fraction_of_a_grazing_approach_is_the_quotient_of_the_numbers_that_ran) {
  const ExactScenery there = world({box(-1e6, -1, 1e6, 0)});
  EXPECT_EQ(there.time_of_impact({0.1, 0.7}, {300, -0.1}, 0).value().fraction * 0.1, ExactFraction(0.7) - 0.625);
}

TEST(ExactImpact, a_seam_of_abutting_tiles_is_not_exposed_and_a_step_is) {
  const std::vector<ColliderDef> tiles{box(0, -1, 1, 0), box(1, -1, 2, 0), box(2, -1, 3, 0.5)};
  // Already a millimetre inside one tile, the next one is met at its vertex, which is none of the floor.
  for (const auto& [from, way, tile] : {std::tuple{0.8, 0.5, 1U}, {1.2, -0.5, 0U}}) {
    const ExactImpact vertex = world(tiles).time_of_impact({from, 0.624}, {way, -0.001}, tile).value();
    EXPECT_EQ(vertex.point, Vec2d(1, 0));
    EXPECT_EQ(vertex.normal.x() < 0, way > 0);
    EXPECT_FALSE(vertex.exposed);
  }
  // All along the side is covered; or what touches ends at the top of both.
  for (const double height : {-0.5, -0.125}) {
    const ExactImpact side = world(tiles, square(0.25)).time_of_impact({0.5, height}, {0.5, 0}, 1).value();
    EXPECT_EQ(side.normal, Vec2d(-1, 0));
    EXPECT_FALSE(side.exposed) << height;
  }
  for (const std::vector<Vec2d>& points : {octagon(), square(0.25)})
    for (const double above : {1e-6, 0.0, -1e-6}) {
      const double rest = points.size() == 4 ? 0.25 : 0.625;
      const ExactImpact step = world(tiles, points).time_of_impact({1.5, rest + above}, {0.5, -1e-9}, 2).value();
      EXPECT_TRUE(step.exposed) << "the step stands out of the floor, above it by " << above;
      EXPECT_LT(step.normal.x(), 0);
    }
}

TEST(ExactImpact, a_side_of_two_tiles_in_one_place_is_exposed_and_a_seam_of_them_is_not) {
  for (const bool before : {false, true}) {
    std::vector<ColliderDef> tiles{box(2, -1, 3, 1), box(2, -1, 3, 1), box(2, -2, 3, 0.5)};
    if (before) tiles.push_back(box(1, -1, 2, 1));
    const ExactScenery there = world(tiles, square(0.25));
    for (const ColliderIndex tile : {0U, 1U, 2U})
      EXPECT_EQ(there.time_of_impact({1.5, 0}, {0.5, 0}, tile).value().exposed, !before) << tile;
  }
}

TEST(ExactImpact, of_two_ledges_that_doubles_cannot_tell_apart_the_higher_one_is_met) {
  constexpr double step = 0x1p-60;
  for (const bool left : {true, false}) {
    const double low_left = left ? step : 0;
    const double low_right = left ? 0 : step;
    const ExactScenery there =
        world({polygon({{-4, -1}, {4, -1}, {4, low_right}, {0, low_right}, {0, low_left}, {-4, low_left}})});
    const ExactImpact impact = there.time_of_impact({0, 1.5}, {0, -2}, 0).value();
    EXPECT_EQ(impact.fraction * 2, ExactFraction(1.5) - 0.625 - step);
    EXPECT_EQ(impact.point.x() < 0, left) << "the middle of what touches lies on the higher ledge";
  }
}

TEST(ExactImpact, corner_to_corner_the_normal_is_the_facet_most_opposed_to_the_motion) {
  using Row = std::tuple<std::vector<Vec2d>, Vec2d, Vec2d, Vec2d>;
  // The position where its corner is on that of the tile. Of the last one the tile's side would oppose the motion most,
  // but the arm already stands above the tile, so that the side separates nothing.
  for (const auto& [points, corner, way, normal] :
       {Row{square(0.25), {-0.25, 0.25}, {1, -2}, {0, 1}}, Row{square(0.25), {-0.25, 0.25}, {2, -1}, {-1, 0}},
        Row{octagon(), {-0.15625, 0.625}, {2, -0.125}, Vec2d(-2, 1).normalized()}}) {
    const ExactScenery there = world({box(0, -1, 1, 0)}, points);
    const ExactImpact impact = there.time_of_impact(Vec2d(corner - way / 4), way, 0).value();
    EXPECT_EQ(impact.fraction, 0.25);
    EXPECT_EQ(impact.point, Vec2d(0, 0));
    EXPECT_NEAR((impact.normal - normal).norm(), 0, 1e-15);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
