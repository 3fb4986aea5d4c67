/// Discrete collision detection: impacts, islands, their order, and the technique made of them.
#include "controller/discrete_support.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace paperproof::article_tests {
namespace {

using discrete::BodyIndex;
using discrete::find_impact;

constexpr double gap = Tolerances<double>{}.stop;
constexpr double touch = Tolerances<double>{}.touch;
constexpr std::string_view kind = "discrete";

TEST(DiscreteImpact, of_two_boxes_is_when_the_later_of_the_two_gaps_closes) {
  Random random(51);
  int hits = 0;
  int others = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bodies<double> bodies;
    const Vec2d size_a{random.between(0.2, 2), random.between(0.2, 2)};
    const Vec2d size_b{random.between(0.2, 2), random.between(0.2, 2)};
    const Vec2d start = random.point(3);
    const Vec2d end = random.point(1.5);
    const Vec2d of_b = random.point(5);
    bodies.add_box(size_a, start, end - start + of_b);
    bodies.add_box(size_b, {0, 0}, of_b);
    const Vec2d reach = (size_a + size_b) / 2;
    if ((start.cwiseAbs() - reach).maxCoeff() < 0.001) continue;  // overlapping from the start, or nearly
    if ((end.cwiseAbs() - reach).cwiseAbs().minCoeff() < 1e-9) continue;
    const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
    const bool overlaps = (end.cwiseAbs() - reach).maxCoeff() < 0;
    ASSERT_EQ(impact.has_value(), overlaps) << "seed 51, case " << i;
    ++(overlaps ? hits : others);
    if (!overlaps) continue;
    // Along each axis the gap |start| - reach is closed at the speed |end - start|, where there was one.
    double last = -1;
    for (const Eigen::Index axis : {0, 1}) {
      const double open = std::abs(start[axis]) - reach[axis];
      if (open > 0) last = std::max(last, open / std::abs(end[axis] - start[axis]));
    }
    ASSERT_NEAR(impact->time, last, 1e-9) << "seed 51, case " << i;
    ASSERT_NEAR(impact->normal.norm(), 1, 1e-15) << "seed 51, case " << i;
  }
  EXPECT_GT(hits, 20'000 * 3 / 10);
  EXPECT_GT(others, 20'000 * 2 / 10);
}

TEST(DiscreteImpact, of_convex_outlines_is_when_they_begin_to_overlap) {
  Random random(52);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    Bodies<double> bodies;
    const Vec2d start = random.point(4);
    const Vec2d end = random.point(1);
    bodies.add(on_an_ellipse(random, {0, 0}, {1, 1}), start, end - start);
    bodies.add(on_an_ellipse(random, {0, 0}, {1, 1}), {0, 0});
    const auto overlap_at = [&](double time) {
      auto moved = bodies.all[0];
      moved.position = start + (end - start) * time;
      return discrete::began_overlapping(moved, bodies.all[1], 0.0);
    };
    if (overlap_at(0)) continue;
    const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
    ASSERT_EQ(impact.has_value(), overlap_at(1)) << "seed 52, case " << i;
    if (!impact) continue;
    ++hits;
    ASSERT_FALSE(overlap_at(impact->time - 1e-9)) << "seed 52, case " << i;
    ASSERT_TRUE(overlap_at(std::min(1.0, impact->time + 1e-9)) || impact->time > 1 - 2e-9) << "seed 52, case " << i;
  }
  EXPECT_GT(hits, 3000);
}

TEST(DiscreteImpact, has_the_depth_and_the_point_of_where_the_frame_ends) {
  Bodies<double> bodies;
  bodies.add_box({1, 1}, {0, 3}, {0, -3});
  bodies.add_static_box({9, 0.5}, {0, 0});
  const auto impact = find_impact(bodies.all[0], bodies.all[1], touch);
  ASSERT_TRUE(impact);
  EXPECT_DOUBLE_EQ(impact->time, (3 - 0.5 - 0.25) / 3);
  EXPECT_EQ(impact->normal, Vec2d(0, 1));
  EXPECT_DOUBLE_EQ(impact->depth, 0.5 + 0.25);
  EXPECT_EQ(impact->point, Vec2d(0, 0.25));
}

TEST(DiscreteIslands, of_many_bodies_are_those_of_a_flood_over_overlapping_boxes) {
  Random random(53);
  int joined = 0;
  for (int scene = 0; scene < 300; ++scene) {
    // So few that each is looked at, or so many that they are swept; the field is as dense.
    const BodyIndex count = scene % 2 == 0 ? 40 : 90;
    Bodies<double> bodies;
    for (BodyIndex i = 0; i < count; ++i) {
      auto& body = bodies.add_box({1, 1}, random.point(scene % 2 == 0 ? 8 : 12), random.point(1));
      if (random.below(5) == 0) body.inverse_mass = 0;
    }
    // Each covers half a metre around its way.
    const auto overlap = [&](BodyIndex a, BodyIndex b) {
      const auto& one = bodies.all[a];
      const auto& other = bodies.all[b];
      const Vec2d low = one.position.cwiseMin(one.expected()).cwiseMax(other.position.cwiseMin(other.expected()));
      const Vec2d high = one.position.cwiseMax(one.expected()).cwiseMin(other.position.cwiseMax(other.expected()));
      return one.inverse_mass > 0 && other.inverse_mass > 0 && (low - high).maxCoeff() <= 1;
    };
    std::vector<std::pair<BodyIndex, BodyIndex>> pairs;
    for (BodyIndex i = 0; i < count; ++i)
      for (BodyIndex j = 0; j < i; ++j)
        if (overlap(i, j)) pairs.emplace_back(i, j);
    std::vector<BodyIndex> labels(count);
    for (BodyIndex i = 0; i < count; ++i) labels[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [i, j] : pairs) {
        changed = changed || labels[i] != labels[j];
        labels[i] = labels[j] = std::min(labels[i], labels[j]);
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
  for (const double y : {-2.5, -2.0, -1.5}) bodies.add_static_box({1, 1}, {0, y});
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
  Random random(54);
  int impacts = 0;
  int against_the_indices = 0;
  for (int scene = 0; scene < 1000; ++scene) {
    Bodies<double> bodies;
    for (int i = 0; i < 30; ++i) bodies.add_box({0.5, 0.5}, random.point(6), random.point(1));
    const std::vector<Bodies<double>::Body> before = bodies.all;
    auto solver = make_solver();
    solver.solve_once(bodies.all);
    std::vector<double> latest(before.size());  // of each island
    BodyIndex last = 0;
    for (const discrete::SolvedImpact<double>& each : solver.solved()) {
      const auto [first, second] = each.bodies;
      const double time = find_impact(before[first], before[second], touch)->time;
      double& until_now = latest[solver.island_of(first)];
      ASSERT_LE(until_now, time) << "seed 54, scene " << scene;
      until_now = time;
      against_the_indices += solver.island_of(first) == solver.island_of(last) && first < last ? 1 : 0;
      last = first;
      ++impacts;
    }
  }
  EXPECT_GT(impacts, 1000);
  EXPECT_GT(against_the_indices, 50);
}

TEST(DiscretePush, keeps_the_momentum_and_the_centre_of_mass_of_what_can_move) {
  Random random(55);
  int solved = 0;
  for (int i = 0; i < 2000; ++i) {
    Bodies<double> bodies;
    for (int body = 0; body < 6; ++body)
      bodies.add_box({1, 1}, random.point(2), random.point(1)).inverse_mass = random.between(0.1, 10);
    const auto sums = [&] {
      Eigen::Vector4d of_momentum_and_place = Eigen::Vector4d::Zero();
      for (const auto& body : bodies.all)
        of_momentum_and_place +=
            Eigen::Vector4d(body.velocity.x(), body.velocity.y(), body.expected().x(), body.expected().y()) /
            body.inverse_mass;
      return of_momentum_and_place;
    };
    const Eigen::Vector4d before = sums();
    auto solver = make_solver();
    solved += solver.solve(bodies.all, 8);
    ASSERT_LE((sums() - before).norm(), 1e-12) << "seed 55, case " << i;
  }
  EXPECT_GT(solved, 2000);
}

/// @return the lowest speed after a step of a walk over flush tiles, as a share of the one that was set.
double slowest_on_flush_tiles(double speed) {
  Rig<double> rig(kind, flush_tiles(40));
  Walker walker{.position = {1, half_height}};
  double slowest = 1;
  while (walker.position.x() < 38 && slowest > 0) {
    walker.velocity.x() = speed;
    slowest = std::min(slowest, walker.step(rig).velocity.x() / speed);
  }
  return slowest;
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

TEST(Discrete, snags_on_flush_tiles_only_where_the_feet_have_left_the_tile_when_the_step_ends) {
  // The tile stood on is met before the next one, which would be hit from the side: gravity takes the feet below its
  // top. The feet are 10 px long: above 20 m/s they can be on a tile when a step of 1/64 s begins, and beyond it at its
  // end. The tile that bore them is then not looked at, and the next one is met from the side.
  std::vector<double> speeds;
  for (int i = 1; i <= 50; ++i) speeds.push_back(10 * px * 64 + 0.037 * i);
  for (int i = 1; i <= test::sampled(100); ++i) speeds.push_back(20.0 * i / test::sampled(100) - 0.05);
  int snagged = 0;
  int passed_above = 0;
  for (const double speed : speeds) {
    const std::optional<bool> expected = oversteps_a_tile(speed);
    if (!expected) continue;
    const double slowest = slowest_on_flush_tiles(speed);
    EXPECT_TRUE(*expected ? slowest < 0.99 : slowest > 1 - 1e-12) << speed;
    snagged += *expected ? 1 : 0;
    passed_above += !*expected && speed > 20 ? 1 : 0;
  }
  EXPECT_GE(snagged, 5);
  EXPECT_GE(passed_above, 5);
}

TEST(Discrete, slides_along_a_slope_and_keeps_its_gap) {
  Rig<double> rig(kind, {{.points = {{-9, -9}, {9, -9}, {9, 9}}}});
  const MoveResult<double>& result = rig.move({0, 1.5}, {0, -1});
  // Of the octagon's corners (5, -20) px is the first to meet the surface y = x: its x - y is the largest.
  const double above = 1.5 - 1 - (5 + 20) * px;  // of the expected end over the surface, along y
  const Vec2d normal = Vec2d{-1, 1} / std::sqrt(2.0);
  const Vec2d expected = Vec2d{0, 0.5} + normal * (-above / std::sqrt(2.0) + gap);
  EXPECT_LE((result.position - expected).norm(), 1e-12);
  EXPECT_LE((result.velocity - Vec2d{-0.5, -0.5}).norm(), 1e-12) << "half of the fall is along the slope";
}

TEST(Discrete, begins_inside_and_comes_out_the_nearest_way_or_is_stuck) {
  Rig<double> rig(kind, {rectangle(-5, -5, 5, 0)});
  EXPECT_NEAR(rig.move({0, half_height - 0.125}, {0, 0}).position.y(), half_height + gap, 1e-12);
  EXPECT_EQ(rig.result.status, MoveStatus::moved);
  Rig<double> narrow(kind, {rectangle(-5, -5, 0.1, 5), rectangle(-0.1, -5, 5, 5)});
  EXPECT_EQ(narrow.move({0, 0}, {0, 0}).status, MoveStatus::stuck);
}

}  // namespace
}  // namespace paperproof::article_tests
