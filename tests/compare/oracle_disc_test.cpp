/// Circles, against answers that are worked out by hand, and against another formulation in rationals.
#include "oracle/exact.hpp"
#include "oracle/first_meeting.hpp"
#include "oracle/number.hpp"

#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double closely = 1e-15;

TEST(Approximate, times_less_than_one_keeps_a_bound_of_the_smallest_double) {
  const Approximate off{0.5, std::numeric_limits<double>::denorm_min()};
  EXPECT_GT((off * Approximate{0.25}).radius, 0);
  EXPECT_GT((Approximate{0.25} * off).radius, 0);
  EXPECT_EQ((Approximate{0.5} * Approximate{0.25}).radius, 0);
}

/// For a square 2 m wide and high: a disc of so many metres at the origin, and what else is there.
ExactScenery disc(double radius, std::vector<ColliderDef> more = {}) {
  more.insert(more.begin(), circle({0, 0}, radius));
  return world(std::move(more), square(1));
}

TEST(ExactDisc, is_a_near_part_with_the_direction_as_its_one_face) {
  const std::vector<NearPart> parts = disc(5, {circle({50, 0}, 1)}).near_parts({-4, 5.0625}, 1);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].faces.size(), 1U);
  const Vec2d corner(-3, 4.0625);
  EXPECT_NEAR(parts[0].faces[0].separation, corner.norm() - 5, closely);
  EXPECT_LE((parts[0].faces[0].normal - corner.normalized()).norm(), closely);
}

TEST(ExactDisc, leaves_a_free_place_beside_it) {
  const Colliders all{0};
  const WayQuestion anywhere{.from = {0, 5.5}, .end = {0, 5.5}, .may_pass = all};
  const auto accept = [](const Vec2d&) { return true; };
  EXPECT_NEAR(disc(5).find_free(anywhere, 2, 1e-7, accept).value().y(), 6, 1e-6);
  EXPECT_FALSE(disc(5).find_free(anywhere, 0.25, 1e-7, accept));
}

Exact dot(const ExactPoint& a, const ExactPoint& b) { return a.x * b.x + a.y * b.y; }

/// Another formulation: of a centre from the hull of the octagon's corners at both ends of its way; zero inside.
Exact squared_distance(const Vec2d& from, const Vec2d& to, const Vec2d& centre) {
  std::vector<ExactPoint> points = octagon_at(exact(from));
  for (const ExactPoint& corner : octagon_at(exact(to))) points.push_back(corner);
  const std::vector<ExactPoint> ring = hull_of(std::move(points));
  const ExactPoint p = exact(centre);
  bool inside = true;
  std::optional<Exact> least;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const ExactPoint& a = ring[k];
    const ExactPoint edge = ring[(k + 1) % ring.size()] - a;
    inside = inside && cross(a, a + edge, p) >= 0;
    const Exact share = std::clamp<Exact>(dot(edge, p - a) / dot(edge, edge), 0, 1);
    const ExactPoint off = p - (a + share * edge);
    if (const Exact square = dot(off, off); !least || square < *least) least = square;
  }
  return inside ? Exact(0) : *least;
}

/// Places on a grid: many of them touch exactly.
Vec2d on_grid(Random& random) { return Vec2d{random.integer(-60, 60) / 32.0, random.integer(-60, 60) / 32.0}; }

Meeting meeting_of(const Vec2d& from, const Vec2d& to, const Vec2d& before, const Vec2d& after, double radius,
                   Asked asked) {
  const VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{before}, {after}}};
  const std::size_t only = 0;
  return first_meeting(octagon(), std::array<PathPoint, 2>{{{from, 0}, {to, 1}}}, way, {&only, 1}, asked, radius);
}

TEST(ExactDisc, agrees_with_the_distance_from_the_hull_of_all_corners) {
  Random random(20260811);
  int met = 0;
  int touching = 0;
  const int rounds = paperproof::test::sampled(3000);
  for (int i = 0; i < rounds; ++i) {
    const Vec2d from = on_grid(random);
    const Vec2d to = random.chance(0.2) ? from : on_grid(random);
    const Vec2d centre = on_grid(random);
    const Exact square = squared_distance(from, to, centre);
    double radius = random.log_between(1e-6, 10);
    const double distance = std::sqrt(static_cast<double>(square));
    if (distance > 0 && Exact(distance) * Exact(distance) == square) {
      ++touching;
      radius = random.chance(0.5) ? distance : one_ulp_up(distance);
    }
    const ExactScenery solids = world({circle(centre, radius)});
    const bool expected = square < Exact(radius) * Exact(radius);
    ASSERT_EQ(solids.meets(from, to, 0), expected) << i;
    met += expected;
    const Meeting meeting = meeting_of(from, to, centre, centre, radius, Asked::whether);
    ASSERT_EQ(meeting.kind == Meeting::Kind::meets, expected) << i;
    const auto impact = solids.time_of_impact(from, to - from, 0);
    ASSERT_EQ(impact.has_value(), expected) << i;
    if (!impact || impact->fraction == 0) continue;
    const auto t = static_cast<double>(impact->fraction);
    EXPECT_NEAR(solids.separation(from + t * (to - from), 0), 0, 1e-14) << i;
  }
  EXPECT_GT(met, rounds / 6);
  EXPECT_GT(touching, rounds / 10);
}

TEST(ExactDisc, that_goes_along_with_what_turns_is_met_as_one_that_stands_in_its_frame) {
  Random random(20260812);
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2d from = on_grid(random);
    const Vec2d to = on_grid(random);
    const Vec2d before = on_grid(random);
    const Vec2d after = on_grid(random);
    const double radius = random.integer(1, 8) * 5 / 32.0;
    const Meeting meeting = meeting_of(from, to, before, after, radius, Asked::when);
    const Vec2d relative = to - (after - before);  // exact on this grid
    const ExactScenery solids = world({circle(before, radius)});
    ASSERT_EQ(meeting.kind != Meeting::Kind::apart, solids.meets(from, relative, 0)) << i;
    if (meeting.kind != Meeting::Kind::meets || solids.overlaps(from, 0)) continue;
    ++met;
    const ExactImpact impact = solids.time_of_impact(from, relative - from, 0).value();
    EXPECT_NEAR(meeting.low, static_cast<double>(impact.fraction), 1e-12) << i;
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace paperproof::compare::detail
