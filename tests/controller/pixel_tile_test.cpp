/// Tiles whose pixels say what a collision does.
#include <paperproof/pixel_tiles.hpp>

#include "techniques/raster/sprite.hpp"

#include "controller/article_support.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <string>

namespace paperproof::article_tests {
namespace {

TEST(PixelTileSlope, takes_nobody_down_who_jumps) {
  Rig rig("pixel_tile", {{.points = {{-20, -1}, {22, -1}, {22, 2}, {2, 2}, {0, 0}, {-20, 0}}}});
  const Vec2d start = rig.move({1, 4}, {0, -4}).position;
  EXPECT_NEAR(start.y() - half_height, 1 + 4.5 * px, px) << "the front foot, 4 px further on, stands";
  const Vec2d displacement{-5 * px, px / 4};
  EXPECT_EQ(rig.move(start, displacement).position, start + displacement);
}

TEST(PixelTiles, agree_with_the_bitmap_for_tiles_of_any_size) {
  Random random(9);
  std::size_t solid = 0;
  const unsigned sceneries = test::sampled(60U);
  for (unsigned i = 0; i < sceneries; ++i) {
    SceneryDef scenery;
    for (int k = 0; k < 3; ++k) scenery.colliders.push_back({.points = on_an_ellipse(random, random.point(3), {3, 3})});
    const int size = 1 + random.below(100);
    const PixelTileSet tiles = make_pixel_tiles(scenery, 16, size);
    tiles.validate();
    const raster::Bitmap level = raster::rasterise(scenery, 16);
    for (std::int64_t y = -100; y < 100; ++y) {
      for (std::int64_t x = -100; x < 100; ++x) {
        // Upwards where a foot comes from the free pixel above the one below, and down where there is one step down.
        const auto white = [&](int dx, int dy) { return level.is_white({x + dx, y + dy}); };
        const auto action = [&](int from) {
          const bool stood = !white(from, 0) && white(from, -1);
          if (white(0, 0)) return stood && !white(0, 1) ? PixelAction::up : PixelAction::block;
          return stood && !white(0, -1) && white(0, -2) ? PixelAction::down : PixelAction::nothing;
        };
        ASSERT_EQ(tiles.at(x, y), (PixelCollision{action(1), action(-1)}))
            << "seed 9, " << i << ", " << size << ": " << x << ' ' << y;
        solid += white(0, 0) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(solid, sceneries * 100'000U / 60);
}

/// Two rows of four tiles of 8 px: the lower ones solid, the third upper one too.
PixelTileSet by_hand() {
  PixelTileSet tiles;
  tiles.pixels_per_tile = 8;
  tiles.types = {PixelTileSet::Tile(64), PixelTileSet::Tile(64, {PixelAction::block, PixelAction::block})};
  tiles.first_column = -2;
  tiles.first_row = -1;
  tiles.columns = 4;
  tiles.map = {1, 1, 1, 1, 0, 0, 0, 1};
  return tiles;
}

TEST(PixelTiles, that_do_not_fit_are_named) {
  struct Case {
    std::string says;
    void (*spoil)(PixelTileSet&);
  };
  for (const Case& each : {
           Case{"", [](PixelTileSet&) {}},
           Case{"at least 1 pixel", [](PixelTileSet& tiles) { tiles.pixels_per_tile = 0; }},
           Case{"type 0 has 64 pixels instead of 49", [](PixelTileSet& tiles) { tiles.pixels_per_tile = 7; }},
           Case{"rows of 3", [](PixelTileSet& tiles) { tiles.columns = 3; }},
           Case{"rows of 0", [](PixelTileSet& tiles) { tiles.columns = 0; }},
           Case{"type 2 of 2", [](PixelTileSet& tiles) { tiles.map[3] = 2; }},
           Case{"one direction only", [](PixelTileSet& tiles) { tiles.types[1][5].moving_left = PixelAction::down; }},
       }) {
    PixelTileSet tiles = by_hand();
    each.spoil(tiles);
    const std::string message = refusal_by<std::invalid_argument>([&] { tiles.validate(); });
    EXPECT_EQ(message.empty(), each.says.empty()) << message;
    EXPECT_NE(message.find(each.says), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
