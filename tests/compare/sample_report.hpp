/// A small report made by hand: what the tests and the browser check look at.
#pragma once

#include "report/report.hpp"

namespace paperproof::compare {

/// Three scenes: a bullet through paper (0), a walk over tiles with a slope, a hole and one-way ledges (1), and one
/// whose texts try to break out of the page and whose runs disagree (2).
[[nodiscard]] Report sample_report();

/// What scene 2 is called, and its collider.
[[nodiscard]] std::string hostile_text();

}  // namespace paperproof::compare
