#include "judge/row.hpp"

#include "compare/exact_shapes.hpp"
#include "records/collider_json.hpp"
#include "records/trace_writer.hpp"
#include "scenes/formula.hpp"
#include "support/expected.hpp"
#include "support/json_folder.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare::test {
namespace {

using paperproof::test::refuse_other_keys;

constexpr double dt = 1.0 / 64;

/// The header of a trace in which there is nothing yet.
Json empty_header(const std::string& contender) {
  TraceHeader header;
  header.scene = "by_hand";
  header.contender = contender;
  header.scalar = "double";
  header.dt = dt;
  header.points = octagon();
  header.starts = {{}};
  return trace_header_json(header);
}

/// Its outline as it lies in each pose, [fraction, x, y, angle].
Json way_of(const Json& collider, const Json& poses) {
  const Json& outline = collider.contains("chain") ? collider["chain"] : collider["polygon"];
  Json way{{"offset", {{poses.front()[1], poses.front()[2]}, {poses.back()[1], poses.back()[2]}}}};
  for (const Json& pose : poses) {
    const Eigen::Rotation2D<double> by(pose[3].get<double>());
    Json points = Json::array();
    for (const Json& point : outline) {
      points.push_back(point_json(Vec2d(pose[1], pose[2]) + by * point.get<Vec2d>()));
    }
    way["k"].push_back(pose[0]);
    way["vertices"].push_back(std::move(points));
  }
  return way;
}

}  // namespace

Json header_of(const Json& said, const std::string& contender) {
  Json header = empty_header(contender);
  header.merge_patch(said.value("header", Json::object()));
  Json movers = Json::array();
  int number = 0;
  for (Json& collider : header["colliders"] = said.value("colliders", Json::array())) {
    if (!collider.contains("id")) collider["id"] = std::to_string(number);
    ++number;
    if (!collider.contains("goes")) continue;
    if (collider["goes"] != "turning" && collider["goes"] != "straight")
      throw std::invalid_argument("goes is straight or turning, not " + collider["goes"].dump());
    Json script = Json::parse(R"({"path": [{"t": 0, "at": [0, 0]}], "loop": "once"})");
    if (collider["goes"] == "turning") script["turns"] = Json::parse(R"([{"t": 0, "at": 0}])");
    script["colliders"].push_back(collider["id"]);
    movers.push_back(std::move(script));
    collider.erase("goes");
  }
  if (!movers.empty()) header["movers"] = std::move(movers);
  return header;
}

Json movers_of(const Json& said, const Json& header) {
  Json movers = Json::object();
  for (const Json& script : header.value("movers", Json::array())) {
    const std::string id = script["colliders"][0];
    const Json goes = said.value(id, Json{0, 0});
    const auto& colliders = header["colliders"];
    const auto collider =
        std::find_if(colliders.begin(), colliders.end(), [&id](const Json& one) { return one["id"] == id; });
    if (goes.is_object())
      movers[id] = goes.contains("poses") ? way_of(*collider, goes["poses"]) : goes;
    else
      movers[id] = goes[0].is_number() ? Json{{0, 0}, goes} : goes;
  }
  for (const auto& [id, ignored] : said.items())
    if (!movers.contains(id)) throw std::invalid_argument(id + ": no collider that moves");
  return movers;
}

Json path_of(Json path) {
  if (path.size() == 1 && path[0].size() == 2) path.push_back(path[0]);  // it stays
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i].size() == 2)
      path[i].push_back(static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(path.size() - 1, 1)));
  return path;
}

namespace {

/// A record of a trace: what is not said is as plain as it can be.
Json record_of(Json said, int number, const Json& header) {
  const Json path = path_of(said["path"]);
  const Vec2d way = point_of(path.back()) - point_of(path.front());
  Json record{{"step", number},    {"input", Json::object()}, {"requested", point_json(way)},  {"steered", 0},
              {"grounded", false}, {"jumping", false},        {"start_overlap", Json::array()}};
  record["velocity"] = point_json(way / dt);
  record["contacts"] = Json::array();
  said["path"] = path;
  said["movers"] = movers_of(said.value("movers", Json::object()), header);
  record.update(said);
  for (const char* key : {"grounded", "jumping", "stuck", "respawn", "dropped"})
    if (record.contains(key)) record[key] = paperproof::test::is_true(record[key]);
  for (const std::string list : {"contacts", "met"}) {
    if (!record.contains(list)) continue;
    for (Json& contact : record[list]) {
      Json whole{{"fraction", 0}};
      const auto normal = contact.at("normal").get<Vec2d>();
      whole["side"] = name_of(side_of_normal(normal.x(), normal.y()));
      if (list == "contacts") whole.update({{"point", {0, 0}}, {"separation", 0}});
      whole.update(contact);
      contact = std::move(whole);
    }
  }
  return record;
}

/// A list of objects is all of them together: an `if` leaves some of them out.
Json together(const Json& said) {
  if (!said.is_array()) return said;
  Json all = Json::object();
  for (const Json& part : said) all.merge_patch(part);
  return all;
}

RowTrace trace_of(const RowCase& one, const std::string& contender) {
  const Json& said = one.said;
  refuse_other_keys(said, " what contender header colliders turned step steps ", "a row");
  RowTrace trace{.title = contender + " " + one.title, .header = header_of(said, contender)};
  trace.turned = said.value("turned", 0.0);
  const std::size_t characters = trace.header.value("characters", std::size_t{1});
  for (const Json& patch : said.value("steps", Json::array({Json::object()}))) {
    Json step = said.value("step", Json::object());
    step.merge_patch(patch);
    Json beside = Json::object();
    for (const char* key : {"what", "wanted", "beside_another", "tells"}) {
      if (!step.contains(key)) continue;
      beside[key] = key == std::string("tells") ? together(step[key]) : step[key];
      step.erase(key);
    }
    const std::size_t count = trace.records.size();
    Json record = record_of(std::move(step), static_cast<int>(count / characters), trace.header);
    if (characters > 1) record["character"] = count % characters;
    if (contender == "sampled") record["path_exact"] = false;
    trace.records.push_back(std::move(record));
    trace.beside.push_back(std::move(beside));
  }
  return trace;
}

}  // namespace

std::vector<Row> read_rows(const std::string& folder) {
  std::vector<Row> rows;
  paperproof::test::for_each_entry(folder, "rows", [&](const std::string& stem, const Json& file, const Json& text) {
    rows.push_back({stem + "_" + text.at("name").get<std::string>(), file, text});
  });
  return rows;
}

std::vector<RowCase> cases_of(const Row& row) {
  Values always = constants();
  always["dt"] = dt;
  name_numbers(row.file.value("let", Json::object()), always);
  std::vector<RowCase> all;
  for (const Values& values : compare::cases_of(row.text.value("for", Json::object()), always))
    for (const Json& one : row.text.value("cases", Json::array({Json::object()}))) {
      Values of_case = values;
      const Json own = one.value("let", Json::object());
      name_numbers(own, of_case);
      Json let = row.text.value("let", Json::object());
      for (const auto& [name, ignored] : own.items()) let.erase(name);
      name_numbers(let, of_case);
      Json said = row.file;
      said.merge_patch(row.text);
      said.merge_patch(one);
      for (const char* key : {"name", "for", "let", "cases"}) said.erase(key);
      all.push_back({.title = one.value("what", ""), .said = computed(said, of_case)});
      for (const auto& [name, value] : of_case)
        if (!always.contains(name)) all.back().title += fmt::format(" {}={}", name, value);
    }
  return all;
}

std::vector<RowTrace> traces_of(const RowCase& one) {
  std::vector<RowTrace> traces;
  const Json contenders = one.said.value("contender", Json("somebody"));
  for (const std::string contender : contenders.is_array() ? contenders : Json::array({contenders})) {
    if (contender != "somebody" && contender != "octagon_sweep" && contender != "sampled")
      throw std::invalid_argument("no such contender of a row: " + contender);
    traces.push_back(trace_of(one, contender));
  }
  return traces;
}

std::string missed(const Json& tells, const Json& told) {
  std::string all;
  for (const auto& [key, wanted] : tells.items()) {
    const Json::json_pointer part("/" + key);
    if (!told.contains(part)) throw std::invalid_argument("nothing is told of " + key + " in " + told.dump());
    if (wanted.is_object()) paperproof::test::refuse_other_bounds(wanted, key);
    const std::string fault =
        paperproof::test::fault_of(told.at(part), wanted.is_object() ? wanted : Json{{"is", wanted}});
    if (!fault.empty()) all += "\n" + key + " " + fault;
  }
  return all;
}

}  // namespace paperproof::compare::test
