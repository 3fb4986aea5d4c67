/// What is said to somebody who mistyped a name.
#include "near_names.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using Names = std::vector<std::string>;

TEST(EditDistance, is_the_fewest_letters_to_put_in_leave_out_or_replace) {
  EXPECT_EQ(edit_distance("kitten", "sitting", false), 3U) << "k/s, e/i, and g";
  EXPECT_EQ(edit_distance("sitting", "kitten", false), 3U);
  EXPECT_EQ(edit_distance("flaw", "lawn", false), 2U);
  EXPECT_EQ(edit_distance("", "abc", false), 3U);
  EXPECT_EQ(edit_distance("abc", "", false), 3U);
  EXPECT_EQ(edit_distance("same", "same", false), 0U);
}

TEST(EditDistance, to_a_part_leaves_out_what_stands_around_it) {
  EXPECT_EQ(edit_distance("bullet", "article_bullet_slow", true), 0U);
  EXPECT_EQ(edit_distance("bulet", "article_bullet_slow", true), 1U);
  EXPECT_EQ(edit_distance("ballot", "article_bullet_slow", true), 2U);
  EXPECT_EQ(edit_distance("abc", "", true), 3U);
  EXPECT_EQ(edit_distance("long", "on", true), 2U) << "the part is no longer than the name";
}

TEST(NearNames, are_first_what_was_typed_in_other_letters) {
  const Names known{"flush_tiles_slow", "flush_tiles", "tiles"};
  EXPECT_EQ(near_names("Flush-Tiles", known), Names{"flush_tiles"});
  EXPECT_EQ(near_names("flushtiles", known), Names{"flush_tiles"});
}

TEST(NearNames, are_then_those_that_hold_it_at_most_five) {
  const Names known{"tiles_1", "wall", "tiles_2", "tiles_3", "flush_tiles", "tiles_4", "tiles_5"};
  EXPECT_EQ(near_names("tiles", known), (Names{"tiles_1", "tiles_2", "tiles_3", "flush_tiles", "tiles_4"}));
}

TEST(NearNames, are_then_those_with_the_fewest_slips_one_in_four_letters_at_most) {
  const Names known{"long_rest", "long_resting"};
  EXPECT_EQ(near_names("lang_rest", known), Names{"long_rest"});
  EXPECT_EQ(near_names("lang_rast", known), Names{"long_rest"}) << "2 of 8";
  EXPECT_EQ(near_names("lamg_rast", known), Names{}) << "3 of 8";
  EXPECT_EQ(near_names("restimg", known), Names{"long_resting"});
}

TEST(NearNames, are_none_where_all_are_far_or_too_little_was_typed) {
  const Names known{"long_rest", "lift_up"};
  EXPECT_EQ(near_names("up", known), Names{}) << "it may stand anywhere";
  EXPECT_EQ(near_names("", known), Names{});
  EXPECT_EQ(near_names("nothing", known), Names{});
  EXPECT_EQ(near_names("long_rest", {}), Names{});
}

TEST(DidYouMean, says_the_near_names_in_a_sentence) {
  EXPECT_EQ(did_you_mean("lift", {"lift_up", "rest"}), "; did you mean lift_up?");
  EXPECT_EQ(did_you_mean("lift", {"lift_up", "lift_down"}), "; did you mean lift_up or lift_down?");
  EXPECT_EQ(did_you_mean("lift", {"lift_a", "lift_b", "lift_c"}), "; did you mean lift_a, lift_b or lift_c?");
  EXPECT_EQ(did_you_mean("lift", {"rest"}), "");
}

}  // namespace
}  // namespace paperproof::compare
