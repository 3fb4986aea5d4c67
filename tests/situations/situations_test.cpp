/// Runs every situation of this folder, has every step judged, and asks for the numbers that it expects.
#include "situations/situation.hpp"

#include "campaign/campaign.hpp"
#include "runs/input_cursor.hpp"
#include "runs/lane.hpp"
#include "scenes/load.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

namespace paperproof::test {
namespace {

using nlohmann::json;

const std::vector<Situation>& all_situations() {
  static const std::vector<Situation> all = read_situations(PAPERPROOF_SITUATIONS);
  return all;
}

/// The steps of a trace file.
std::vector<json> records_of(const std::string& path) {
  std::vector<json> records;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) records.push_back(json::parse(line));
  return records;
}

/// What a game may say of its character, and no scene file.
void set_rules(const json& rules, CharacterDef& character) {
  character.coyote_time = rules.value("coyote_time", character.coyote_time);
  character.jump_cut = rules.value("jump_cut", character.jump_cut);
  if (rules.contains("jump_buffer")) character.jump_buffer = rules["jump_buffer"].get<double>();
}

/// How the command is told of them.
std::string options_of(const SituationCase& situation) {
  std::string options = " --contender " + situation.contender + (situation.in_float ? " --scalar float" : "");
  for (const std::string& knob : situation.knobs) options += " --knob " + knob;
  return options;
}

class Situations : public ::testing::TestWithParam<Situation> {
 protected:
  /// Files of this test: its scene and its trace, kept where it fails.
  [[nodiscard]] std::string stem() const {
    const std::string process = std::to_string(getpid());  // sanitized tests run at the same time
    return ::testing::TempDir() + "situation_" + process + "_" + GetParam().file + "_" + GetParam().name;
  }

  void run(const SituationCase& situation) {
    std::ofstream(stem() + ".json") << situation.scene.dump(1);
    compare::Scene scene = compare::load_scenes(stem() + ".json").front();
    set_rules(situation.rules, scene.character);
    const Scenery scenery(scene.scenery);
    std::vector<compare::KnobSetting> knobs;
    for (const std::string& knob : situation.knobs) {
      knobs.push_back(compare::parse_knob(knob));
      ASSERT_TRUE(compare::has_knob(situation.contender, knobs.back().name)) << knob;
    }
    const auto scalar = situation.in_float ? compare::ScalarKind::binary32 : compare::ScalarKind::binary64;
    compare::Lane lane(situation.contender, scalar, scene, scenery, {.knobs = knobs}, "free", stem(),
                       {.steps = scene.steps});
    ASSERT_TRUE(lane.running()) << lane.row().reason;
    const compare::Script script = script_of(scene);
    compare::InputCursor cursor(scene, script);
    for (int step = 0; step < scene.steps && lane.running(); ++step) lane.step(step, cursor.at(step));
    ASSERT_TRUE(lane.running()) << lane.row().reason;
    lane.finish();
    const std::string trace = compare::trace_path(stem(), scene.name, situation.contender, name_of(scalar));
    for (const std::string& sentence : missed(situation, records_of(trace))) ADD_FAILURE() << sentence;
    std::filesystem::remove(trace);
    if (situation.contender != "octagon_sweep" || situation.in_float || !situation.rules.empty()) return;
    for (const auto& [clause, breach] : lane.breaches()) {
      broken_.emplace(name_of(clause));
      EXPECT_EQ(std::count(situation.breaks.begin(), situation.breaks.end(), name_of(clause)), 1)
          << compare::describe({{clause, breach}}, "");
    }
  }

  std::set<std::string> broken_;  ///< Clauses, in any case.
};

TEST_P(Situations, come_to_what_they_must) {
  const std::vector<SituationCase> cases = some_cases_of(GetParam());
  for (const SituationCase& situation : cases) {
    run(situation);
    ASSERT_FALSE(HasFailure()) << GetParam().name << situation.title << "\npaperproof compare " << stem() << ".json"
                               << options_of(situation) << " --trace STEM";
  }
  std::filesystem::remove(stem() + ".json");
  if (cases.size() < cases_of(GetParam()).size()) return;  // it may be another case that breaks it
  for (const std::string& clause : cases.front().breaks)
    EXPECT_TRUE(broken_.contains(clause)) << clause << " is broken no more";
}

INSTANTIATE_TEST_SUITE_P(All, Situations, ::testing::ValuesIn(all_situations()),
                         [](const auto& situation) { return situation.param.file + "_" + situation.param.name; });

/// A situation of two steps: a fall of one metre, and a rest.
TEST(Situation, is_missed_where_its_numbers_are_not_those_of_the_record) {
  const std::vector<json> records{
      json::parse(R"({"path": [[0, 2, 0], [0, 1, 1]], "grounded": false, "contacts": []})"),
      json::parse(R"({"path": [[0, 1, 0]], "grounded": true, "contacts": [{"side": "bottom"}]})")};
  const std::vector<std::pair<const char*, const char*>> rows{
      {R"({"step": 0, "of": "y", "is": "=high - 1"})", ""},
      {R"({"step": 0, "of": "y", "is": 1.25, "within": 0.25})", ""},
      {R"({"step": 0, "of": "y", "is": 1.25, "within": 0.24})", "in step 0 y is 1 instead of 1.25 within 0.24"},
      {R"({"step": 0, "of": "y", "is": 3, "because": "it rises"})",
       "in step 0 y is 1 instead of 3 within 0 (it rises)"},
      {R"({"step": 0, "of": "/path/0", "is": [0, 2, 0]})", ""},
      {R"({"step": -1, "of": "contacts/#", "is": 1})", ""},
      {R"({"step": -1, "of": "contacts/-1/side", "is": "top"})",
       "in step 1 contacts/-1/side is \"bottom\" instead of \"top\" within 0"},
      {R"({"step": 0, "of": "contacts/0/side", "is": null})", ""},
      {R"({"steps": [0, 1], "of": "y", "is": 1})", ""},
      {R"({"steps": [0, -1], "of": "grounded", "is": true})", "in step 0 grounded is false instead of true within 0"},
      {R"({"some": [0, 1], "of": "grounded", "is": true})", ""},
      {R"({"some": [0, 1], "of": "y", "above": 1})",
       "0 of steps 0 to 1 are as expected; in step 0 y is 1, and not above 1"},
      {R"({"some": [0, 1], "times": 1, "of": "grounded", "is": true})", ""},
      {R"({"some": [0, 1], "times": 1, "of": "y", "is": 1})", "2 of steps 0 to 1 are as expected; "},
      {R"({"step": 1, "of": "y", "is": "=last_y"})", ""},
      {R"({"step": 1, "of": "=high*y - last_y", "is": 1})", ""},
      {R"({"step": 1, "of": "=high*y - last_y", "is": 2})", "in step 1 =high*y - last_y is 1.0 instead of 2 within 0"},
      {R"({"steps": [0, 1], "of": "grounded", "is": "=step == 1"})", ""},
      {R"({"steps": [0, 1], "of": "grounded", "is": "=step == 0"})",
       "in step 0 grounded is false instead of 1.0 within 0"},
      {R"({"steps": [0, 1], "of": "stuck", "is": "=step > 1"})", ""},
      {R"({"steps": [0, 1], "of": "y", "is": "=step + 1"})", "in step 1 y is 1 instead of 2.0 within 0"},
      {R"({"step": 0, "of": "ride", "at_most": 1})", "in step 0 ride is null, and not at_most 1"},
      {R"({"step": 2, "of": "y", "is": 1})", "y is asked of steps 2 to 2, and there are 2"},
  };
  for (const auto& [expected, sentence] : rows) {
    SituationCase situation;
    situation.values = {{"high", 2}};
    situation.expected = json::array({json::parse(expected)});
    const std::vector<std::string> sentences = missed(situation, records);
    EXPECT_EQ(sentences.empty() ? "" : sentences.front(), sentence) << expected;
  }
}

TEST(Situation, that_no_run_could_miss_is_refused) {
  const std::vector<json> records{json::parse(R"({"path": [[0, 2, 0]]})")};
  for (const char* expected :
       {R"({"step": 0, "of": "y", "iz": 2})", R"({"step": 0, "of": "y"})", R"({"of": "y", "is": 2})",
        R"({"step": 0, "steps": [0, 0], "of": "y", "is": 2})", R"({"step": 0, "times": 1, "of": "y", "is": 2})",
        R"({"step": 0, "of": "crsh/#", "is": 0})", R"({"step": 0, "of": "rides", "is": null})",
        R"({"step": 0.5, "of": "y", "is": 2})"}) {
    SituationCase situation;
    situation.expected = json::array({json::parse(expected)});
    EXPECT_THROW((void)missed(situation, records), std::invalid_argument) << expected;
  }
  for (const char* text : {R"({"contendr": "x", "expect": []})", R"({"for": {"pull": []}, "expect": []})",
                           R"({"for": {"y": [7]}, "expect": []})", R"({"rules": {"snap": 1}, "expect": []})",
                           R"({"let": {"dt": 1}, "expect": []})"}) {
    const Situation situation{.file = "f", .name = "s", .text = nlohmann::ordered_json::parse(text)};
    EXPECT_THROW((void)cases_of(situation), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace paperproof::test
