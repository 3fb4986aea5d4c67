/// What is said to somebody who mistyped a name.
#include "near_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace paperproof::compare {
namespace {

using Names = std::vector<std::string>;

TEST(NearNames, are_the_same_in_other_letters_then_what_holds_it_then_one_slip_in_four_letters) {
  const Names flush{"flush_tiles_slow", "flush_tiles", "tiles"};
  const Names rest{"long_rest", "long_resting", "lift_up"};
  for (const auto& [typed, known, near] : std::vector<std::tuple<std::string, Names, Names>>{
           {"Flush-Tiles", flush, {"flush_tiles"}},
           {"flushtiles", flush, {"flush_tiles"}},
           {"tiles",
            {"tiles_1", "wall", "a_tiles", "tiles_2", "tiles_3", "tiles_4", "tiles_5"},
            {"tiles_1", "a_tiles", "tiles_2", "tiles_3", "tiles_4"}},  // at most five
           {"lang_rast", rest, {"long_rest"}},                         // 2 of 8
           {"lamg_rast", rest, {}},                                    // 3 of 8
           {"restimg", rest, {"long_resting"}},
           {"up", rest, {}},  // it may stand anywhere
           {"", rest, {}},
           {"nothing", rest, {}},
           {"long_rest", {}, {}},
       })
    EXPECT_EQ(near_names(typed, known), near) << typed;
}

}  // namespace
}  // namespace paperproof::compare
