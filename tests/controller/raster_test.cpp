/// Which pixels a scenery covers.
#include "techniques/raster/sprite.hpp"

#include "controller/article_support.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <set>

namespace paperproof::article_tests {
namespace {

using raster::Bitmap;
using raster::Pixel;
using raster::Span;

constexpr int sixteenth = 16;  // the tests place vertices on sixteenths of a pixel, exact in every arithmetic

using Lattice = std::array<std::int64_t, 2>;  ///< A point in sixteenths of a pixel.

ColliderDef polygon_of(const std::vector<Lattice>& ring) {
  ColliderDef polygon;
  for (const Lattice& at : ring) polygon.points.push_back(Vec2d(double(at[0]), double(at[1])) / sixteenth);
  return polygon;
}

enum class Place : std::uint8_t { outside, inside, edge };

/// The slow, honest twin: crossing parity of one point in whole numbers.
Place place_of(const Lattice& point, const std::vector<Lattice>& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Lattice& a = ring[i];
    const Lattice& b = ring[(i + 1) % ring.size()];
    const std::int64_t area = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
    const bool in_box = std::min(a[0], b[0]) <= point[0] && point[0] <= std::max(a[0], b[0]) &&
                        std::min(a[1], b[1]) <= point[1] && point[1] <= std::max(a[1], b[1]);
    if (area == 0 && in_box) return Place::edge;
    const bool crosses = (a[1] <= point[1]) != (b[1] <= point[1]);
    const bool on_right = b[1] > a[1] ? area < 0 : area > 0;
    if (crosses && on_right) inside = !inside;
  }
  return inside ? Place::inside : Place::outside;
}

std::vector<Lattice> random_ring(Random& random, int size) {
  std::vector<Lattice> ring;
  const int corners = 3 + random.below(6);
  for (int i = 0; i < corners; ++i) ring.push_back({random.below(2 * size) - size, random.below(2 * size) - size});
  return ring;
}

TEST(Rasteriser, makes_a_pixel_solid_when_its_centre_is_inside) {
  Random random(3);
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    const std::vector<Lattice> ring = random_ring(random, 20 * sixteenth);  // it may cross itself: parity counts
    const Bitmap level = raster::rasterise({{polygon_of(ring)}}, 1);
    for (int y = -22; y < 22; ++y) {
      for (int x = -22; x < 22; ++x) {
        const Place place = place_of({x * sixteenth + sixteenth / 2, y * sixteenth + sixteenth / 2}, ring);
        if (place == Place::edge) continue;  // either: see the test of shared edges
        ++(place == Place::inside ? inside : outside);
        ASSERT_EQ(level.is_white({x, y}), place == Place::inside) << "seed 3, polygon " << i << ": " << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(inside, 80'000);
  EXPECT_GT(outside, 80'000);
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
  constexpr int pairs = test::sampled(2000);
  for (int i = 0; i < pairs; ++i) {
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
  ColliderDef frame = rectangle(0, 0, 10, 10);
  frame.holes.push_back({{3, 3}, {7, 3}, {7, 7}, {3, 7}});
  EXPECT_EQ(pixels_of(frame, 1).size(), 100U - 16U);
  EXPECT_FALSE(raster::rasterise({{frame}}, 1).is_white({5, 5}));
}

TEST(Rasteriser, draws_a_chain_as_a_line_without_gaps_or_thickness) {
  Random random(5);
  constexpr int chains = test::sampled(2000);
  for (int i = 0; i < chains; ++i) {
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

TEST(Rasteriser, finds_the_pixels_of_a_piece_one_by_one_too) {
  Random random(6);
  std::size_t solid = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<Vec2d> points{random.point(9), random.point(9)};
    if (i % 2 == 1) points.push_back(random.point(9));
    const Pixels pixels = pixels_of(i % 2 == 0 ? chain(points) : ColliderDef{.points = points}, 1.3);
    for (std::int64_t y = -14; y < 14; ++y)
      for (std::int64_t x = -14; x < 14; ++x)
        ASSERT_EQ(raster::covers<double>(points, 1.3, {x, y}), pixels.contains({x, y})) << "seed 6, " << i;
    solid += pixels.size();
  }
  EXPECT_GT(solid, 10'000U);
}

TEST(Rasteriser, draws_neither_sensors_nor_what_moves) {
  const ColliderDef solid = rectangle(0, 0, 1, 1);
  ColliderDef sensor = chain({{-100, 0}, {1e6, 7}});
  sensor.sensor = true;
  const ColliderDef mover = compare::box(4, 0, 5, 1, 0);
  const raster::PixelBox level = raster::rasterise({{sensor, solid, mover}}, 32).box();
  const raster::PixelBox alone = raster::rasterise({{solid}}, 32).box();
  EXPECT_EQ(level.lower, alone.lower);
  EXPECT_EQ(level.width, alone.width);
  EXPECT_EQ(level.height, alone.height);
  EXPECT_EQ(raster::pixels_around({{sensor, mover}}, 32).width, 0) << "nothing is solid";
  const raster::ColourPicture picture({{sensor, solid, mover}}, 32);
  EXPECT_EQ(picture.colour({16, 16}), 2) << "a collider keeps its number";
  EXPECT_EQ(picture.colour({-1, 0}), 0);
}

TEST(Rasteriser, says_why_it_cannot_draw_something) {
  for (const std::string_view kind : {"mask", "pixel_colour", "pixel_tile"}) {
    const auto reason = [&](const ColliderDef& collider) {
      return refusal_by<NotExpressible>([&] { Rig<double>(kind, {collider}); });
    };
    EXPECT_NE(reason(chain({{-1, 0}, {1, 0}}, Vec2d{0, 1})).find("one-way"), std::string::npos);
    const std::string too_large = reason({.points = {{-1e6, 0}, {1e6, 0}, {0, 1e6}}});
    EXPECT_NE(too_large.find("64000001 x 32000001"), std::string::npos) << too_large;
    EXPECT_NE(too_large.find("256 MiB"), std::string::npos) << too_large;
  }
}

TEST(Colours, go_round_from_1_to_255_and_leave_0_to_the_background) {
  const raster::ColourPicture picture({flush_tiles(300)}, 2);
  for (int x = 0; x < 600; ++x) ASSERT_EQ(picture.colour({x, -1}), 1 + x / 2 % 255);
  for (const Pixel& outside : {Pixel{-1, -1}, Pixel{0, 0}, Pixel{0, -3}, Pixel{600, -1}})
    EXPECT_EQ(picture.colour(outside), 0);
}

TEST(SpriteOfTheArticle, is_its_octagon_with_the_collision_points_on_its_edge) {
  const raster::Sprite sprite(CharacterShape::article(), 32);
  // Row y of 40 is cut by the shoulders: in the lowest and highest 10 rows half a pixel for each row of the distance.
  for (int y = 0; y < 40; ++y) {
    const double cut = std::max(0.0, 5 - (std::min(y, 39 - y) + 0.5) / 2);  // from (5, 0) to (0, 10)
    for (int x = 0; x < 20; ++x) {
      const double from_side = std::min(x, 19 - x) + 0.5;
      if (from_side == cut) continue;  // on the slant: either
      ASSERT_EQ(sprite.mask().is_white({x, y}), from_side > cut) << x << ' ' << y;
    }
  }
  EXPECT_EQ(sprite.edge(Side::left).size(), 40U);
  EXPECT_EQ(sprite.edge(Side::bottom).size(), 20U);
  EXPECT_EQ(sprite.feet()[0], (Pixel{5, 0}));
  EXPECT_EQ(sprite.feet()[1], (Pixel{14, 0}));
  for (const Pixel& point : sprite.points()) EXPECT_TRUE(sprite.mask().box().contains(point));
}

TEST(Bitmaps, overlap_by_words_as_they_do_pixel_by_pixel) {
  Random random(7);
  int overlapping = 0;
  constexpr int scenes = test::sampled(100);
  for (int scene = 0; scene < scenes; ++scene) {
    SceneryDef scenery;
    for (int i = 0; i < 12; ++i)
      scenery.colliders.push_back({.points = on_an_ellipse(random, random.point(200), {75, 75})});
    const Bitmap level = raster::rasterise(scenery, 1);
    // Up to three words wide.
    const Bitmap sprite = raster::rasterise({{polygon_of(random_ring(random, (5 + random.below(80)) * sixteenth))}}, 1);
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

}  // namespace
}  // namespace paperproof::article_tests
