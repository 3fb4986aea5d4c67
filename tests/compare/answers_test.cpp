/// Whether a run comes to what its scene must come to, on traces made by hand.
#include "compare/moments.hpp"
#include "compare/table.hpp"
#include "records/rows_json.hpp"
#include "scenes/built_in.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::compare {
namespace {

/// Steps that end grounded at these places, the first of which is also the start.
std::vector<TraceStep> run_to(const std::vector<Vec2d>& places) {
  std::vector<TraceStep> run;
  Vec2d at = places.front();
  for (const Vec2d& place : places) {
    TraceStep step = moment(static_cast<int>(run.size())).step;
    step.path = {{at, 0}, {place, 1}};
    step.grounded = true;
    run.push_back(step);
    at = place;
  }
  return run;
}

void check_answers(const Json& row) {
  std::vector<TraceStep> run = run_to(row.at("ends").get<std::vector<Vec2d>>());
  for (const Json& touch : row.value("contacts", Json::array()))
    run.at(touch["step"]).contacts = {contact(0, Side::bottom, touch["fraction"])};
  for (const Json& crush : row.value("crushed", Json::array())) run.at(crush["step"]).crushed = {crush["by"]};
  TraceHeader head = header();
  head.path_exact = !row.value("skin", false);
  const Row found = answered(answers_of(row.at("answers")), run, head);
  ASSERT_TRUE(found.answer_error && found.answer_ok);
  const Json told = row_json(found);
  for (const auto& [key, value] : row.at("is").items()) EXPECT_EQ(told.value(key, Json()), value) << key;
  if (row.contains("words")) {
    EXPECT_EQ(found.answer, row["words"]);
  }
}

const bool table = table_tests("answers.json", " ends answers is words contacts crushed skin ", check_answers);

TEST(Answers, that_only_the_law_or_less_of_a_gap_can_give_are_not_asked_of_others) {
  TraceHeader others = header();
  others.tolerances = {{"unit", 0.02}};
  const auto asked = [](const char* text, const TraceHeader& head) {
    return answered(answers_of(Json::parse(text)), {}, head).answer_ok.has_value();
  };
  EXPECT_TRUE(asked(R"([{"of": "x", "is": 0, "law": true}])", header("octagon_sweep")));
  EXPECT_FALSE(asked(R"([{"of": "x", "is": 0, "law": true}])", others));
  EXPECT_FALSE(asked(R"([{"of": "x", "is": 0, "beyond": 0.005}])", others));
  EXPECT_TRUE(asked(R"([{"of": "x", "is": 0, "beyond": 0.03}])", others));
}

TEST(Answers, are_not_met_by_a_place_that_is_no_number) {
  const std::vector<Answer> zero = answers_of(Json::parse(R"([{"of": "x", "is": 0}])"));
  EXPECT_EQ(answered(zero, run_to({{0, 0}, {std::nan(""), 0}}), header()).answer_ok, false);
}

TEST(Answers, about_a_collider_that_is_not_there_are_an_error) {
  const std::vector<Answer> nothing = answers_of(Json::parse(R"([{"of": "x", "is": 0, "with": "nothing"}])"));
  EXPECT_THROW((void)answered(nothing, {}, header()), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::compare
