/// A scene in one screen: what happens to each contender, in plain words, and what a step costs.
#pragma once

#include "records/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// "through", "ends inside", "hangs", "stopped at 0.600", "meets nothing", "cannot run" or "failed"; with the step
/// where it is not the first one.
[[nodiscard]] std::string outcome_of(const Row& row);

/// What exact arithmetic has as the first impact, in one sentence; empty where no run has any.
[[nodiscard]] std::string exact_answer(const std::vector<Row>& rows);

/// One line per row under a heading: contender, outcome, nanoseconds per step.
[[nodiscard]] std::string headline(const std::vector<Row>& rows);

}  // namespace paperproof::compare
