/// Discrete collision detection: impacts, islands, their order, and the technique made of them.
#include "controller/discrete_support.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace paperproof::article_tests {
namespace {

using discrete::BodyIndex;
using discrete::find_impact;

constexpr double gap = Tolerances<double>{}.stop;
constexpr double touch = Tolerances<double>{}.touch;
constexpr std::string_view kind = "discrete";
constexpr double half_width = 10 * px;
constexpr double half_height = 20 * px;

TEST(DiscreteImpact, of_two_boxes_is_when_the_later_of_the_two_gaps_closes) {
  constexpr std::uint64_t seed = 51;
  Random random(seed);
  int hits = 0;
  int moving_apart_or_free = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bodies<double> bodies;
    const Vec2d size_a{random.between(0.2, 2), random.between(0.2, 2)};
    const Vec2d size_b{random.between(0.2, 2), random.between(0.2, 2)};
    const Vec2d start{random.between(-3, 3), random.between(-3, 3)};
    const Vec2d end{random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
    const Vec2d of_b{random.between(-5, 5), random.between(-5, 5)};
    bodies.add_box(size_a, start, end - start + of_b);
    bodies.add_box(size_b, {0, 0}, of_b);
    const Vec2d reach = (size_a + size_b) / 2;
    if ((start.cwiseAbs() - reach).maxCoeff() < 0.001) continue;  // overlapping from the start, or nearly
    if ((end.cwiseAbs() - reach).cwiseAbs().minCoeff() < 1e-9) continue;
    const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
    const bool overlaps = (end.cwiseAbs() - reach).maxCoeff() < 0;
    ASSERT_EQ(impact.has_value(), overlaps) << "seed 51, case " << i;
    ++(overlaps ? hits : moving_apart_or_free);
    if (!overlaps) continue;
    // Along each axis the gap |start| - reach is closed at the speed |end - start|, where there was one.
    double last = -1;
    for (const Eigen::Index axis : {0, 1}) {
      const double open = std::abs(start[axis]) - reach[axis];
      if (open > 0) last = std::max(last, open / std::abs(end[axis] - start[axis]));
    }
    ASSERT_NEAR(impact->time, last, 1e-9) << "seed 51, case " << i;
    ASSERT_NEAR(impact->normal.norm(), 1, 1e-15);
  }
  EXPECT_GT(hits, 20'000 * 3 / 10);
  EXPECT_GT(moving_apart_or_free, 20'000 * 2 / 10);
}

std::vector<Vec2d> convex_outline(Random& random) {
  const int corners = 3 + random.below(5);
  const double turn = random.between(0, 6.28);
  std::vector<Vec2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 6.283185 * (i + random.between(0, 0.7)) / corners;
    outline.emplace_back(std::cos(angle), std::sin(angle));
  }
  return outline;
}

TEST(DiscreteImpact, of_convex_outlines_is_when_they_begin_to_overlap) {
  constexpr std::uint64_t seed = 52;
  Random random(seed);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    Bodies<double> bodies;
    const Vec2d start{random.between(-4, 4), random.between(-4, 4)};
    const Vec2d end{random.between(-1, 1), random.between(-1, 1)};
    bodies.add(convex_outline(random), start, end - start);
    bodies.add(convex_outline(random), {0, 0});
    const auto overlap_at = [&](double time) {
      auto moved = bodies.all[0];
      moved.position = start + (end - start) * time;
      return discrete::began_overlapping(moved, bodies.all[1], 0.0);
    };
    if (discrete::began_overlapping(bodies.all[0], bodies.all[1], 0.0)) continue;
    const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
    ASSERT_EQ(impact.has_value(), overlap_at(1)) << "seed 52, case " << i;
    if (!impact) continue;
    ++hits;
    ASSERT_FALSE(overlap_at(impact->time - 1e-9)) << "seed 52, case " << i;
    ASSERT_TRUE(overlap_at(std::min(1.0, impact->time + 1e-9)) || impact->time > 1 - 2e-9) << "seed 52, case " << i;
  }
  EXPECT_GT(hits, 3000);
}

TEST(DiscreteImpact, is_not_found_where_a_body_is_passed) {
  Bodies<double> bodies;
  bodies.add_box({1, 1}, {0, 3}, {0, -6});
  bodies.add_static_box({9, 0.5}, {0, 0});
  EXPECT_FALSE(find_impact(bodies.all[0], bodies.all[1], touch));
  bodies.all[0].movement.y() = -3;
  const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
  ASSERT_TRUE(impact);
  EXPECT_DOUBLE_EQ(impact->time, (3 - 0.5 - 0.25) / 3);
  EXPECT_EQ(impact->normal, Vec2d(0, 1));
  EXPECT_DOUBLE_EQ(impact->depth, 0.5 + 0.25);
  EXPECT_EQ(impact->point, Vec2d(0, 0.25));
}

TEST(DiscreteIslands, are_apart_where_total_boxes_are_and_static_bodies_join_none) {
  Bodies<double> bodies;
  bodies.add_static_box({100, 1}, {0, -0.5});                               // 0: under everything
  for (const double x : {0.0, 0.9, 1.8}) bodies.add_box({1, 1}, {x, 0.5});  // 1 2 3: a chain of neighbours
  bodies.add_box({1, 1}, {10, 0.5}, {3, 0});                                // 4: its total box reaches 5
  bodies.add_box({1, 1}, {13.9, 0.5});                                      // 5
  bodies.add_box({1, 1}, {20, 0.5});                                        // 6: alone
  auto solver = make_solver();
  solver.solve_once(bodies.all);
  const std::array<BodyIndex, 7> expected{0, 1, 1, 1, 4, 4, 6};
  for (BodyIndex body = 0; body < expected.size(); ++body) EXPECT_EQ(solver.island_of(body), expected[body]) << body;
}

TEST(DiscreteIslands, of_many_bodies_are_those_of_a_flood_over_overlapping_boxes) {
  constexpr std::uint64_t seed = 53;
  Random random(seed);
  int joined = 0;
  for (int scene = 0; scene < 300; ++scene) {
    // So few that each is looked at, or so many that they are swept; the field is as dense.
    const BodyIndex count = scene % 2 == 0 ? 40 : 90;
    const double half = scene % 2 == 0 ? 8 : 12;
    Bodies<double> bodies;
    for (BodyIndex i = 0; i < count; ++i) {
      const Vec2d middle{random.between(-half, half), random.between(-half, half)};
      auto& body = bodies.add_box({1, 1}, middle, {random.between(-1, 1), random.between(-1, 1)});
      if (random.below(5) == 0) body.inverse_mass = 0;
    }
    std::vector<Box2<double>> boxes;
    for (const auto& body : bodies.all) boxes.push_back(body.total_box());
    std::vector<BodyIndex> labels(count);
    for (BodyIndex i = 0; i < count; ++i) labels[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (BodyIndex i = 0; i < count; ++i) {
        for (BodyIndex j = 0; j < count; ++j) {
          const bool both = bodies.all[i].can_be_moved() && bodies.all[j].can_be_moved();
          if (!both || !boxes[i].overlaps(boxes[j]) || labels[i] <= labels[j]) continue;
          labels[i] = labels[j];
          changed = true;
        }
      }
    }
    auto solver = make_solver();
    solver.solve_once(bodies.all);
    for (BodyIndex i = 0; i < count; ++i) {
      ASSERT_EQ(solver.island_of(i), labels[i]) << "seed 53, scene " << scene << ", body " << i;
      joined += labels[i] != i ? 1 : 0;
    }
  }
  EXPECT_GT(joined, 300 * 65 / 4);
  EXPECT_LT(joined, 300 * 65 * 3 / 4);
}

TEST(DiscreteOrder, is_that_of_the_times_of_impact_within_an_island) {
  // The mover is expected to end in all three boxes, of which the last, whose top is the highest, is met first.
  Bodies<double> bodies;
  bodies.add_static_box({1, 1}, {0, -2.5});
  bodies.add_static_box({1, 1}, {0, -2});
  bodies.add_static_box({1, 1}, {0, -1.5});
  bodies.add_box({1, 1}, {0, 1}, {0, -3});
  for (BodyIndex i = 0; i < 3; ++i) ASSERT_TRUE(find_impact(bodies.all[3], bodies.all[i], touch));
  auto solver = make_solver();
  ASSERT_TRUE(solver.solve_once(bodies.all));
  ASSERT_EQ(solver.solved().size(), 1U) << "after the first impact there is no other";
  EXPECT_EQ(solver.solved()[0].bodies.second, 2U);
  EXPECT_DOUBLE_EQ(solver.solved()[0].impact.time, (1 - 0.5 - -1.0) / 3);
  EXPECT_DOUBLE_EQ(bodies.all[3].expected().y(), -0.5 + gap);
  EXPECT_FALSE(solver.solve_once(bodies.all)) << "nothing is left";
}

TEST(DiscreteOrder, of_all_solved_impacts_rises_within_each_island) {
  constexpr std::uint64_t seed = 54;
  Random random(seed);
  int impacts = 0;
  int out_of_order_before_solving = 0;
  for (int scene = 0; scene < 1000; ++scene) {
    Bodies<double> bodies;
    for (int i = 0; i < 30; ++i) {
      const Vec2d middle{random.between(-6, 6), random.between(-6, 6)};
      bodies.add_box({0.5, 0.5}, middle, {random.between(-1, 1), random.between(-1, 1)});
    }
    const std::vector<Bodies<double>::Body> before = bodies.all;
    auto solver = make_solver();
    solver.solve_once(bodies.all);
    const auto planned_time = [&](const discrete::SolvedImpact<double>& each) {
      return find_impact(before[each.bodies.first], before[each.bodies.second], touch)->time;
    };
    const auto solved = solver.solved();
    impacts += static_cast<int>(solved.size());
    for (std::size_t i = 1; i < solved.size(); ++i) {
      const BodyIndex island = solver.island_of(solved[i].bodies.first);
      const BodyIndex last = solver.island_of(solved[i - 1].bodies.first);
      ASSERT_LE(last, island);
      if (last == island) {
        ASSERT_LE(planned_time(solved[i - 1]), planned_time(solved[i])) << "seed 54, scene " << scene;
        out_of_order_before_solving += solved[i - 1].bodies.first > solved[i].bodies.first ? 1 : 0;
      }
    }
  }
  EXPECT_GT(impacts, 1000);
  EXPECT_GT(out_of_order_before_solving, 50) << "the order must not be that of the indices anyway";
}

TEST(DiscretePush, keeps_the_momentum_and_the_centre_of_mass_of_what_can_move) {
  constexpr std::uint64_t seed = 55;
  Random random(seed);
  int solved = 0;
  for (int i = 0; i < 2000; ++i) {
    Bodies<double> bodies;
    for (int body = 0; body < 6; ++body) {
      const Vec2d middle{random.between(-2, 2), random.between(-2, 2)};
      auto& added = bodies.add_box({1, 1}, middle, {random.between(-1, 1), random.between(-1, 1)});
      added.inverse_mass = random.between(0.1, 10);
    }
    const auto sums = [&] {
      Vec2d momentum{0, 0};
      Vec2d centre{0, 0};
      for (const auto& body : bodies.all) {
        momentum += body.velocity / body.inverse_mass;
        centre += body.expected() / body.inverse_mass;
      }
      return std::pair(momentum, centre);
    };
    const auto before = sums();
    auto solver = make_solver();
    solved += solver.solve(bodies.all, 8);
    const auto after = sums();
    ASSERT_LE((after.first - before.first).norm(), 1e-12) << "seed 55, case " << i;
    ASSERT_LE((after.second - before.second).norm(), 1e-12) << "seed 55, case " << i;
  }
  EXPECT_GT(solved, 2000);
}

TEST(DiscretePush, makes_equal_bodies_share_and_a_static_one_stay) {
  Bodies<double> bodies;
  bodies.add_box({1, 1}, {-1, 0}, {0.25, 0});
  bodies.add_box({1, 1}, {1, 0}, {-1.25, 0});
  auto solver = make_solver();
  ASSERT_EQ(solver.solve(bodies.all, 9), 1);
  // They end a width apart, in the middle of where they were expected, at the mean of their velocities.
  const double middle = (-0.75 - 0.25) / 2;
  EXPECT_NEAR(bodies.all[0].expected().x(), middle - 0.5 - gap / 2, 1e-15);
  EXPECT_NEAR(bodies.all[1].expected().x(), middle + 0.5 + gap / 2, 1e-15);
  EXPECT_DOUBLE_EQ(bodies.all[0].velocity.x(), -0.5);
  EXPECT_DOUBLE_EQ(bodies.all[1].velocity.x(), -0.5);
}

template <class Scalar>
class DiscreteTechnique : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DiscreteTechnique, Scalars, );

TYPED_TEST(DiscreteTechnique, lands_with_a_gap_and_keeps_its_motion_along_the_ground) {
  using Scalar = TypeParam;
  Rig<Scalar> rig(kind, {rectangle(-9, -2, 9, 0)});
  const MoveResult<Scalar>& result = rig.move({0, half_height + 0.25}, {0.5, -1});
  constexpr Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon();
  EXPECT_NEAR(result.position.y(), static_cast<Scalar>(half_height) + Tolerances<Scalar>{}.stop, rounding);
  EXPECT_NEAR(result.position.x(), Scalar(0.5), rounding);
  EXPECT_EQ(result.velocity, Vec2<Scalar>(Scalar(0.5), 0));
  EXPECT_TRUE(result.grounded);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_NEAR(result.contacts[0].fraction, Scalar(0.25), rounding);
  EXPECT_EQ(result.contacts[0].normal, Vec2<Scalar>(0, 1));
  EXPECT_NEAR(result.contacts[0].point.y(), Scalar(0), rounding);
  EXPECT_NEAR(result.contacts[0].point.x(), Scalar(0.125), rounding) << "under the feet when they met";
  EXPECT_NEAR(result.contacts[0].separation, Tolerances<Scalar>{}.stop, rounding);
}

TYPED_TEST(DiscreteTechnique, passes_paper_at_speed_and_stops_on_it_when_slow) {
  using Scalar = TypeParam;
  Rig<Scalar> rig(kind, {rectangle(-2, -35.5 * px, 2, -30.5 * px)}, {}, single_pixel());
  EXPECT_EQ(rig.move({0, 0}, {0, -50 * px}).position.y(), Scalar(-50 * px));
  EXPECT_TRUE(rig.result.contacts.empty());
  EXPECT_NEAR(rig.move({0, 0}, {0, -32 * px}).position.y(), Scalar(-30 * px), 2 * Tolerances<Scalar>{}.stop);
  EXPECT_EQ(rig.result.contacts.size(), 1U);
}

/// @return the lowest speed after a step of a walk over flush tiles, as a share of the one that was set.
double slowest_on_flush_tiles(double speed) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 40; ++i) tiles.push_back(rectangle(i, -1, i + 1, 0));
  Rig<double> rig(kind, tiles);
  Walker walker{.position = {1, half_height}};
  double slowest = 1;
  while (walker.position.x() < 38 && slowest > 0) {
    walker.velocity.x() = speed;
    slowest = std::min(slowest, walker.step(rig).velocity.x() / speed);
  }
  return slowest;
}

TEST(Discrete, does_not_snag_on_flush_tiles_because_the_tile_stood_on_is_met_first) {
  // Alone, the next tile would be hit from the side: gravity takes the feet below its top before they reach it.
  constexpr int speeds = test::sampled(100);
  for (int i = 1; i <= speeds; ++i) {
    const double speed = 20.0 * i / speeds - 0.05;
    EXPECT_NEAR(slowest_on_flush_tiles(speed), 1, 1e-12) << speed;
  }
}

/// Whether a walk from x = 1 over flush tiles comes, in a step, from wholly on one tile to wholly beyond it. Nothing
/// where a gap decides it.
std::optional<bool> oversteps_a_tile(double speed) {
  const Walker walker;
  const double way = speed * walker.dt;
  const double sunk = walker.gravity * walker.dt * walker.dt;  // at the end of a step, below the tiles' tops
  const double half_foot = 5 * px;
  const double half_at_the_end = half_foot + sunk / 2;  // at the tops: the flanks go 10 px up and 5 px out
  // What is reached before the gap to the tiles below has closed is met from above.
  const double band = 2 * gap * std::max(1.0, way / sunk);
  bool any = false;
  for (double x = 1; x < 38; x += way)
    for (int end = 2; end < 40; ++end) {
      const double before = end - (x + half_foot);           // of the front of the feet
      const double after = x + way - half_at_the_end - end;  // of their back
      if (before < -band || after < -band) continue;
      if (before < band || after < band) return std::nullopt;
      any = true;
    }
  return any;
}

TEST(Discrete, snags_where_the_feet_have_left_the_tile_when_the_step_ends) {
  // The feet are 10 px long: above 20 m/s they can be on a tile when a step of 1/64 s begins, and beyond it at its end.
  // The tile that bore them is then not looked at, and the next one is met from the side.
  const double all_of_the_feet = 10 * px * 64;
  int snagged = 0;
  int passed = 0;
  for (int i = 1; i <= 50; ++i) {
    const double speed = all_of_the_feet + 0.037 * i;
    const std::optional<bool> expected = oversteps_a_tile(speed);
    if (!expected) continue;
    EXPECT_EQ(slowest_on_flush_tiles(speed) < 0.99, *expected) << speed;
    ++(*expected ? snagged : passed);
  }
  EXPECT_GE(snagged, 5);
  EXPECT_GE(passed, 5);
}

TEST(Discrete, slides_along_a_slope_and_keeps_its_gap) {
  const ColliderDef slope{.points = {{-9, -9}, {9, -9}, {9, 9}}};
  Rig<double> rig(kind, {slope});
  const MoveResult<double>& result = rig.move({0, 1.5}, {0, -1});
  // Of the octagon's corners (5, -20) px is the first to meet the surface y = x: its x - y is the largest.
  const double above = 1.5 - 1 - (5 + 20) * px;  // of the expected end over the surface, along y
  ASSERT_LT(above, 0);
  const Vec2d normal = Vec2d{-1, 1} / std::sqrt(2.0);
  const Vec2d expected = Vec2d{0, 0.5} + normal * (-above / std::sqrt(2.0) + gap);
  EXPECT_LE((result.position - expected).norm(), 1e-12);
  EXPECT_LE((result.velocity - Vec2d{-0.5, -0.5}).norm(), 1e-12) << "half of the fall is along the slope";
}

TEST(Discrete, rests_with_a_contact_in_every_step_and_does_not_creep) {
  Rig<double> rig(kind, {rectangle(-3, -2, 3, 0.1)});
  Walker walker{.position = {0.1, 1}};
  for (int step = 0; step < 200; ++step) walker.step(rig);
  double lowest = walker.position.y();
  double highest = lowest;
  for (int step = 0; step < 10'000; ++step) {
    ASSERT_TRUE(walker.step(rig).grounded);
    lowest = std::min(lowest, walker.position.y());
    highest = std::max(highest, walker.position.y());
  }
  EXPECT_EQ(walker.position.x(), 0.1);
  EXPECT_LE(highest - lowest, 1e-15) << "the article's jitter, down to rounding";
}

TEST(Discrete, meets_a_one_way_ledge_only_from_the_side_of_its_normal) {
  Rig<double> rig(kind, {chain({{-3, 0}, {3, 0}}, Vec2d{0, 1})});
  EXPECT_NEAR(rig.move({0, half_height + 0.25}, {0, -0.5}).position.y(), half_height + gap, 1e-12);
  EXPECT_EQ(rig.move({0, -1}, {0, 1}).position.y(), 0) << "upwards it is not there";
  EXPECT_EQ(rig.move({0, 0}, {0.5, -0.25}).position, Vec2d(0.5, -0.25)) << "nor from within";
  Rig<double> both(kind, {chain({{-3, 0}, {3, 0}})});
  EXPECT_NEAR(both.move({0, -1}, {0, 1}).position.y(), -half_height - gap, 1e-12);
}

TEST(Discrete, begins_inside_and_comes_out_the_nearest_way_or_is_stuck) {
  Rig<double> rig(kind, {rectangle(-5, -5, 5, 0)});
  const MoveResult<double>& out = rig.move({0, half_height - 0.125}, {0, 0});
  EXPECT_EQ(out.status, MoveStatus::moved);
  EXPECT_NEAR(out.position.y(), half_height + gap, 1e-12);
  Rig<double> narrow(kind, {rectangle(-5, -5, 0.1, 5), rectangle(-0.1, -5, 5, 5)});
  EXPECT_EQ(narrow.move({0, 0}, {0, 0}).status, MoveStatus::stuck);
}

TEST(Discrete, comes_to_rest_in_a_corner_of_two_pieces) {
  Rig<double> rig(kind, {rectangle(-9, -2, 9, 0), rectangle(1, 0, 3, 9)});
  const MoveResult<double>& result = rig.move({0, 1}, {1.5, -0.75});
  EXPECT_NEAR(result.position.x(), 1 - half_width - gap, 1e-12);
  EXPECT_NEAR(result.position.y(), half_height + gap, 1e-12);
  EXPECT_EQ(result.velocity, Vec2d(0, 0));
  EXPECT_EQ(result.contacts.size(), 2U);
}

TEST(Discrete, takes_no_memory_while_moving) {
  Random random(56);
  std::vector<ColliderDef> level;
  for (int i = 0; i < 300; ++i) {
    const double x = random.between(-9, 9);
    const double y = random.between(-9, 9);
    level.push_back(rectangle(x, y, x + 0.5, y + 0.5));
  }
  Rig<double> rig(kind, level);
  const std::size_t before = tests::allocations();
  int contacts = 0;
  for (int step = 0; step < 5000; ++step) {
    const Vec2d start{random.between(-9, 9), random.between(-9, 9)};
    contacts += rig.move(start, {random.between(-9, 9), random.between(-9, 9)}).contacts.empty() ? 0 : 1;
  }
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_GT(contacts, 1000);
}

}  // namespace
}  // namespace paperproof::article_tests
