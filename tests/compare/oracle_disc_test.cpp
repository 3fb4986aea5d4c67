/// Circles, against answers that are worked out by hand, and against another formulation in rationals.
#include "oracle/exact.hpp"
#include "oracle/first_meeting.hpp"
#include "oracle/number.hpp"

#include "compare/exact_shapes.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double closely = 1e-15;

ColliderDef disc(const Vec2d& centre, double radius) {
  ColliderDef def{.shape = ColliderDef::Shape::circle, .points = {centre}};
  def.radius = radius;
  return def;
}

/// 2 m wide and high.
std::vector<Vec2d> square() { return {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}; }

TEST(Approximate, times_less_than_one_keeps_a_bound_of_the_smallest_double) {
  const Approximate off{0.5, std::numeric_limits<double>::denorm_min()};
  EXPECT_GT((off * Approximate{0.25}).radius, 0);
  EXPECT_GT((Approximate{0.25} * off).radius, 0);
  EXPECT_EQ((Approximate{0.5} * Approximate{0.25}).radius, 0);
}

ExactScenery beside(std::vector<ColliderDef> colliders) { return {scenery(std::move(colliders)), square()}; }

TEST(ExactDisc, overlaps_from_one_ulp_nearer_than_its_radius) {
  const ExactScenery solids = beside({disc({0, 0}, 1)});
  EXPECT_FALSE(solids.overlaps({0, 2}, 0)) << "an edge touches the top";
  EXPECT_TRUE(solids.overlaps({0, one_ulp_down(2)}, 0));
  // The lower right corner is at (-3, 4): 5 m away.
  const ExactScenery wide = beside({disc({0, 0}, 5)});
  EXPECT_FALSE(wide.overlaps({-4, 5}, 0));
  EXPECT_TRUE(wide.overlaps({-4, one_ulp_down(5)}, 0));
  EXPECT_TRUE(wide.overlaps({one_ulp_up(-4), 5}, 0));
  EXPECT_FALSE(wide.overlaps({one_ulp_down(-4), 5}, 0));
  EXPECT_TRUE(wide.overlaps({0, 0}, 0)) << "wholly inside";
  EXPECT_TRUE(beside({disc({0.5, 0.5}, 1e-9)}).overlaps({0, 0}, 0)) << "wholly inside of the character";
}

TEST(ExactDisc, is_missed_by_a_way_that_grazes_it) {
  const ExactScenery solids = beside({disc({0, 0}, 1)});
  EXPECT_FALSE(solids.meets({-10, 2}, {10, 2}, 0));
  EXPECT_TRUE(solids.meets({-10, 2}, {10, one_ulp_down(2)}, 0));
  // A corner goes along the tangent through (3, 4), downwards to the right by (4, -3).
  const ExactScenery wide = beside({disc({0, 0}, 5)});
  EXPECT_FALSE(wide.meets({4 - 40, 5 + 30}, {4 + 40, 5 - 30}, 0));
  EXPECT_TRUE(wide.meets({4 - 40, 5 + 30}, {4 + 40, one_ulp_down(5 - 30)}, 0));
  EXPECT_FALSE(wide.meets({4 - 40, 5 + 30}, {4 + 40, one_ulp_up(5 - 30)}, 0));
}

TEST(ExactDisc, of_a_micrometre_is_met_by_a_bullet) {
  const ExactScenery solids = beside({disc({0, 0}, 1e-6)});
  EXPECT_TRUE(solids.meets({-1e6, 0.5}, {1e6, 0.5}, 0));
  EXPECT_FALSE(solids.overlaps({1e6, 0.5}, 0));
  const auto impact = solids.time_of_impact({-1e6, 0.5}, {2e6, 0}, 0);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(static_cast<double>(impact->fraction), (1e6 - 1 - 1e-6) / 2e6, 1e-15);
}

TEST(ExactDisc, is_hit_by_an_edge_after_the_distance_over_the_speed) {
  const auto impact = beside({disc({0, 0}, 1)}).time_of_impact({0, 10}, {0, -10}, 0);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(static_cast<double>(impact->fraction), 0.8, closely);
  EXPECT_EQ(impact->normal, Vec2d(0, 1));
  EXPECT_LE((impact->point - Vec2d(0, 1)).norm(), closely);
  EXPECT_TRUE(impact->exposed);
}

TEST(ExactDisc, is_hit_by_a_corner_where_three_four_five_says) {
  // The lower right corner falls from (-3, 14) by 20 m: it is at (-3, 4) after the half.
  const auto impact = beside({disc({0, 0}, 5)}).time_of_impact({-4, 15}, {0, -20}, 0);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(static_cast<double>(impact->fraction), 0.5, closely);
  EXPECT_LE((impact->normal - Vec2d(-0.6, 0.8)).norm(), 1e-14);
  EXPECT_LE((impact->point - Vec2d(-3, 4)).norm(), 1e-13);
}

TEST(ExactDisc, that_moves_is_hit_in_its_own_frame) {
  ColliderDef moving = disc({0, 0}, 1);
  moving.mover = 0;
  const ExactScenery solids = beside({moving});
  const std::array<MoverMotion<double>, 1> up{{{{0, 0}, {0, 5}}}};
  const auto impact = solids.time_of_impact(Place({0, 10}, up, 0), {0, -5}, 0);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(static_cast<double>(impact->fraction), 0.8, closely);
  EXPECT_LE((impact->point - Vec2d(0, 1 + 4)).norm(), 1e-14);
  EXPECT_FALSE(solids.overlaps(Place({0, 7}, up, 1), 0));
  EXPECT_TRUE(solids.overlaps(Place({0, one_ulp_down(7)}, up, 1), 0));
}

TEST(ExactDisc, separation_and_depth_are_those_of_the_nearest_feature) {
  const ExactScenery solids = beside({disc({0, 0}, 5)});
  EXPECT_EQ(solids.separation({0, 8}, 0), 2);
  EXPECT_NEAR(solids.separation({-7, 9}, 0), 5, closely) << "from the corner (-6, 8)";
  EXPECT_EQ(solids.penetration({0, 5.5}, 0), 0.5);
  EXPECT_EQ(solids.penetration({0, 0.25}, 0), 5.75) << "through the nearest edge";
  EXPECT_EQ(solids.penetration({0, 6}, 0), 0);
}

TEST(ExactDisc, is_a_near_part_with_the_direction_as_its_one_face) {
  const std::vector<NearPart> parts = beside({disc({0, 0}, 5), disc({50, 0}, 1)}).near_parts({-4, 5.0625}, 1);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].faces.size(), 1U);
  const Vec2d corner(-3, 4.0625);
  EXPECT_NEAR(parts[0].faces[0].separation, corner.norm() - 5, closely);
  EXPECT_LE((parts[0].faces[0].normal - corner.normalized()).norm(), closely);
}

TEST(ExactDisc, is_left_by_the_shortest_way_that_is_open) {
  const std::optional<Vec2d> out = beside({disc({0, 0}, 5)}).way_out({0, 5}, 100);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->y(), 6, 0.0013 * 5);
  EXPECT_GE(out->y(), 6);
  // A ceiling bars that way: it goes out sideways, to where a corner is on the disc.
  const auto aside = beside({disc({0, 0}, 5), box(-20, 6.5, 20, 7)}).way_out({0.5, 5.375}, 100);
  ASSERT_TRUE(aside);
  EXPECT_LT(aside->y(), 5.5);
  EXPECT_GT(aside->x(), 1);
}

TEST(ExactDisc, leaves_a_free_place_beside_it) {
  const std::vector<ColliderIndex> all{0};
  const WayQuestion anywhere{.from = {0, 5.5}, .end = {0, 5.5}, .may_pass = all};
  const auto accept = [](const Vec2d&) { return true; };
  const auto place = beside({disc({0, 0}, 5)}).find_free(anywhere, 2, 1e-7, accept);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->y(), 6, 1e-6);
  EXPECT_FALSE(beside({disc({0, 0}, 5)}).find_free(anywhere, 0.25, 1e-7, accept));
}

TEST(ExactDisc, as_a_sensor_is_entered_and_left_where_it_is_overlapped) {
  ColliderDef sensor = disc({0, 0}, 5);
  sensor.sensor = true;
  const ExactScenery solids = beside({sensor});
  EXPECT_TRUE(solids.overlapped({0, 0}).empty()) << "sensors are no solids";
  // An edge comes to the disc at x = -6, and leaves it at 6.
  const std::array<Place, 2> path{Place({-10, 0}, {}, 0), Place({10, 0}, {}, 1)};
  const std::vector<ExactSensorEvent> events = solids.sensor_events(path);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].change, ExactSensorEvent::Change::enter);
  EXPECT_NEAR(static_cast<double>(events[0].fraction), 0.2, closely);
  EXPECT_EQ(events[1].change, ExactSensorEvent::Change::exit);
  EXPECT_NEAR(static_cast<double>(events[1].fraction), 0.8, closely);
  const std::array<Place, 2> inside{Place({0, 0}, {}, 0), Place({1, 0}, {}, 1)};
  EXPECT_TRUE(solids.sensor_events(inside).empty());
  const std::array<Place, 2> grazing{Place({-10, 6}, {}, 0), Place({10, 6}, {}, 1)};
  EXPECT_TRUE(solids.sensor_events(grazing).empty());
}

// ---------------------------------------------------------------------------------------- another formulation

/// Counter-clockwise, without points on its edges (A. M. Andrew 1979).
std::vector<ExactPoint> hull_of(std::vector<ExactPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const ExactPoint& a, const ExactPoint& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<ExactPoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const ExactPoint& point : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Exact dot(const ExactPoint& a, const ExactPoint& b) { return a.x * b.x + a.y * b.y; }

/// Of a point from a convex ring; zero inside.
Exact squared_distance(const std::vector<ExactPoint>& ring, const ExactPoint& p) {
  bool inside = true;
  std::optional<Exact> least;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const ExactPoint& a = ring[k];
    const ExactPoint edge = ring[(k + 1) % ring.size()] - a;
    inside = inside && cross(a, a + edge, p) >= 0;
    const Exact share = std::clamp<Exact>(dot(edge, p - a) / dot(edge, edge), 0, 1);
    const ExactPoint gap = p - (a + share * edge);
    if (const Exact square = dot(gap, gap); !least || square < *least) least = square;
  }
  return inside ? Exact(0) : *least;
}

/// Of a centre from the octagon, wherever it is on its way.
Exact squared_distance(const Vec2d& from, const Vec2d& to, const Vec2d& centre) {
  std::vector<ExactPoint> points;
  for (const Vec2d& corner : octagon())
    for (const Vec2d& end : {from, to}) points.push_back(exact(end) + exact(corner));
  return squared_distance(hull_of(points), exact(centre));
}

/// Places on a grid: many of them touch exactly.
Vec2d on_grid(Random& random, int reach) {
  return Vec2d{random.integer(-reach, reach) / 32.0, random.integer(-reach, reach) / 32.0};
}

TEST(ExactDisc, agrees_with_the_distance_from_the_hull_of_all_corners) {
  constexpr std::uint64_t seed = 20260811;
  SCOPED_TRACE(seed);
  Random random(seed);
  int met = 0;
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec2d from = on_grid(random, 60);
    const Vec2d to = random.chance(0.2) ? from : on_grid(random, 60);
    const Vec2d centre = on_grid(random, 60);
    const Exact square = squared_distance(from, to, centre);
    double radius = random.log_between(1e-6, 10);
    const double distance = std::sqrt(static_cast<double>(square));
    if (distance > 0 && Exact(distance) * Exact(distance) == square) {
      ++touching;
      radius = random.chance(0.5) ? distance : one_ulp_up(distance);
    }
    const ExactScenery solids(scenery({disc(centre, radius)}), octagon());
    const bool expected = square < Exact(radius) * Exact(radius);
    ASSERT_EQ(solids.meets(from, to, 0), expected) << i;
    met += expected;
    const VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{centre}, {centre}}};
    const std::array<PathPoint<double>, 2> path{{{from, 0}, {to, 1}}};
    const std::size_t only = 0;
    const Meeting meeting = first_meeting(octagon(), path, way, {&only, 1}, Asked::whether, radius);
    ASSERT_EQ(meeting.kind == Meeting::Kind::meets, expected) << i;
    const auto impact = solids.time_of_impact(from, to - from, 0);
    ASSERT_EQ(impact.has_value(), expected) << i;
    if (!impact || impact->fraction == 0) continue;
    const auto t = static_cast<double>(impact->fraction);
    EXPECT_NEAR(solids.separation(from + t * (to - from), 0), 0, 1e-14) << i;
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(touching, 300);
  std::printf("%d of 3000 ways meet, %d touch to an ulp\n", met, touching);
}

TEST(ExactDisc, that_goes_along_with_what_turns_is_met_as_one_that_stands_in_its_frame) {
  constexpr std::uint64_t seed = 20260812;
  SCOPED_TRACE(seed);
  Random random(seed);
  const std::size_t only = 0;
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2d from = on_grid(random, 60);
    const Vec2d to = on_grid(random, 60);
    const Vec2d before = on_grid(random, 60);
    const Vec2d after = on_grid(random, 60);
    const double radius = random.integer(1, 8) * 5 / 32.0;
    const VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{before}, {after}}};
    const std::array<PathPoint<double>, 2> path{{{from, 0}, {to, 1}}};
    const Meeting meeting = first_meeting(octagon(), path, way, {&only, 1}, Asked::when, radius);
    const Vec2d relative = to - (after - before);  // exact on this grid
    const ExactScenery solids(scenery({disc(before, radius)}), octagon());
    ASSERT_EQ(meeting.kind != Meeting::Kind::apart, solids.meets(from, relative, 0)) << i;
    if (meeting.kind != Meeting::Kind::meets || solids.overlaps(from, 0)) continue;
    ++met;
    const auto impact = solids.time_of_impact(from, relative - from, 0);
    ASSERT_TRUE(impact) << i;
    EXPECT_NEAR(meeting.low, static_cast<double>(impact->fraction), 1e-12) << i;
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace paperproof::compare::detail
