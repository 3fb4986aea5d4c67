#include "records/rows_json.hpp"

#include "records/commit.hpp"
#include "records/metric.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace paperproof::compare {
namespace {

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

bool is_no_number(const nlohmann::ordered_json& value) {
  return value.is_number_float() && !std::isfinite(value.get<double>());
}

/// JSON has no word for such numbers: a file leaves them out, and `finite` says that something is not.
nlohmann::ordered_json with_finite_numbers(const nlohmann::ordered_json& object) {
  nlohmann::ordered_json kept = nlohmann::ordered_json::object();
  for (const auto& [key, value] : object.items())
    if (!is_no_number(value)) kept[key] = value.is_object() ? with_finite_numbers(value) : value;
  return kept;
}

}  // namespace

nlohmann::ordered_json row_json(const Row& row) {
  nlohmann::ordered_json object;
  object["scene"] = row.scene;
  object["contender"] = row.contender;
  object["scalar"] = row.scalar;
  object["mode"] = row.mode;
  if (!row.knob.empty()) object["knob"] = row.knob;
  if (row.border) object["border"] = *row.border;
  if (!row.curve.empty()) object["curve"] = row.curve;
  object["steps"] = row.steps;
  object["verdict"] = name_of(row.verdict);
  if (!row.reason.empty()) object["reason"] = row.reason;
  if (!row.case_id.empty()) object["case"] = row.case_id;
  if (row.swept)
    object["swept"] = {{"question", row.swept->question},
                       {"axes", row.swept->axes},
                       {"bad", row.swept->bad == Bad::tunnels ? "tunnels" : "does_not_hold"}};
  if (!row.parameters.empty()) {
    nlohmann::ordered_json& parameters = object["parameters"];
    for (const auto& [key, value] : row.parameters) parameters[key] = value;
  }
  if (!row.source.empty()) object["source"] = row.source;
  for_each_metric(row, [&](const Metric& metric, const auto& value) { object[std::string(metric.key)] = value; });
  if (!row.broken.empty()) object["broken"] = row.broken;
  if (row.steps > 0) object["exempted"] = row.exempted;
  if (!row.event_sequence.empty()) object["event_sequence"] = row.event_sequence;
  for (const auto& [name, some] : row.disagreements)
    object["disagreements"][name] = {{"count", some.count}, {"first_step", some.first_step}, {"first", some.first}};
  if (row.first_tunnel) object["first_tunnel"] = first_tunnel_json(*row.first_tunnel);
  if (!row.first_difference_box2d.empty()) object["first_difference_box2d"] = row.first_difference_box2d;
  if (!row.findings.empty()) object["findings"] = row.findings;
  if (!row.command.empty()) object["command"] = row.command;
  if (!built_commit().empty()) object["commit"] = built_commit();
  return object;
}

nlohmann::ordered_json rows_header(const Environment& environment) {
  nlohmann::ordered_json header{{"paperproof_rows", 1}};
  for (const auto& [name, value] : environment) header["environment"][name] = value;
  return header;
}

nlohmann::ordered_json rows_json(const std::vector<Row>& rows, const Environment& environment) {
  nlohmann::ordered_json file = rows_header(environment);
  file["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows) file["rows"].push_back(with_finite_numbers(row_json(row)));
  return file;
}

bool breaks_guarantee(const nlohmann::ordered_json& row) {
  const std::string scalar = row.value("scalar", "");
  return is_guaranteed(row.value("contender", ""), scalar) && row.value("verdict", "") == name_of(Verdict::violates);
}

std::string json_line(const nlohmann::ordered_json& object) {
  return with_finite_numbers(object).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace paperproof::compare
