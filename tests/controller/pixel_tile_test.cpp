/// Tiles whose pixels say what a collision does.
#include <paperproof/pixel_tiles.hpp>

#include "techniques/raster/sprite.hpp"

#include "controller/passenger.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <string>

namespace paperproof::article_tests {
namespace {

/// Up to the right by `rise` for each of `run`, from x = 0 to x = run, then level; level ground on the left.
std::vector<ColliderDef> hill(double run, double rise) {
  return {{.points = {{-20, -1}, {run + 20, -1}, {run + 20, rise}, {run, rise}, {0, 0}, {-20, 0}}}};
}

/// The highest ground under the two feet [m], from the bitmap.
double ground_below(const raster::Bitmap& level, const Vec2d& position) {
  std::int64_t highest = level.box().lower.y - 1;
  const auto left = static_cast<std::int64_t>(std::floor(position.x() * 32)) - 10;
  for (const std::int64_t foot : {left + 5, left + 14}) {
    for (std::int64_t y = level.box().lower.y; y < level.box().lower.y + level.box().height; ++y) {
      if (level.is_white({foot, y})) highest = std::max(highest, y + 1);
    }
  }
  return static_cast<double>(highest) * px;
}

TEST(PixelTileSlope, is_walked_up_and_down_at_any_speed_with_a_foot_on_the_ground_in_every_step) {
  Random random(10);
  for (const double run : {2.0, 4.0, 6.0}) {
    const raster::Bitmap level = raster::rasterise({hill(run, 2)}, 32);
    std::vector<double> speeds{2, 6};  // whole pixels in each step of 1/64 s
    for (int i = 0; i < 20; ++i) speeds.push_back(random.between(1, 12));
    for (std::size_t i = 0; i < 2 * speeds.size(); ++i) {
      const bool up = i % 2 == 0;
      const double speed = up ? speeds[i / 2] : -speeds[i / 2];
      Passenger walker("pixel_tile", hill(run, 2));
      walker.position = up ? Vec2d{-1, half_height} : Vec2d{run + 1, 2 + half_height};
      for (int step = 1; step <= static_cast<int>((run + 2) * 64 / std::abs(speed)); ++step) {
        walker.velocity.x() = speed;
        const double from = walker.position.x();
        ASSERT_TRUE(walker.step({}).grounded) << "seed 10, run " << run << ", speed " << speed << ", step " << step;
        if (i < 4) {
          ASSERT_EQ(walker.position.x(), from + speed / 64) << "run " << run << ", speed " << speed;
        }
        // Between two pixels it stands on the ground of one of them.
        const double feet = walker.position.y() - half_height;
        const Vec2d beside = walker.position + Vec2d(i < 4 ? 0 : px, 0);
        ASSERT_TRUE(feet == ground_below(level, walker.position) || feet == ground_below(level, beside))
            << "seed 10, run " << run << ", speed " << speed << ", step " << step;
      }
      EXPECT_EQ(walker.position.y(), (up ? 2 : 0) + half_height) << "seed 10, run " << run << ", speed " << speed;
    }
  }
}

TEST(PixelTileSlope, takes_nobody_down_who_jumps) {
  Rig<double> rig("pixel_tile", hill(2, 2));
  const Vec2d start{1, ground_below(raster::rasterise({hill(2, 2)}, 32), {1, 0}) + half_height};
  const Vec2d displacement{-5 * px, px / 4};
  EXPECT_EQ(rig.move(start, displacement).position, start + displacement);
}

TEST(PixelTiles, agree_with_the_bitmap_for_tiles_of_any_size) {
  Random random(9);
  std::size_t solid = 0;
  constexpr int sceneries = test::sampled(60);
  for (int i = 0; i < sceneries; ++i) {
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

TEST(PixelTiles, may_be_given_instead_of_being_made_from_the_scenery) {
  const TechniqueDef def{.name = "pixel_tile", .pixel_tiles = std::make_shared<const PixelTileSet>(by_hand())};
  Rig<double> rig(def, {rectangle(-0.5, -0.25, 0.5, 0)}, single_pixel());
  EXPECT_EQ(rig.move({-0.3, 1}, {0, -5}).position, Vec2d(-0.3, px / 2)) << "on the lower row";
  EXPECT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.move({-0.3, px / 2}, {5, 0}).position, Vec2d(8 * px - px / 2, px / 2))
      << "at the third tile of the upper row, which no collider has";
  EXPECT_TRUE(rig.result.contacts.empty());
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
