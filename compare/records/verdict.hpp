/// How the four axes of a result become one word and one reason.
#pragma once

#include "records/row.hpp"

namespace paperproof::compare {

/// Adds that a run fell short. `settle` turns all of these into verdict and reason.
void add_fault(Row& row, Axis axis, Verdict verdict, std::string words);

/// The verdict is the worst of the faults: failed, not_applicable, violates, tunnels, flagged; without any it holds.
/// The reason names every axis at fault, as in "safety: 1 step through a solid; progress: hangs on 20 steps". May be
/// called again after more were added. A run that was not made at all keeps what it says.
void settle(Row& row);

/// Whether the reason names an axis at fault: also of a row that was read from a file.
[[nodiscard]] bool falls_short(const Row& row, Axis axis);

}  // namespace paperproof::compare
