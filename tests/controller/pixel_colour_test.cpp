/// The colours next to the character, before each pixel of movement.
#include "techniques/raster/sprite.hpp"

#include "controller/article_support.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::article_tests {
namespace {

using raster::Pixel;

constexpr double half_height = 20 * px;
constexpr double half_width = 10 * px;
constexpr std::string_view pixel_colour = "pixel_colour";

template <class Scalar>
class PixelColourIn : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PixelColourIn, Scalars);

TYPED_TEST(PixelColourIn, stops_the_articles_bullet_on_the_pixel_above_the_platform) {
  for (const double thickness : {5.0, 1.0}) {
    // Half a pixel higher than in the article's scene, where all edges lie on whole pixels.
    const double top = -30 * px;
    Rig<TypeParam> rig(pixel_colour, {rectangle(-2, top - thickness * px, 2, top)}, {}, single_pixel());
    for (const double speed : {50.0, 1000.0, 100'000.0}) {
      const MoveResult<TypeParam>& result = rig.move({px / 2, px / 2}, {0, -speed * px});
      EXPECT_EQ(result.position, Vec2<TypeParam>(static_cast<TypeParam>(px / 2), static_cast<TypeParam>(-29.5 * px)));
      EXPECT_TRUE(result.grounded);
      ASSERT_EQ(result.contacts.size(), 1U);
      EXPECT_NEAR(double(result.contacts[0].fraction), 30 / speed, 1e-6);
      EXPECT_EQ(result.contacts[0].point.y(), static_cast<TypeParam>(top));
    }
  }
}

TEST(PixelColour, is_stopped_by_decoration_in_the_colour_of_a_platform) {
  const Scenery<double> scenery(SceneryDef{{rectangle(-9, -9, 9, -half_height)}});
  TechniqueDef def{.name = pixel_colour};
  SceneryDef cloud{{rectangle(half_width + 2 * px, 0, 3, 1)}};
  for (const bool painted : {false, true}) {
    if (painted) def.decoration = std::make_shared<const SceneryDef>(cloud);
    const auto technique = make_technique<double>(def, scenery, CharacterDef{});
    Scratch<double> scratch = technique->make_scratch();
    MoveRequest<double> request;
    request.displacement = request.velocity = Vec2d(8 * px, 0);
    MoveResult<double> result;
    technique->move(request, scratch, result);
    EXPECT_EQ(result.position.x(), (painted ? 2 : 8) * px);
    EXPECT_TRUE(result.contacts.empty()) << "it is no collider";
  }
}

TYPED_TEST(PixelColourIn, keeps_the_component_that_is_free_and_records_the_corner) {
  Rig<TypeParam> rig(pixel_colour, {rectangle(-9, -9, 9, 0)});
  const MoveResult<TypeParam>& result = rig.move({0, 24 * px}, {10 * px, -10 * px});
  EXPECT_EQ(result.position, Vec2<TypeParam>(10 * px, half_height));
  EXPECT_EQ(result.velocity, Vec2<TypeParam>(10 * px, 0));
  ASSERT_EQ(result.path.size(), 3U);
  EXPECT_NEAR(double(result.path[1].fraction), 0.4, 1e-6);
  EXPECT_NEAR(double(result.path[1].position.x()), 4 * px, 1e-6);
  EXPECT_NEAR(double(result.path[1].position.y()), half_height, 1e-6);
}

TEST(PixelColour, moves_by_fractions_of_a_pixel_where_nothing_is_in_the_way) {
  Rig<double> rig(pixel_colour, {rectangle(-9, -9, 9, -5)});
  const Vec2d displacement{1.3 * px, -0.7 * px};
  EXPECT_EQ(rig.move({0.123, 0.456}, displacement).position, Vec2d(0.123, 0.456) + displacement);
  EXPECT_TRUE(rig.result.contacts.empty());
}

TEST(PixelColour, names_every_collider_that_it_stands_on) {
  Rig<double> rig(pixel_colour, {rectangle(-3, -1, 0, 0), rectangle(0, -1, 3, 0)});
  rig.move({0, half_height}, {0, -px});
  ASSERT_EQ(rig.result.contacts.size(), 2U);
  EXPECT_EQ(rig.result.contacts[0].collider, 0U);
  EXPECT_EQ(rig.result.contacts[1].collider, 1U);
  rig.move({1, half_height}, {0, -px});
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].collider, 1U);
}

TEST(PixelColour, falls_and_walks_over_flush_tiles_without_a_change_of_speed) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 12; ++i) tiles.push_back(rectangle(i, -1, i + 1, 0));
  Rig<double> rig(pixel_colour, tiles);
  Walker walker{.position = {1, half_height}, .velocity = {6, 0}};
  for (int step = 1; step <= 96; ++step) {
    walker.step(rig);
    ASSERT_EQ(walker.position, Vec2d(1 + step * 6.0 / 64, half_height));
    ASSERT_EQ(walker.velocity, Vec2d(6, 0));
  }
}

TEST(PixelColour, meets_a_corner_where_its_octagon_does) {
  // A ledge whose edge is `off` px right of the middle of a fall: the feet reach 5 px to the right, the arms 10.
  for (int off = 0; off <= 11; ++off) {
    Rig<double> rig(pixel_colour, {rectangle(off * px, -9, 9, 0)});
    rig.move({0, 30 * px}, {0, -40 * px});
    // The lowest row whose half width exceeds `off`: row y (its middle y + 1/2) has 5 + (y + 1/2) / 2.
    int row = 0;
    while (row < 10 && std::floor(5 + (row + 0.5) / 2 + 0.5) <= off) ++row;
    const bool lands = off < 10;
    EXPECT_EQ(rig.result.position.y(), lands ? half_height - row * px : -10 * px) << off;
    EXPECT_EQ(rig.result.grounded, lands) << off;
  }
}

bool is_free_around(const raster::Bitmap& level, const raster::Sprite& sprite, const Vec2d& corner) {
  for (const double y : {std::floor(corner.y()), std::ceil(corner.y())}) {
    for (const double x : {std::floor(corner.x()), std::ceil(corner.x())}) {
      if (!level.overlaps(sprite.mask(), {std::int64_t(x), std::int64_t(y)})) return true;
    }
  }
  return false;
}

TEST(PixelColour, never_ends_in_a_solid_nor_leaves_a_room_of_paper) {
  constexpr std::uint64_t seed = 8;
  Random random(seed);
  int hits = 0;
  constexpr int throws_per_room = 500;
  constexpr int rooms = test::sampled(20);
  for (int room = 0; room < rooms; ++room) {
    // Walls without thickness, none of them straight up or down, and things in between.
    const auto near = [&](double x, double y) { return Vec2d{x + random.between(-1, 1), y + random.between(-1, 1)}; };
    const Vec2d first = near(-8, -6);
    SceneryDef scenery{{chain({first, near(8, -6), near(8, 6), near(-8, 6), first})}};
    for (int i = 0; i < 8; ++i) {
      const Vec2d at{random.between(-6, 6), random.between(-4, 4)};
      if (at.cwiseAbs().maxCoeff() < 2.5) continue;  // room for the start
      const auto side = [&] { return random.between(0.1, 1); };
      scenery.colliders.push_back({.points = {at, at + Vec2d{side(), -0.2 * side()}, at + Vec2d{0.1, side()}}});
    }
    const raster::Bitmap level = raster::rasterise(scenery, 32);
    const raster::Sprite sprite(CharacterShape::article(), 32);
    Rig<double> rig(pixel_colour, scenery.colliders);
    Vec2d position{0, 0};
    for (int i = 0; i < throws_per_room; ++i) {
      const double reach = i % 2 == 0 ? 0.2 : 30;
      const MoveResult<double>& result =
          rig.move(position, {random.between(-reach, reach), random.between(-reach, reach)});
      position = result.position;
      hits += result.contacts.empty() ? 0 : 1;
      ASSERT_TRUE(is_free_around(level, sprite, (position + Vec2d(-half_width, -half_height)) * 32))
          << "seed " << seed << ", room " << room << ", throw " << i;
      ASSERT_LT(position.cwiseAbs().maxCoeff(), 9) << "seed " << seed << ", room " << room << ", throw " << i;
    }
  }
  EXPECT_GT(hits, rooms * throws_per_room * 3 / 10);
  EXPECT_LT(hits, rooms * throws_per_room * 9 / 10);
}

TEST(PixelColour, takes_a_byte_for_each_pixel_and_nothing_while_moving) {
  Rig<double> rig(pixel_colour, {rectangle(0, 0, 10, 5)});
  EXPECT_GE(rig.technique->memory_bytes(), 320U * 160U);
  EXPECT_LE(rig.technique->memory_bytes(), 322U * 162U + 400U);
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 100; ++i) rig.move({1, 5 + half_height + 5 * px}, {i * px, -i * px});
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(rig.result.contacts.empty());
}

}  // namespace
}  // namespace paperproof::article_tests
