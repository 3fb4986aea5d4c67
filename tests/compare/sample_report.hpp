/// A small report made by hand: what the tests and the browser check look at.
#pragma once

#include "report/report.hpp"

namespace paperproof::compare {

/// A bullet through paper (0), a walk over tiles with a slope, a hole and one-way ledges (1), one whose texts try to
/// break out of the page and whose runs disagree (2), a lift and a sensor (3), two characters (4), and steps of
/// different lengths with a drop (5).
[[nodiscard]] Report sample_report();

/// What scene 2 is called, and its collider.
[[nodiscard]] std::string hostile_text();

}  // namespace paperproof::compare
