#include "report/index_json.hpp"

#include "records/metric.hpp"
#include "report/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// As the page shows it.
std::string words_for(Verdict verdict) {
  std::string words(name_of(verdict));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

nlohmann::json row_in_index(const Row& row) {
  nlohmann::json object{{"contender", row.contender}, {"scalar", row.scalar}, {"mode", row.mode},
                        {"steps", row.steps},         {"reason", row.reason}, {"findings", row.findings}};
  if (!row.first_difference_box2d.empty()) object["findings"].push_back(row.first_difference_box2d);
  if (!row.knob.empty()) object["knob"] = row.knob;
  object["verdict"] = words_for(row.verdict);
  for_each_metric(row, [&](const Metric& metric, const auto& value) {
    nlohmann::json& number = object[std::string(metric.key)];
    number = value;
    if (!std::isfinite(static_cast<double>(value))) number = "not finite";
  });
  return object;
}

std::string dumped(const nlohmann::json& value) {
  return script_safe(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

std::string scene_index_json(const ReportScene& scene) {
  nlohmann::json object{{"name", scene.name},
                        {"description", scene.description},
                        {"sentence", scene.sentence},
                        {"runs", scene.runs.size()},
                        {"disagreements", scene.disagreements.size()}};
  object["rows"] = nlohmann::json::array();
  for (const Row& row : scene.rows) object["rows"].push_back(row_in_index(row));
  return dumped(object);
}

std::string index_json(const Environment& environment, const std::vector<NamedTolerance>& tolerances,
                       const std::vector<std::string>& guarantee_notes, const std::vector<ReportSection>& sections,
                       const std::vector<std::string>& scenes) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& [name, value] : environment) names.push_back({name, value});
  nlohmann::json lengths = nlohmann::json::array();
  for (const NamedTolerance& tolerance : tolerances) lengths.push_back({tolerance.name, tolerance.metres});
  JsonArray list;
  for (const std::string& scene : scenes) list.add_raw(scene);
  nlohmann::json titled = nlohmann::json::array();
  for (const ReportSection& section : sections) titled.push_back({{"title", section.title}, {"lines", section.lines}});
  JsonObject object;
  object.put("environment", dumped(names)).put("tolerances", dumped(lengths));
  object.put("guarantee_notes", dumped(guarantee_notes))
      .put("sections", dumped(titled))
      .put("scenes", std::move(list).take());
  return std::move(object).take();
}

}  // namespace paperproof::compare
