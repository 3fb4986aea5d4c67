#include "report/index_json.hpp"

#include "records/metric.hpp"
#include "report/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// As the page shows it.
std::string words_for(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

nlohmann::json row_in_index(const Row& row) {
  nlohmann::json object(row_json(row));
  for (auto& [key, value] : object.items())
    if (value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))) value = "not finite";
  object["verdict"] = words_for(std::string(name_of(row.verdict)));
  if (!object.contains("reason")) object["reason"] = "";
  if (!object.contains("findings")) object["findings"] = nlohmann::json::array();
  if (object.contains("first_difference_box2d")) object["findings"].push_back(object["first_difference_box2d"]);
  if (object.contains("exempted")) {
    int all = 0;
    for (const nlohmann::json& times : object["exempted"]) all += times.get<int>();
    object["exempted"] = all;
  }
  for (const char* key : {"scene", "source", "parameters", "first_tunnel", "first_difference_box2d"}) object.erase(key);
  return object;
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
  return script_safe(dumped(object));
}

std::string index_json(const ReportFacts& facts, const std::vector<std::string>& scenes,
                       const std::vector<std::string>& studies) {
  nlohmann::json columns = nlohmann::json::array();
  for (const Metric& metric : metrics())
    columns.push_back({{"key", metric.key},
                       {"title", metric.title},
                       {"unit", metric.unit},
                       {"group", name_of(metric.group)},
                       {"kind", name_of(metric.kind)},
                       {"meaning", metric.meaning}});
  nlohmann::json lengths = nlohmann::json::array();
  for (const NamedTolerance& tolerance : facts.tolerances) lengths.push_back({tolerance.name, tolerance.metres});
  nlohmann::json titled = nlohmann::json::array();
  for (const ReportSection& section : facts.sections)
    titled.push_back({{"title", section.title}, {"lines", section.lines}, {"table", section.table}});
  std::string text = script_safe(dumped(nlohmann::json{{"environment", facts.environment},
                                                       {"metrics", columns},
                                                       {"tolerances", lengths},
                                                       {"guarantee_notes", facts.guarantee_notes},
                                                       {"sections", titled}}));
  text.back() = ',';
  return text + "\"scenes\":" + list_of(scenes) + ",\"studies\":" + list_of(studies) + '}';
}

}  // namespace paperproof::compare
