/// Level and sprite in black and white, and the colours next to the character: what no other technique does.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

namespace paperproof::article_tests {
namespace {

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
