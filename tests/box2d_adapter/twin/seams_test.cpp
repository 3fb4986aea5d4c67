/// Flush tiles: what ghost collisions do to fixtures per piece, and what chain loops are for.
#include "levels.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::test {
namespace {

/// How many of 100 walking speeds (0.1 to 10 m/s) lose over 1 % of their speed on 20 flush tiles of 1 m.
int snagged_speeds(SceneryMode mode) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 20; ++i) tiles.push_back(box(i, -1, i + 1, 0));
  const Scenery<double> scenery = level(tiles);
  int snagged = 0;
  for (int i = 1; i <= 100; ++i) {
    const double speed = 0.1 * i;
    ReferenceWorld world(scenery, {}, {1.5, half_height() + rest_gap}, {.mode = mode});
    const int steps = static_cast<int>(std::min(17 / (speed * frame), 1200.0));
    double slowest = speed;
    run(world, {speed, 0}, {0, -10}, steps,
        [&slowest](const TwinStep& step) { slowest = std::min(slowest, step.velocity.x()); });
    if (slowest < 0.99 * speed) ++snagged;
  }
  return snagged;
}

TEST(Seams, one_fixture_per_tile_snags_most_speeds) {
  const int snagged = snagged_speeds(SceneryMode::pieces);
  RecordProperty("snagged", snagged);
  EXPECT_GT(snagged, 50);
}

TEST(Seams, a_chain_loop_around_the_tiles_snags_none) { EXPECT_EQ(snagged_speeds(SceneryMode::chain_loops), 0); }

}  // namespace
}  // namespace paperproof::box2d::test
