#include "records/schema.hpp"

#include "compare/table.hpp"
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

const bool table = table_tests("schema.json", " schema value says ", [](const Json& row) {
  EXPECT_EQ(quoted(Schema(row["schema"].dump()).fault(row["value"]).value_or("")), quoted(row["says"]));
});

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

/// row_of_everything.json has every key but those of most numbers, with a value that is not the usual one.
TEST(RowsJson, a_row_that_is_read_back_is_written_alike) {
  const std::string path = PAPERPROOF_SOURCE_DIR "/tests/compare/row_of_everything.json";
  const ordered_json row = strict_json(read_file(path, path), path);
  EXPECT_EQ(rows_schema().fault(row, "row"), std::nullopt);
  EXPECT_EQ(row_json(row_of(row)), row);
  const auto asked = ordered_json::parse(rows_schema_text())["$defs"]["row"]["properties"];
  for (const auto& [key, schema] : asked.items())
    EXPECT_TRUE(row.contains(key) || find_metric(key) != nullptr) << key << " is not asked for here";
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
