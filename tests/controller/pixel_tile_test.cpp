/// Tiles whose pixels say what a collision does.
#include <paperproof/pixel_tiles.hpp>

#include "techniques/raster/sprite.hpp"

#include "controller/article_support.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <string>

namespace paperproof::article_tests {
namespace {

constexpr double half_height = 20 * px;
constexpr std::string_view pixel_tile = "pixel_tile";

/// Up to the right by `rise` for each of `run`, from x = 0 to x = run, then level; level ground on the left.
std::vector<ColliderDef> hill(double run, double rise) {
  return {{.points = {{-20, -1}, {run + 20, -1}, {run + 20, rise}, {run, rise}, {0, 0}, {-20, 0}}}};
}

/// The highest ground under the two feet [px], from the bitmap.
std::int64_t ground_below(const raster::Bitmap& level, const Vec2d& position) {
  std::int64_t highest = level.box().lower.y - 1;
  const auto left = static_cast<std::int64_t>(std::floor(position.x() * 32)) - 10;
  for (const std::int64_t foot : {left + 5, left + 14}) {
    for (std::int64_t y = level.box().lower.y; y < level.box().lower.y + level.box().height; ++y) {
      if (level.is_white({foot, y})) highest = std::max(highest, y + 1);
    }
  }
  return highest;
}

TEST(PixelTileSlope, is_walked_up_and_down_with_a_foot_on_the_ground_in_every_step) {
  for (const double run : {2.0, 4.0, 6.0}) {
    const raster::Bitmap level = raster::rasterise({hill(run, 2)}, 32);
    for (const double speed : {1.0, 3.0, -1.0, -3.0}) {  // whole pixels in each step
      Rig<double> rig(pixel_tile, hill(run, 2));
      const bool up = speed > 0;
      Walker walker{.position = up ? Vec2d{-1, half_height} : Vec2d{run + 1, 2 + half_height}};
      const int steps = static_cast<int>((run + 2) * 32 / std::abs(speed));
      for (int step = 1; step <= steps; ++step) {
        walker.velocity.x() = speed * px * 64;
        const double from = walker.position.x();
        walker.step(rig);
        ASSERT_EQ(walker.position.x(), from + speed * px) << "run " << run << ", speed " << speed << ", step " << step;
        ASSERT_EQ(walker.position.y() * 32 - 20, double(ground_below(level, walker.position)))
            << "run " << run << ", speed " << speed << ", step " << step;
        ASSERT_TRUE(rig.result.grounded);
      }
      EXPECT_EQ(walker.position.y(), (up ? 2 : 0) + half_height) << "at the other end";
    }
  }
}

TEST(PixelTileSlope, is_followed_at_any_speed) {
  constexpr std::uint64_t seed = 10;
  Random random(seed);
  const raster::Bitmap level = raster::rasterise({hill(4, 2)}, 32);
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(1, 12) * (i % 2 == 0 ? 1 : -1);
    Rig<double> rig(pixel_tile, hill(4, 2));
    Walker walker{.position = speed > 0 ? Vec2d{-1, half_height} : Vec2d{5, 2 + half_height}};
    const int steps = static_cast<int>(6 * 64 / std::abs(speed));  // 6 m: over the hill
    for (int step = 1; step <= steps; ++step) {
      walker.velocity.x() = speed;
      walker.step(rig);
      ASSERT_TRUE(rig.result.grounded) << "seed " << seed << ", speed " << speed << ", step " << step;
      // Between two pixels it stands on the ground of one of them.
      const double feet = walker.position.y() * 32 - 20;
      const double other = double(ground_below(level, walker.position + Vec2d(px, 0)));
      ASSERT_TRUE(feet == double(ground_below(level, walker.position)) || feet == other)
          << "seed " << seed << ", speed " << speed << ", step " << step;
    }
    EXPECT_EQ(walker.position.y(), (speed > 0 ? 2 : 0) + half_height) << "seed " << seed << ", speed " << speed;
  }
}

TEST(PixelTileSlope, is_climbed_first_up_and_then_along) {
  // The right foot ends at pixel column -1, before the first solid one of the hill.
  Rig<double> rig(pixel_tile, hill(2, 2));
  const Vec2d start{-5 * px, half_height};
  const MoveResult<double>& result = rig.move(start, {3 * px, -px / 4});
  ASSERT_GE(result.path.size(), 4U);
  int climbs = 0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const Vec2d leg = result.path[i].position - result.path[i - 1].position;
    EXPECT_TRUE(leg.x() == 0 || leg.y() == 0) << "leg " << i << " is not diagonal";
    EXPECT_GE(result.path[i].fraction, result.path[i - 1].fraction);
    climbs += leg.y() > 0 ? 1 : 0;
  }
  EXPECT_EQ(double(climbs) * px, result.position.y() - start.y());
  EXPECT_GE(climbs, 2);
}

TEST(PixelTileSlope, steeper_than_45_degrees_is_a_wall) {
  Rig<double> rig(pixel_tile, hill(1, 2));
  Walker walker{.position = {-1, half_height}};
  for (int step = 0; step < 64; ++step) {
    walker.velocity.x() = 6;
    walker.step(rig);
  }
  EXPECT_EQ(walker.velocity.x(), 0);
  EXPECT_LT(walker.position.x(), 0);
  ASSERT_FALSE(rig.result.contacts.empty());
  EXPECT_EQ(rig.result.contacts.back().side, Side::right);
}

TEST(PixelTileSlope, takes_nobody_down_who_jumps) {
  Rig<double> rig(pixel_tile, hill(2, 2));
  const double x = 1;
  Walker walker{.position = {x, 0}};
  walker.position.y() = double(ground_below(raster::rasterise({hill(2, 2)}, 32), walker.position)) * px + half_height;
  const Vec2d displacement{-5 * px, px / 4};
  EXPECT_EQ(rig.move(walker.position, displacement).position, walker.position + displacement);
}

TEST(PixelTileSlope, is_held_back_by_a_ceiling) {
  std::vector<ColliderDef> colliders = hill(2, 2);
  colliders.push_back(rectangle(-20, 40 * px + 0.5, 20, 9));  // half a metre of room
  Rig<double> rig(pixel_tile, colliders);
  Walker walker{.position = {-1, half_height}};
  for (int step = 0; step < 64; ++step) {
    walker.velocity.x() = 6;
    walker.step(rig);
  }
  EXPECT_EQ(walker.position.y(), half_height + 0.5) << "the head is at the ceiling";
  EXPECT_EQ(walker.velocity.x(), 0);
  ASSERT_EQ(rig.result.contacts.size(), 3U) << "the floor, and on the right the slope and what ends the way up it";
  EXPECT_EQ(rig.result.contacts[1].collider, 1U);
  EXPECT_EQ(rig.result.contacts[1].side, Side::right);
}

template <class Scalar>
class PixelTileIn : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PixelTileIn, Scalars);

TYPED_TEST(PixelTileIn, stops_on_whole_pixels_at_floor_wall_and_ceiling) {
  const std::vector<ColliderDef> room{rectangle(-9, -9, 9, 0), rectangle(2, 0, 9, 9), rectangle(-9, 3, 9, 9)};
  Rig<TypeParam> rig(pixel_tile, room);
  const MoveResult<TypeParam>& fall = rig.move({0.01, 1}, {0, -3});
  EXPECT_EQ(fall.position, Vec2<TypeParam>(TypeParam(0.01), TypeParam(half_height)));
  EXPECT_TRUE(fall.grounded);
  EXPECT_EQ(rig.move({0, half_height}, {7, 0}).position,
            Vec2<TypeParam>(TypeParam(2 - 10 * px), TypeParam(half_height)));
  EXPECT_EQ(rig.move({0, half_height}, {0, 7}).position, Vec2<TypeParam>(0, TypeParam(3 - half_height)));
  EXPECT_EQ(rig.result.contacts[0].side, Side::top);
  EXPECT_EQ(rig.result.contacts[0].collider, 2U);
  const Vec2<TypeParam> resting = rig.move({0.01, half_height}, {0, -px / 9}).position;
  EXPECT_EQ(resting, Vec2<TypeParam>(TypeParam(0.01), TypeParam(half_height)));
}

TEST(PixelTile, misses_what_passes_between_its_collision_points) {
  // A spike of 6 px between feet 10 px apart, and paper met at any speed.
  const ColliderDef spike{.points = {{-3 * px, 0}, {3 * px, 0}, {0, 8 * px}}};
  Rig<double> rig(pixel_tile, {rectangle(-2, -2, 2, 0), spike});
  EXPECT_EQ(rig.move({0, half_height + 20 * px}, {0, -25 * px}).position.y(), half_height);
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].collider, 0U);
  Rig<double> fast(pixel_tile, {rectangle(-2, -px, 2, 0)});
  EXPECT_EQ(fast.move({0, 3}, {0, -1000}).position.y(), half_height);
}

TEST(PixelTiles, of_a_hill_that_slopes_down_to_the_right_say_up_to_the_left_and_down_to_the_right) {
  // The article's example: half of a tile, from top left to bottom right.
  const PixelTileSet tiles = make_pixel_tiles({{{.points = {{0, 0}, {1, 0}, {0, 1}}}}}, 32, 32);
  for (int x = 1; x < 30; ++x) {
    const int top = tiles.at(x, 31 - x).is_solid() ? 31 - x : 30 - x;  // of the column: the edge runs through centres
    for (int y = 0; y < 32; ++y) {
      const PixelCollision pixel = tiles.at(x, y);
      ASSERT_EQ(pixel.is_solid(), y <= top) << x << ' ' << y;
      if (y < top) {
        EXPECT_EQ(pixel, (PixelCollision{PixelAction::block, PixelAction::block})) << x << ' ' << y;
      } else if (y == top) {
        EXPECT_EQ(pixel, (PixelCollision{PixelAction::up, PixelAction::block})) << x << ' ' << y;
      } else if (y == top + 2) {
        EXPECT_EQ(pixel, (PixelCollision{PixelAction::nothing, PixelAction::down})) << x << ' ' << y;
      } else {
        EXPECT_EQ(pixel, PixelCollision{}) << x << ' ' << y;
      }
    }
  }
}

TEST(PixelTiles, with_the_same_content_share_a_type) {
  SceneryDef scenery;
  for (int i = 0; i < 500; ++i) scenery.colliders.push_back(rectangle(i, 0, i + 1, 1));
  const PixelTileSet tiles = make_pixel_tiles(scenery, 32, 32);
  tiles.validate();
  // Empty, solid, and the two ends: there the ground's upper edge is one column short of nothing at all.
  EXPECT_LE(tiles.types.size(), 6U);
  EXPECT_GE(tiles.types.size(), 2U);
  EXPECT_GE(tiles.map.size(), 500U);
  EXPECT_LT(tiles.memory_bytes(), 6U * 32U * 32U * 2U + 5000U * 4U);
}

TEST(PixelTiles, agree_with_the_bitmap_for_tiles_of_any_size) {
  constexpr std::uint64_t seed = 9;
  Random random(seed);
  std::size_t solid = 0;
  constexpr int sceneries = test::sampled(60);
  for (int i = 0; i < sceneries; ++i) {
    SceneryDef scenery;
    for (int k = 0; k < 3; ++k) {
      ColliderDef triangle;
      for (int corner = 0; corner < 3; ++corner)
        triangle.points.push_back({random.between(-5, 5), random.between(-5, 5)});
      scenery.colliders.push_back(triangle);
    }
    const int size = 1 + random.below(100);
    const PixelTileSet tiles = make_pixel_tiles(scenery, 16, size);
    tiles.validate();
    const raster::Bitmap level = raster::rasterise(scenery, 16);
    for (std::int64_t y = -90; y < 90; ++y) {
      for (std::int64_t x = -90; x < 90; ++x) {
        const auto white = [&](int dx, int dy) { return level.is_white({x + dx, y + dy}); };
        const auto action = [&](int from) {
          const bool stood = !white(from, 0) && white(from, -1);
          if (white(0, 0)) return stood && !white(0, 1) ? PixelAction::up : PixelAction::block;
          return stood && !white(0, -1) && white(0, -2) ? PixelAction::down : PixelAction::nothing;
        };
        ASSERT_EQ(tiles.at(x, y), (PixelCollision{action(1), action(-1)}))
            << "seed " << seed << ", " << i << ", " << size << ": " << x << ' ' << y;
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
  const Scenery<double> scenery(SceneryDef{{rectangle(-0.5, -0.25, 0.5, 0)}});
  TechniqueDef def{.name = pixel_tile, .pixel_tiles = std::make_shared<const PixelTileSet>(by_hand())};
  const auto technique = make_technique<double>(def, scenery, of_shape(single_pixel()));
  Scratch<double> scratch = technique->make_scratch();
  MoveResult<double> result;
  technique->move({.position = {-0.3, 1}, .displacement = {0, -5}}, scratch, result);
  EXPECT_EQ(result.position, Vec2d(-0.3, px / 2)) << "on the lower row";
  ASSERT_EQ(result.contacts.size(), 1U);
  technique->move({.position = {-0.3, px / 2}, .displacement = {5, 0}}, scratch, result);
  EXPECT_EQ(result.position, Vec2d(8 * px - px / 2, px / 2))
      << "at the third tile of the upper row, which no collider has";
  EXPECT_TRUE(result.contacts.empty());
}

TEST(PixelTiles, that_do_not_fit_are_named) {
  const auto message = [](const auto& spoil) -> std::string {
    PixelTileSet tiles = by_hand();
    spoil(tiles);
    try {
      tiles.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto expect = [&](const std::string& part, const auto& spoil) {
    EXPECT_NE(message(spoil).find(part), std::string::npos) << message(spoil);
  };
  expect("accepted", [](PixelTileSet&) {});
  expect("at least 1 pixel", [](PixelTileSet& tiles) { tiles.pixels_per_tile = 0; });
  expect("type 0 has 64 pixels instead of 49", [](PixelTileSet& tiles) { tiles.pixels_per_tile = 7; });
  expect("rows of 3", [](PixelTileSet& tiles) { tiles.columns = 3; });
  expect("rows of 0", [](PixelTileSet& tiles) { tiles.columns = 0; });
  expect("type 2 of 2", [](PixelTileSet& tiles) { tiles.map[3] = 2; });
  expect("one direction only", [](PixelTileSet& tiles) { tiles.types[1][5].moving_left = PixelAction::down; });
}

TEST(PixelTile, allocates_nothing_while_moving) {
  Rig<double> rig(pixel_tile, hill(2, 2));
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 100; ++i) rig.move({-1, half_height}, {i * px, -i * px});
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(rig.result.contacts.empty());
}

TEST(RasterKnobs, out_of_range_are_named) {
  const auto message = [](const ArticleKnobs& knobs) -> std::string {
    try {
      Rig<double> rig(pixel_tile, {rectangle(0, 0, 1, 1)}, knobs);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({}), "accepted");
  for (const double bad : {0.0, -1.0, 1001.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(message({.raster_pixels_per_metre = bad}).substr(0, 24), "raster_pixels_per_metre:");
  for (const int bad : {0, -4, 4097}) EXPECT_EQ(message({.pixels_per_tile = bad}).substr(0, 16), "pixels_per_tile:");
}

}  // namespace
}  // namespace paperproof::article_tests
