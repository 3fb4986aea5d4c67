/// What is said to somebody who mistyped a name.
#include "near_names.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using Names = std::vector<std::string>;

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

}  // namespace
}  // namespace paperproof::compare
