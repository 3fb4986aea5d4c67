/// Which pixels a scenery covers, and the techniques that compare them.
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

TEST(Rasteriser, draws_neither_sensors_nor_what_moves) {
  const ColliderDef solid = rectangle(0, 0, 1, 1);
  ColliderDef sensor = chain({{-100, 0}, {1e6, 7}});
  sensor.sensor = true;
  const ColliderDef mover = compare::box(4, 0, 5, 1, 0);
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

TEST(Mask, takes_the_vertical_movement_first_as_the_pairs_are) {
  // Past the corner of a block, by as much down as to the right: down first, and then its fourth row of pixels, which
  // is 7 px wide on the right of the middle, meets the block 3 px later. The other way round it would end at (4, -3).
  Rig<double> rig("mask", {rectangle(half_width, -9, 9, -half_height)});
  EXPECT_EQ(rig.move({0, 0}, {4 * px, -4 * px}).position, Vec2d(3 * px, -4 * px));
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].side, Side::right);
}

TEST(Mask, compares_only_the_white_pixels_of_its_picture_which_is_as_large_as_the_character) {
  TechniqueDef leg_on_the_left{.name = "mask"};
  for (int row = 0; row < 40; ++row) leg_on_the_left.sprite.emplace_back(row < 30 ? 20 : 5, '#').resize(20, '.');
  const std::vector<ColliderDef> on_the_right{rectangle(0, -9, 9, -half_height - px)};
  EXPECT_EQ(Rig<double>("mask", on_the_right).move({0, 0}, {0, -5 * px}).position.y(), -px) << "the hull";
  EXPECT_EQ(Rig<double>(leg_on_the_left, on_the_right).move({0, 0}, {0, -5 * px}).position.y(), -5 * px);
  leg_on_the_left.sprite.pop_back();
  EXPECT_THROW(Rig<double>(leg_on_the_left, on_the_right), std::invalid_argument);
}

TEST(Mask, is_accurate_to_the_pixel_in_scenery_of_any_shape) {
  // A tooth two pixels high and two wide, under the left foot, beside it, or just not.
  for (int x = -12; x <= 12; ++x) {
    const double left = x * px;
    Rig<double> rig("mask", {rectangle(-2, -1, 2, 0), rectangle(left, 0, left + 2 * px, 2 * px)});
    const double feet = rig.move({0, half_height + 10 * px}, {0, -9.5 * px}).position.y() - half_height;
    // The lowest two rows of the octagon: half a pixel above the feet it reaches from -5 - 0.25 to 5 + 0.25 px, with
    // pixel centres from -4.5 to 4.5; one and a half above, up to 5.75: from -5.5 to 5.5.
    int expected = 2;
    if (x + 1 < -5 || x > 4) expected = 1;
    if (x + 1 < -6 || x > 5) expected = 0;
    // A column that only the second row has collides from one row higher on.
    EXPECT_EQ(feet, expected == 0 ? 0.5 * px : expected * px) << x;
  }
}

TEST(PixelColour, is_stopped_by_decoration_in_the_colour_of_a_platform_which_is_no_collider) {
  const SceneryDef cloud{{rectangle(half_width + 2 * px, 0, 3, 1)}};
  const TechniqueDef painted{.name = "pixel_colour", .decoration = std::make_shared<const SceneryDef>(cloud)};
  Rig<double> rig(painted, {rectangle(-9, -9, 9, -half_height)});
  EXPECT_EQ(rig.move({0, 0}, {8 * px, 0}).position.x(), 2 * px);
  EXPECT_TRUE(rig.result.contacts.empty());
}

}  // namespace
}  // namespace paperproof::article_tests
