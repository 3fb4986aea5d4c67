/// What a step costs, measured apart from everything that is judged.
#pragma once

#include "runs/contestant.hpp"

namespace paperproof::compare {

struct Cost {
  double ns_per_step_min = 0;  ///< Of the repeats; the least disturbed one.
  double ns_per_step_median = 0;
  double ns_per_step_max = 0;  ///< The spread.
};

/// Of all characters together. One untimed warm-up, then 9 timed runs of the same steps from the start, of which
/// minimum, median and maximum are returned. Not for tests: machines are shared.
[[nodiscard]] Cost measure_cost(Contestant& contestant, const Scene& scene, const Script& script, int steps);

}  // namespace paperproof::compare
