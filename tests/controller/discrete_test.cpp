/// Discrete collision detection: impacts, islands, their order. The technique made of them is in tests/situations.
#include "controller/stepping.hpp"
#include "support/steps_wanted.hpp"
#include "techniques/discrete/solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::stepping {
namespace {

using discrete::Body;
using discrete::BodyIndex;
using discrete::find_impact;
using discrete::Pair;

constexpr double gap = Tolerances{}.stop;
constexpr double touch = Tolerances{}.touch;

/// @param outline must outlive the body.
Body body_of(const std::vector<Vec2d>& outline, const Vec2d& position, const Vec2d& movement) {
  Body body{.outline = std::span<const Vec2d>(outline), .box = Box2::around(outline), .base = {}};
  body.position = position;
  body.movement = body.velocity = movement;
  return body;
}

TEST(DiscreteImpact, of_convex_outlines_is_when_they_begin_to_overlap) {
  Random random(52);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec2d start = random.point(4);
    const Vec2d end = random.point(1);
    const Vec2d of_both = random.point(5);
    const std::vector<Vec2d> outline = on_an_ellipse(random, {0, 0}, {1, 1});
    const std::vector<Vec2d> other_outline = on_an_ellipse(random, {0, 0}, {1, 1});
    const Body body = body_of(outline, start, end - start + of_both);
    const Body other = body_of(other_outline, {0, 0}, of_both);
    const auto overlap_at = [&](double time) {  // seen from the other
      return discrete::began_overlapping(body_of(outline, start + (end - start) * time, {0, 0}), other, 0.0);
    };
    if (overlap_at(0)) continue;
    const auto impact = find_impact(body, other, touch);
    ASSERT_EQ(impact.has_value(), overlap_at(1)) << "seed 52, case " << i;
    if (!impact) continue;
    ++hits;
    ASSERT_NEAR(impact->normal.norm(), 1, 1e-15) << "seed 52, case " << i;
    ASSERT_FALSE(overlap_at(impact->time - 1e-9)) << "seed 52, case " << i;
    ASSERT_TRUE(overlap_at(std::min(1.0, impact->time + 1e-9)) || impact->time > 1 - 2e-9) << "seed 52, case " << i;
  }
  EXPECT_GT(hits, 3000);
}

TEST(DiscreteOrder, is_that_of_the_times_of_impact_within_an_island) {
  // The mover is expected to end in all three boxes, of which the last, whose top is the highest, is met first.
  const std::vector<Vec2d> metre = box(-0.5, -0.5, 0.5, 0.5).points;
  std::vector<Body> bodies;
  for (const double y : {-2.5, -2.0, -1.5}) bodies.push_back(body_of(metre, {0, y}, {0, 0}));
  for (Body& body : bodies) body.inverse_mass = 0;
  bodies.push_back(body_of(metre, {0, 1}, {0, -3}));
  for (BodyIndex i = 0; i < 3; ++i) ASSERT_TRUE(find_impact(bodies[3], bodies[i], touch));
  discrete::Solver solver{gap, touch};
  ASSERT_TRUE(solver.solve_once(bodies));
  ASSERT_EQ(solver.solved().size(), 1U) << "after the first impact there is no other";
  EXPECT_EQ(solver.solved()[0].bodies.second, 2U);
  EXPECT_DOUBLE_EQ(solver.solved()[0].impact.time, (1 - 0.5 - -1.0) / 3);
  EXPECT_DOUBLE_EQ(bodies[3].expected().y(), -0.5 + gap);
  EXPECT_FALSE(solver.solve_once(bodies)) << "nothing is left";
}

/// By looking at all. Ascending.
std::vector<Pair> overlapping(const std::vector<Body>& bodies) {
  std::vector<Pair> pairs;
  for (BodyIndex i = 0; i < bodies.size(); ++i)
    for (BodyIndex j = 0; j < bodies.size(); ++j) {
      const bool in_order = bodies[i].can_be_moved() && (!bodies[j].can_be_moved() || i < j);
      if (i != j && in_order && bodies[i].total_box().overlaps(bodies[j].total_box())) pairs.push_back({i, j});
    }
  return pairs;
}

/// Of the first round.
std::vector<Pair> found_in(std::vector<Body> bodies) {
  discrete::Solver solver{gap, touch};
  (void)solver.solve_once(bodies);
  return {solver.pairs().begin(), solver.pairs().end()};
}

/// Pairs are of boxes: the outline does not matter.
Body body_in(const Box2& box, bool can_be_moved) {
  Body body{.outline = {Box2{{0, 0}, {1, 1}}, 0}, .box = box, .base = {}};
  body.inverse_mass = can_be_moved ? 1 : 0;
  return body;
}

TEST(DiscretePairs, are_those_of_looking_at_all) {
  Random random(61);
  std::size_t possible = 0;
  std::size_t found = 0;
  const int scenes = test::sampled(9000);
  for (int scene = 0; scene < scenes; ++scene) {
    // Boxes in a field, a row or a tower; on whole quarters of a metre, so that many touch and begin at the same place.
    const Vec2d field{random.between(0.5, 12), random.between(0.5, 12)};
    const double share_that_moves = random.unit();
    const auto place = [&random](double most) { return std::floor(random.between(0, 4 * most)) / 4; };
    std::vector<Body> bodies(static_cast<std::size_t>(random.below(60)));
    std::size_t movable = 0;
    for (Body& body : bodies) {
      const Vec2d lower{place(field.x()), place(field.y())};
      const Vec2d size{place(random.below(10) == 0 ? 12 : 1), place(1)};
      body = body_in({lower, lower + size}, random.chance(share_that_moves));
      movable += body.can_be_moved();
    }
    possible += movable * bodies.size();
    const std::vector<Pair> expected = overlapping(bodies);
    ASSERT_EQ(found_in(bodies), expected) << "seed 61, scene " << scene;
    found += expected.size();
  }
  EXPECT_GT(found, possible / 50);
  EXPECT_LT(found, possible / 3);
}

TEST(DiscretePairs, have_first_what_can_be_moved_and_the_lower_of_two_that_can) {
  std::vector<Body> bodies;
  for (const bool can_be_moved : {false, true, false, true}) bodies.push_back(body_in({{0, 0}, {1, 1}}, can_be_moved));
  EXPECT_EQ(found_in(bodies), (std::vector<Pair>{{1, 0}, {1, 2}, {1, 3}, {3, 0}, {3, 2}}));
}

}  // namespace
}  // namespace paperproof::stepping
