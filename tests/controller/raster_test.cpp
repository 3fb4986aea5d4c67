/// Which pixels a scenery covers, and the techniques that compare them.
#include <paperproof/pixel_tiles.hpp>

#include "techniques/raster/sprite.hpp"

#include "controller/scenery_definitions.hpp"
#include "controller/stepping.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <set>

namespace paperproof::stepping {
namespace {

using raster::Bitmap;
using raster::Pixel;
using raster::Span;
using test::Where;
using test::where_is;

constexpr int sixteenth = 16;  // the tests place vertices on sixteenths of a pixel, exact in every arithmetic

/// In pixels.
std::vector<Vec2d> random_ring(Random& random, int size) {
  std::vector<Vec2d> ring(static_cast<std::size_t>(3 + random.below(6)));
  for (Vec2d& point : ring) point = Vec2d{random.integer(-size, size - 1), random.integer(-size, size - 1)} / sixteenth;
  return ring;
}

TEST(Rasteriser, makes_a_pixel_solid_when_its_centre_is_inside) {
  Random random(3);
  int inside = 0;
  int outside = 0;
  const int rings = test::sampled(500);
  for (int i = 0; i < rings; ++i) {
    const std::vector<Vec2d> ring = random_ring(random, 20 * sixteenth);  // it may cross itself: parity counts
    const Bitmap level = raster::rasterise({{compare::polygon(ring)}}, 1);
    for (int y = -22; y < 22; ++y) {
      for (int x = -22; x < 22; ++x) {
        const Where place = where_is({x + 0.5, y + 0.5}, ring);
        if (place == Where::on_the_outline) continue;  // either: see the test of shared edges
        ++(place == Where::inside ? inside : outside);
        ASSERT_EQ(level.is_white({x, y}), place == Where::inside) << "seed 3, polygon " << i << ": " << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(inside, 160 * rings);
  EXPECT_GT(outside, 160 * rings);
}

using Pixels = std::set<std::pair<std::int64_t, std::int64_t>>;

Pixels pixels_of(const ColliderDef& collider, double pixels_per_metre) {
  std::vector<Span> spans;
  raster::spans_of(collider, pixels_per_metre, spans);
  Pixels pixels;
  for (const Span& span : spans)
    for (std::int64_t x = span.first; x < span.end; ++x) pixels.insert({x, span.row});
  return pixels;
}

TEST(Rasteriser, gives_each_pixel_of_two_polygons_with_a_common_edge_to_exactly_one) {
  Random random(4);
  std::size_t shared = 0;
  const unsigned pairs = test::sampled(2000U);
  for (unsigned i = 0; i < pairs; ++i) {
    const auto corner = [&](double x, double y) { return Vec2d{x * random.between(1, 9), y * random.between(1, 9)}; };
    // One corner in each quadrant; cut from the first to the third.
    const std::vector<Vec2d> quad{corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)};
    const Pixels whole = pixels_of({.points = quad}, 2.7);
    const Pixels left = pixels_of({.points = {quad[0], quad[1], quad[2]}}, 2.7);
    const Pixels right = pixels_of({.points = {quad[2], quad[3], quad[0]}}, 2.7);
    // The quadrilateral is concave where the cut leaves it: then one triangle takes from the other.
    const Vec2d cut = quad[2] - quad[0];
    const auto side = [&](const Vec2d& p) { return cut.x() * (p - quad[0]).y() - cut.y() * (p - quad[0]).x(); };
    if (side(quad[1]) >= 0 || side(quad[3]) <= 0) continue;
    ++shared;
    Pixels both = left;
    both.insert(right.begin(), right.end());
    ASSERT_EQ(both, whole) << "seed 4, " << i;
    ASSERT_EQ(left.size() + right.size(), whole.size()) << "seed 4, " << i;
  }
  EXPECT_GT(shared, pairs / 4U);
}

TEST(Rasteriser, respects_holes) {
  ColliderDef frame = box(0, 0, 10, 10);
  frame.holes.push_back({{3, 3}, {7, 3}, {7, 7}, {3, 7}});
  EXPECT_EQ(pixels_of(frame, 1).size(), 100U - 16U);
  EXPECT_FALSE(raster::rasterise({{frame}}, 1).is_white({5, 5}));
}

TEST(Rasteriser, draws_a_chain_as_a_line_without_gaps_or_thickness) {
  Random random(5);
  const unsigned chains = test::sampled(2000U);
  for (unsigned i = 0; i < chains; ++i) {
    const std::vector<Vec2d> points{random.point(30), random.point(30), random.point(30)};
    const Pixels pixels = pixels_of(chain(points), 1);
    std::size_t longest = 0;
    for (const std::size_t segment : {0U, 1U}) {
      const Vec2d way = points[segment + 1] - points[segment];
      const bool flat = std::abs(way.x()) >= std::abs(way.y());
      longest += static_cast<std::size_t>(way.cwiseAbs().maxCoeff()) + 4;
      // Every pixel that the line runs through is drawn, or a neighbour of it across the line; the ends are.
      for (int k = 0; k <= 100; ++k) {
        const Vec2d on_line = (points[segment] + way * (k / 100.0)).array().floor();
        const auto is_drawn = [&](int off) {
          return pixels.contains({static_cast<std::int64_t>(on_line.x()) + (flat ? 0 : off),
                                  static_cast<std::int64_t>(on_line.y()) + (flat ? off : 0)});
        };
        ASSERT_TRUE(is_drawn(0) || (k % 100 != 0 && (is_drawn(-1) || is_drawn(1)))) << "seed 5, chain " << i;
      }
    }
    EXPECT_LE(pixels.size(), longest) << "one pixel for each column or row";
  }
}

TEST(Rasteriser, draws_neither_sensors_nor_what_moves) {
  const ColliderDef solid = box(0, 0, 1, 1);
  ColliderDef sensor = chain({{-100, 0}, {1e6, 7}});
  sensor.sensor = true;
  const ColliderDef mover = box(4, 0, 5, 1, 0);
  const Bitmap level = raster::rasterise({{sensor, solid, mover}}, 32);
  const Bitmap alone = raster::rasterise({{solid}}, 32);
  EXPECT_EQ(level.box().lower, alone.box().lower);
  EXPECT_EQ(level.memory_bytes(), alone.memory_bytes());
  EXPECT_EQ(raster::pixels_around({{sensor, mover}}, 32).width, 0) << "nothing is solid";
  const raster::ColourPicture picture({{sensor, solid, mover}}, 32);
  EXPECT_EQ(picture.colour({16, 16}), 2) << "a collider keeps its number";
  EXPECT_EQ(picture.colour({-1, 0}), 0);
}

TEST(Rasteriser, says_why_it_cannot_draw_something) {
  for (const std::string_view kind : {"mask", "pixel_colour", "pixel_tile"}) {
    const auto reason = [&](const ColliderDef& collider) {
      return refusal_by<NotExpressible>([&] { Stepper({collider}, {}, kind); });
    };
    EXPECT_NE(reason(chain({{-1, 0}, {1, 0}}, Vec2d{0, 1})).find("one-way"), std::string::npos);
    const std::string too_large = reason({.points = {{-1e6, 0}, {1e6, 0}, {0, 1e6}}});
    EXPECT_NE(too_large.find("64000001 x 32000001"), std::string::npos) << too_large;
    EXPECT_NE(too_large.find("256 MiB"), std::string::npos) << too_large;
  }
}

TEST(Colours, go_round_from_1_to_255_and_leave_0_to_the_background) {
  SceneryDef tiles;
  for (int x = 0; x < 300; ++x) tiles.colliders.push_back(box(x, -1, x + 1, 0));
  const raster::ColourPicture picture(tiles, 2);
  for (int x = 0; x < 600; ++x) ASSERT_EQ(picture.colour({x, -1}), 1 + x / 2 % 255);
  for (const Pixel& outside : {Pixel{-1, -1}, Pixel{0, 0}, Pixel{0, -3}, Pixel{600, -1}})
    EXPECT_EQ(picture.colour(outside), 0);
}

TEST(Bitmaps, overlap_by_words_as_they_do_pixel_by_pixel) {
  Random random(7);
  int overlapping = 0;
  const int scenes = test::sampled(100);
  for (int scene = 0; scene < scenes; ++scene) {
    SceneryDef scenery;
    for (int i = 0; i < 12; ++i)
      scenery.colliders.push_back({.points = on_an_ellipse(random, random.point(200), {75, 75})});
    const Bitmap level = raster::rasterise(scenery, 1);
    // Up to three words wide.
    const Bitmap sprite =
        raster::rasterise({{compare::polygon(random_ring(random, (5 + random.below(80)) * sixteenth))}}, 1);
    for (int i = 0; i < 100; ++i) {
      const Pixel at{random.below(500) - 250, random.below(500) - 250};
      int expected = 0;
      for (std::int64_t y = 0; y < sprite.box().height; ++y)
        for (std::int64_t x = 0; x < sprite.box().width; ++x)
          expected += level.is_white(at + Pixel{x, y}) && sprite.is_white(sprite.box().lower + Pixel{x, y}) ? 1 : 0;
      ASSERT_EQ(level.overlaps(sprite, at), expected > 0) << "seed 7, scene " << scene << ", " << i;
      int found = 0;
      level.for_each_overlap(sprite, at, [&](const Pixel&) { ++found; });
      ASSERT_EQ(found, expected) << "seed 7, scene " << scene << ", " << i;
      overlapping += expected > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(overlapping, scenes * 30);
  EXPECT_LE(overlapping, scenes * 70);
}

TEST(Sprite, has_the_outermost_pixel_of_each_row_and_column_on_its_edges) {
  for (const double pixels_per_metre : {32, 47, 49}) {  // exact; the last row, or column, is a part of a pixel
    const raster::Sprite sprite(CharacterDef{}.shape, pixels_per_metre);
    const Bitmap& mask = sprite.mask();
    for (const auto& [side, outwards] : {std::pair{Side::left, Pixel{-1, 0}}, std::pair{Side::right, Pixel{1, 0}},
                                         std::pair{Side::bottom, Pixel{0, -1}}, std::pair{Side::top, Pixel{0, 1}}}) {
      Pixels outermost;  // a convex shape has one run of pixels in each row and column
      for (std::int64_t y = 0; y < mask.box().height; ++y)
        for (std::int64_t x = 0; x < mask.box().width; ++x)
          if (mask.is_white({x, y}) && !mask.is_white(Pixel{x, y} + outwards)) outermost.emplace(x, y);
      Pixels edge;
      for (const Pixel& pixel : sprite.edge(side)) edge.emplace(pixel.x, pixel.y);
      EXPECT_EQ(edge, outermost);
      EXPECT_EQ(sprite.edge(side).size(), outermost.size());
    }
  }
}

TEST(Mask, refuses_a_picture_that_is_not_as_large_as_the_character) {
  TechniqueDef too_low{.name = "mask"};
  too_low.sprite.assign(39, std::string(20, '#'));
  EXPECT_THROW(Stepper({box(0, 0, 1, 1)}, {}, too_low), std::invalid_argument);
}

// Tiles whose pixels say what a collision does. See also tests/situations/techniques.json.

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
}  // namespace paperproof::stepping
