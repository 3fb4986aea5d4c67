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

TEST(ExactImpact, the_fraction_of_a_grazing_approach_is_the_quotient_of_the_numbers_that_ran) {
  const ExactScenery there = world({box(-1e6, -1, 1e6, 0)});
  EXPECT_EQ(there.time_of_impact({0.1, 0.7}, {300, -0.1}, 0).value().fraction * 0.1, ExactFraction(0.7) - 0.625);
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

}  // namespace
}  // namespace paperproof::compare::test
