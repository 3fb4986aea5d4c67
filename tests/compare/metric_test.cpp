#include "records/metric.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>
#include <string>

namespace paperproof::compare {
namespace {

nlohmann::json properties_of_rows() {
  std::ifstream file(ROWS_SCHEMA);
  return nlohmann::json::parse(file)["$defs"]["row"]["properties"];
}

std::string type_of(const Metric& metric) {
  if (std::holds_alternative<std::optional<bool> Row::*>(metric.field)) return "boolean";
  return std::holds_alternative<std::optional<double> Row::*>(metric.field) ? "number" : "integer";
}

TEST(Metric, the_schema_of_rows_says_what_the_descriptors_say) {
  const nlohmann::json properties = properties_of_rows();
  for (const Metric& metric : metrics()) {
    const std::string key(metric.key);
    ASSERT_TRUE(properties.contains(key)) << key;
    const std::string unit = metric.unit.empty() ? "" : " [" + std::string(metric.unit) + "]";
    EXPECT_EQ(properties[key]["description"], std::string(metric.meaning) + unit + ".") << key;
    EXPECT_EQ(properties[key]["type"], type_of(metric)) << key;
  }
}

TEST(Metric, every_number_in_the_schema_of_rows_is_described) {
  const nlohmann::json properties = properties_of_rows();
  for (const auto& [key, property] : properties.items()) {
    const std::string type = property.value("type", "");
    if (type == "string" || type == "object" || type == "array" || key == "steps") continue;
    EXPECT_NE(find_metric(key), nullptr) << key;
  }
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
  for_each_metric(row, [&](const Metric& metric, const auto&) { seen += std::string(metric.key) + " "; });
  EXPECT_EQ(seen, "tunnels answer_ok ");
  EXPECT_EQ(value_of(*find_metric("tunnels"), row), 3.0);
  EXPECT_EQ(value_of(*find_metric("answer_ok"), row), 0.0);
  EXPECT_EQ(value_of(*find_metric("slope"), row), std::nullopt);
}

TEST(Metric, costs_are_times_and_what_depends_on_them) {
  EXPECT_TRUE(is_cost("ns_per_step"));
  EXPECT_TRUE(is_cost("ns_per_step_bare"));
  EXPECT_TRUE(is_cost("on_front"));
  EXPECT_FALSE(is_cost("memory_bytes"));
  EXPECT_FALSE(is_cost("tunnels"));
}

}  // namespace
}  // namespace paperproof::compare
