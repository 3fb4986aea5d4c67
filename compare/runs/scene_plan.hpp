/// The plan of a scene: what its level has no need of, what that saves, and which metrics apply.
#pragma once

#include "metrics/measured.hpp"
#include "records/trace.hpp"
#include "runs/knobs.hpp"
#include "scenes/scene.hpp"

#include <span>
#include <string>
#include <vector>

namespace paperproof::compare {

/// How the runs of a scene are planned.
struct Planning {
  bool full = false;                     ///< Nothing is left out: see `PieceSearch::none`.
  std::span<const KnobSetting> knobs{};  ///< Turned, of the techniques that have them.
};

/// What the level has no need of, in the order of a step. It follows from the colliders alone.
[[nodiscard]] LevelPlan plan_of(const Scenery& scenery, const Planning& planning);

struct MetricPlan {
  Measured measured;
  std::vector<Omission> omitted;  ///< Those, and what has no cause in the scene.
};
[[nodiscard]] MetricPlan metrics_for(const Scene& scene, const Planning& planning);

/// Several lines for `paperproof plan`: what the level has no need of, why that is safe, and which metrics the scene
/// does not need. Nothing is measured.
[[nodiscard]] std::string describe_plan(const Scene& scene, const Scenery& scenery);

/// One line for `paperproof plan`: time of a step and memory of `octagon_sweep`, as planned and with nothing left out.
/// Both run the same steps, by turns: see `measure_costs`. Not for tests: machines are shared.
/// @throws std::logic_error where the two do not end at the same position.
[[nodiscard]] std::string describe_saving(const Scene& scene, const Scenery& scenery, const Script& script);

}  // namespace paperproof::compare
