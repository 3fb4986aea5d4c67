/// All scenes in one table: what became of each contender.
#pragma once

#include "records/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One line per contender, in the order in which they first appear, and a last line that says what the columns are. A
/// column whose metric no row has is left out.
[[nodiscard]] std::string summary_table(const std::vector<Row>& rows);

}  // namespace paperproof::compare
