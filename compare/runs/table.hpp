/// Rows as a table for a terminal.
#pragma once

#include "runs/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One line per row under a heading; columns that no row has are left out.
[[nodiscard]] std::string table(const std::vector<Row>& rows);

}  // namespace paperproof::compare
