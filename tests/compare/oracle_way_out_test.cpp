/// Whether there is a straight way out of what the octagon is inside of, and where.
#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

/// What the end keeps from solids, and what the way keeps from those it passes [m].
constexpr double kept = 2e-6;

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
  const int cases = paperproof::test::sampled(100);
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
