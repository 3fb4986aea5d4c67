/// Whether there is a straight way out of what the octagon is inside of, and where.
#include "compare/exact_shapes.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double half_width = 0.3125;
constexpr double half_height = 0.625;
/// What the end keeps from solids, and what the way keeps from those it passes [m].
constexpr double kept = 2e-6;

TEST(ExactWayOut, of_a_block_is_straight_to_the_nearest_side) {
  const ExactScenery world(scenery({box(-2, -1.5, 2, 1.5)}), octagon());
  struct Row {
    Vec2d from;
    Vec2d to;
  };
  for (const Row& row : {Row{{0.3, 1.4}, {0.3, 1.5 + half_height}}, Row{{-0.7, -1.2}, {-0.7, -1.5 - half_height}},
                         Row{{1.8, 0.2}, {2 + half_width, 0.2}}, Row{{-1.5, -0.1}, {-2 - half_width, -0.1}}}) {
    const std::optional<Vec2d> out = world.way_out(row.from, 10);
    ASSERT_TRUE(out) << row.from.transpose();
    EXPECT_LE((*out - row.to).norm(), kept) << row.from.transpose();
    EXPECT_TRUE(world.overlapped(*out).empty()) << row.from.transpose();
  }
  EXPECT_FALSE(world.way_out({0.3, 1.4}, 0.7)) << "it is 0.725 m long";
  EXPECT_FALSE(world.way_out({0, 3}, 10)) << "it is inside of nothing";
}

TEST(ExactWayOut, passes_beside_what_stands_in_the_straight_way) {
  // A crate in the block, above the octagon: the way up passes beside its corner.
  const ExactScenery world(scenery({box(-5, -10, 5, 0), box(-0.1, -0.9, 0.1, -0.8)}), octagon());
  const Vec2d from{0, -2};
  const std::optional<Vec2d> out = world.way_out(from, 10);
  ASSERT_TRUE(out);
  // Seen by the position, the crate is larger by the octagon: the right corner of its lower side is at (0.25625,
  // -1.525), the one above it at (0.4125, -1.2125). The steepest way past both ends at the level where it is free.
  const double rise = half_height - from.y();
  const double slope = std::max(0.25625 / (2 - 1.525), 0.4125 / (2 - 1.2125));
  EXPECT_NEAR((*out - from).norm(), rise * std::sqrt(1 + slope * slope), kept);
  EXPECT_NEAR(out->y(), half_height, kept);
}

TEST(ExactWayOut, is_none_where_walls_leave_no_room) {
  // A block that the four around it leave no room beside; and the same with a gap in one of them.
  const std::vector<ColliderDef> closed{box(-2, -2, 2, 2), box(-3, -3, -2.5, 3), box(2.5, -3, 3, 3),
                                        box(-2.5, -3, 2.5, -2.5), box(-2.5, 2.5, 2.5, 3)};
  EXPECT_FALSE(ExactScenery(scenery(closed), octagon()).way_out({0.5, 1}, 100));
  std::vector<ColliderDef> open = closed;
  open.back() = box(-2.5, 2.5, 0, 3);
  const std::optional<Vec2d> out = ExactScenery(scenery(open), octagon()).way_out({0.5, 1}, 100);
  ASSERT_TRUE(out);
  EXPECT_LE((*out - Vec2d{0.5, 2 + half_height}).norm(), kept);
}

TEST(ExactWayOut, does_not_pass_a_solid_however_thin) {
  const std::vector<ColliderDef> colliders{box(-2, -1.5, 2, 1.5), chain({{-9, 2}, {9, 2}})};
  const ExactScenery world(scenery(colliders), octagon());
  const std::optional<Vec2d> out = world.way_out({1.1, 1.3}, 10);
  ASSERT_TRUE(out);
  EXPECT_LE((*out - Vec2d{2 + half_width, 1.3}).norm(), kept);
}

TEST(ExactWayOut, passes_a_one_way_segment_along_its_normal_only) {
  for (const bool up : {true, false}) {
    // The segment lies above the octagon, in the block.
    const ExactScenery world(scenery({box(-2, -1.5, 2, 1.5), chain({{-9, 1.4}, {9, 1.4}}, Vec2d{0, up ? 1 : -1})}),
                             octagon());
    const std::optional<Vec2d> out = world.way_out({0.2, 0.5}, 10);
    ASSERT_TRUE(out);
    const Vec2d nearest = up ? Vec2d{0.2, 1.5 + half_height} : Vec2d{2 + half_width, 0.5};
    EXPECT_LE((*out - nearest).norm(), kept) << up;
  }
}

TEST(ExactWayOut, takes_movers_where_they_are_at_the_moment) {
  // A lid lies on the block at the step's start, and is gone at its end.
  std::vector<ColliderDef> colliders{box(-2, -1.5, 2, 1.5), box(-9, 1.5, 9, 1.6)};
  colliders[1].mover = 0;
  const ExactScenery world(scenery(colliders), octagon());
  const std::vector<MoverMotion<double>> movers{{{0, 0}, {0, 20}}};
  const Vec2d from{0.3, 0.8};
  const std::optional<Vec2d> at_first = world.way_out(Place(from, movers, 0), 10);
  ASSERT_TRUE(at_first);
  EXPECT_LE((*at_first - Vec2d{2 + half_width, 0.8}).norm(), kept);
  const std::optional<Vec2d> at_last = world.way_out(Place(from, movers, 1), 10);
  ASSERT_TRUE(at_last);
  EXPECT_LE((*at_last - Vec2d{0.3, 1.5 + half_height}).norm(), kept);
}

/// The same by trial: the nearest of many places in many directions.
std::optional<double> nearest_by_trial(const ExactScenery& world, const Vec2d& from, double reach) {
  constexpr int directions = 64;
  constexpr double stride = 0.03;
  const std::vector<ColliderIndex> inside = world.overlapped(from);
  std::optional<double> nearest;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * 3.14159265358979 * k / directions;
    const Vec2d way{std::cos(angle), std::sin(angle)};
    for (double distance = stride; distance < std::min(reach, nearest.value_or(reach)); distance += stride) {
      const Vec2d end = from + way * distance;
      const std::vector<ColliderIndex> met = world.met(from, end);
      if (!std::includes(inside.begin(), inside.end(), met.begin(), met.end())) break;
      if (world.overlapped(end).empty()) nearest = distance;
    }
  }
  return nearest;
}

TEST(ExactWayOut, is_found_wherever_trial_finds_one_and_never_longer) {
  constexpr std::uint64_t seed = 50;
  Random random(seed);
  int found = 0;
  int none = 0;
  constexpr int cases = paperproof::test::sampled(100);
  for (int round = 0; found + none < cases; ++round) {
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
    const ExactScenery world(scenery(colliders), octagon());
    const Vec2d from = random.point(1.5);
    const std::vector<ColliderIndex> inside = world.overlapped(from);
    if (inside.empty()) continue;
    const std::optional<Vec2d> out = world.way_out(from, 10);
    const std::optional<double> by_trial = nearest_by_trial(world, from, 10);
    (out ? found : none) += 1;
    if (out) {
      EXPECT_TRUE(world.overlapped(*out).empty()) << "seed " << seed << " round " << round;
      const std::vector<ColliderIndex> met = world.met(from, *out);
      EXPECT_TRUE(std::includes(inside.begin(), inside.end(), met.begin(), met.end()))
          << "seed " << seed << " round " << round;
    }
    if (!by_trial) continue;
    ASSERT_TRUE(out) << "seed " << seed << " round " << round << ": trial finds one of " << *by_trial;
    EXPECT_LE((*out - from).norm(), *by_trial + kept) << "seed " << seed << " round " << round;
  }
  EXPECT_GT(found, cases * 2 / 5);
  EXPECT_GT(none, cases / 25);
}

/// Teeth around a disk: outside `outer`, and down to `inner` between them [m].
std::vector<Vec2d> gear(int teeth, double inner, double outer) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < 2 * teeth; ++i) {
    const double r = i % 2 == 0 ? inner : outer;
    const double angle = 3.14159265358979 * i / teeth;
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return ring;
}

TEST(ExactWayOut, of_a_large_gear_is_over_its_teeth) {
  // So many teeth that the octagon does not fit between them, and a paper ring in it that leaves one opening.
  std::vector<Vec2d> ring;
  for (double angle = 0.2; angle < 2 * 3.14159265358979 - 0.2; angle += 0.1) {
    ring.emplace_back(5 * std::cos(angle), 5 * std::sin(angle));
  }
  const std::vector<ColliderDef> colliders{polygon(gear(500, 7, 8)), chain(ring)};
  const ExactScenery world(scenery(colliders), octagon());
  const std::optional<Vec2d> out = world.way_out({0, 0}, 100);
  ASSERT_TRUE(out);
  EXPECT_TRUE(world.overlapped(*out).empty());
  // The opening is to the right, and the octagon is half as wide as high.
  EXPECT_NEAR(out->x(), 8 + half_width, 0.05);
  EXPECT_FALSE(world.way_out({0, 0}, 8.2));
}

}  // namespace
}  // namespace paperproof::compare
