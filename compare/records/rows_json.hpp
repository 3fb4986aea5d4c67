/// Rows as JSON, both ways: `"paperproof_rows": 1`. What a row has is said once, in the table of rows_json.cpp and, of
/// its numbers, in metric_table.hpp; the schema comes of the same tables.
#pragma once

#include "records/row.hpp"
#include "records/schema.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Versions, compiler, flags, processor, build: (name, value) in the order in which they are shown.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// What does not apply is absent.
[[nodiscard]] nlohmann::ordered_json row_json(const Row& row);

/// The inverse, as far as a file goes: it has no faults and no words of a tunnel, for example.
/// @param object what holds to the schema.
[[nodiscard]] Row row_of(const nlohmann::ordered_json& object);

/// What stands before the rows of a file, and is the first line of JSON Lines.
[[nodiscard]] nlohmann::ordered_json rows_header(const Environment& environment);

/// The rows with their header. As in `json_line`, numbers that are not finite are left out.
[[nodiscard]] nlohmann::ordered_json rows_json(const std::vector<Row>& rows, const Environment& environment);

/// On one line, with its line feed. Numbers that are not finite are left out: JSON has no word for them.
[[nodiscard]] std::string json_line(const nlohmann::ordered_json& object);

/// As it ships: `paperproof_rows.schema.json` is what `paperproof list schema` prints.
[[nodiscard]] std::string rows_schema_text();
[[nodiscard]] const Schema& rows_schema();

}  // namespace paperproof::compare
