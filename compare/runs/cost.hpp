/// What a step costs, measured apart from everything that is judged.
#pragma once

#include "runs/contender.hpp"

#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

struct Cost {
  double ns_per_step_min = 0;  ///< Of the repeats; the least disturbed one.
  double ns_per_step_median = 0;
  double ns_per_step_max = 0;  ///< The spread.
};

/// A character was put back to where the scene has it begin, before a step.
struct Respawn {
  int step = 0;
  std::size_t character = 0;
};

struct TimedRun {
  Contender* contender = nullptr;
  std::span<const Respawn> respawns;  ///< Of the run that was judged, ascending: they are repeated, and not timed.
  std::optional<int> step{};          ///< To be timed alone as well: one of the first 120, before any respawn.
};

/// Of one step, the least of the repeats [ns]. The time that reading the clock takes is taken off.
struct StepCost {
  double warm = 0;  ///< After the steps before it.
  double cold = 0;  ///< After 4 MB of other memory were written as well: it finds nothing in the caches of its core.
};

struct Costs {
  Cost full;
  std::optional<Cost> bare;      ///< Of an engine alone: see `Contender::step_bare`.
  std::optional<StepCost> step;  ///< Of an engine alone, too, where it can be timed so.
};

/// Of all characters together. Each runs the same steps from the start, at most 1,000 of them: once untimed, as a
/// warm-up, then 9 times. They take turns, so that whatever else the machine does disturbs all of them alike.
/// @return one for each run. Not for tests: machines are shared.
[[nodiscard]] std::vector<Costs> measure_costs(std::span<const TimedRun> runs, const Scene& scene, const Script& script,
                                               int steps);

}  // namespace paperproof::compare
