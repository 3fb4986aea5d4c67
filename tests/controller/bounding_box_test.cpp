/// The smallest box around everything: right on flat ground, wrong on slopes.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace paperproof::article_tests {
namespace {

constexpr std::string_view kind = "bounding_box";
/// Half of the article's character [m].
constexpr double half_width = 10 * px;
constexpr double half_height = 20 * px;

template <class Scalar>
class BoundingBoxes : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoundingBoxes, Scalars, );

TYPED_TEST(BoundingBoxes, land_exactly_on_what_they_end_in) {
  using Scalar = TypeParam;
  Rig<Scalar> rig(kind, {rectangle(-3, -2, 3, 0)});
  const MoveResult<Scalar>& result = rig.move({0, 1}, {0.25, -1});
  EXPECT_EQ(result.position, Vec2<Scalar>(Scalar(0.25), Scalar(half_height)));
  EXPECT_EQ(result.velocity, Vec2<Scalar>(Scalar(0.25), 0));
  EXPECT_TRUE(result.grounded);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts[0].side, Side::bottom);
  EXPECT_EQ(result.contacts[0].normal, Vec2<Scalar>(0, 1));
  EXPECT_EQ(result.contacts[0].fraction, 1) << "known only where the frame ends";
  EXPECT_EQ(result.contacts[0].point.y(), 0);
  EXPECT_EQ(result.contacts[0].separation, 0);
}

TYPED_TEST(BoundingBoxes, stop_on_each_of_the_four_sides) {
  using Scalar = TypeParam;
  Rig<Scalar> rig(kind, {rectangle(-1, -1, 1, 1)});
  const double x = 1 + half_width;
  const double y = 1 + half_height;
  struct Case {
    Vec2d start, displacement, end;
    Side side;
  };
  for (const Case& each :
       {Case{{3, 0}, {-2.5, 0}, {x, 0}, Side::left}, Case{{-3, 0}, {2.5, 0}, {-x, 0}, Side::right},
        Case{{0, 3}, {0, -2.5}, {0, y}, Side::bottom}, Case{{0, -3}, {0, 2.5}, {0, -y}, Side::top}}) {
    const MoveResult<Scalar>& result = rig.move(each.start, each.displacement);
    EXPECT_EQ(result.position, each.end.template cast<Scalar>());
    ASSERT_EQ(result.contacts.size(), 1U);
    EXPECT_EQ(result.contacts[0].side, each.side);
    EXPECT_EQ(result.grounded, each.side == Side::bottom);
    EXPECT_TRUE(result.velocity.isZero(0));
  }
}

TYPED_TEST(BoundingBoxes, of_enemies_are_where_they_will_be_at_the_end_of_the_frame) {
  using Scalar = TypeParam;
  ColliderDef enemy = rectangle(2, -1, 3, 1);
  enemy.mover = 0;
  Rig<Scalar> rig(kind, {enemy});
  MoveRequest<Scalar> request;
  const auto move = [&](const Vec2d& from, const Vec2d& by, const Vec2d& enemy_by) {
    const std::array motions{MoverMotion<Scalar>{{0, 0}, enemy_by.template cast<Scalar>()}};
    request.position = from.template cast<Scalar>();
    request.displacement = request.velocity = by.template cast<Scalar>();
    request.movers = motions;
    rig.technique->move(request, rig.scratch, rig.result);
    return rig.result.position;
  };
  // It walks into the box that has come nearer by a quarter.
  EXPECT_EQ(move({1, 0}, {0.5, 0}, {-0.25, 0}), Vec2<Scalar>(Scalar(1.75 - half_width), 0));
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].side, Side::right);
  EXPECT_EQ(rig.result.contacts[0].point.x(), Scalar(1.75));
  // The box comes over it while it stands: out along the axis of least overlap.
  EXPECT_EQ(move({1.5, 0}, {0, 0}, {-0.25, 0}), Vec2<Scalar>(Scalar(1.75 - half_width), 0));
  // The box goes away.
  EXPECT_EQ(move({1.5, 0}, {0.5, 0}, {1, 0}), Vec2<Scalar>(2, 0));
  EXPECT_TRUE(rig.result.contacts.empty());
  // Between start and end nothing is looked at: each may pass the other.
  EXPECT_EQ(move({1, 0}, {0, 0}, {-4, 0}), Vec2<Scalar>(1, 0));
}

/// Exactly: doubles hold every sum of floats of these sizes.
bool overlap(const Box2<float>& piece, const Vec2f& position, const Box2<double>& character) {
  const Vec2d at = position.cast<double>();
  const Vec2d lower = at + character.lower;
  const Vec2d upper = at + character.upper;
  return static_cast<double>(piece.lower.x()) < upper.x() && lower.x() < static_cast<double>(piece.upper.x()) &&
         static_cast<double>(piece.lower.y()) < upper.y() && lower.y() < static_cast<double>(piece.upper.y());
}

TEST(BoundingBox, ends_free_to_the_last_bit_and_moves_no_further_than_asked) {
  constexpr std::uint64_t seed = 41;
  Random random(seed);
  int hits = 0;
  int tried = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<ColliderDef> boxes;
    for (int i = 0; i < 30; ++i) {
      const Vec2d low{random.between(-9, 9), random.between(-9, 9)};
      const Vec2d high = low + Vec2d{random.between(0.1, 2), random.between(0.1, 2)};
      boxes.push_back(rectangle(low.x(), low.y(), high.x(), high.y()));
    }
    Rig<float> rig(kind, boxes, {.iterations = 64});
    const Box2<double>& character = rig.character.shape.box();
    const auto free = [&](const Vec2f& position) {
      return std::none_of(rig.scenery.boxes().begin(), rig.scenery.boxes().end(),
                          [&](const Box2<float>& piece) { return overlap(piece, position, character); });
    };
    for (int sweep = 0; sweep < 100; ++sweep) {
      const Vec2f start = Vec2d{random.between(-9, 9), random.between(-9, 9)}.cast<float>();
      if (!free(start)) continue;
      const Vec2f wanted = Vec2d{random.between(-4, 4), random.between(-4, 4)}.cast<float>();
      const MoveResult<float>& result = rig.move(start.cast<double>(), wanted.cast<double>());
      ASSERT_TRUE(free(result.position)) << "seed 41, scene " << scene << ", sweep " << sweep;
      const Vec2f end = start + wanted;
      for (const Eigen::Index i : {0, 1}) {
        ASSERT_GE(result.position[i], std::min(start[i], end[i])) << "seed 41, scene " << scene;
        ASSERT_LE(result.position[i], std::max(start[i], end[i])) << "seed 41, scene " << scene;
      }
      ASSERT_EQ(result.contacts.empty(), result.position == end) << "seed 41, scene " << scene << ", sweep " << sweep;
      ++tried;
      hits += result.contacts.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(hits, tried * 3 / 10);
  EXPECT_LT(hits, tried * 7 / 10);
}

TEST(BoundingBox, walks_over_flush_tiles_and_never_changes_speed_or_height) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 60; ++i) tiles.push_back(rectangle(i, -1, i + 1, 0));
  Rig<double> rig(kind, tiles);
  for (int i = 1; i <= 100; ++i) {
    Walker walker{.position = {1, half_height}};
    const double speed = 0.37 * i;
    while (walker.position.x() < 58) {
      walker.velocity.x() = speed;
      const MoveResult<double>& result = walker.step(rig);
      ASSERT_EQ(result.velocity, Vec2d(speed, 0)) << "at " << walker.position.x();
      ASSERT_EQ(result.position.y(), half_height);
      ASSERT_TRUE(result.grounded);
    }
  }
}

TEST(BoundingBox, rests_without_moving_a_bit) {
  Rig<double> rig(kind, {rectangle(-3, -2, 3, 0.1)});
  Walker walker{.position = {0.1, 1}};
  for (int step = 0; step < 60; ++step) walker.step(rig);
  const Vec2d rest = walker.position;
  EXPECT_NEAR(rest.y(), 0.1 + half_height, 1e-15);
  for (int step = 0; step < 1000; ++step) {
    ASSERT_TRUE(walker.step(rig).grounded);
    ASSERT_EQ(walker.position, rest);
  }
}

TEST(BoundingBox, moves_vertically_first_so_that_a_corner_reached_from_beside_it_is_a_wall) {
  Rig<double> rig(kind, {rectangle(0, -3, 3, 0)});
  const double above = half_height + 0.25;
  const double beside = -half_width - 0.25;
  const MoveResult<double>& fallen = rig.move({beside, above}, {0.5, -0.5});
  EXPECT_EQ(fallen.position, Vec2d(-half_width, above - 0.5));
  EXPECT_EQ(fallen.velocity, Vec2d(0, -0.5));
  const MoveResult<double>& landed = rig.move({-half_width + 0.125, above}, {0.5, -0.5});
  EXPECT_EQ(landed.position, Vec2d(-half_width + 0.625, half_height)) << "over the edge already";
}

TEST(BoundingBox, takes_a_slope_for_a_block_of_its_height) {
  // Two metres up over four: the surface is at x / 2, the box's top at 2 all along.
  const ColliderDef slope{.points = {{0, 0}, {4, 0}, {4, 2}}};
  Rig<double> rig(kind, {slope, rectangle(-9, -1, 9, 0)});
  Walker walker{.position = {-2, half_height}};
  for (int step = 0; step < 120; ++step) {
    walker.velocity.x() = 2;
    walker.step(rig);
  }
  EXPECT_EQ(walker.position, Vec2d(-half_width, half_height)) << "stands before its foot as before a wall";
  Walker falling{.position = {1, 4}};
  for (int step = 0; step < 120; ++step) falling.step(rig);
  EXPECT_EQ(falling.position.y(), 2 + half_height) << "stands in the air";
}

TEST(BoundingBox, passes_paper_that_it_does_not_end_in) {
  Rig<double> rig(kind, {rectangle(-3, -0.1, 3, 0)}, {}, single_pixel());
  EXPECT_EQ(rig.move({0, 1}, {0, -2}).position.y(), -1);
  EXPECT_TRUE(rig.result.contacts.empty());
  EXPECT_EQ(rig.move({0, 1}, {0, -1.05}).position.y(), px / 2);
}

TEST(BoundingBox, looks_again_where_it_was_put_back_to) {
  // The movement ends below the paper in the thick piece, whose face is inside the paper: the second look finds it.
  Rig<double> rig(kind, {rectangle(-3, -4, 3, -1), rectangle(-3, -1, 3, -1 + px / 4)}, {}, single_pixel());
  const MoveResult<double>& result = rig.move({0, 1}, {0, -3});
  EXPECT_EQ(result.position.y(), -1 + px / 4 + px / 2);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts[0].collider, 1U);
}

TEST(BoundingBox, is_pushed_out_of_what_it_began_in_along_the_least_overlap) {
  Rig<double> rig(kind, {rectangle(-5, -5, 5, 0)});
  const MoveResult<double>& up = rig.move({0, half_height - 0.25}, {0, 0});
  EXPECT_EQ(up.position, Vec2d(0, half_height));
  EXPECT_EQ(up.status, MoveStatus::moved);
  EXPECT_TRUE(up.grounded);
  const MoveResult<double>& right = rig.move({5 + half_width - 0.125, -2}, {0, 0});
  EXPECT_EQ(right.position, Vec2d(5 + half_width, -2));
  ASSERT_EQ(right.contacts.size(), 1U);
  EXPECT_EQ(right.contacts[0].side, Side::left);
}

TEST(BoundingBox, is_stuck_where_each_way_out_leads_into_the_next_box) {
  Rig<double> rig(kind, {rectangle(0, 0, 1, 9), rectangle(1, 0, 2, 9)});
  const MoveResult<double>& result = rig.move({1, 4.5}, {0, 0});
  EXPECT_EQ(result.status, MoveStatus::stuck);
}

TEST(BoundingBox, meets_a_one_way_ledge_only_from_above) {
  Rig<double> rig(kind, {chain({{-3, 0}, {3, 0}}, Vec2d{0, 1})});
  EXPECT_EQ(rig.move({0, half_height + 0.25}, {0, -0.5}).position.y(), half_height);
  EXPECT_EQ(rig.move({0, -1}, {0, 1}).position.y(), 0) << "upwards it is not there";
  EXPECT_EQ(rig.move({0, 0}, {0.5, -0.25}).position, Vec2d(0.5, -0.25)) << "nor from within";
  Rig<double> solid(kind, {chain({{-3, 0}, {3, 0}})});
  EXPECT_EQ(solid.move({0, -1}, {0, 1}).position.y(), -half_height) << "one that blocks both ways does";
}

}  // namespace
}  // namespace paperproof::article_tests
