#include "runs/rows_json.hpp"

#include "runs/build_info.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace paperproof::compare {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

template <class Value>
void put(nlohmann::ordered_json& object, const char* key, const std::optional<Value>& value) {
  if (value) object[key] = *value;
}

nlohmann::ordered_json row_json(const Row& row) {
  nlohmann::ordered_json object;
  object["scene"] = row.scene;
  object["contender"] = row.contender;
  object["scalar"] = row.scalar;
  object["mode"] = row.mode;
  if (!row.knob.empty()) object["knob"] = row.knob;
  object["steps"] = row.steps;
  object["verdict"] = name_of(row.verdict);
  if (!row.reason.empty()) object["reason"] = row.reason;
  put(object, "tunnels", row.tunnels);
  put(object, "corner_cuts", row.corner_cuts);
  put(object, "steps_ending_inside", row.steps_ending_inside);
  put(object, "one_way_violations", row.one_way_violations);
  put(object, "max_penetration_m", row.max_penetration_m);
  put(object, "max_contact_gap_m", row.max_contact_gap_m);
  put(object, "first_contact_step", row.first_contact_step);
  put(object, "first_contact_fraction", row.first_contact_fraction);
  put(object, "contact_precision", row.contact_precision);
  put(object, "contact_recall", row.contact_recall);
  put(object, "contact_precision_box2d", row.contact_precision_box2d);
  put(object, "contact_recall_box2d", row.contact_recall_box2d);
  put(object, "contact_agreement_box2d", row.contact_agreement_box2d);
  put(object, "contact_steps", row.contact_steps);
  put(object, "colliders_touched", row.colliders_touched);
  put(object, "respawns", row.respawns);
  put(object, "crushes", row.crushes);
  put(object, "crushes_with_room", row.crushes_with_room);
  put(object, "sensor_events", row.sensor_events);
  put(object, "sensor_errors", row.sensor_errors);
  put(object, "max_sensor_error", row.max_sensor_error);
  put(object, "dropped_steps", row.dropped_steps);
  put(object, "toi_error_max", row.toi_error_max);
  put(object, "ghost_speed_loss", row.ghost_speed_loss);
  put(object, "rest_peak_to_peak_m", row.rest_peak_to_peak_m);
  put(object, "rest_rms_m", row.rest_rms_m);
  put(object, "contact_toggles", row.contact_toggles);
  put(object, "max_position_difference_box2d_m", row.max_position_difference_box2d_m);
  put(object, "first_difference_box2d_step", row.first_difference_box2d_step);
  if (!row.first_difference_box2d.empty()) object["first_difference_box2d"] = row.first_difference_box2d;
  put(object, "ns_per_step", row.ns_per_step);
  put(object, "ns_per_step_median", row.ns_per_step_median);
  put(object, "ns_per_step_max", row.ns_per_step_max);
  put(object, "memory_bytes", row.memory_bytes);
  if (!row.findings.empty()) object["findings"] = row.findings;
  return object;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> environment() {
  return {{"paperproof", PAPERPROOF_VERSION},
          {"box2d", box2d::box2d_version()},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"boost", BOOST_LIB_VERSION},
          {"compiler", PAPERPROOF_COMPILER},
          {"flags", PAPERPROOF_FLAGS},
          {"cpu", processor()},
          {"build", PAPERPROOF_BUILD_TYPE}};
}

nlohmann::ordered_json rows_json(const std::vector<Row>& rows) {
  nlohmann::ordered_json file;
  file["paperproof_rows"] = 1;
  for (const auto& [name, value] : environment()) file["environment"][name] = value;
  file["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows) file["rows"].push_back(row_json(row));
  return file;
}

nlohmann::ordered_json gallery_json(const std::vector<GalleryEntry>& gallery) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const GalleryEntry& entry : gallery) {
    nlohmann::ordered_json object{{"contender", entry.contender}, {"scenes", entry.scenes}};
    if (entry.fails) object["fails_on"] = {{"scene", entry.fails->scene}, {"failure", entry.fails->failure.words}};
    if (entry.cheapest) {
      object["cheapest_on"] = {{"scene", entry.cheapest->scene}, {"ns_per_step", entry.cheapest->ns_per_step}};
      if (!entry.cheapest->next.empty())
        object["cheapest_on"]["next"] = {{"contender", entry.cheapest->next},
                                         {"ns_per_step", entry.cheapest->next_ns_per_step}};
    }
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace paperproof::compare
