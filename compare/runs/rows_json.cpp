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

nlohmann::ordered_json first_tunnel_json(const FirstTunnel& first) {
  nlohmann::ordered_json object{{"step", first.step}};
  if (!first.collider.empty()) {
    object["collider"] = first.collider;
    object["speed_m_s"] = first.speed_m_s;
    object["thickness_m"] = first.thickness_m;
    object["angle_deg"] = first.angle_deg;
  }
  return object;
}

}  // namespace

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
  for_each_metric(row, [&](const char* key, const auto& value) {
    if (value) object[key] = *value;
  });
  if (row.steps > 0) object["exempted"] = row.exempted;
  if (row.first_tunnel) object["first_tunnel"] = first_tunnel_json(*row.first_tunnel);
  if (!row.first_difference_box2d.empty()) object["first_difference_box2d"] = row.first_difference_box2d;
  if (!row.findings.empty()) object["findings"] = row.findings;
  return object;
}

std::vector<std::pair<std::string, std::string>> environment() {
  return {{"paperproof", PAPERPROOF_VERSION},
          {"box2d", box2d::box2d_version()},
          {"box2d_build", box2d::box2d_build()},
          {"box2d_asserts", box2d::box2d_asserts()},
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
