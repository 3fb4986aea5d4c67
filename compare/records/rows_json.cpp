#include "records/rows_json.hpp"

#include "records/clause.hpp"
#include "records/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace paperproof::compare {

using nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 2> bad_names{"does_not_hold", "tunnels"};  // by `Bad`

template <std::size_t count>
std::size_t place_in(const std::array<std::string_view, count>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

template <class Value>
ordered_json json_of(const Value& value) {
  return value;
}
ordered_json json_of(Verdict verdict) { return name_of(verdict); }
ordered_json json_of(const std::optional<SweptIn>& in) {
  return {{"question", in->question}, {"axes", in->axes}, {"bad", bad_names[static_cast<std::size_t>(in->bad)]}};
}
ordered_json json_of(const std::vector<std::pair<std::string, double>>& parameters) {
  ordered_json object;
  for (const auto& [key, value] : parameters) object[key] = value;
  return object;
}
ordered_json json_of(const std::map<std::string, Disagreements>& all) {
  ordered_json object;
  for (const auto& [name, some] : all)
    object[name] = {{"count", some.count}, {"first_step", some.first_step}, {"first", some.first}};
  return object;
}
ordered_json json_of(const std::optional<FirstTunnel>& first) {
  if (first->collider.empty()) return {{"step", first->step}};
  return {{"step", first->step},
          {"collider", first->collider},
          {"speed_m_s", first->speed_m_s},
          {"thickness_m", first->thickness_m},
          {"angle_deg", first->angle_deg}};
}

template <class Value>
void take(const ordered_json& json, Value& value) {
  json.get_to(value);
}
template <class Number>
void take(const ordered_json& json, std::optional<Number>& value) {
  value = json.get<Number>();
}
void take(const ordered_json& json, Verdict& verdict) {
  verdict = static_cast<Verdict>(place_in(verdict_names, json.get<std::string>()));
}
void take(const ordered_json& json, std::optional<SweptIn>& in) {
  SweptIn& made = in.emplace();
  json["question"].get_to(made.question);
  json["axes"].get_to(made.axes);
  made.bad = static_cast<Bad>(place_in(bad_names, json["bad"].get<std::string>()));
}
void take(const ordered_json& json, std::vector<std::pair<std::string, double>>& parameters) {
  for (const auto& [key, value] : json.items()) parameters.emplace_back(key, value.get<double>());
}
void take(const ordered_json& json, std::map<std::string, Disagreements>& all) {
  for (const auto& [name, some] : json.items()) all[name] = {some["count"], some["first_step"], some["first"]};
}
void take(const ordered_json& json, std::optional<FirstTunnel>& first) {
  first = {.step = json["step"],
           .collider = json.value("collider", ""),
           .speed_m_s = json.value("speed_m_s", 0.0),
           .thickness_m = json.value("thickness_m", 0.0),
           .angle_deg = json.value("angle_deg", 0.0),
           .words = {}};
}

/// A key of a row.
struct Field {
  std::string key;
  ordered_json schema;
  bool required = false;
  std::function<ordered_json(const Row&)> written;  ///< Null: it is absent.
  std::function<void(const ordered_json&, Row&)> read;
};

/// A member that is absent where it says nothing. @param asks what the schema asks for, as JSON.
template <class Value>
Field field(const char* key, Value Row::*member, const char* description, const char* asks = R"({"type":"string"})") {
  ordered_json schema = ordered_json::parse(asks);
  schema["description"] = description;
  return {key, std::move(schema), false,
          [member](const Row& row) { return row.*member == Value{} ? ordered_json{} : json_of(row.*member); },
          [member](const ordered_json& json, Row& row) { take(json, row.*member); }};
}

/// One that always stands there.
template <class Value>
Field required(const char* key, Value Row::*member, const char* description,
               const char* asks = R"({"type":"string"})") {
  Field one = field(key, member, description, asks);
  one.required = true;
  one.written = [member](const Row& row) { return json_of(row.*member); };
  return one;
}

Field field(const Metric& metric) {
  const bool counts = metric.kind == Metric::Kind::count || metric.kind == Metric::Kind::bytes;
  const bool is_flag = metric.kind == Metric::Kind::flag;
  Field one{std::string(metric.key), {{"type", is_flag ? "boolean" : counts ? "integer" : "number"}}, false, {}, {}};
  if (counts || metric.kind == Metric::Kind::measure) one.schema["minimum"] = 0;
  one.schema["description"] =
      fmt::format("{}{}.", metric.meaning, metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit));
  std::visit(
      [&one](const auto member) {
        one.written = [member](const Row& row) { return row.*member ? ordered_json(*(row.*member)) : ordered_json{}; };
        one.read = [member](const ordered_json& json, Row& row) { take(json, row.*member); };
      },
      metric.field);
  return one;
}

/// By the clauses of the guarantee.
std::string counts_by_clause() {
  ordered_json asks{{"type", "object"}, {"additionalProperties", false}};
  for (const std::string_view clause : clause_names)
    asks["properties"][std::string(clause)] = {{"type", "integer"}, {"minimum", 1}};
  return asks.dump();
}

constexpr const char* asks_for_id = R"({"type":"string","pattern":"^[0-9a-f]{16}$"})";

std::vector<Field> all_fields() {
  std::vector<Field> all{
      required("scene", &Row::scene, "Name of the scene or family."),
      required("contender", &Row::contender, "Who ran: see `paperproof list contenders`."),
      required("scalar", &Row::scalar,
               "Number type: double or float. Box2D is float. Empty where the scene could not be used.",
               R"({"type":"string","enum":["double","float",""]})"),
      required("mode", &Row::mode, "free, lockstep or work_precision. Empty where the scene could not be used.",
               R"({"type":"string","enum":["free","lockstep","work_precision",""]})"),
      field("knob", &Row::knob, "Settings that are not the usual ones, as name=value."),
      field("engine", &Row::engine, "Name and version of a peer's engine, as it says."),
      field("machine", &Row::machine, "What a peer's engine runs on: times of two of them are not compared.",
            R"({"type":"string","enum":["native","webassembly","javascript","script"]})"),
      field("worst", &Row::worst, "The worst that it does, in a word and a figure; in rows of `study field`."),
      field("border", &Row::border, "Key of the parameter that was bisected."),
      field("curve", &Row::curve, "Key of the parameter that a curve of several runs is over."),
      required("steps", &Row::steps, "Steps that ran.", R"({"type":"integer","minimum":0})"),
      required("verdict", &Row::verdict, "The worst of failed, not_applicable, violates, tunnels, flagged and holds.",
               R"({"type":"string","enum":["failed","not_applicable","violates","tunnels","flagged","holds"]})"),
      field("reason", &Row::reason, "Every axis at fault, in words; absent for holds."),
      field("case", &Row::case_id, "Stable id of the Case: 16 hexadecimal digits.", asks_for_id),
      field("swept", &Row::swept, "The sweep that it is a case of: a cell of a heat map stands for it.",
            R"({"type":"object","required":["question","axes","bad"],"additionalProperties":false,"properties":{
                "question":{"type":"string","description":"Of a study that asks several."},
                "axes":{"type":"array","description":"Keys in parameters.","items":{"type":"string"}},
                "bad":{"enum":["does_not_hold","tunnels"],"description":"What a cell counts."}}})"),
      field("parameters", &Row::parameters, "Numbers of scene, input and knobs; keys end in their units.",
            R"({"type":"object","additionalProperties":{"type":"number"}})"),
      field("source", &Row::source, "The file of the scene, or builtin:NAME."),
  };
  for (const Metric& metric : metrics()) all.push_back(field(metric));
  all.push_back(field("broken", &Row::broken,
                      "Steps that broke a clause of the guarantee, whether the contender promises it or not, by the "
                      "clause's name; absent where none was broken.",
                      counts_by_clause().c_str()));
  all.push_back(field("exempted", &Row::exempted, "What was not held against the contender, and how often.",
                      R"({"type":"object","additionalProperties":{"type":"integer","minimum":0}})"));
  all.back().written = [](const Row& row) { return row.steps > 0 ? json_of(row.exempted) : ordered_json{}; };
  const std::vector<Field> last{
      field("event_sequence", &Row::event_sequence, "Which events, in order: equal for equal sequences.", asks_for_id),
      field("disagreements", &Row::disagreements, "Events on which the contender and Box2D differ, by `cause.kind`.",
            R"({"type":"object","additionalProperties":{"type":"object","additionalProperties":false,
                "required":["count","first_step","first"],"properties":{"count":{"type":"integer","minimum":0},
                "first_step":{"type":"integer","minimum":0},"first":{"type":"string"}}}})"),
      field("first_tunnel", &Row::first_tunnel, "The first passage: step, collider, speed_m_s, thickness_m, angle_deg.",
            R"({"type":"object","required":["step"],"additionalProperties":false,"properties":{
                "step":{"type":"integer","minimum":0},"collider":{"type":"string"},"speed_m_s":{"type":"number"},
                "thickness_m":{"type":"number"},"angle_deg":{"type":"number"}}})"),
      field("first_difference_box2d", &Row::first_difference_box2d,
            "How it and the twin first differ, and who is right."),
      field("findings", &Row::findings, "Sentences: where the run began, what was not compared.",
            R"({"type":"array","items":{"type":"string"}})"),
      field("command", &Row::command, "What runs the Case alone."),
      field("commit", &Row::commit, "That the command was built from; it ends in + where files were changed since."),
  };
  all.insert(all.end(), last.begin(), last.end());
  return all;
}

/// In the order in which they stand in a row.
const std::vector<Field>& fields() {
  static const std::vector<Field> all = all_fields();
  return all;
}

/// Of a file: its one object, or its first line.
constexpr const char* schema_of_files = R"({
"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "paperproof rows",
"description": "A .json file of rows is one such object with `rows`; the first line of a .jsonl file is one without, and each further line a row ($defs/row).",
"type": "object", "required": ["paperproof_rows"], "additionalProperties": false, "properties": {
 "paperproof_rows": {"const": 1},
 "environment": {"type": "object", "additionalProperties": {"type": "string"}},
 "sweep": {"type": "object", "required": ["id", "cases", "shard"], "additionalProperties": false, "properties": {
  "id": {"type": "string"}, "cases": {"type": "integer", "minimum": 0},
  "shard": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "integer", "minimum": 1}}},
  "description": "Of which sweep the rows are, and which part of it: [K, N]."},
 "rows": {"type": "array", "items": {"$ref": "#/$defs/row"}}},
"$defs": {"row": {"type": "object", "additionalProperties": false, "required": )";

bool is_no_number(const ordered_json& value) { return value.is_number_float() && !std::isfinite(value.get<double>()); }

/// JSON has no word for such numbers: a file leaves them out, and `finite` says that something is not.
ordered_json with_finite_numbers(const ordered_json& object) {
  ordered_json kept = ordered_json::object();
  for (const auto& [key, value] : object.items())
    if (!is_no_number(value)) kept[key] = value.is_object() ? with_finite_numbers(value) : value;
  return kept;
}

}  // namespace

ordered_json row_json(const Row& row) {
  ordered_json object;
  for (const Field& one : fields())
    if (ordered_json value = one.written(row); !value.is_null()) object[one.key] = std::move(value);
  return object;
}

Row row_of(const ordered_json& object) {
  static const std::map<std::string, const Field*> by_key = [] {
    std::map<std::string, const Field*> all;
    for (const Field& one : fields()) all.emplace(one.key, &one);
    return all;
  }();
  Row row;
  row.commit.clear();
  for (const auto& [key, value] : object.items()) by_key.at(key)->read(value, row);
  return row;
}

ordered_json rows_header(const Environment& environment) {
  ordered_json header{{"paperproof_rows", 1}};
  for (const auto& [name, value] : environment) header["environment"][name] = value;
  return header;
}

ordered_json rows_json(const std::vector<Row>& rows, const Environment& environment) {
  ordered_json file = rows_header(environment);
  file["rows"] = ordered_json::array();
  for (const Row& row : rows) file["rows"].push_back(with_finite_numbers(row_json(row)));
  return file;
}

std::string json_line(const ordered_json& object) {
  return with_finite_numbers(object).dump(-1, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string rows_schema_text() {
  std::vector<std::string> keys;
  std::string properties;
  for (const Field& one : fields()) {
    if (one.required) keys.push_back(one.key);
    properties += fmt::format("{} \"{}\": {}", properties.empty() ? "\n" : ",\n", one.key, one.schema.dump());
  }
  return fmt::format("{}{}, \"properties\": {{{}}}}}}}}}\n", schema_of_files, ordered_json(keys).dump(), properties);
}

const Schema& rows_schema() {
  static const Schema schema(rows_schema_text());
  return schema;
}

}  // namespace paperproof::compare
