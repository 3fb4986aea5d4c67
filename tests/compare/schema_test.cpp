#include "records/schema.hpp"

#include "records/metric.hpp"
#include "records/rows_json.hpp"
#include "records/strict_json.hpp"
#include "scenes/input_error.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* small_schema = R"({
  "type": "object", "required": ["name"], "additionalProperties": false,
  "properties": {
    "name": {"type": "string", "pattern": "^[a-z]+$"}, "kind": {"enum": ["one", "two"]}, "version": {"const": 1},
    "count": {"type": "integer", "minimum": 0}, "length": {"type": "number"}, "sure": {"type": "boolean"},
    "pair": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"$ref": "#/$defs/inner"}},
    "share": {"type": ["number", "string"], "exclusiveMinimum": 0, "maximum": 1, "title": "a word", "minLength": 2},
    "plain": {"title": "a text of letters", "type": "string", "not": {"pattern": "[^a-z]"}},
    "set": {"type": "array", "minItems": 1, "uniqueItems": true}, "most": {"maximum": 3},
    "shape": {"type": "object", "oneOf": [{"$ref": "#/$defs/disc"}, {"required": ["box"]}]},
    "free": {"type": "object"}, "counts": {"type": "object", "additionalProperties": {"$ref": "#/$defs/count"}}
  },
  "$defs": {"disc": {"required": ["disc"], "dependentRequired": {"hole": ["rim"]}},
            "inner": {"type": "object", "properties": {"x": {"type": "number"}}, "additionalProperties": false},
            "count": {"type": "integer", "minimum": 0}}
})";

std::string fault(const std::string& text) {
  return Schema(small_schema).fault(ordered_json::parse(text)).value_or("");
}

TEST(Schema, names_the_place_of_what_does_not) {
  EXPECT_EQ(fault("[]"), "/: expected an object, not []");
  EXPECT_EQ(fault("{}"), "/name: expected this key, which is missing");
  EXPECT_EQ(fault(R"({"name": 1})"), "/name: expected a text, not 1");
  EXPECT_EQ(fault(R"({"name": "A"})"), "/name: expected a text like ^[a-z]+$, not \"A\"");
  EXPECT_EQ(fault(R"({"name": "a", "kind": "three"})"), "/kind: expected one or two, not \"three\"");
  EXPECT_EQ(fault(R"({"name": "a", "version": 2})"), "/version: expected 1, not 2");
  EXPECT_EQ(fault(R"({"name": "a", "count": -1})"), "/count: expected 0 or more, not -1");
  EXPECT_EQ(fault(R"({"name": "a", "count": 1.5})"), "/count: expected a whole number, not 1.5");
  EXPECT_EQ(fault(R"({"name": "a", "count": 1e300})"), "/count: expected a whole number, not 1e+300");
  EXPECT_EQ(fault(R"({"name": "a", "length": null})"), "/length: expected a number, not null");
  EXPECT_EQ(fault(R"({"name": "a", "sure": "yes"})"), "/sure: expected true or false, not \"yes\"");
  EXPECT_EQ(fault(R"({"name": "a", "pair": [{}]})"), "/pair: expected 2 entries, not 1");
  EXPECT_EQ(fault(R"({"name": "a", "pair": [{}, {"x": "1"}]})"), "/pair/1/x: expected a number, not \"1\"");
  EXPECT_EQ(fault(R"({"name": "a", "pair": [{}, {"y": 1}]})"), "/pair/1/y: unknown key; expected one of x");
  EXPECT_EQ(fault(R"({"name": "a", "counts": {"a/b": -2}})"), "/counts/a~1b: expected 0 or more, not -2");
  EXPECT_EQ(fault(R"({"name": "a", "share": 0})"), "/share: expected more than 0, at most 1, not 0");
  EXPECT_EQ(fault(R"({"name": "a", "share": []})"), "/share: expected a number or a text, not []");
  EXPECT_EQ(fault(R"({"name": "a", "share": "b"})"), "/share: expected a word, not \"b\"");
  EXPECT_EQ(fault(R"({"name": "a", "plain": "a1"})"), "/plain: expected a text of letters, not \"a1\"");
  EXPECT_EQ(fault(R"({"name": "a", "set": []})"), "/set: expected 1 or more entries, not 0");
  EXPECT_EQ(fault(R"({"name": "a", "set": [1, 2, 1]})"), "/set/2: expected another entry than those before, not 1");
  EXPECT_EQ(fault(R"({"name": "a", "most": 4})"), "/most: expected at most 3, not 4");
  EXPECT_EQ(fault(R"({"name": "a", "shape": {}})"), "/shape: expected exactly one of disc, box; here is none");
  EXPECT_EQ(fault(R"({"name": "a", "shape": {"box": 1, "disc": 2}})"),
            "/shape: expected exactly one of disc, box; here are disc, box");
  EXPECT_EQ(fault(R"({"name": "a", "shape": {"disc": 1, "hole": 2}})"), "/shape/hole: expected only beside rim");
  EXPECT_EQ(fault(R"({"name": "a", "coumt": 2})"), "/coumt: unknown key; did you mean count?");
}

TEST(Schema, refuses_to_ask_less_than_it_says) {
  EXPECT_THROW(Schema(R"({"properties": {"a": {"multipleOf": 2}}})"), std::logic_error);
  EXPECT_THROW(Schema(R"({"$defs": {"a": {"type": "null"}}})"), std::logic_error);
  EXPECT_THROW(Schema(R"({"not": {"required": ["a"]}})"), std::logic_error);
  EXPECT_THROW(Schema(R"({"oneOf": [{"type": "string"}, {"type": "number"}]})"), std::logic_error);
}

TEST(Schema, a_row_whose_numbers_are_not_finite_holds_as_it_is_written) {
  Row row;
  row.finite = false;
  row.max_penetration_m = std::numeric_limits<double>::quiet_NaN();
  FirstTunnel& first = row.first_tunnel.emplace();
  first.step = 3;
  first.collider = "a";
  first.speed_m_s = std::numeric_limits<double>::infinity();
  const ordered_json read = strict_json(json_line(row_json(row)), "file");
  EXPECT_EQ(rows_schema().fault(read, "row"), std::nullopt);
  EXPECT_FALSE(read.contains("max_penetration_m"));
  EXPECT_FALSE(read["first_tunnel"].contains("speed_m_s"));
  EXPECT_EQ(read["first_tunnel"]["step"], 3);
}

TEST(RowsJson, the_schema_that_ships_is_that_of_the_table_of_rows) {
  EXPECT_EQ(read_file(ROWS_SCHEMA, "schema"), rows_schema_text()) << "`paperproof list schema` prints it";
}

TEST(RowsJson, a_row_that_is_read_back_is_written_alike) {
  Row row;
  row.scene = "paper";
  row.contender = "mask";
  row.scalar = "float";
  row.mode = "lockstep";
  row.steps = 7;
  row.verdict = Verdict::not_applicable;
  row.reason = row.knob = row.engine = row.border = row.curve = row.source = row.command = row.commit = row.worst =
      "text";
  row.machine = "native";
  row.case_id = row.event_sequence = "0123456789abcdef";
  row.swept = {"question", {"speed_m_s"}, Bad::tunnels};
  row.parameters = {{"speed_m_s", 0.1}, {"dt_s", 1e-3}};
  row.broken = {{"overlap", 2}};
  row.exempted = {{"reach", 3}};
  row.disagreements = {{"skin.contact", {4, 5, "words"}}};
  row.first_tunnel = {.step = 3, .collider = "a", .speed_m_s = 1, .thickness_m = 2, .angle_deg = 4, .words = {}};
  row.first_difference_box2d = "step 3";
  row.findings = {"one", "two"};
  row.finite = false;
  row.tunnels = 1;
  row.memory_bytes = 12;
  row.error_max_m = 0.1;
  const ordered_json written = row_json(row);
  EXPECT_EQ(rows_schema().fault(written, "row"), std::nullopt);
  EXPECT_EQ(row_json(row_of(written)), written);
  const auto asked = ordered_json::parse(rows_schema_text())["$defs"]["row"]["properties"];
  for (const auto& [key, schema] : asked.items())
    EXPECT_TRUE(written.contains(key) || find_metric(key) != nullptr) << key << " is not asked for here";
}

TEST(Metric, keys_are_unique_and_end_in_their_unit) {
  std::set<std::string_view> keys;
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(keys.insert(metric.key).second) << metric.key;
    EXPECT_EQ(metric.unit == "m" || metric.unit.starts_with("m,"), metric.key.ends_with("_m")) << metric.key;
    EXPECT_FALSE(metric.meaning.ends_with(".")) << metric.key;
  }
  EXPECT_EQ(find_metric("no_such_metric"), nullptr);
}

TEST(Metric, a_row_has_only_the_numbers_that_apply) {
  Row row;
  row.tunnels = 3;
  row.answer_ok = false;
  std::string seen;
  for (const Metric& metric : metrics())
    if (value_of(metric, row)) seen += std::string(metric.key) + " ";
  EXPECT_EQ(seen, "tunnels answer_ok ");
  EXPECT_EQ(value_of(*find_metric("tunnels"), row), 3.0);
  EXPECT_EQ(value_of(*find_metric("answer_ok"), row), 0.0);
  EXPECT_EQ(value_of(*find_metric("slope"), row), std::nullopt);
}

}  // namespace
}  // namespace paperproof::compare
