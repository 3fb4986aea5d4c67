/// Rows as a table for a terminal.
#pragma once

#include "records/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One line per row under a heading: the columns that matter first; those that no row has are left out. "prec. recall"
/// is against exact arithmetic, "since" the first step on which a contender and Box2D differ, "ns/step"
/// minimum..median.
[[nodiscard]] std::string table(const std::vector<Row>& rows);

}  // namespace paperproof::compare
