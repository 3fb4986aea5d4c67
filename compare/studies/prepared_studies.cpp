#include "studies/prepared_studies.hpp"

#include "embedded.hpp"
#include "runs/contender.hpp"
#include "scenes/json_text.hpp"
#include "studies/bullet.hpp"
#include "studies/field.hpp"
#include "studies/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace paperproof::compare {
namespace {

const Json& texts() {
  static const Json all = Json::parse(prepared_studies_file.front().text);
  return all;
}

/// As `{"box2d": {"movers": "transform"}}`: names, each with its knobs.
std::vector<NamedContender> contenders_in(const Json& list) {
  std::vector<NamedContender> all;
  for (const Json& one : list)
    for (const auto& [name, knobs] : one.items()) {
      all.push_back({name});
      for (const auto& [key, value] : knobs.items()) all.back().knobs.push_back({key, value});
    }
  return all;
}

std::vector<StudyPart> parts_of(const Json& study, GridSize size) {
  std::vector<StudyPart> parts;
  for (const Json& text : study.at("parts")) parts.push_back(part_of(text, size));
  return parts;
}

}  // namespace

const Json& study_text(std::string_view name) {
  for (const Json& study : texts())
    if (study.at("name") == name) return study;
  throw std::invalid_argument(fmt::format("no study is called {}", name));
}

const Json& of_size(const Json& list, GridSize size) {
  return list[std::min(static_cast<std::size_t>(size), list.size() - 1)];
}

StudyPart part_of(const Json& text, GridSize size) {
  StudyPart part;
  part.title = text.value("title", "");
  part.question = text.value("question", "");
  Sweep& sweep = part.sweep;
  sweep.scene = text.at("scene");
  if (text.contains("axes")) sweep.axes = parse_axes(of_size(text["axes"], size).get<std::string>());
  if (text.contains("steps")) sweep.steps = of_size(text["steps"], size).get<int>();
  const Json set = text.value("set", Json::object());
  for (const auto& [key, value] : set.items()) sweep.set.push_back({key, value});
  if (text.contains("border")) sweep.border = text["border"].get<std::string>();
  if (text.contains("range")) sweep.border_range = text["range"].get<std::pair<double, double>>();
  sweep.contenders = text.contains("only") ? contenders_in(text["only"])
                                           : all_contenders_and(contenders_in(text.value("also", Json::array())));
  return part;
}

GridSize grid_size(std::string_view name) noexcept {
  if (name == "full") return GridSize::full;
  return name == "standard" ? GridSize::standard : GridSize::quick;
}

std::vector<NamedContender> all_contenders_and(const std::vector<NamedContender>& more) {
  std::vector<NamedContender> all;
  for (const std::string_view name : contender_names()) all.push_back({std::string(name)});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void keep_only(const std::vector<std::string>& wanted, std::vector<StudyPart>& parts) {
  if (wanted.empty()) return;
  for (StudyPart& part : parts)
    std::erase_if(part.sweep.contenders, [&](const NamedContender& one) {
      return std::find(wanted.begin(), wanted.end(), one.name) == wanted.end();
    });
  std::erase_if(parts, [](const StudyPart& part) { return part.sweep.contenders.empty(); });
}

const std::vector<PreparedStudy>& prepared_studies() {
  static const std::vector<PreparedStudy> all = [] {
    std::vector<PreparedStudy> listed;
    for (const Json& text : texts()) {
      PreparedStudy& study = listed.emplace_back();
      study.name = text.at("name");
      study.help = text.at("help");
      study.parts = [&text](GridSize size, const std::vector<std::string>&) { return parts_of(text, size); };
      study.title = text.at("title");
      study.paragraphs = text.value("paragraphs", study.paragraphs);
      study.grid = text.value("grid", "quick");
      study.in_one_table = text.value("in_one_table", false);
      std::vector<std::string> more;
      if (study.name == "bullet") {
        study.parts = bullet_parts;
        study.theory = bullet_theory_in_words;
      } else if (study.name == "field") {
        study.parts = field_parts;
        more = field_questions();
      } else if (study.name == "stability") {
        study.parts = stability_parts;
        more = stability_predicates();
      }
      study.paragraphs.insert(study.paragraphs.end(), more.begin(), more.end());
    }
    return listed;
  }();
  return all;
}

}  // namespace paperproof::compare
