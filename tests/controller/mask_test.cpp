/// Level and sprite in black and white.
#include "controller/article_support.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::article_tests {
namespace {

constexpr double half_height = 20 * px;
constexpr double half_width = 10 * px;
constexpr std::string_view mask = "mask";

template <class Scalar>
class MaskIn : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MaskIn, Scalars);

TYPED_TEST(MaskIn, lands_on_the_pixel_above_the_ground_and_stays_there) {
  for (int eighths = 1; eighths < 40; ++eighths) {
    Rig<TypeParam> rig(mask, {rectangle(-9, -2, 9, 0)});
    Vec2d position{0.3, half_height + eighths * px / 8};
    Vec2d velocity{0, 0};
    for (int step = 0; step < 60; ++step) {
      velocity.y() -= px / 8;
      const MoveResult<TypeParam>& result = rig.move(position, velocity);
      position = result.position.template cast<double>();
      velocity = result.velocity.template cast<double>();
    }
    EXPECT_EQ(position.y(), half_height);
    EXPECT_EQ(velocity, Vec2d(0, 0));
    EXPECT_TRUE(rig.result.grounded);
    ASSERT_EQ(rig.result.contacts.size(), 1U);
    EXPECT_EQ(rig.result.contacts[0].side, Side::bottom);
    EXPECT_EQ(rig.result.contacts[0].point.y(), 0);
    EXPECT_EQ(rig.result.contacts[0].normal, Vec2<TypeParam>(0, 1));
  }
}

TYPED_TEST(MaskIn, is_stopped_on_a_whole_pixel_by_a_wall_on_any_side) {
  struct Case {
    Side side;
    ColliderDef wall;
    Vec2d movement;
    Vec2d end;
  };
  const double gap = 3 * px;
  const std::array cases{
      Case{Side::left, rectangle(-4, -9, -half_width - gap, 9), {-10.3 * px, 0}, {-gap, 0}},
      Case{Side::right, rectangle(half_width + gap, -9, 4, 9), {10.3 * px, 0}, {gap, 0}},
      Case{Side::bottom, rectangle(-9, -4, 9, -half_height - gap), {0, -10.3 * px}, {0, -gap}},
      Case{Side::top, rectangle(-9, half_height + gap, 9, 4), {0, 10.3 * px}, {0, gap}},
  };
  for (const Case& each : cases) {
    Rig<TypeParam> rig(mask, {each.wall});
    EXPECT_EQ(rig.move({0, 0}, each.movement).position.template cast<double>(), each.end);
    ASSERT_EQ(rig.result.contacts.size(), 1U);
    EXPECT_EQ(rig.result.contacts[0].side, each.side);
    EXPECT_NEAR(double(rig.result.contacts[0].fraction), 3 / 10.3, 1e-6);
    EXPECT_EQ(rig.result.velocity, Vec2<TypeParam>(0, 0));
    // Pressing on changes nothing, even by a fraction of a pixel.
    EXPECT_EQ(rig.move(each.end, 0.01 * each.movement).position.template cast<double>(), each.end);
    EXPECT_EQ(rig.result.contacts[0].fraction, 0);
  }
}

TEST(Mask, takes_the_vertical_movement_first_as_the_pairs_are) {
  // Past the corner of a block, by as much down as to the right: down first, and then its fourth row of pixels, which
  // is 7 px wide on the right of the middle, meets the block 3 px later. The other way round it would end at (4, -3).
  Rig<double> rig(mask, {rectangle(half_width, -9, 9, -half_height)});
  EXPECT_EQ(rig.move({0, 0}, {4 * px, -4 * px}).position, Vec2d(3 * px, -4 * px));
  ASSERT_EQ(rig.result.contacts.size(), 1U);
  EXPECT_EQ(rig.result.contacts[0].side, Side::right);
}

TEST(Mask, compares_only_the_white_pixels_of_its_picture) {
  TechniqueDef def{.name = mask};
  for (int row = 0; row < 40; ++row) def.sprite.emplace_back(row < 30 ? 20 : 5, '#').resize(20, '.');
  const Scenery<double> scenery(SceneryDef{{rectangle(0, -9, 9, -half_height - px)}});
  const auto fall = [&](const TechniqueDef& as) {
    const auto technique = make_technique<double>(as, scenery, CharacterDef{});
    Scratch<double> scratch = technique->make_scratch();
    MoveRequest<double> request;
    request.displacement = request.velocity = Vec2d(0, -5 * px);
    MoveResult<double> result;
    technique->move(request, scratch, result);
    return result.position.y();
  };
  EXPECT_EQ(fall({.name = mask}), -px) << "the hull is stopped by what is under its right half";
  EXPECT_EQ(fall(def), -5 * px) << "the picture has a leg on its left alone";
  def.sprite.pop_back();
  EXPECT_THROW((void)make_technique<double>(def, scenery, CharacterDef{}), std::invalid_argument);
}

TEST(Mask, passes_paper_that_lies_between_start_and_end) {
  const std::vector<ColliderDef> paper{rectangle(-2, -20 * px - half_height, 2, -17 * px - half_height)};
  Rig<double> fast(mask, paper);
  EXPECT_EQ(fast.move({0, 0}, {0, -70 * px}).position, Vec2d(0, -70 * px));
  EXPECT_TRUE(fast.result.contacts.empty());
  Rig<double> slow(mask, paper);
  EXPECT_EQ(slow.move({0, 0}, {0, -30 * px}).position, Vec2d(0, -17 * px)) << "an end that collides is wound back";
}

TEST(Mask, keeps_the_component_that_is_free) {
  Rig<double> rig(mask, {rectangle(-9, -9, 9, 0)});
  EXPECT_EQ(rig.move({0, 24 * px}, {10 * px, -10 * px}).position, Vec2d(10 * px, half_height));
  EXPECT_EQ(rig.result.velocity, Vec2d(10 * px, 0));
}

TEST(Mask, with_the_whole_vector_shortened_sticks_to_the_floor) {
  const std::vector<ColliderDef> floor{rectangle(-9, -9, 9, 0)};
  Rig<double> whole(mask, floor, {.response = ArticleKnobs::Response::shorten});
  // Feet 4 px above the floor and 6 px below at the end: wound back by k px of sqrt(200) until k >= 0.6 sqrt(200).
  const double fraction = 1 - std::ceil(0.6 * std::sqrt(200.0)) / std::sqrt(200.0);
  const MoveResult<double>& result = whole.move({0, 24 * px}, {10 * px, -10 * px});
  EXPECT_NEAR(result.position.x(), 10 * px * fraction, 1e-15);
  EXPECT_NEAR(result.position.y(), 24 * px - 10 * px * fraction, 1e-15);
  EXPECT_EQ(result.contacts[0].side, Side::bottom);
  for (const auto response : {ArticleKnobs::Response::component, ArticleKnobs::Response::shorten}) {
    Rig<double> rig(mask, floor, {.response = response});
    Walker walker{.position = {0, half_height}};
    for (int step = 1; step <= 64; ++step) {
      walker.velocity.x() = 6;
      walker.step(rig);
    }
    EXPECT_EQ(walker.position, Vec2d(response == ArticleKnobs::Response::component ? 6 : 0, half_height));
  }
}

TEST(Mask, is_accurate_to_the_pixel_in_scenery_of_any_shape) {
  // A tooth two pixels high and two wide, under the left foot, beside it, or just not.
  for (int x = -12; x <= 12; ++x) {
    const double left = x * px;
    Rig<double> rig(mask, {rectangle(-2, -1, 2, 0), rectangle(left, 0, left + 2 * px, 2 * px)});
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

TEST(Mask, reports_its_memory) {
  for (const double ppm : {16.0, 32.0, 64.0}) {
    Rig<double> rig(mask, {rectangle(0, 0, 500, 75)}, {.raster_pixels_per_metre = ppm});
    const double level = 500 * ppm * 75 * ppm / 8;  // bytes
    EXPECT_GE(double(rig.technique->memory_bytes()), level);
    EXPECT_LE(double(rig.technique->memory_bytes()), 1.02 * level) << "rows are filled up to words";
    EXPECT_EQ(Rig<double>("speculative", {rectangle(0, 0, 500, 75)}).technique->memory_bytes(), 0U);
  }
}

TEST(Mask, that_begins_inside_a_solid_is_stuck_until_a_movement_ends_free) {
  for (const auto response : {ArticleKnobs::Response::component, ArticleKnobs::Response::shorten}) {
    Rig<double> rig(mask, {rectangle(-9, -2, 9, 0)}, {.response = response});
    EXPECT_EQ(rig.move({0, 10 * px}, {px, -3 * px}).position, Vec2d(0, 10 * px));
    EXPECT_EQ(rig.result.status, MoveStatus::stuck);
    EXPECT_EQ(rig.move({0, 10 * px}, {0, 30 * px}).position, Vec2d(0, 40 * px));
    EXPECT_EQ(rig.result.status, MoveStatus::moved);
  }
}

TEST(Mask, allocates_nothing_while_moving) {
  Rig<double> rig(mask, {rectangle(-9, -2, 9, 0)});
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 100; ++i) rig.move({0, half_height + 5 * px}, {i * px, -i * px});
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(rig.result.contacts.empty());
}

}  // namespace
}  // namespace paperproof::article_tests
