/// Several heroes of one world that take turns: the places of `heroes/together`.
#include "situations/bodies.hpp"
#include "situations/situation.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

using test::Situation;

struct Outcome {
  int crushed = 0;
  int stuck = 0;
  int in_the_air = 0;  ///< Of all, after a second in which they come down.
  std::vector<Vec2d> ends{};
  bool is_row = false;  ///< Else a tower.
};

Outcome run(const Situation& place, int count, bool last_first) {
  compare::Values values = compare::constants();
  values["dt"] = frame;
  World all;
  Bodies bodies(all);
  bodies.build(compare::computed(place.text.at("scene"), values));
  const json said = compare::computed(place.text.at("party"), values);
  test::refuse_other_keys(place.text, " name because scene party set ", "a place");
  test::refuse_other_keys(said, " feet next move ", "a party");
  std::vector<std::unique_ptr<Hero>> heroes;
  std::vector<Hero*> party;
  std::vector<Input> inputs;
  for (int i = 0; i < count; ++i) {
    Vec2d at = vector_of<Vec2d>(said.at("feet")) + i * vector_of<Vec2d>(said.at("next"));
    at.y() += half_height + 0.005;
    const HeroDef def{.character = {.snap = 0.2, .step_height = 0.2}, .position = at};
    heroes.push_back(std::make_unique<Hero>(all.world, def));
    party.push_back(heroes.back().get());
    inputs.push_back({.move = 0.0});
  }
  if (last_first) {
    std::reverse(party.begin(), party.end());
    std::reverse(inputs.begin(), inputs.end());
  }
  Outcome outcome{.is_row = said.at("next").at(0) > 0};
  for (int step = -60; step < 600; ++step) {
    values["frame"] = step;
    if (step == 0) inputs[last_first ? inputs.size() - 1 : 0].move = said.value("move", 0.0);
    if (step >= 0) bodies.put(compare::computed(place.text.value("set", compare::Json::object()), values));
    all.world.Step(static_cast<float>(frame), 8, 3);
    step_together(party, inputs, frame);
    for (const auto& hero : heroes) {
      outcome.crushed += !hero->crushed_by().empty();
      outcome.stuck += hero->report().status == StepStatus::stuck;
      outcome.in_the_air += step >= 0 && !hero->grounded();
    }
  }
  for (const auto& hero : heroes) outcome.ends.push_back(hero->position());
  return outcome;
}

class Heroes : public ::testing::TestWithParam<Situation> {};

TEST_P(Heroes, are_carried_and_pushed_as_one_alone_would_be) {
  const Outcome alone = run(GetParam(), 1, false);
  for (const int count : {2, 4}) {
    for (const bool last_first : {false, true}) {
      SCOPED_TRACE(testing::Message() << count << (last_first ? ", the last one first" : ""));
      const Outcome party = run(GetParam(), count, last_first);
      EXPECT_EQ(party.crushed, 0);
      EXPECT_EQ(party.stuck, 0);
      EXPECT_LE(party.in_the_air, alone.in_the_air);
      for (int i = 0; i < count; ++i) {
        const Vec2d apart = party.is_row ? Vec2d(2 * half_width * i, 0) : Vec2d(0, 2 * half_height * i);
        EXPECT_LE((party.ends[static_cast<std::size_t>(i)] - alone.ends[0] - apart).norm(), 1e-3) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(On, Heroes,
                         ::testing::ValuesIn(test::read_situations(PAPERPROOF_SITUATIONS "/heroes/together")),
                         [](const auto& place) { return place.param.name; });

}  // namespace
}  // namespace paperproof::box2d::hero_test
