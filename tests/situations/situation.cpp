#include "situations/situation.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace paperproof::test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// What every formula may name.
Values constants() {
  return {
      {"px", 1.0 / 32},  // of the article's pictures [m]
      {"half_width", 10.0 / 32},
      {"half_height", 20.0 / 32},
      {"half_foot", 5.0 / 32},
      {"dt", 1.0 / 60},
      {"gap", 1e-6},  // the largest that may be kept at a contact [m]
      {"pi", std::numbers::pi},
      {"degree", std::numbers::pi / 180},
  };
}

/// The cases of `for`: every combination of the numbers that it lists by name, or each of a list of rows.
std::vector<Values> cases_of(const ordered_json& given) {
  std::vector<Values> all{constants()};
  if (given.is_array()) {
    all.assign(given.size(), constants());
    for (std::size_t i = 0; i < given.size(); ++i)
      for (const auto& [name, number] : given[i].items()) all[i][name] = computed(json(number), all[i]).get<double>();
    return all;
  }
  for (const auto& [name, numbers] : given.items()) {
    std::vector<Values> longer;
    for (const Values& values : all) {
      for (const json number : numbers) {
        longer.push_back(values);
        longer.back()[name] = computed(number, values).get<double>();
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// The numbers that tell a case from the others.
std::string title_of(const ordered_json& given, const Values& values) {
  const ordered_json& names = given.is_array() ? given.at(0) : given;
  std::string title;
  for (const auto& [name, ignored] : names.items()) title += fmt::format(" {}={}", name, values.at(name));
  return title;
}

Situation read_situation(const ordered_json& text, const ordered_json& file) {
  Situation situation{.file = {}, .name = text.at("name"), .cases = {}};
  const ordered_json given = text.value("for", ordered_json::object());
  for (Values& values : cases_of(given)) {
    for (const ordered_json* place : {&file, &text}) {
      const ordered_json lets = place->value("let", ordered_json::object());
      for (const auto& [name, formula] : lets.items()) values[name] = value_of(formula, values);
    }
    json scene = json(file.value("scene", ordered_json::object()));
    scene.merge_patch(json(text.value("scene", ordered_json::object())));
    scene["paperproof_scene"] = 1;
    scene["name"] = situation.name;
    situation.cases.push_back({.title = title_of(given, values),
                               .values = values,
                               .scene = computed(scene, values),
                               .contender = text.value("contender", "octagon_sweep"),
                               .expected = json(text.at("expect")),
                               .breaks = text.value("breaks", std::vector<std::string>{})});
  }
  return situation;
}

/// Short names of what is asked for most; everything else is a JSON pointer into the step's record.
const std::map<std::string, std::string>& short_names() {
  static const std::map<std::string, std::string> names{
      {"x", "/path/-1/0"}, {"y", "/path/-1/1"}, {"speed_x", "/velocity/0"}, {"speed_y", "/velocity/1"}};
  return names;
}

/// The part of a record that a pointer names: -1 is the last of a list, # how many it has; null where there is none.
json part_of(const json& record, const std::string& of) {
  const auto name = short_names().find(of);
  std::string pointer = name == short_names().end() ? of : name->second;
  if (pointer.front() != '/') pointer.insert(0, "/");
  json part = record;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string key = pointer.substr(at + 1, end - at - 1);
    at = end;
    if (key == "#") return part.is_null() ? 0 : part.size();
    if (part.is_object()) {
      part = part.contains(key) ? json(part[key]) : json();
    } else if (part.is_array()) {
      const int index = std::stoi(key);
      const auto place = static_cast<std::size_t>(index < 0 ? index + static_cast<int>(part.size()) : index);
      part = place < part.size() ? json(part[place]) : json();
    } else {
      return {};
    }
  }
  return part;
}

bool is_near(const json& part, const json& wanted, double within) {
  if (part.is_number() && wanted.is_number()) return std::abs(part.get<double>() - wanted.get<double>()) <= within;
  if (!part.is_array() || !wanted.is_array()) return part == wanted;
  return std::equal(part.begin(), part.end(), wanted.begin(), wanted.end(),
                    [within](const json& a, const json& b) { return is_near(a, b, within); });
}

/// What is wrong with a part of a record, in words; empty where nothing is.
std::string fault_of(const json& part, const json& wanted) {
  if (wanted.contains("is")) {
    const double within = wanted.value("within", 0.0);
    if (!is_near(part, wanted["is"], within))
      return fmt::format("is {} instead of {} within {}", part.dump(), wanted["is"].dump(), within);
  }
  for (const char* bound : {"at_least", "at_most", "above", "below"}) {
    if (!wanted.contains(bound)) continue;
    const double limit = wanted[bound];
    const double value = part.is_number() ? part.get<double>() : NAN;
    const std::string which = bound;
    const bool holds = which == "at_least"  ? value >= limit
                       : which == "at_most" ? value <= limit
                       : which == "above"   ? value > limit
                                            : value < limit;
    if (!holds) return fmt::format("is {}, and not {} {}", part.dump(), which, limit);
  }
  return {};
}

void refuse_other_keys(const json& wanted) {
  for (const auto& [key, value] : wanted.items())
    if (std::string(" of step steps some times is within at_least at_most above below because ")
            .find(" " + key + " ") == std::string::npos)
      throw std::invalid_argument("no such key of an expectation: " + key);
}

/// The first and the last step that an expectation speaks of.
std::pair<int, int> steps_of(const json& expected, const Values& values, int count) {
  const char* key = expected.contains("step") ? "step" : expected.contains("some") ? "some" : "steps";
  const json given = computed(expected.at(key), values);
  const auto step = [count](const json& number) {
    const int at = number.get<int>();
    return at < 0 ? count + at : at;
  };
  return given.is_array() ? std::pair(step(given.at(0)), step(given.at(1))) : std::pair(step(given), step(given));
}

/// What a formula may name in a step: its number, and where and how fast the character was after the one before.
Values in_step(int step, const std::vector<json>& records, Values values) {
  values["step"] = step;
  if (step == 0) return values;
  for (const auto& [name, pointer] : short_names()) {
    const json part = part_of(records[static_cast<std::size_t>(step) - 1], pointer);
    if (part.is_number()) values["last_" + name] = part;
  }
  return values;
}

std::string missed_one(const SituationCase& situation, const json& expected, const std::vector<json>& records) {
  refuse_other_keys(expected);
  const std::string of = expected.at("of");
  const auto [first, last] = steps_of(expected, situation.values, static_cast<int>(records.size()));
  if (first < 0 || last < first || last >= static_cast<int>(records.size()))
    return fmt::format("{} is asked of steps {} to {}, and there are {}", of, first, last, records.size());
  std::string fault;
  int times = 0;
  for (int step = first; step <= last; ++step) {
    const Values values = in_step(step, records, situation.values);
    const std::string here = fault_of(part_of(records[static_cast<std::size_t>(step)], of), computed(expected, values));
    times += here.empty();
    if (!here.empty() && fault.empty()) fault = fmt::format("in step {} {} {}", step, of, here);
  }
  if (expected.contains("some")) {
    const int wanted = computed(expected, situation.values).value("times", 0);
    if (wanted == 0 ? times > 0 : times == wanted) return {};
    fault = fmt::format("{} of steps {} to {} are as expected; {}", times, first, last, fault);
  }
  if (fault.empty()) return {};
  return fault + (expected.contains("because") ? " (" + expected["because"].get<std::string>() + ")" : "");
}

}  // namespace

double value_of(const std::string& formula, const Values& values) {
  try {
    mu::Parser parser;
    for (const auto& [name, value] : values) parser.DefineConst(name, value);
    parser.SetExpr(formula);
    return parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(formula + ": " + error.GetMsg());
  }
}

json computed(const json& document, const Values& values) {
  if (document.is_string()) {
    const auto& text = document.get_ref<const std::string&>();
    return text.starts_with('=') ? json(value_of(text.substr(1), values)) : document;
  }
  if (!document.is_structured()) return document;
  json result = document;
  for (json& part : result) part = computed(part, values);
  if (!result.is_object() || !result.contains("box")) return result;
  const std::vector<double> box = result["box"];
  result.erase("box");
  result["polygon"] = {{box.at(0), box.at(1)}, {box.at(2), box[1]}, {box[2], box.at(3)}, {box[0], box[3]}};
  return result;
}

std::vector<Situation> read_situations(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Situation> situations;
  for (const std::filesystem::path& path : paths) {
    try {
      const ordered_json file = ordered_json::parse(std::ifstream(path));
      for (const ordered_json& text : file.at("situations")) {
        situations.push_back(read_situation(text, file));
        situations.back().file = path.stem();
      }
    } catch (const std::exception& error) {
      throw std::invalid_argument(path.string() + ": " + error.what());
    }
  }
  return situations;
}

std::vector<std::string> missed(const SituationCase& situation, const std::vector<json>& records) {
  std::vector<std::string> sentences;
  for (const json& expected : situation.expected) {
    const std::string sentence = missed_one(situation, expected, records);
    if (!sentence.empty()) sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace paperproof::test
