#include "situations/situation.hpp"

#include "records/clause.hpp"
#include "support/expected.hpp"
#include "support/json_folder.hpp"
#include "support/steps_wanted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace paperproof::test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Short names of what is asked for most; everything else is a JSON pointer into the step's record.
const std::map<std::string, std::string>& short_names() {
  static const std::map<std::string, std::string> names{
      {"x", "/path/-1/0"}, {"y", "/path/-1/1"}, {"speed_x", "/velocity/0"}, {"speed_y", "/velocity/1"}};
  return names;
}

/// @throws std::invalid_argument where formulas have a name of a `for` or a `let` for something else.
void check_names(const ordered_json& given) {
  for (const auto& [name, ignored] : (given.is_array() ? given.at(0) : given).items())
    if (name == "dt" || name == "step" || short_names().contains(name.starts_with("last_") ? name.substr(5) : name))
      throw std::invalid_argument(name + ": formulas have this name for something else");
}

/// The numbers that tell a case from the others.
std::string title_of(const ordered_json& given, const Values& values) {
  const ordered_json& names = given.is_array() ? given.at(0) : given;
  std::string title;
  for (const auto& [name, ignored] : names.items()) title += fmt::format(" {}={}", name, values.at(name));
  return title;
}

/// Where nothing is of that name in any record, an expectation of `null` or of none would hold.
/// @param record of a story: it has all that there is. Of a trace it may lack some.
void check_part(const std::string& of, const json* record) {
  static const json keys = json::parse(std::ifstream(PAPERPROOF_TRACE_SCHEMA)).at("$defs").at("step").at("properties");
  const std::string first = of.substr(0, of.find('/', 1));
  const json& known = record != nullptr ? *record : keys;
  if (!of.starts_with('=') && !short_names().contains(of) && !known.contains(first.substr(first.starts_with('/'))))
    throw std::invalid_argument("a step's record has no " + of);
}

/// @throws std::invalid_argument for an expectation that no run could miss, or that says nothing of when.
void check(const json& expected, const json* record) {
  refuse_other_keys(expected, " of step steps some times least is within at_least at_most above below because ",
                    "an expectation");
  const auto has = [&](const char* key) { return static_cast<int>(expected.contains(key)); };
  if (has("is") + has("at_least") + has("at_most") + has("above") + has("below") == 0)
    throw std::invalid_argument("an expectation needs is, at_least, at_most, above or below: " + expected.dump());
  if (has("step") + has("steps") + has("some") != 1)
    throw std::invalid_argument("an expectation needs one of step, steps and some: " + expected.dump());
  if (has("times") + has("least") > has("some"))
    throw std::invalid_argument("times and least stand beside some: " + expected.dump());
  check_part(expected.at("of"), record);
}

/// The first and the last step that an expectation speaks of.
std::pair<int, int> steps_of(const json& expected, const Values& values, int count) {
  const char* key = expected.contains("step") ? "step" : expected.contains("some") ? "some" : "steps";
  const json given = compare::computed(expected.at(key), values);
  const auto step = [count](const json& number) {
    const double at = number;
    if (at != std::rint(at)) throw std::invalid_argument(fmt::format("expected a whole number of a step, not {}", at));
    return static_cast<int>(at) + (at < 0 ? count : 0);
  };
  return given.is_array() ? std::pair(step(given.at(0)), step(given.at(1))) : std::pair(step(given), step(given));
}

std::string missed_one(const SituationCase& situation, const json& expected, const std::vector<json>& records,
                       std::size_t before) {
  check(expected, situation.is_story ? &records.front() : nullptr);
  const int count = static_cast<int>(records.size() - before);
  const std::string of = expected.at("of");
  const auto [first, last] = steps_of(expected, situation.values, count);
  if (first < 0 || last < first || last >= count)
    return fmt::format("{} is asked of steps {} to {}, and there are {}", of, first, last, count);
  std::string fault;
  int times = 0;
  for (int step = first; step <= last; ++step) {
    const std::size_t at = before + static_cast<std::size_t>(step);
    Values values = in_step(static_cast<int>(at), records, situation.values);
    values["step"] = step;
    const json part = of.starts_with('=') ? json(compare::computed(of, values)) : part_of(records[at], of);
    const std::string here = fault_of(part, compare::computed(expected, values));
    times += here.empty();
    if (!here.empty() && fault.empty()) fault = fmt::format("in step {} {} {}", step, of, here);
  }
  if (expected.contains("some")) {
    const bool exactly = expected.contains("times");
    const json wanted = compare::computed(expected.value(exactly ? "times" : "least", json(1)), situation.values);
    if (times == wanted || (times > wanted && !exactly)) return {};
    fault = fmt::format("{} of steps {} to {} are as expected; {}", times, first, last, fault);
  }
  if (fault.empty()) return {};
  return fault + (expected.contains("because") ? " (" + expected["because"].get<std::string>() + ")" : "");
}

}  // namespace

json part_of(const json& record, const std::string& of) {
  const auto name = short_names().find(of);
  std::string pointer = name == short_names().end() ? of : name->second;
  if (pointer.front() != '/') pointer.insert(0, "/");
  const json* part = &record;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string key = pointer.substr(at + 1, end - at - 1);
    at = end;
    if (key == "#") return part->size();
    if (part->is_object() && part->contains(key)) {
      part = &part->at(key);
    } else if (part->is_array()) {
      const int index = std::stoi(key);
      const auto place = static_cast<std::size_t>(index < 0 ? index + static_cast<int>(part->size()) : index);
      if (place >= part->size()) return {};
      part = &part->at(place);
    } else if (key == "stuck" || key == "dropped") {
      return false;  // where it is not set
    } else {
      static const json nothing;
      part = &nothing;
    }
  }
  return *part;
}

Values in_step(int step, const std::vector<json>& records, Values values) {
  values["step"] = step;
  const auto add = [&](const std::string& before, int of) {
    const json& record = records[static_cast<std::size_t>(of)];
    for (const auto& [name, pointer] : short_names()) {
      const json part = part_of(record, pointer);
      if (part.is_number()) values[before + name] = part;
    }
    const json movers = record.value("movers", json::object());
    for (const auto& [id, ends] : movers.items()) {
      if (ends.is_object()) continue;  // it turns
      values[before + id + "_x"] = ends[1][0];
      values[before + id + "_y"] = ends[1][1];
    }
  };
  add("", step);
  if (step > 0) add("last_", step - 1);
  const json& record = records[static_cast<std::size_t>(step)];
  if (record.contains("feet")) values["feet"] = record["feet"];
  const json bodies = record.value("bodies", json::object());
  for (const auto& [id, body] : bodies.items()) {
    values[id + "_x"] = body["at"][0];
    values[id + "_y"] = body["at"][1];
    values[id + "_angle"] = body["angle"];
    values[id + "_speed"] = body["speed"];
  }
  return values;
}

std::vector<SituationCase> cases_of(const Situation& situation) {
  const ordered_json& text = situation.text;
  const ordered_json& file = situation.shared;
  const bool is_story = text.contains("story");
  const std::string keys = is_story ? "story " : "expect contender in_float knobs rules breaks ";
  refuse_other_keys(text, " name for let scene because " + keys, "a situation");
  for (const std::string clause : text.value("breaks", ordered_json::array()))
    if (!compare::clause_named(clause)) throw std::invalid_argument(situation.name + ": no such clause: " + clause);
  const json rules = json(text.value("rules", ordered_json::object()));
  refuse_other_keys(rules, " coyote_time jump_buffer jump_cut ", "rules");
  std::vector<SituationCase> cases;
  const ordered_json given = text.value("for", ordered_json::object());
  const json named = text.value("contender", ordered_json("octagon_sweep"));
  const json contenders = named.is_array() ? named : json::array({named});
  check_names(given);
  Values always = compare::constants();
  always["dt"] = 1.0 / 60;
  for (Values& values : compare::cases_of(given, always)) {
    for (const ordered_json* place : {&file, &text}) {
      const ordered_json let = place->value("let", ordered_json::object());
      check_names(let);
      compare::name_numbers(let, values);
    }
    json scene = json(file.value("scene", ordered_json::object()));
    scene.merge_patch(json(text.value("scene", ordered_json::object())));
    scene["paperproof_scene"] = 1;
    scene["name"] = situation.name;
    for (const std::string contender : contenders)
      cases.push_back({.title = title_of(given, values),
                       .values = values,
                       .scene = compare::computed(scene, values),
                       .contender = contender,
                       .in_float = text.value("in_float", false),
                       .rules = compare::computed(rules, values),
                       .knobs = text.value("knobs", std::vector<std::string>{}),
                       .expected = json(text.at(is_story ? "story" : "expect")),
                       .is_story = is_story,
                       .breaks = text.value("breaks", std::vector<std::string>{})});
  }
  if (cases.empty()) throw std::invalid_argument(situation.name + ": `for` has no case");
  return cases;
}

std::vector<SituationCase> some_cases_of(const Situation& situation) {
  const std::vector<SituationCase> cases = cases_of(situation);
  const std::size_t most = sanitized ? 1 : steps_per_family() < few_steps ? 2 : cases.size();
  const std::size_t count = std::min(cases.size(), most);
  std::vector<SituationCase> some;  // in even strides, from the first: it is often the cheapest
  for (std::size_t k = 0; k < count; ++k) some.push_back(cases[k * cases.size() / count]);
  return some;
}

std::vector<Situation> read_situations(const std::string& folder) {
  std::vector<Situation> situations;
  for_each_entry(folder, "situations",
                 [&](const std::string& stem, const ordered_json& file, const ordered_json& text) {
                   situations.push_back({.file = stem, .name = text.at("name"), .text = text, .shared = file});
                 });
  return situations;
}

std::vector<std::string> missed(const SituationCase& situation, const std::vector<json>& records, std::size_t first) {
  std::vector<std::string> sentences;
  for (const json& expected : situation.expected) {
    const std::string sentence = missed_one(situation, expected, records, first);
    if (!sentence.empty()) sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace paperproof::test
