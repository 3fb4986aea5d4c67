/// Rows as JSON: `"paperproof_rows": 1`.
#pragma once

#include "runs/row.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Versions, compiler, flags, cpu and build of this executable, as name and value.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> environment();

/// One object per row; what does not apply is absent.
[[nodiscard]] nlohmann::ordered_json rows_json(const std::vector<Row>& rows);

}  // namespace paperproof::compare
