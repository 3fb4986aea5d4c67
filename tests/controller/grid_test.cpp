/// The grid: squares out of scenery, and a character that is always in exactly one of them. How it begins and ends a
/// move is in tests/situations/techniques.json.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "techniques/grid/squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace paperproof::article_tests {
namespace {

using grid::Squares;

constexpr double tolerance = Tolerances{}.touch;

/// A square of the side 1 as large as the character, so that its centre is the position.
CharacterShape unit_square() { return CharacterShape(rectangle(-0.5, -0.5, 0.5, 0.5).points); }

Vec2d centre_of(double column, double row) { return {column + 0.5, row + 0.5}; }

/// Hands the remainder on, as the controller does.
struct GridWalk : Rig {
  GridWalk(std::vector<ColliderDef> colliders, const Vec2d& start)
      : Rig("grid", std::move(colliders), {}, unit_square()) {
    this->result.position = start;
    this->request.dt = 1.0 / 64;
  }
  const MoveResult& move(const Vec2d& displacement) {
    this->request.technique_memory = this->result.technique_memory;
    return Rig::move(this->result.position, displacement);
  }
  [[nodiscard]] bool is_in(double column, double row) const { return this->result.position == centre_of(column, row); }
};

TEST(Squares, are_solid_where_a_polygon_with_bays_and_holes_is_and_name_the_first_collider) {
  // Five by four, a bay of two squares from the top, and a hole of one; a second one fills the bay and goes on.
  ColliderDef polygon{.points = {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 2}, {3, 2}, {3, 4}, {0, 4}}};
  polygon.holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  for (const double side : {1.0, 0.5}) {
    const Squares squares(SceneryDef{{polygon, rectangle(3, 3, 6, 4)}}, side, tolerance);
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
    return refusal_by<NotExpressible>([&] { Squares(SceneryDef{{rectangle(0, 0, 1, 1), collider}}, side, tolerance); });
  };
  const std::string not_whole = ": collider 1 is not made of whole squares of 1 m";
  EXPECT_EQ(refusal({.points = {{0, 0}, {2, 0}, {2, 1}}}), "the grid cannot express a slope" + not_whole);
  EXPECT_EQ(refusal(chain({{0, 0}, {1, 0}})), "the grid cannot express a chain" + not_whole);
  const std::string between = "the grid cannot express an edge between two squares" + not_whole;
  EXPECT_EQ(refusal(rectangle(0, 0, 1.5, 1)), between);
  ColliderDef holed = rectangle(0, 0, 3, 3);
  holed.holes = {{{1, 1}, {2, 1}, {2, 1.5}, {1, 1.5}}};
  EXPECT_EQ(refusal(holed), between);
  EXPECT_EQ(refusal(holed, 0.5), "");
  EXPECT_EQ(refusal(rectangle(0, 0, 1 + tolerance / 2, 1)), "") << "a touch is no edge of its own";
  EXPECT_NE(refusal(rectangle(1e6, 1e6, 1e6 + 1, 1e6 + 1)), "") << "a million squares each way";
}

TEST(GridMoves, are_drawn_to_the_end_where_nothing_more_is_wanted) {
  GridWalk walk({rectangle(-9, -1, 99, 0)}, centre_of(0, 0));
  for (int step = 0; step < 11; ++step) walk.move({0.125, 0});
  ASSERT_TRUE(walk.is_in(1, 0));
  ASSERT_EQ(walk.result.technique_memory.x(), 0.375);
  // 6 m/s, 64 steps per second: 3/32 m per step, 4 steps.
  for (int step = 1; step <= 6; ++step) {
    walk.move({0, 0});
    EXPECT_EQ(walk.result.technique_memory.x(), std::max(0.0, 0.375 - static_cast<double>(step) * 3 / 32));
    EXPECT_TRUE(walk.is_in(1, 0)) << "step " << step;
  }
  for (int step = 0; step < 5; ++step) walk.move({-0.0625, 0});
  for (int step = 0; step < 2; ++step) walk.move({0, 0});
  EXPECT_EQ(walk.result.technique_memory.x(), -0.3125 + 0.1875) << "from the other side, too";
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
      tiles.push_back(rectangle(column, row, column + 1, row + 1));
      solid.insert({column, row});
    }
  }
  GridWalk walk(tiles, centre_of(12, 12));
  std::array<bool, 576> visited{};
  int moves = 0;
  int contacts = 0;
  Vec2d wanted{0, 0};
  walk.result.reserve(16);
  const std::size_t before_all = tests::allocations();
  for (int step = 0; step < 100'000; ++step) {
    if (step % 20 == 0) wanted = random.point(1.5);
    const Vec2d before = walk.result.position;
    contacts += walk.move(wanted).contacts.empty() ? 0 : 1;
    const double way = (walk.result.position - before).cwiseAbs().sum();
    ASSERT_TRUE(way == 0 || way == 1) << "seed 31, step " << step;
    const std::pair here{static_cast<int>(std::floor(walk.result.position.x())),
                         static_cast<int>(std::floor(walk.result.position.y()))};
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

TEST(Grid, puts_the_feet_on_the_edge_of_the_square_and_replays_from_a_copy_of_the_state) {
  // 20 by 40 px in squares of a metre: the head is in the square above, which is not looked at.
  const std::vector<ColliderDef> level{rectangle(-20, -1, 20, 0), rectangle(3, 1, 4, 2)};
  stepping::Stepper walker(level, {}, "grid");
  walker.at(0.3, 0.7).steps(1);
  EXPECT_EQ(walker.state.position, Vec2d(0.5, half_height));
  EXPECT_TRUE(walker.state.grounded);
  walker.steps(60, {.move = 1});
  ASSERT_GT(walker.state.position.x(), 3) << "under the block, with the head in it, and beyond its left side";
  ASSERT_GT(std::abs(walker.state.technique_memory.x()), 0.01) << "else there is nothing to carry";
  stepping::Stepper copy(level, {}, "grid");
  copy.state = walker.state;
  for (int step = 0; step < 100; ++step) {
    walker.step({.move = 1});
    copy.step({.move = 1});
    ASSERT_TRUE(stepping::same_bits(walker.state, copy.state)) << "step " << step;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
