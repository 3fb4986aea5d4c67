/// Built-in scenes as data: what the files may say, and what their formulas come to.
#include "scenes/built_in.hpp"
#include "records/schema.hpp"
#include "records/strict_json.hpp"
#include "scenes/formula.hpp"
#include "scenes/input_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace paperproof::compare {
namespace {

TEST(BuiltInFiles, hold_to_their_schema) {
  const std::filesystem::path folder = PAPERPROOF_SOURCE_DIR "/compare/scenes/built_in";
  const Schema schema(read_file(folder / "built_in.schema.json", "schema"));
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename() == "built_in.schema.json") continue;
    const std::string name = entry.path().filename();
    EXPECT_EQ(schema.fault(strict_json(read_file(entry.path(), name), name)).value_or(""), "") << name;
    ++files;
  }
  EXPECT_EQ(files, 15);
}

TEST(BuiltInFiles, name_scenes_that_there_are) {
  for (const SceneSet& set : scene_sets())
    for (const std::string& scene : set.scenes) EXPECT_TRUE(find_built_in(scene)) << scene;
  for (const BuiltInScene& scene : built_in_scenes()) {
    if (scene.family.empty()) continue;
    const auto family = find_family(scene.family);
    ASSERT_TRUE(family) << scene.name;
    for (const ParameterSetting& setting : scene.settings) EXPECT_NO_THROW(check_setting(family->name, setting));
  }
  EXPECT_FALSE(find_built_in("tiles")) << "a family";
  EXPECT_FALSE(find_family("flush_tiles")) << "a scene";
  EXPECT_THROW((void)built_in_scene("nothing", {}), std::invalid_argument);
}

TEST(Formulas, are_computed_in_the_order_in_which_they_are_written) {
  const Values values{{"x", 0.1}, {"y", 0.2}, {"z", 0.3}};
  EXPECT_EQ(value_of("x + y + z", values), 0.1 + 0.2 + 0.3);
  EXPECT_NE(value_of("x + y + z", values), value_of("x + (y + z)", values));
  EXPECT_EQ(value_of("x*3 + x*7", values), 0.1 * 3 + 0.1 * 7);
  EXPECT_EQ(value_of("x - 1e16 + 1e16", values), 0);
  EXPECT_EQ(value_of("-x*-y", values), 0.1 * 0.2);
  EXPECT_EQ(value_of("17 % 5 == 2 && x < y ? floor(2.5) : ceil(2.5)", values), 2);
  EXPECT_THROW((void)value_of("x +", values), std::invalid_argument);
  EXPECT_THROW((void)value_of("unknown", values), std::invalid_argument);
}

TEST(Formulas, know_the_law_of_motion) {
  const Values values{{"gravity", 10}, {"dt", 0.25}, {"jump_speed", 8}, {"walk_speed", 2}, {"acceleration", 4}};
  EXPECT_EQ(value_of("fallen(3)", values), 10 * 0.0625 * (1 + 2 + 3));
  EXPECT_EQ(value_of("risen(3)", values), 8 * 0.75 - 10 * 0.0625 * 6);
  EXPECT_EQ(value_of("steps_to_fall(fallen(3), 0)", values), 3);
  EXPECT_EQ(value_of("steps_to_fall(0.5, 4)", values), 0.5 / ((4 + 2.5) * 0.25)) << "within the first step";
  EXPECT_EQ(value_of("walked(3)", values), (1 + 2 + 2) * 0.25) << "1 m/s faster in each step, to 2 m/s";
  EXPECT_EQ(value_of("steps_to_walk(1)", values), 2.5);
  EXPECT_EQ(value_of("sprung(1, 2, 0, 0)", values), -10 * 0.0625) << "without a spring it falls";
  EXPECT_EQ(value_of("support(0, -1)", values), 20.0 / 32);
  EXPECT_EQ(value_of("ulp(1)", values), std::nextafter(1, 2) - 1);
  EXPECT_EQ(value_of("next(1, 0)", values), std::nextafter(1, 0));
  EXPECT_THROW((void)value_of("fallen(1)", {}), std::invalid_argument) << "without a gravity";
}

TEST(Formulas, repeat_leave_out_and_fill_in) {
  const auto made = [](const char* text) { return computed(Json::parse(text), {{"first", 1}}).dump(); };
  EXPECT_EQ(made(R"([[9, 9], {"for": {"i": {"from": "=first", "to": 2}, "k": [5, 7]}, "each": ["=i", "=k"]}])"),
            "[[9,9],[1.0,5.0],[1.0,7.0],[2.0,5.0],[2.0,7.0]]");
  EXPECT_EQ(made(R"([{"for": [{"i": 3, "k": 4}], "let": {"sum": "i + k"}, "each": {"id": "tile{sum + 1}, {i}"}}])"),
            R"([{"id":"tile8, 3"}])");
  EXPECT_EQ(made(R"([{"if": "first > 1", "a": 1}, {"if": "first == 1", "a": 2}])"), R"([{"a":2}])");
  EXPECT_EQ(made(R"({"id": "a", "box": [0, 1, "=first + 1", 3]})"),
            R"({"id":"a","polygon":[[0.0,1.0],[2.0,1.0],[2.0,3.0],[0.0,3.0]]})");
  EXPECT_THROW((void)made(R"("{first")"), std::invalid_argument);
  EXPECT_THROW((void)made(R"([{"for": {"pi": [1]}, "each": "=pi"}])"), std::invalid_argument) << "a constant";
}

}  // namespace
}  // namespace paperproof::compare
