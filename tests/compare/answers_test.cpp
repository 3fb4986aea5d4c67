/// Whether a run comes to what its scene must come to, on traces made by hand.
#include "metrics/answers.hpp"

#include "compare/moments.hpp"
#include "scenes/built_in.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::compare {
namespace {

struct Checked {
  double error = 0;
  bool ok = false;
  std::string words;
};

/// @param text of answers, as a built-in scene has them.
std::vector<Answer> answers(const std::string& text) { return answers_of(Json::parse("[" + text + "]")); }

Checked checked(const std::string& text, const std::vector<TraceStep>& run, const TraceHeader& head = header()) {
  AnswerCheck check(answers(text), head);
  for (const TraceStep& step : run) check.add(step);
  Row row;
  check.write(row);
  EXPECT_TRUE(row.answer_error && row.answer_ok);
  return {row.answer_error.value_or(-1), row.answer_ok.value_or(false), row.answer};
}

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

TEST(Answers, of_a_place_are_about_the_end_or_the_step_that_is_asked_for) {
  const std::vector<TraceStep> run = run_to({{0, 0}, {1, 2}, {3, 5}});
  EXPECT_TRUE(checked(R"({"of": "x", "is": 3})", run).ok);
  EXPECT_TRUE(checked(R"({"of": "y", "is": 2, "after": 2})", run).ok);
  const Checked missed = checked(R"({"of": "y", "is": 4})", run);
  EXPECT_FALSE(missed.ok);
  EXPECT_EQ(missed.error, 1);
  EXPECT_EQ(missed.words, "stands at y = 5 m at the end instead of 4");
}

TEST(Answers, that_are_a_range_are_missed_by_the_distance_to_it) {
  const std::vector<TraceStep> run = run_to({{0, 0}, {1, 0}});
  EXPECT_EQ(checked(R"({"of": "x", "at_least": 0.5, "at_most": 2})", run).error, 0);
  EXPECT_EQ(checked(R"({"of": "x", "at_least": 1.25})", run).error, 0.25);
  EXPECT_EQ(checked(R"({"of": "x", "at_most": 0.5})", run).error, 0.5);
}

/// Other answers are those of built-in scenes, which meet them, and miss them where their run is spoilt.
TEST(Answers, of_what_never_comes_are_the_end) {
  std::vector<TraceStep> run = run_to({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  run[1].contacts = {contact(0, Side::bottom, 0.75)};
  EXPECT_TRUE(checked(R"({"of": "contact", "is": 1.75})", run).ok);
  EXPECT_EQ(checked(R"({"of": "contact", "is": 1.5, "with": "paper"})", run).error, 2.5);
  EXPECT_TRUE(checked(R"({"of": "crush", "is": 4, "gaps": 0})", run).ok);
  run[2].crushed = {1};
  EXPECT_TRUE(checked(R"({"of": "crush", "is": 2, "gaps": 0})", run).ok);
}

TEST(Answers, allow_a_contender_the_gap_that_it_keeps_and_no_more) {
  TraceHeader skin = header();  // of 20 mm, and a contact is noticed a step late
  skin.path_exact = false;
  const std::vector<TraceStep> near = run_to({{0, 0}, {0, 0.015}});
  EXPECT_FALSE(checked(R"({"of": "y", "is": 0})", near).ok);
  EXPECT_TRUE(checked(R"({"of": "y", "is": 0})", near, skin).ok);
  EXPECT_EQ(checked(R"({"of": "y", "is": 0})", near, skin).error, 0.015)
      << "a larger gap is accepted, and the error is still told";
  EXPECT_FALSE(checked(R"({"of": "y", "is": 0, "gaps": 0.5})", near, skin).ok);
  EXPECT_TRUE(checked(R"({"of": "y", "is": -0.03, "gaps": 3})", near, skin).ok);
  std::vector<TraceStep> late = run_to({{0, 0}, {0, 0}, {0, 0}});
  late[1].contacts = {contact(0, Side::bottom, 0.5)};
  EXPECT_TRUE(checked(R"({"of": "contact", "is": 0.5, "gaps": 0})", late, skin).ok);
  EXPECT_FALSE(checked(R"({"of": "contact", "is": 0.5, "gaps": 0})", late).ok);
}

TEST(Answers, that_only_the_law_or_less_of_a_gap_can_give_are_not_asked_of_others) {
  TraceHeader others = header();
  others.tolerances = {{"unit", 0.02}};
  const auto asked = [](const std::string& text, const TraceHeader& head) {
    Row row;
    AnswerCheck(answers(text), head).write(row);
    return row.answer_ok.has_value();
  };
  EXPECT_TRUE(asked(R"({"of": "x", "is": 0, "law": true})", header("octagon_sweep")));
  EXPECT_FALSE(asked(R"({"of": "x", "is": 0, "law": true})", others));
  EXPECT_FALSE(asked(R"({"of": "x", "is": 0, "beyond": 0.005})", others));
  EXPECT_TRUE(asked(R"({"of": "x", "is": 0, "beyond": 0.03})", others));
}

TEST(Answers, are_not_met_by_a_place_that_is_no_number) {
  EXPECT_FALSE(checked(R"({"of": "x", "is": 0})", run_to({{0, 0}, {std::nan(""), 0}})).ok);
}

TEST(Answers, about_a_collider_that_is_not_there_are_an_error) {
  EXPECT_THROW(AnswerCheck(answers(R"({"of": "x", "is": 0, "with": "nothing"})"), header()), std::invalid_argument);
}

TEST(Answers, tell_of_the_one_that_is_missed_by_most_of_its_tolerances) {
  EXPECT_EQ(checked(R"({"of": "x", "is": 0, "within": 1}, {"of": "y", "is": 0})", run_to({{0, 0}, {1.5, 0.001}})).error,
            0.001);
}

}  // namespace
}  // namespace paperproof::compare
