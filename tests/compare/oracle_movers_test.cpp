#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;
using Motions = std::vector<MoverMotion<double>>;

ColliderDef moving(ColliderDef def, MoverIndex mover) {
  def.mover = mover;
  return def;
}

/// The octagon at a rational place: what a second formulation starts from.
std::vector<ExactPoint> octagon_at(const ExactPoint& at) {
  std::vector<ExactPoint> corners;
  for (const Vec2d& point : octagon()) corners.push_back(at + exact(point));
  return corners;
}

std::vector<ExactPoint> hull_of(std::vector<ExactPoint> all) {
  std::sort(all.begin(), all.end(),
            [](const ExactPoint& a, const ExactPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<ExactPoint> hull;
  const auto add_half = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() > first + 1 && cross(hull[hull.size() - 2], hull.back(), *it) <= 0) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  add_half(all.begin(), all.end());
  add_half(all.rbegin(), all.rend());
  return hull;
}

/// p - m(t), all in rationals.
ExactPoint relative(const Place& place, MoverIndex mover) {
  const MoverMotion<double>& motion = place.movers[mover];
  const ExactPoint from = exact(motion.from);
  return exact(place.position) - (from + Exact(place.fraction) * (exact(motion.to) - from));
}

/// Second formulation: in the frame of the mover, what the hull of the octagon at both ends leaves of the ring.
bool meets_by_clipping(const std::vector<Vec2d>& ring, const Place& from, const Place& to, MoverIndex mover) {
  std::vector<ExactPoint> corners = octagon_at(relative(from, mover));
  for (const ExactPoint& corner : octagon_at(relative(to, mover))) corners.push_back(corner);
  return area_within(ring, hull_of(std::move(corners))) > 0;
}

TEST(ExactMovers, a_way_among_movers_agrees_with_clipping_in_rationals) {
  constexpr std::uint64_t seed = 41;
  Random random(seed);
  int met = 0;
  constexpr int rounds = paperproof::test::sampled(2000);
  for (int i = 0; i < rounds; ++i) {
    const Vec2d centre = random.point(1);
    const std::vector<Vec2d> ring = star(random, centre, 0.8, 3 + random.below(6));
    const std::vector<Vec2d> other = star(random, random.point(1), 0.8, 3);
    const ExactScenery world(scenery({moving(polygon(ring), 1), moving(polygon(other), 0)}), octagon());
    // Half of them on a grid, where much only touches.
    const auto point = [&](int reach) { return i % 2 == 0 ? random.grid_point(4 * reach) : random.point(reach); };
    const Motions movers{{point(1), point(1)}, {point(1), point(1)}};
    double begin = i % 2 == 0 ? random.below(5) * 0.25 : random.between(0, 1);
    double end = i % 2 == 0 ? random.below(5) * 0.25 : random.between(0, 1);
    if (begin > end) std::swap(begin, end);
    const Place from(point(2), movers, begin);
    const Place to(point(2), movers, end);
    const Colliders expected = [&] {
      Colliders all;
      if (meets_by_clipping(ring, from, to, 1)) all.push_back(0);
      if (meets_by_clipping(other, from, to, 0)) all.push_back(1);
      return all;
    }();
    ASSERT_EQ(world.met(from, to), expected) << "seed " << seed << " round " << i;
    met += static_cast<int>(expected.size());
    const bool over = meets_by_clipping(ring, to, to, 1);
    ASSERT_EQ(world.overlaps(to, 0), over) << "seed " << seed << " round " << i;
  }
  EXPECT_GT(met, 2 * rounds * 3 / 10);
  EXPECT_LT(met, 2 * rounds * 7 / 10);
}

TEST(ExactMovers, head_on_they_meet_at_the_distance_over_the_sum_of_the_speeds) {
  // The character's right arm begins at 0.3125; the paper's left side at 2.
  const ExactScenery world(scenery({moving(box(2, -1, 2.0078125, 1), 0)}), octagon());
  for (const double v1 : {0.1, 1.7, 30.0}) {
    for (const double v2 : {0.0, 0.3, 1e5}) {
      const Motions movers{{{0, 0}, {-v2, 0}}};
      const std::optional<ExactImpact> impact = world.time_of_impact(Place({0, 0}, movers, 0), {v1, 0}, 0);
      const Exact fraction = (Exact(2) - Exact(0.3125)) / (Exact(v1) + Exact(v2));
      ASSERT_EQ(impact.has_value(), fraction < 1) << v1 << " " << v2;
      if (!impact) continue;
      EXPECT_EQ(impact->fraction, fraction);
      EXPECT_EQ(impact->normal, Vec2d(-1, 0));
      EXPECT_NEAR(impact->point.x(), 0.3125 + v1 * static_cast<double>(fraction), 1e-10) << "in the world";
    }
  }
}

TEST(ExactMovers, a_paper_that_sweeps_over_a_resting_character_meets_it_at_distance_over_speed) {
  const ExactScenery world(scenery({moving(chain({{0, -1}, {0, 1}}), 0)}), octagon());
  const Motions movers{{{-3, 0}, {7, 0.5}}};
  const std::optional<ExactImpact> impact = world.time_of_impact(Place({0, 0}, movers, 0), {0, 0}, 0);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, (Exact(3) - Exact(0.3125)) / 10);
  EXPECT_EQ(impact->normal, Vec2d(1, 0));
  EXPECT_EQ(world.met(Place({0, 0}, movers, 0), Place({0, 0}, movers, 1)), Colliders{0}) << "both ends are free";
  EXPECT_TRUE(world.overlapped(Place({0, 0}, movers, 1)).empty());
}

TEST(ExactMovers, one_ulp_to_either_side_of_touching_a_lift_decides) {
  const ExactScenery world(scenery({moving(box(-1, -1, 1, 0), 0)}), octagon());
  const Motions movers{{{0, 0.1}, {0, 0.7}}};
  // At a quarter the lift's top is at 0.1 + 0.25 (0.7 - 0.1), which no double holds; the octagon stands on it where
  // its position is above that by 0.625.
  const Exact top = Exact(0.1) + Exact(0.25) * (Exact(0.7) - Exact(0.1));
  double above = static_cast<double>(Exact(top + Exact(0.625)));
  while (Exact(above) < top + Exact(0.625)) above = one_ulp_up(above);
  while (Exact(one_ulp_down(above)) >= top + Exact(0.625)) above = one_ulp_down(above);
  EXPECT_TRUE(world.overlapped(Place({0, above}, movers, 0.25)).empty());
  EXPECT_EQ(world.overlapped(Place({0, one_ulp_down(above)}, movers, 0.25)), Colliders{0});
  // As the step begins and as it ends.
  EXPECT_EQ(world.overlapped(Place({0, one_ulp_down(0.1 + 0.625)}, movers, 0)), Colliders{0});
  EXPECT_EQ(world.overlapped(Place({0, one_ulp_down(0.7 + 0.625)}, movers, 1)), Colliders{0});
}

TEST(ExactMovers, riding_along_is_free_however_fast_and_lagging_by_an_ulp_is_not) {
  const ExactScenery world(scenery({moving(box(-1, -1, 1, 0), 0)}), octagon());
  const Motions movers{{{0, 0}, {0, 1024}}};
  const Vec2d start(0, 0.625);
  EXPECT_TRUE(world.met(Place(start, movers, 0), Place({0, 1024.625}, movers, 1)).empty());
  EXPECT_EQ(world.met(Place(start, movers, 0), Place({0, one_ulp_down(1024.625)}, movers, 1)), Colliders{0});
  EXPECT_FALSE(world.time_of_impact(Place(start, movers, 0), {0, 1024}, 0)) << "nothing comes nearer";
  EXPECT_TRUE(world.time_of_impact(Place(start, movers, 0), {0, one_ulp_down(1024)}, 0));
}

TEST(ExactMovers, a_one_way_lift_blocks_the_relative_motion_against_its_normal) {
  const ExactScenery world(scenery({moving(chain({{-1, 0}, {1, 0}}, Vec2d(0, 1)), 0)}), octagon());
  const Motions up{{{0, 0}, {0, 3}}};
  const Motions down{{{0, 0}, {0, -3}}};
  EXPECT_EQ(world.met(Place({0, 1}, up, 0), Place({0, 2}, up, 1)), Colliders{0}) << "it rises faster";
  EXPECT_TRUE(world.met(Place({0, 1}, down, 0), Place({0, -1}, down, 1)).empty()) << "it falls faster";
  EXPECT_TRUE(world.met(Place({0, -1}, down, 0), Place({0, -1}, down, 1)).empty()) << "it comes from above";
}

TEST(ExactMovers, a_lift_beside_the_floor_is_a_seam_exactly_where_the_two_are_flush) {
  const ExactScenery world(scenery({box(0, -1, 1, 0), moving(box(-2, -1.75, -1, -0.75), 0)}), octagon());
  // Already a millimetre inside the floor, the lift is met at its vertex.
  const auto exposed = [&](MoverMotion<double> motion) {
    const std::vector<MoverMotion<double>> movers{motion};
    const std::optional<ExactImpact> vertex = world.time_of_impact(Place({0.8, 0.624}, movers, 0), {0.5, -0.001}, 1);
    EXPECT_TRUE(vertex);
    return vertex && vertex->exposed;
  };
  EXPECT_FALSE(exposed({{3, 0.75}, {3, 0.75}})) << "waiting";
  EXPECT_FALSE(exposed({{2.97, 0.75}, {3, 0.75}})) << "sliding out of the floor, its top in line";
  EXPECT_TRUE(exposed({{3, 0.75 + 0x1p-40}, {3, 0.75 + 0x1p-40}})) << "a hair above it";
  EXPECT_TRUE(exposed({{3, 0.75}, {3, 0.85}})) << "rising out of it";
}

TEST(ExactMovers, a_seam_is_looked_for_where_the_neighbours_are_at_the_moment_of_the_touch) {
  // Two halves of a platform go along together; or the near one falls away and uncovers the far one's side.
  const std::vector<Vec2d> square{{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}};
  const ExactScenery world(scenery({moving(box(0, -1, 1, 0), 1), moving(box(1, -1, 2, 0), 0)}), square);
  for (const bool together : {true, false}) {
    const std::vector<MoverMotion<double>> movers{{{0, 0}, {0, 0.5}}, {{0, 0}, {0, together ? 0.5 : -4}}};
    const std::optional<ExactImpact> side = world.time_of_impact(Place({0.5, -0.5}, movers, 0), {0.5, 0.5}, 1);
    ASSERT_TRUE(side);
    EXPECT_EQ(side->fraction, Exact(1, 2));
    EXPECT_EQ(side->normal, Vec2d(-1, 0));
    EXPECT_EQ(side->exposed, !together);
  }
}

TEST(ExactMovers, separation_and_penetration_are_those_at_the_moment) {
  const ExactScenery world(scenery({moving(box(-1, -1, 1, 0), 0)}), octagon());
  const Motions movers{{{0, 0}, {0, -2}}};
  EXPECT_EQ(world.separation(Place({0, 0.625}, movers, 0), 0), 0);
  EXPECT_EQ(world.separation(Place({0, 0.625}, movers, 0.5), 0), 1);
  EXPECT_EQ(world.penetration(Place({0, 0.125}, movers, 0), 0), 0.5);
  EXPECT_EQ(world.penetration(Place({0, 0.125}, movers, 1), 0), 0);
}

TEST(ExactMovers, without_motions_every_mover_is_at_offset_zero_and_too_few_are_refused) {
  const ExactScenery world(scenery({moving(box(-1, -1, 1, 0), 1), box(5, 0, 6, 1)}), octagon());
  EXPECT_EQ(world.overlapped({0, 0.5}), Colliders{0});
  const Motions one(1);
  EXPECT_THROW((void)world.overlapped(Place({0, 0}, one, 0)), std::invalid_argument);
  EXPECT_THROW((void)world.met(Place({0, 0}, one, 0), Place({0, 0}, one, 1)), std::invalid_argument);
}

TEST(ExactMovers, near_follows_the_movers) {
  const ExactScenery world(scenery({moving(box(-1, -1, 1, 0), 0), box(-1, -9, 1, -8)}), octagon());
  const Motions movers{{{50, 0}, {20, 0}}};
  EXPECT_EQ(world.near(Place({20, 0}, movers, 0), Place({20, 0}, movers, 1), 0.1), Colliders{0});
  EXPECT_EQ(world.near(Place({0, 0}, movers, 0), Place({0, -7}, movers, 1), 0.5), Colliders{1});
}

TEST(ExactMovers, a_sensor_is_no_solid) {
  ColliderDef sensor = box(-1, -1, 1, 1);
  sensor.sensor = true;
  const ExactScenery world(scenery({sensor, moving(sensor, 0), box(-1, -1, 1, 0)}), octagon());
  EXPECT_EQ(world.overlapped({0, 0}), Colliders{2});
  EXPECT_EQ(world.met({0, 5}, {0, -5}), Colliders{2});
  EXPECT_EQ(world.impacts({0, 5}, {0, -9}).size(), 1U);
  EXPECT_EQ(world.near({0, 0}, {0, 0}, 1), Colliders{2});
}

}  // namespace
}  // namespace paperproof::compare
