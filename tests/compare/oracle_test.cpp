#include "oracle/exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace paperproof::compare {
namespace {

constexpr double one_ulp_up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double one_ulp_down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

using Exact = Rational;

struct ExactPoint {
  Exact x;
  Exact y;
};

Exact cross(const ExactPoint& o, const ExactPoint& a, const ExactPoint& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

ExactPoint exact(const Vec2d& v) { return {Exact(v.x()), Exact(v.y())}; }

/// The article's hull at 32 pixels per metre, counter-clockwise.
std::vector<Vec2d> octagon() {
  return {{-0.15625, -0.625}, {0.15625, -0.625}, {0.3125, -0.3125}, {0.3125, 0.3125},
          {0.15625, 0.625},   {-0.15625, 0.625}, {-0.3125, 0.3125}, {-0.3125, -0.3125}};
}

ColliderDef polygon(std::vector<Vec2d> points) { return {.points = std::move(points)}; }
ColliderDef box(double left, double bottom, double right, double top) {
  return polygon({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}
ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}
SceneryDef scenery(std::vector<ColliderDef> colliders) { return {.colliders = std::move(colliders)}; }

/// Second formulation of overlap: what is left of the ring after clipping it by every edge of the octagon, in rationals
/// (Sutherland, Hodgman 1974); its area is right for concave rings too.
Exact area_inside(const std::vector<Vec2d>& ring, const std::vector<Vec2d>& points, const Vec2d& position) {
  std::vector<ExactPoint> left;
  for (const Vec2d& v : ring) left.push_back(exact(v));
  std::vector<ExactPoint> clip;
  for (const Vec2d& o : points)
    clip.push_back({Exact(position.x()) + Exact(o.x()), Exact(position.y()) + Exact(o.y())});
  for (std::size_t k = 0; k < clip.size(); ++k) {
    const ExactPoint& a = clip[k];
    const ExactPoint& b = clip[(k + 1) % clip.size()];
    std::vector<ExactPoint> kept;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const ExactPoint& p = left[i];
      const ExactPoint& q = left[(i + 1) % left.size()];
      const Exact at_p = cross(a, b, p);
      const Exact at_q = cross(a, b, q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
        const Exact t = at_p / (at_p - at_q);
        kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    left = std::move(kept);
  }
  Exact twice = 0;
  for (std::size_t i = 1; i + 1 < left.size(); ++i) twice += cross(left[0], left[i], left[i + 1]);
  return abs(twice) / 2;
}

/// Third formulation, for convex things: the origin against the hull of all pairwise differences.
bool in_minkowski_difference(const std::vector<Vec2d>& convex, const std::vector<Vec2d>& points,
                             const Vec2d& position) {
  std::vector<ExactPoint> all;
  for (const Vec2d& v : convex) {
    for (const Vec2d& o : points) {
      all.push_back({Exact(v.x()) - Exact(o.x()), Exact(v.y()) - Exact(o.y())});
    }
  }
  const ExactPoint p = exact(position);
  std::sort(all.begin(), all.end(),
            [](const ExactPoint& a, const ExactPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto strictly_left = [&](auto begin, auto end) {
    std::vector<ExactPoint> half;
    for (auto it = begin; it != end; ++it) {
      while (half.size() > 1 && cross(half[half.size() - 2], half.back(), *it) <= 0) half.pop_back();
      half.push_back(*it);
    }
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
      if (cross(half[i], half[i + 1], p) <= 0) return false;
    }
    return true;
  };
  return strictly_left(all.begin(), all.end()) && strictly_left(all.rbegin(), all.rend());
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * unit(); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  Vec2d point(double reach) { return {between(-reach, reach), between(-reach, reach)}; }
  /// On a coarse grid, so that touching is frequent.
  Vec2d grid_point(int reach) {
    return {(below(2 * reach + 1) - reach) * 0.15625, (below(2 * reach + 1) - reach) * 0.15625};
  }

 private:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::mt19937_64 engine_;
};

/// A star-shaped ring, concave as a rule.
std::vector<Vec2d> star(Random& random, const Vec2d& centre, double radius, int corners) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + random.between(0, 0.8)) / corners;
    const double r = radius * random.between(0.2, 1);
    ring.emplace_back(centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle));
  }
  return ring;
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
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    const std::vector<Vec2d> ring = star(random, random.point(1), 1.2, 3 + random.below(9));
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
  constexpr int rounds = 2000;
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
  EXPECT_GT(touches, 20);
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
  for (int i = 0; i < 800; ++i) {
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
  EXPECT_GT(exact_decisions, 100U) << "otherwise this says nothing about the exact path";
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

TEST(ExactImpact, the_articles_bullet_meets_the_paper_at_three_fifths_exactly) {
  const double pixel = 1.0 / 32;
  const std::vector<Vec2d> square{
      {-pixel / 2, -pixel / 2}, {pixel / 2, -pixel / 2}, {pixel / 2, pixel / 2}, {-pixel / 2, pixel / 2}};
  const ExactScenery world(scenery({box(-1, -5 * pixel, 1, 0)}), square);
  const std::optional<ExactImpact> impact = world.first_impact({0, 30.5 * pixel}, {0, -50 * pixel});
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, Exact(3, 5));
  EXPECT_EQ(impact->normal, Vec2d(0, 1));
  EXPECT_EQ(impact->point, Vec2d(0, 0));
  EXPECT_TRUE(impact->exposed);
}

TEST(ExactImpact, separates_before_and_meets_after) {
  constexpr std::uint64_t seed = 24;
  Random random(seed);
  int hits = 0;
  int rounds = 0;
  for (int i = 0; i < 1500; ++i) {
    const ExactScenery world(scenery({polygon(star(random, random.point(1), 0.8, 3 + random.below(7)))}), octagon());
    const Vec2d from = random.point(2.5);
    const Vec2d displacement = 1.5 * (random.point(1.2) - from);
    if (world.overlaps(from, 0)) continue;
    ++rounds;
    const std::optional<ExactImpact> impact = world.time_of_impact(from, displacement, 0);
    // The displacement that the sweep took is the exact one; the nearest double end may differ by an ulp.
    if (!impact) {
      EXPECT_FALSE(world.meets(from, from + displacement * (1 - 1e-12), 0) &&
                   world.penetration(from + displacement, 0) > 1e-12)
          << "seed " << seed << " round " << i;
      continue;
    }
    ++hits;
    const double t = static_cast<double>(impact->fraction);
    ASSERT_GE(t, 0);
    ASSERT_LT(t, 1);
    EXPECT_NEAR(world.separation(from + t * displacement, 0), 0, 1e-14) << "seed " << seed << " round " << i;
    EXPECT_FALSE(world.meets(from, from + (t - 1e-9) * displacement, 0)) << "seed " << seed << " round " << i;
    EXPECT_TRUE(world.meets(from, from + (t + 1e-9) * displacement, 0)) << "seed " << seed << " round " << i;
    EXPECT_LT(impact->normal.dot(displacement), 0);
    EXPECT_NEAR(impact->normal.norm(), 1, 1e-15);
    // Along its normal the octagon is free of the place that it touches, a little back from there.
    EXPECT_FALSE(world.overlaps(from + t * displacement + 1e-9 * impact->normal, 0))
        << "seed " << seed << " round " << i;
  }
  EXPECT_GT(hits, rounds * 3 / 10);
  EXPECT_LT(hits, rounds * 7 / 10);
}

TEST(ExactImpact, a_touching_start_hits_at_once_when_it_moves_in_and_never_when_it_slides) {
  const ExactScenery world(scenery({box(-4, -1, 4, 0)}), octagon());
  const std::optional<ExactImpact> in = world.time_of_impact({0, 0.625}, {1, -1e-9}, 0);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->fraction, 0);
  EXPECT_EQ(in->normal, Vec2d(0, 1));
  EXPECT_FALSE(world.time_of_impact({0, 0.625}, {1, 0}, 0));
  EXPECT_FALSE(world.time_of_impact({0, 0.625}, {1, 5e-324}, 0));
  EXPECT_FALSE(world.time_of_impact({0, 1}, {0, -0.375}, 0)) << "ending in touch is no impact";
}

TEST(ExactImpact, the_fraction_of_a_grazing_approach_is_the_quotient_of_the_numbers_that_ran) {
  const ExactScenery world(scenery({box(-1e6, -1, 1e6, 0)}), octagon());
  const Vec2d from(0.1, 0.7);
  const Vec2d displacement(300, -0.1);
  const std::optional<ExactImpact> impact = world.time_of_impact(from, displacement, 0);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, (Exact(0.7) - Exact(0.625)) / Exact(0.1));
}

TEST(ExactImpact, a_seam_of_abutting_tiles_is_not_exposed_and_a_step_is) {
  const SceneryDef tiles = scenery({box(0, -1, 1, 0), box(1, -1, 2, 0), box(2, -1, 3, 0.5)});
  // Already a millimetre inside the first tile, the second one is met at its vertex, which is none of the floor.
  const ExactScenery world(tiles, octagon());
  const std::optional<ExactImpact> vertex = world.time_of_impact({0.8, 0.624}, {0.5, -0.001}, 1);
  ASSERT_TRUE(vertex);
  EXPECT_EQ(vertex->point, Vec2d(1, 0));
  EXPECT_LT(vertex->normal.x(), 0);
  EXPECT_FALSE(vertex->exposed);

  const std::vector<Vec2d> square{{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}};
  const ExactScenery square_world(tiles, square);
  const std::optional<ExactImpact> side = square_world.time_of_impact({0.5, -0.5}, {0.5, 0}, 1);
  ASSERT_TRUE(side);
  EXPECT_EQ(side->normal, Vec2d(-1, 0));
  EXPECT_FALSE(side->exposed) << "covered all along";
  const std::optional<ExactImpact> partly = square_world.time_of_impact({0.5, -0.125}, {0.5, 0}, 1);
  ASSERT_TRUE(partly);
  EXPECT_FALSE(partly->exposed) << "what touches ends at the top of both";

  for (const std::vector<Vec2d>& points : {octagon(), square}) {
    const ExactScenery stair(tiles, points);
    const double rest = points == square ? 0.25 : 0.625;
    for (const double gap : {1e-6, 0.0, -1e-6}) {
      const std::optional<ExactImpact> step = stair.time_of_impact({1.5, rest + gap}, {0.5, -1e-9}, 2);
      ASSERT_TRUE(step);
      EXPECT_TRUE(step->exposed) << "the step stands out of the floor, gap " << gap;
      EXPECT_LT(step->normal.x(), 0);
    }
  }
}

TEST(ExactImpact, a_seam_is_not_exposed_from_either_direction) {
  const ExactScenery world(scenery({box(0, -1, 1, 0), box(1, -1, 2, 0)}), octagon());
  const std::optional<ExactImpact> leftward = world.time_of_impact({1.2, 0.624}, {-0.5, -0.001}, 0);
  ASSERT_TRUE(leftward);
  EXPECT_EQ(leftward->point, Vec2d(1, 0));
  EXPECT_GT(leftward->normal.x(), 0);
  EXPECT_FALSE(leftward->exposed);
}

TEST(ExactImpact, of_two_ledges_that_doubles_cannot_tell_apart_the_higher_one_is_met) {
  constexpr double step = 0x1p-60;
  const Vec2d from(0, 1.5);
  const Vec2d way(0, -2);
  for (const bool left : {true, false}) {
    const double low_left = left ? step : 0;
    const double low_right = left ? 0 : step;
    const ExactScenery world(
        scenery({polygon({{-4, -1}, {4, -1}, {4, low_right}, {0, low_right}, {0, low_left}, {-4, low_left}})}),
        octagon());
    const std::optional<ExactImpact> impact = world.time_of_impact(from, way, 0);
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->fraction, (Exact(1.5) - Exact(0.625) - Exact(step)) / 2);
    EXPECT_EQ(impact->point.x() < 0, left) << "the middle of what touches lies on the higher ledge";
  }
}

TEST(ExactImpact, corner_to_corner_the_normal_is_the_facet_most_opposed_to_the_motion) {
  const std::vector<Vec2d> square{{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}};
  const ExactScenery square_world(scenery({box(0, -1, 1, 0)}), square);
  for (const Vec2d& way : {Vec2d(1, -2), Vec2d(2, -1)}) {
    const std::optional<ExactImpact> impact = square_world.time_of_impact(Vec2d(-0.25, 0.25) - way / 4, way, 0);
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->fraction, Exact(1, 4));
    EXPECT_EQ(impact->point, Vec2d(0, 0));
    EXPECT_EQ(impact->normal, way.x() > 1 ? Vec2d(-1, 0) : Vec2d(0, 1));
  }
  // The foot's corner meets the tile's: the tile's side would oppose the motion most, but the arm already stands above
  // the tile, so that the side separates nothing.
  const ExactScenery world(scenery({box(0, -1, 1, 0)}), octagon());
  const Vec2d way(2, -0.125);
  const std::optional<ExactImpact> impact = world.time_of_impact(Vec2d(-0.15625, 0.625) - way / 4, way, 0);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, Exact(1, 4));
  const Vec2d foot = Vec2d(-0.3125, 0.15625) / std::sqrt(0.3125 * 0.3125 + 0.15625 * 0.15625);
  EXPECT_NEAR((impact->normal - foot).norm(), 0, 1e-15);
}

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
  constexpr int rounds = 1000;
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
