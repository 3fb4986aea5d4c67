/// What differs between the sides by their nature, and touches the numbers of a comparison.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

/// A heading, then a line for each difference: what, octagon_sweep, the article's techniques, Box2D. Sizes and numbers
/// of iterations are those of this build; one that a knob turns in a run stands in its row.
[[nodiscard]] std::vector<std::vector<std::string>> fairness_table();

}  // namespace paperproof::compare
