#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

/// p - m(t), all in rationals.
ExactPoint relative(const Place& place, MoverIndex mover) {
  if (mover == no_mover) return exact(place.position);
  const MoverMotion& motion = place.movers[mover];
  const ExactPoint from = exact(motion.from);
  return exact(place.position) - (from + Exact(place.fraction) * (exact(motion.to) - from));
}

/// Second formulation: in the frame of the mover, what the hull of the octagon at both ends leaves of the ring.
bool meets_by_clipping(const ColliderDef& def, const Place& from, const Place& to) {
  std::vector<ExactPoint> corners = octagon_at(relative(from, def.mover));
  for (const ExactPoint& corner : octagon_at(relative(to, def.mover))) corners.push_back(corner);
  return area_within(def.points, hull_of(std::move(corners))) > 0;
}

TEST(ExactMovers, a_way_among_movers_agrees_with_clipping_in_rationals) {
  Random random(41);
  int met = 0;
  constexpr int rounds = 1500;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    std::vector<ColliderDef> solids;
    for (const MoverIndex mover : {MoverIndex{1}, MoverIndex{0}, no_mover}) {
      const Vec2d centre = random.point(1);
      solids.push_back(polygon(star(random, centre, 0.8, 3 + random.below(6)), mover));
    }
    const ExactScenery there = world(solids);
    // Half of them on a grid, where much only touches.
    const auto point = [&](int reach) { return i % 2 == 0 ? random.grid_point(4 * reach) : random.point(reach); };
    const Motions movers{{point(1), point(1)}, {point(1), point(1)}};
    double begin = i % 2 == 0 ? random.below(5) * 0.25 : random.between(0, 1);
    double end = i % 2 == 0 ? random.below(5) * 0.25 : random.between(0, 1);
    if (begin > end) std::swap(begin, end);
    const Place from(point(2), movers, begin);
    const Place to(point(2), movers, end);
    Colliders expected;
    for (ColliderIndex k = 0; k < solids.size(); ++k) {
      if (meets_by_clipping(solids[k], from, to)) expected.push_back(k);
    }
    ASSERT_EQ(there.met(from, to), expected);
    const auto one = static_cast<ColliderIndex>(i % 3);
    ASSERT_EQ(there.overlaps(to, one), meets_by_clipping(solids[one], to, to));
    met += static_cast<int>(expected.size());
  }
  EXPECT_NEAR(met, 0.5 * (3 * rounds), 0.2 * (3 * rounds));
}

TEST(ExactMovers, head_on_they_meet_at_the_distance_over_the_sum_of_the_speeds) {
  // The character's right arm begins at 0.3125; the paper's left side at 2.
  const ExactScenery there = world({box(2, -1, 2.0078125, 1, 0)});
  for (const double v1 : {0.0, 0.1, 1.7, 30.0})
    for (const double v2 : {1e-9, 0.3, 1e5}) {
      const Motions movers{{{0, 0}, {-v2, 0}}};
      const std::optional<ExactImpact> impact = there.time_of_impact(Place({0, 0}, movers, 0), {v1, 0}, 0);
      const ExactFraction speed = ExactFraction(v1) + v2;
      ASSERT_EQ(impact.has_value(), speed > 1.6875) << v1 << " " << v2;
      if (!impact) continue;
      EXPECT_EQ(impact->fraction * speed, 1.6875);
      EXPECT_EQ(impact->normal, Vec2d(-1, 0));
      EXPECT_NEAR(impact->point.x(), 0.3125 + v1 * static_cast<double>(impact->fraction), 1e-10) << "in the world";
    }
}

TEST(ExactMovers, without_motions_every_mover_is_at_offset_zero_and_too_few_are_refused) {
  const ExactScenery there = world({box(-1, -1, 1, 0, 1), box(5, 0, 6, 1)});
  EXPECT_EQ(there.overlapped({0, 0.5}), Colliders{0});
  const Motions one(1);
  EXPECT_THROW((void)there.overlapped(Place({0, 0}, one, 0)), std::invalid_argument);
  EXPECT_THROW((void)there.met(Place({0, 0}, one, 0), Place({0, 0}, one, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::compare::test
