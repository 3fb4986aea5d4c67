/// The grid: squares out of scenery, and a character that is always in exactly one of them. How it begins and ends a
/// move is in tests/situations/techniques.json, and that a copy of its state goes on alike in replay_test.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "techniques/grid/squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace paperproof::stepping {
namespace {

using grid::Squares;

constexpr double tolerance = Tolerances{}.touch;

TEST(Squares, are_solid_where_a_polygon_with_bays_and_holes_is_and_name_the_first_collider) {
  // Five by four, a bay of two squares from the top, and a hole of one; a second one fills the bay and goes on.
  ColliderDef polygon{.points = {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 2}, {3, 2}, {3, 4}, {0, 4}}};
  polygon.holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  for (const double side : {1.0, 0.5}) {
    const Squares squares(SceneryDef{{polygon, box(3, 3, 6, 4)}}, side, tolerance);
    for (int column = -2; column < 14; ++column) {
      for (int row = -2; row < 10; ++row) {
        const double x = std::floor(column * side);
        const double y = std::floor(row * side);
        const bool open = (x == 3 && y >= 2) || (x == 1 && y == 1);
        const bool first = x >= 0 && x < 5 && y >= 0 && y < 4 && !open;
        const bool second = x >= 3 && x < 6 && y == 3;
        const std::optional<ColliderIndex> found = squares.collider_at({column, row});
        EXPECT_EQ(found.has_value(), first || second) << column << ", " << row;
        EXPECT_EQ(found.value_or(0), first || !second ? 0U : 1U) << column << ", " << row;
      }
    }
    EXPECT_EQ(squares.memory_bytes(), static_cast<std::size_t>(6 * 4 / side / side) * sizeof(ColliderIndex));
  }
}

TEST(Squares, are_refused_with_the_reason_where_scenery_is_not_made_of_them) {
  const auto refusal = [](const ColliderDef& collider, double side = 1) {
    return refusal_by<NotExpressible>([&] { Squares(SceneryDef{{box(0, 0, 1, 1), collider}}, side, tolerance); });
  };
  const std::string not_whole = ": collider 1 is not made of whole squares of 1 m";
  EXPECT_EQ(refusal({.points = {{0, 0}, {2, 0}, {2, 1}}}), "the grid cannot express a slope" + not_whole);
  EXPECT_EQ(refusal(chain({{0, 0}, {1, 0}})), "the grid cannot express a chain" + not_whole);
  const std::string between = "the grid cannot express an edge between two squares" + not_whole;
  EXPECT_EQ(refusal(box(0, 0, 1.5, 1)), between);
  ColliderDef holed = box(0, 0, 3, 3);
  holed.holes = {{{1, 1}, {2, 1}, {2, 1.5}, {1, 1.5}}};
  EXPECT_EQ(refusal(holed), between);
  EXPECT_EQ(refusal(holed, 0.5), "");
  EXPECT_EQ(refusal(box(0, 0, 1 + tolerance / 2, 1)), "") << "a touch is no edge of its own";
  EXPECT_NE(refusal(box(1e6, 1e6, 1e6 + 1, 1e6 + 1)), "") << "a million squares each way";
}

TEST(GridMoves, go_in_one_of_four_directions_and_never_into_a_solid_square) {
  Random random(31);
  std::vector<ColliderDef> tiles;
  std::set<std::pair<int, int>> solid;
  for (int column = 0; column < 24; ++column) {
    for (int row = 0; row < 24; ++row) {
      const bool border = column == 0 || row == 0 || column == 23 || row == 23;
      const bool start = column == 12 && row == 12;
      if (start || (!border && random.below(4) != 0)) continue;
      tiles.push_back(box(column, row, column + 1, row + 1));
      solid.insert({column, row});
    }
  }
  // As large as a square, so that its centre is the position.
  Stepper walk(tiles, of_shape(CharacterShape(box(-0.5, -0.5, 0.5, 0.5).points)), "grid");
  walk.gravity = {0, 0};
  walk.dt = 1.0 / 64;
  walk.at(12.5, 12.5).report.reserve(16);
  std::array<bool, 576> visited{};
  int moves = 0;
  int contacts = 0;
  Vec2d wanted{0, 0};
  const std::size_t before_all = tests::allocations();
  for (int step = 0; step < 100'000; ++step) {
    if (step % 20 == 0) wanted = random.point(1.5);
    const Vec2d before = walk.state.position;
    walk.with_velocity(wanted.x() / walk.dt, wanted.y() / walk.dt).step();
    contacts += walk.report.move.contacts.empty() ? 0 : 1;
    const double way = (walk.state.position - before).cwiseAbs().sum();
    ASSERT_TRUE(way == 0 || way == 1) << "seed 31, step " << step;
    const std::pair here{static_cast<int>(std::floor(walk.state.position.x())),
                         static_cast<int>(std::floor(walk.state.position.y()))};
    ASSERT_FALSE(solid.contains(here)) << "seed 31, step " << step;
    moves += way == 0 ? 0 : 1;
    visited.at(static_cast<std::size_t>(24 * here.first + here.second)) = true;
  }
  EXPECT_GT(moves, 10'000);
  EXPECT_GT(contacts, 30'000);
  EXPECT_LT(contacts, 98'000);
  EXPECT_EQ(tests::allocations(), before_all);
  EXPECT_GT(std::ranges::count(visited, true), 100);
}

}  // namespace
}  // namespace paperproof::stepping
