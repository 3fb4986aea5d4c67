/// Whether there is a straight way out of what the octagon is inside of, and where.
#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

/// What the end keeps from solids, and what the way keeps from those it passes [m].
constexpr double kept = 2e-6;

TEST(ExactWayOut, is_straight_to_the_nearest_side_that_is_open) {
  const ColliderDef block = box(-2, -1.5, 2, 1.5);
  // Within the block, and a lid that lies on it at the step's start, and is gone at its end.
  const auto line = [](double direction) { return one_way(chain({{-9, 1.4}, {9, 1.4}}), {0, direction}); };
  const ColliderDef lid = box(-9, 1.5, 9, 1.6, 0);
  const Motions movers{{{0, 0}, {0, 20}}};
  const double over = 1.5 + half_height;
  const double beside = 2 + half_width;
  using Row = std::tuple<const char*, std::vector<ColliderDef>, Vec2d, double, Vec2d>;
  for (const auto& [what, solids, from, fraction, to] :
       {Row{"up", {block}, {0.3, 1.4}, 0, {0.3, over}}, Row{"down", {block}, {-0.7, -1.2}, 0, {-0.7, -over}},
        Row{"to the left", {block}, {-1.5, -0.1}, 0, {-beside, -0.1}},
        Row{"along a one-way normal", {block, line(1)}, {0.2, 0.5}, 0, {0.2, over}},
        Row{"not against it", {block, line(-1)}, {0.2, 0.5}, 0, {beside, 0.5}},
        Row{"a lid is there at first", {block, lid}, {0.3, 0.8}, 0, {beside, 0.8}},
        Row{"and not at last", {block, lid}, {0.3, 0.8}, 1, {0.3, over}}}) {
    const ExactScenery there = world(solids);
    const std::optional<Vec2d> out = there.way_out(Place(from, movers, fraction), 10);
    ASSERT_TRUE(out) << what;
    EXPECT_LE((*out - to).norm(), kept) << what;
    EXPECT_EQ(there.overlapped(Place(*out, movers, fraction)), Colliders{}) << what;
  }
  EXPECT_FALSE(world({block}).way_out({0.3, 1.4}, 0.7)) << "it is 0.725 m long";
  EXPECT_FALSE(world({block}).way_out({0, 3}, 10)) << "it is inside of nothing";
}

TEST(ExactWayOut, passes_beside_what_stands_in_the_straight_way) {
  // A crate in the block, above the octagon: the way up passes beside its corner.
  const Vec2d from{0, -2};
  const Vec2d out = world({box(-5, -10, 5, 0), box(-0.1, -0.9, 0.1, -0.8)}).way_out(from, 10).value();
  // Seen by the position, the crate is larger by the octagon: the right corner of its lower side is at (0.25625,
  // -1.525), the one above it at (0.4125, -1.2125). The steepest way past both ends at the level where it is free.
  const double rise = half_height - from.y();
  const double slope = std::max(0.25625 / (2 - 1.525), 0.4125 / (2 - 1.2125));
  EXPECT_NEAR((out - from).norm(), rise * std::sqrt(1 + slope * slope), kept);
  EXPECT_NEAR(out.y(), half_height, kept);
}

/// The same by trial: the nearest of many places in many directions.
std::optional<double> nearest_by_trial(const ExactScenery& there, const Vec2d& from, double reach) {
  constexpr int directions = 64;
  constexpr double stride = 0.03;
  const Colliders inside = there.overlapped(from);
  std::optional<double> nearest;
  for (int k = 0; k < directions; ++k)
    for (double distance = stride; distance < std::min(reach, nearest.value_or(reach)); distance += stride) {
      const Vec2d end = from + distance * towards(2 * std::numbers::pi * k / directions);
      const Colliders met = there.met(from, end);
      if (!std::includes(inside.begin(), inside.end(), met.begin(), met.end())) break;
      if (there.overlapped(end).empty()) nearest = distance;
    }
  return nearest;
}

TEST(ExactWayOut, is_found_wherever_trial_finds_one_and_never_longer) {
  Random random(50);
  int found = 0;
  int none = 0;
  constexpr int cases = 100;
  for (int round = 0; found + none < cases; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    std::vector<ColliderDef> colliders{polygon(star(random, {0, 0}, 3, 5 + random.below(20)))};
    for (int n = random.below(8); n > 0; --n) {
      const Vec2d at = random.point(3);
      random.below(2) == 0 ? colliders.push_back(box(at.x(), at.y(), at.x() + random.between(0.1, 2), at.y() + 0.1))
                           : colliders.push_back(polygon(star(random, at, 0.8, 3)));
    }
    if (random.below(2) == 0) {  // a frame around all, so that there may be no way
      const double r = random.between(0.8, 2);
      colliders.push_back(chain({{-r, -r}, {r, -r}, {r, r}, {-r, r}, {-r, -r}}));
    }
    const ExactScenery there = world(colliders);
    const Vec2d from = random.point(1.5);
    const Colliders inside = there.overlapped(from);
    if (inside.empty()) continue;
    const std::optional<Vec2d> out = there.way_out(from, 10);
    const std::optional<double> by_trial = nearest_by_trial(there, from, 10);
    (out ? found : none) += 1;
    if (out) {
      EXPECT_EQ(there.overlapped(*out), Colliders{});
      const Colliders met = there.met(from, *out);
      EXPECT_TRUE(std::includes(inside.begin(), inside.end(), met.begin(), met.end()));
    }
    if (!by_trial) continue;
    ASSERT_TRUE(out) << "trial finds one of " << *by_trial;
    EXPECT_LE((*out - from).norm(), *by_trial + kept);
  }
  EXPECT_GT(found, cases * 2 / 5);
  EXPECT_GT(none, cases / 25);
}

}  // namespace
}  // namespace paperproof::compare::test
