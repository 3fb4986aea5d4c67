/// What a terminal shows of rows: a scene as a table or in plain words, and all scenes together.
#pragma once

#include "records/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One line per row under a heading: the columns that matter first; those that no row has are left out. "prec. recall"
/// is against exact arithmetic, "since" the first step on which a contender and Box2D differ, "ns/step"
/// minimum..median.
[[nodiscard]] std::string table(const std::vector<Row>& rows);

/// "through", "ends inside", "hangs", "stopped at 0.600", "meets nothing", "cannot run" or "failed"; with the step
/// where it is not the first one.
[[nodiscard]] std::string outcome_of(const Row& row);

/// What exact arithmetic has as the first impact, in one sentence; empty where no run has any.
[[nodiscard]] std::string exact_answer(const std::vector<Row>& rows);

/// One line per row under a heading: contender, outcome, nanoseconds per step.
[[nodiscard]] std::string headline(const std::vector<Row>& rows);

/// One line per contender, in the order in which they first appear, and a last line that says what the columns are. A
/// column whose metric no row has is left out.
[[nodiscard]] std::string summary_table(const std::vector<Row>& rows);

/// The sentence under a table: who is right where the contenders differ.
[[nodiscard]] std::string who_is_right(const std::vector<Row>& rows);

}  // namespace paperproof::compare
