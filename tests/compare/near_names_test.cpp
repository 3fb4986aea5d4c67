/// What is said to somebody who mistyped a name.
#include "near_names.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using Names = std::vector<std::string>;

TEST(EditDistance, is_the_fewest_letters_to_put_in_leave_out_or_replace_in_all_or_a_part) {
  EXPECT_EQ(edit_distance("kitten", "sitting", false), 3U) << "k/s, e/i, and g";
  EXPECT_EQ(edit_distance("sitting", "kitten", false), 3U);
  EXPECT_EQ(edit_distance("flaw", "lawn", false), 2U);
  EXPECT_EQ(edit_distance("", "abc", false), 3U);
  EXPECT_EQ(edit_distance("abc", "", false), 3U);
  EXPECT_EQ(edit_distance("same", "same", false), 0U);
  EXPECT_EQ(edit_distance("bullet", "article_bullet_slow", true), 0U);
  EXPECT_EQ(edit_distance("ballot", "article_bullet_slow", true), 2U);
  EXPECT_EQ(edit_distance("abc", "", true), 3U);
  EXPECT_EQ(edit_distance("long", "on", true), 2U) << "the part is no longer than the name";
}

TEST(NearNames, are_the_same_in_other_letters_then_what_holds_it_then_one_slip_in_four_letters) {
  struct Case {
    const char* typed;
    Names known;
    Names near;
  };
  const Names flush{"flush_tiles_slow", "flush_tiles", "tiles"};
  const Names rest{"long_rest", "long_resting", "lift_up"};
  for (const Case& each : {
           Case{"Flush-Tiles", flush, {"flush_tiles"}},
           Case{"flushtiles", flush, {"flush_tiles"}},
           Case{"tiles",
                {"tiles_1", "wall", "a_tiles", "tiles_2", "tiles_3", "tiles_4", "tiles_5"},
                {"tiles_1", "a_tiles", "tiles_2", "tiles_3", "tiles_4"}},  // at most five
           Case{"lang_rast", rest, {"long_rest"}},                         // 2 of 8
           Case{"lamg_rast", rest, {}},                                    // 3 of 8
           Case{"restimg", rest, {"long_resting"}},
           Case{"up", rest, {}},  // it may stand anywhere
           Case{"", rest, {}},
           Case{"nothing", rest, {}},
           Case{"long_rest", {}, {}},
       })
    EXPECT_EQ(near_names(each.typed, each.known), each.near) << each.typed;
}

TEST(DidYouMean, says_the_near_names_in_a_sentence) {
  EXPECT_EQ(did_you_mean("lift", {"lift_up", "rest"}), "; did you mean lift_up?");
  EXPECT_EQ(did_you_mean("lift", {"lift_up", "lift_down"}), "; did you mean lift_up or lift_down?");
  EXPECT_EQ(did_you_mean("lift", {"lift_a", "lift_b", "lift_c"}), "; did you mean lift_a, lift_b or lift_c?");
  EXPECT_EQ(did_you_mean("lift", {"rest"}), "");
}

}  // namespace
}  // namespace paperproof::compare
