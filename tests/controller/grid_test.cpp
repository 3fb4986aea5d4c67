/// The grid: squares out of scenery, and a character that is always in exactly one of them.
#include "controller/article_support.hpp"
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "techniques/grid/squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace paperproof::article_tests {
namespace {

using grid::Square;
using grid::Squares;

constexpr double tolerance = Tolerances<double>{}.touch;

std::string refusal_of(const std::vector<ColliderDef>& colliders, double side = 1) {
  try {
    const Squares squares(SceneryDef{colliders}, side, tolerance);
  } catch (const NotExpressible& refused) {
    return refused.what();
  }
  return "";
}

/// A square of the side 1 as large as the character, so that its centre is the position.
CharacterShape unit_square() {
  const std::array corners{Vec2d{-0.5, -0.5}, Vec2d{0.5, -0.5}, Vec2d{0.5, 0.5}, Vec2d{-0.5, 0.5}};
  return CharacterShape(corners);
}

Vec2d centre_of(std::int64_t column, std::int64_t row) {
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

/// Hands the remainder on, as the controller does.
template <class Scalar>
struct GridWalk {
  Rig<Scalar> rig;
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};
  Vec2<Scalar> remainder{Vec2<Scalar>::Zero()};
  Scalar dt = Scalar(1) / 64;

  GridWalk(std::vector<ColliderDef> colliders, const Vec2d& start, const CharacterShape& shape = unit_square())
      : rig("grid", std::move(colliders), {}, shape), position(start.cast<Scalar>()) {}

  const MoveResult<Scalar>& move(const Vec2d& displacement) {
    MoveRequest<Scalar> request;
    request.position = position;
    request.displacement = displacement.cast<Scalar>();
    request.velocity = request.displacement;
    request.technique_memory = remainder;
    request.dt = dt;
    rig.technique->move(request, rig.scratch, rig.result);
    position = rig.result.position;
    remainder = rig.result.technique_memory;
    return rig.result;
  }
};

TEST(Squares, are_solid_where_a_polygon_with_bays_and_holes_is) {
  // Five by four, a bay of two squares from the top, and a hole of one.
  ColliderDef polygon{.points = {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 2}, {3, 2}, {3, 4}, {0, 4}}};
  polygon.holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  const Squares squares(SceneryDef{{polygon}}, 1, tolerance);
  const std::set<std::pair<int, int>> open{{3, 2}, {3, 3}, {1, 1}};
  for (int column = -2; column < 8; ++column) {
    for (int row = -2; row < 8; ++row) {
      const bool within = column >= 0 && column < 5 && row >= 0 && row < 4;
      EXPECT_EQ(squares.collider_at({column, row}).has_value(), within && !open.contains({column, row}))
          << column << ", " << row;
    }
  }
}

TEST(Squares, name_the_first_of_the_colliders_that_fill_them) {
  const Squares squares(SceneryDef{{rectangle(-3, -2, 0, 0), rectangle(-1, -1, 2, 0)}}, 0.5, tolerance);
  EXPECT_EQ(squares.collider_at({-6, -4}), 0U);
  EXPECT_EQ(squares.collider_at({-1, -1}), 0U);
  EXPECT_EQ(squares.collider_at({0, -1}), 1U);
  EXPECT_EQ(squares.collider_at({3, -2}), 1U);
  EXPECT_FALSE(squares.collider_at({4, -1}));
  EXPECT_FALSE(squares.collider_at({0, -3}));
  EXPECT_EQ(squares.memory_bytes(), 10U * 4U * sizeof(ColliderIndex)) << "ten columns and four rows";
}

TEST(Squares, are_refused_with_the_reason_where_scenery_is_not_made_of_them) {
  const ColliderDef tile = rectangle(0, 0, 1, 1);
  const std::string not_whole = ": collider 1 is not made of whole squares of 1 m";
  const ColliderDef slope{.points = {{0, 0}, {2, 0}, {2, 1}}};
  EXPECT_EQ(refusal_of({tile, slope}), "the grid cannot express a slope" + not_whole);
  EXPECT_EQ(refusal_of({tile, chain({{0, 0}, {1, 0}})}), "the grid cannot express a chain" + not_whole);
  EXPECT_EQ(refusal_of({tile, rectangle(0, 0, 1.5, 1)}),
            "the grid cannot express an edge between two squares" + not_whole);
  ColliderDef holed = rectangle(0, 0, 3, 3);
  holed.holes = {{{1, 1}, {2, 1}, {2, 1.5}, {1, 1.5}}};
  EXPECT_NE(refusal_of({holed}), "");
  EXPECT_EQ(refusal_of({holed}, 0.5), "");
  EXPECT_EQ(refusal_of({tile, rectangle(0, 0, 1 + tolerance / 2, 1)}), "") << "a touch is no edge of its own";
  EXPECT_NE(refusal_of({tile, rectangle(1e6, 1e6, 1e6 + 1, 1e6 + 1)}), "") << "a million squares each way";
}

TEST(Squares, must_have_a_side_that_is_longer_than_a_touch) {
  for (const double side : {0.0, -1.0, 1e-9, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(Rig<double>("grid", {rectangle(0, 0, 1, 1)}, {.square = side}), std::invalid_argument);
  }
}

template <class Scalar>
class GridMoves : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(GridMoves, Scalars, );

TYPED_TEST(GridMoves, end_exactly_in_the_next_square_once_half_of_it_was_wanted) {
  GridWalk<TypeParam> walk({rectangle(-9, -1, 99, 0)}, centre_of(0, 0));
  for (int step = 1; step <= 200; ++step) {
    walk.move({0.125, 0});
    const auto column = static_cast<std::int64_t>(std::floor(0.125 * step + 0.5));
    ASSERT_EQ(walk.position, centre_of(column, 0).template cast<TypeParam>()) << "step " << step;
    ASSERT_EQ(walk.remainder.x(), static_cast<TypeParam>(0.125 * step - static_cast<double>(column)));
  }
}

TYPED_TEST(GridMoves, are_drawn_to_the_end_where_nothing_more_is_wanted) {
  GridWalk<TypeParam> walk({rectangle(-9, -1, 99, 0)}, centre_of(0, 0));
  for (int step = 0; step < 11; ++step) walk.move({0.125, 0});
  ASSERT_EQ(walk.position, centre_of(1, 0).template cast<TypeParam>());
  ASSERT_EQ(walk.remainder.x(), TypeParam(0.375));
  // 6 m/s, 64 steps per second: 3/32 m per step, 4 steps.
  for (int step = 1; step <= 6; ++step) {
    walk.move({0, 0});
    EXPECT_EQ(walk.remainder.x(), std::max(TypeParam(0), TypeParam(0.375) - TypeParam(step) * 3 / 32));
    EXPECT_EQ(walk.position, centre_of(1, 0).template cast<TypeParam>());
  }
  for (int step = 0; step < 5; ++step) walk.move({-0.0625, 0});
  for (int step = 0; step < 2; ++step) walk.move({0, 0});
  EXPECT_EQ(walk.remainder.x(), TypeParam(-0.3125 + 0.1875)) << "from the other side, too";
}

TYPED_TEST(GridMoves, into_a_solid_square_are_prevented_before_they_begin) {
  GridWalk<TypeParam> walk({rectangle(-9, -1, 9, 0), rectangle(1, 0, 2, 1)}, centre_of(0, 0));
  const MoveResult<TypeParam>& result = walk.move({0.125, -0.25});
  EXPECT_EQ(result.position, centre_of(0, 0).template cast<TypeParam>());
  EXPECT_EQ(result.velocity, Vec2<TypeParam>(0, 0));
  EXPECT_EQ(result.technique_memory, Vec2<TypeParam>(0, 0));
  EXPECT_TRUE(result.grounded);
  ASSERT_EQ(result.contacts.size(), 2U);
  const Contact<TypeParam>& ground = result.contacts[0];
  EXPECT_EQ(ground.collider, 0U);
  EXPECT_EQ(ground.side, Side::bottom);
  EXPECT_EQ(ground.point, Vec2<TypeParam>(TypeParam(0.5), 0));
  EXPECT_EQ(ground.normal, Vec2<TypeParam>(0, 1));
  EXPECT_EQ(ground.separation, 0);
  EXPECT_EQ(ground.fraction, 0);
  const Contact<TypeParam>& wall = result.contacts[1];
  EXPECT_EQ(wall.collider, 1U);
  EXPECT_EQ(wall.side, Side::right);
  EXPECT_EQ(wall.point, Vec2<TypeParam>(1, TypeParam(0.5)));
  EXPECT_EQ(wall.normal, Vec2<TypeParam>(-1, 0));
}

TYPED_TEST(GridMoves, go_in_one_of_four_directions_and_never_into_a_solid_square) {
  constexpr std::uint64_t seed = 31;
  Random random(seed);
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
  GridWalk<TypeParam> walk(tiles, centre_of(12, 12));
  std::set<std::pair<int, int>> visited;
  int moves = 0;
  int contacts = 0;
  Vec2d wanted{0, 0};
  for (int step = 0; step < 100'000; ++step) {
    if (step % 20 == 0) wanted = {random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
    const Vec2<TypeParam> before = walk.position;
    contacts += walk.move(wanted).contacts.empty() ? 0 : 1;
    const Vec2<TypeParam> way = walk.position - before;
    ASSERT_TRUE(way.cwiseAbs().sum() == 0 || way.cwiseAbs().sum() == 1) << "seed 31, step " << step;
    const std::pair here{static_cast<int>(std::floor(walk.position.x())),
                         static_cast<int>(std::floor(walk.position.y()))};
    ASSERT_FALSE(solid.contains(here)) << "seed 31, step " << step;
    moves += way.isZero(0) ? 0 : 1;
    visited.insert(here);
  }
  EXPECT_GT(moves, 10'000);
  EXPECT_GT(contacts, 30'000);
  EXPECT_LT(contacts, 98'000);
  EXPECT_GT(visited.size(), 100U);
}

TYPED_TEST(GridMoves, are_by_one_square_however_fast_and_never_pass_paper_of_one_square) {
  GridWalk<TypeParam> bullet({rectangle(-3, -20, 3, -19)}, centre_of(0, 0));
  for (int step = 1; step <= 18; ++step) {
    EXPECT_EQ(bullet.move({0, -50}).status, MoveStatus::dropped);
    EXPECT_EQ(bullet.position.y(), TypeParam(0.5) - TypeParam(step));
  }
  bullet.move({0, -50});
  const MoveResult<TypeParam>& result = bullet.move({0, -50});
  EXPECT_EQ(result.position.y(), TypeParam(0.5) - 19) << "in the square above the platform's top";
  EXPECT_TRUE(result.grounded);
  EXPECT_EQ(result.velocity.y(), 0);
}

TEST(Grid, draws_a_fall_along_the_parabola) {
  stepping::Stepper<double> faller({rectangle(50, -100, 51, 100)}, of_shape(unit_square()), "grid");
  faller.at(0.5, 7.5).with_velocity(1.25, 0);
  for (int n = 1; n <= 80; ++n) {
    faller.step();
    const Vec2d drawn = faller.state.position + faller.state.technique_memory;
    EXPECT_NEAR(drawn.y(), 7.5 - 10.0 / 3600 * n * (n + 1) / 2, 1e-12) << "step " << n;
    EXPECT_NEAR(drawn.x(), 0.5 + 1.25 / 60 * n, 1e-12);
  }
  EXPECT_LT(faller.state.position.y(), 0) << "it fell through several squares";
}

/// How far a walk from rest leads in so many steps of 1/60 s: each first adds to the speed, and then moves.
double walked(int steps) {
  const CharacterDef character;
  double way = 0;
  for (int k = 1; k <= steps; ++k) way += std::min(k * character.acceleration / 60, character.walk_speed) / 60;
  return way;
}

/// The square nearest to a way from the middle of a square [m].
double squares_to(double way) { return std::floor(way + 0.5); }

TEST(Grid, puts_the_feet_of_a_tall_character_on_the_edge_of_its_square) {
  // 20 by 40 px in squares of a metre: the head is in the square above, which is not looked at.
  stepping::Stepper<double> walker({rectangle(-20, -1, 20, 0), rectangle(3, 1, 4, 2)}, {}, "grid");
  walker.at(0.3, 0.7).steps(1);
  EXPECT_EQ(walker.state.position, Vec2d(0.5, stepping::half_height));
  EXPECT_TRUE(walker.state.grounded);
  walker.steps(60, {.move = 1});
  ASSERT_GT(squares_to(walked(60)), 3) << "beyond the left side of the block";
  EXPECT_EQ(walker.state.position.x(), 0.5 + squares_to(walked(60))) << "under the block, with the head in it";
}

TEST(Grid, begins_inside_and_stays_stuck_until_there_is_a_free_square) {
  GridWalk<double> walk({rectangle(0, 0, 3, 3)}, centre_of(1, 1));
  EXPECT_EQ(walk.move({0.75, 0}).status, MoveStatus::stuck);
  EXPECT_EQ(walk.position, centre_of(1, 1));
  GridWalk<double> beside({rectangle(0, 0, 3, 3)}, centre_of(2, 1));
  EXPECT_EQ(beside.move({0.75, 0}).status, MoveStatus::moved);
  EXPECT_EQ(beside.position, centre_of(3, 1));
}

TEST(Grid, refuses_what_leaves_the_range_and_changes_nothing) {
  GridWalk<double> walk({rectangle(0, 0, 3, 3)}, centre_of(9, 9));
  walk.remainder = {0.25, -0.125};
  for (const double bad : {3e6, -3e6, std::nan("")}) {
    EXPECT_EQ(walk.move({bad, 0}).status, MoveStatus::out_of_range);
    EXPECT_EQ(walk.position, centre_of(9, 9));
    EXPECT_EQ(walk.remainder, Vec2d(0.25, -0.125));
  }
}

TEST(Grid, carries_its_remainder_in_the_state_so_that_a_copy_replays) {
  const auto make = [] {
    return stepping::Stepper<double>({rectangle(-50, -1, 50, 0)}, of_shape(unit_square()), "grid");
  };
  stepping::Stepper<double> first = make();
  first.at(0.5, 0.5).steps(17, {.move = 1});
  const double remainder = walked(17) - squares_to(walked(17));
  ASSERT_GT(std::abs(remainder), 0.01) << "else there is nothing to carry";
  EXPECT_NEAR(first.state.technique_memory.x(), remainder, 1e-12);
  stepping::Stepper<double> second = make();
  second.state = first.state;
  for (int step = 0; step < 100; ++step) {
    first.step({.move = 1});
    second.step({.move = 1});
    ASSERT_TRUE(stepping::same_bits(first.state, second.state)) << "step " << step;
  }
}

TEST(Grid, takes_no_memory_while_moving) {
  GridWalk<double> walk({rectangle(-9, -1, 9, 0), rectangle(3, 0, 4, 3)}, centre_of(0, 0));
  const std::size_t before = tests::allocations();
  int contacts = 0;
  for (int step = 0; step < 1000; ++step)
    contacts += walk.move({step % 40 < 20 ? 0.3 : -0.3, -0.2}).contacts.empty() ? 0 : 1;
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_EQ(contacts, 1000) << "each step goes down onto the floor";
}

}  // namespace
}  // namespace paperproof::article_tests
