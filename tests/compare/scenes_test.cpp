#include "scenes/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "oracle/exact.hpp"
#include "scenes/load.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {
namespace {

TEST(Input, steers_from_the_first_direction_on_and_holds_a_key_until_a_later_event_changes_it) {
  const std::vector<InputEvent> events{{.step = 3, .move = {}, .jump = true, .drop = true},
                                       {.step = 5, .move = -1, .jump = {}},
                                       {.step = 6, .move = 0.5, .jump = false}};
  EXPECT_FALSE(input_at(events, 2).move || input_at(events, 2).jump || input_at(events, 2).drop);
  EXPECT_FALSE(input_at(events, 4).move.has_value());
  EXPECT_TRUE(input_at(events, 5).jump);
  EXPECT_EQ(input_at(events, 5).move, -1);
  EXPECT_FALSE(input_at(events, 6).jump);
  EXPECT_EQ(input_at(events, 1000).move, 0.5);
  EXPECT_TRUE(input_at(events, 1000).drop);
}

TEST(RandomInput, is_the_same_for_a_seed_and_begins_alike_however_long_it_is) {
  const std::vector<InputEvent> shorter = random_input(3, 1000);
  const std::vector<InputEvent> longer = random_input(3, 5000);
  EXPECT_EQ(shorter, random_input(3, 1000));
  EXPECT_NE(shorter, random_input(8, 1000));
  ASSERT_LT(shorter.size(), longer.size());
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST(RandomInput, holds_each_choice_for_15_to_120_steps_and_makes_all_of_them) {
  std::map<double, int> moves;
  int presses = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    int moved = -1;
    int pressed = -1;
    for (const InputEvent& e : random_input(seed, 20000)) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << e.step);
      if (e.move) {
        ++moves[*e.move];
        EXPECT_TRUE(moved < 0 || (e.step - moved >= 15 && e.step - moved <= 120));
        moved = e.step;
      }
      const bool jump = e.jump.value();
      EXPECT_TRUE(pressed < 0 || (!jump && e.step - pressed >= 4 && e.step - pressed <= 30));
      presses += jump;
      pressed = jump ? e.step : -1;
    }
  }
  EXPECT_EQ(moves.size(), 3U);
  for (const auto& [move, count] : moves) EXPECT_GT(count, 100) << "move " << move;
  EXPECT_GT(presses, 100);
}

TEST(BuiltInScenes, every_one_is_valid_has_its_own_name_and_says_what_it_is) {
  std::set<std::string> names;
  int inside = 0;
  for (const BuiltInScene& entry : built_in_scenes()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.description.empty()) << entry.name;
    const Scene scene = load_scenes(entry.name).front();
    EXPECT_EQ(scene.name, entry.name);
    EXPECT_EQ(scene.description, entry.description);
    EXPECT_EQ(scene.ids.size(), scene.scenery.colliders.size());
    EXPECT_EQ(std::set<std::string>(scene.ids.begin(), scene.ids.end()).size(), scene.ids.size()) << entry.name;
    EXPECT_GE(scene.steps, 1);
    EXPECT_LE(scene.steps, entry.name == "long_rest" ? 1'000'000 : 10'000) << entry.name;
    EXPECT_NO_THROW(scene.character.validate()) << entry.name;
    EXPECT_TRUE(std::ranges::is_sorted(scene.input, {}, &InputEvent::step)) << entry.name;
    // A start inside is refused by the loader where nothing asks to resolve it.
    if (!scene.start.resolve_overlap) continue;
    EXPECT_FALSE(FreePlaces(scene.scenery, scene.character.shape).overlapped(scene.start.position).empty())
        << entry.name;
    ++inside;
  }
  EXPECT_GE(names.size(), 140U);
  EXPECT_GE(inside, 2);
}

}  // namespace
}  // namespace paperproof::compare
