/// The smallest box around everything: what no other technique does.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

namespace paperproof::article_tests {
namespace {

constexpr std::string_view kind = "bounding_box";

/// A long double holds every sum of doubles of these sizes, but for less than any gap.
bool overlap(const Box2& piece, const Vec2d& position, const Box2& character) {
  const auto wide = [](const Vec2d& v) { return v.cast<long double>(); };
  return (wide(piece.lower) - wide(position) - wide(character.upper)).maxCoeff() < 0 &&
         (wide(piece.upper) - wide(position) - wide(character.lower)).minCoeff() > 0;
}

TEST(BoundingBox, ends_free_to_the_last_bit_and_moves_no_further_than_asked) {
  Random random(41);
  int hits = 0;
  int tried = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<ColliderDef> boxes;
    for (int i = 0; i < 30; ++i) {
      const Vec2d low = random.point(9);
      const Vec2d high = low + Vec2d{random.between(0.1, 2), random.between(0.1, 2)};
      boxes.push_back(rectangle(low.x(), low.y(), high.x(), high.y()));
    }
    Rig rig(kind, boxes, {.iterations = 64});
    const auto free = [&](const Vec2d& position) {
      return std::none_of(rig.scenery.boxes().begin(), rig.scenery.boxes().end(),
                          [&](const Box2& piece) { return overlap(piece, position, rig.character.shape.box()); });
    };
    for (int sweep = 0; sweep < 100; ++sweep) {
      const Vec2d start = random.point(9);
      if (!free(start)) continue;
      const Vec2d wanted = random.point(4);
      const Vec2d end = start + wanted;
      const MoveResult& result = rig.move(start, wanted);
      ASSERT_TRUE(free(result.position)) << "seed 41, scene " << scene << ", sweep " << sweep;
      ASSERT_EQ(result.position, result.position.cwiseMax(start.cwiseMin(end)).cwiseMin(start.cwiseMax(end)))
          << "seed 41, scene " << scene << ", sweep " << sweep;
      ASSERT_EQ(result.contacts.empty(), result.position == end) << "seed 41, scene " << scene << ", sweep " << sweep;
      ++tried;
      hits += result.contacts.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(hits, tried * 3 / 10);
  EXPECT_LT(hits, tried * 7 / 10);
}

TEST(BoundingBox, looks_again_where_it_was_put_back_to) {
  // The movement ends below the paper in the thick piece, whose face is inside the paper: the second look finds it.
  Rig rig(kind, {rectangle(-3, -4, 3, -1), rectangle(-3, -1, 3, -1 + px / 4)}, {}, single_pixel());
  const MoveResult& result = rig.move({0, 1}, {0, -3});
  EXPECT_EQ(result.position.y(), -1 + px / 4 + px / 2);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts[0].collider, 1U);
}

TEST(BoundingBox, is_pushed_out_of_what_it_began_in_along_the_least_overlap_or_is_stuck) {
  Rig rig(kind, {rectangle(-5, -5, 5, 0)});
  EXPECT_EQ(rig.move({0, half_height - 0.25}, {0, 0}).position, Vec2d(0, half_height));
  EXPECT_EQ(rig.result.status, StepStatus::moved);
  EXPECT_TRUE(rig.result.grounded);
  EXPECT_EQ(rig.move({5 + half_width - 0.125, -2}, {0, 0}).position, Vec2d(5 + half_width, -2));
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].side, Side::left);
  Rig between(kind, {rectangle(0, 0, 1, 9), rectangle(1, 0, 2, 9)});
  EXPECT_EQ(between.move({1, 4.5}, {0, 0}).status, StepStatus::stuck) << "each way out leads into the next box";
}

}  // namespace
}  // namespace paperproof::article_tests
