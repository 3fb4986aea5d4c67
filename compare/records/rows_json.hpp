/// Rows as JSON: `"paperproof_rows": 1`.
#pragma once

#include "records/row.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Versions, compiler, flags, processor, build: (name, value) in the order in which they are shown.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// What does not apply is absent.
[[nodiscard]] nlohmann::ordered_json row_json(const Row& row);

/// What stands before the rows of a file, and is the first line of JSON Lines.
[[nodiscard]] nlohmann::ordered_json rows_header(const Environment& environment);

/// The rows with their header. As in `json_line`, numbers that are not finite are left out.
[[nodiscard]] nlohmann::ordered_json rows_json(const std::vector<Row>& rows, const Environment& environment);

/// Whether octagon_sweep in double broke its guarantee. @param row one of `row_json`.
[[nodiscard]] bool breaks_guarantee(const nlohmann::ordered_json& row);

/// On one line, with its line feed. Numbers that are not finite are left out: JSON has no word for them.
[[nodiscard]] std::string json_line(const nlohmann::ordered_json& object);

}  // namespace paperproof::compare
