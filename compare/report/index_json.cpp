#include "report/index_json.hpp"

#include "report/json_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

std::string_view words_for(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::tunnels:
      return "tunnels";
    case Verdict::violates:
      return "violates";
    case Verdict::not_applicable:
      return "not applicable";
    case Verdict::flagged:
      return "flagged";
    case Verdict::failed:
      return "failed";
  }
  return "failed";
}

template <class Number>
void put(nlohmann::json& object, const char* key, const std::optional<Number>& value) {
  if (!value) return;
  if (std::isfinite(static_cast<double>(*value))) {
    object[key] = *value;
  } else {
    object[key] = "not finite";
  }
}

void put_counts(nlohmann::json& object, const Row& row) {
  put(object, "tunnels", row.tunnels);
  put(object, "corner_cuts", row.corner_cuts);
  put(object, "steps_ending_inside", row.steps_ending_inside);
  put(object, "one_way_violations", row.one_way_violations);
  put(object, "first_contact_step", row.first_contact_step);
  put(object, "first_difference_box2d_step", row.first_difference_box2d_step);
  put(object, "contact_steps", row.contact_steps);
  put(object, "colliders_touched", row.colliders_touched);
  put(object, "respawns", row.respawns);
  put(object, "crushes", row.crushes);
  put(object, "crushes_with_room", row.crushes_with_room);
  put(object, "sensor_events", row.sensor_events);
  put(object, "sensor_errors", row.sensor_errors);
  put(object, "dropped_steps", row.dropped_steps);
}

void put_measures(nlohmann::json& object, const Row& row) {
  put(object, "max_penetration_m", row.max_penetration_m);
  put(object, "max_contact_gap_m", row.max_contact_gap_m);
  put(object, "first_contact_fraction", row.first_contact_fraction);
  put(object, "contact_precision", row.contact_precision);
  put(object, "contact_recall", row.contact_recall);
  put(object, "contact_precision_box2d", row.contact_precision_box2d);
  put(object, "contact_recall_box2d", row.contact_recall_box2d);
  put(object, "contact_agreement_box2d", row.contact_agreement_box2d);
  put(object, "toi_error_max", row.toi_error_max);
  put(object, "max_sensor_error", row.max_sensor_error);
  put(object, "ghost_speed_loss", row.ghost_speed_loss);
  put(object, "rest_peak_to_peak_m", row.rest_peak_to_peak_m);
  put(object, "rest_rms_m", row.rest_rms_m);
  put(object, "contact_toggles", row.contact_toggles);
  put(object, "max_position_difference_box2d_m", row.max_position_difference_box2d_m);
  put(object, "ns_per_step", row.ns_per_step);
  put(object, "ns_per_step_median", row.ns_per_step_median);
  put(object, "ns_per_step_max", row.ns_per_step_max);
  put(object, "memory_bytes", row.memory_bytes);
}

nlohmann::json row_json(const Row& row) {
  nlohmann::json object{{"contender", row.contender}, {"scalar", row.scalar}, {"mode", row.mode},
                        {"steps", row.steps},         {"reason", row.reason}, {"findings", row.findings}};
  if (!row.first_difference_box2d.empty()) object["findings"].push_back(row.first_difference_box2d);
  object["verdict"] = std::string(words_for(row.verdict));
  put_counts(object, row);
  put_measures(object, row);
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
  for (const Row& row : scene.rows) object["rows"].push_back(row_json(row));
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
