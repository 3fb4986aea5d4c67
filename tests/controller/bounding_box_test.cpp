/// The smallest box around everything, in random scenes. Where it looks again, and how it comes out of what it began
/// in, is in tests/situations/techniques.json.
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

}  // namespace
}  // namespace paperproof::article_tests
