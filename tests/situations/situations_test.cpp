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
    // Sanitizers look at how a step is made. A run without them asks for the numbers, which are often those of the end.
    const bool is_cut = sanitized && scene.steps > 60;
    if (is_cut) scene.steps = 60;
    const Scenery scenery(scene.scenery);
    std::vector<compare::KnobSetting> knobs;
    for (const std::string& knob : situation.knobs) {
      knobs.push_back(compare::parse_knob(knob));
      ASSERT_TRUE(compare::has_knob(situation.contender, knobs.back().key)) << knob;
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
    if (!is_cut) {
      for (const std::string& sentence : missed(situation, records_of(trace))) ADD_FAILURE() << sentence;
    }
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
  if (sanitized || cases.size() < cases_of(GetParam()).size()) return;  // another case may break it, or a later step
  for (const std::string& clause : cases.front().breaks)
    EXPECT_TRUE(broken_.contains(clause)) << clause << " is broken no more";
}

INSTANTIATE_TEST_SUITE_P(All, Situations, ::testing::ValuesIn(read_situations(PAPERPROOF_SITUATIONS)),
                         [](const auto& situation) { return situation.param.file + "_" + situation.param.name; });

const json& notation() {
  static const json file = json::parse(std::ifstream(PAPERPROOF_SITUATIONS "/notation/expectations.json"));
  return file;
}

/// Which sentence an expectation makes of the records there.
std::string missed_there(const json& expected) {
  SituationCase situation;
  situation.values = {{"high", 2}};
  situation.expected = json::array({expected});
  const std::vector<std::string> sentences = missed(situation, notation().at("records").get<std::vector<json>>());
  return sentences.empty() ? "" : sentences.front();
}

TEST(Situation, is_missed_where_its_numbers_are_not_those_of_the_record) {
  for (const json& row : notation().at("asked")) EXPECT_EQ(missed_there(row.at("expect")), row.at("missed")) << row;
}

TEST(Situation, that_no_run_could_miss_is_refused) {
  for (const json& expected : notation().at("refused"))
    EXPECT_THROW((void)missed_there(expected), std::invalid_argument) << expected;
  for (const json& text : notation().at("refused_situations")) {
    const Situation situation{.file = "f", .name = "s", .text = nlohmann::ordered_json(text)};
    EXPECT_THROW((void)cases_of(situation), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace paperproof::test
