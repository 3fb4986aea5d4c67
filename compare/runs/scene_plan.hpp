/// The plan of a scene: what its controller leaves out, and which metrics apply.
#pragma once

#include "metrics/measured.hpp"
#include "runs/knobs.hpp"
#include "scenes/scene.hpp"

#include <paperproof/plan.hpp>

#include <span>
#include <string>
#include <vector>

namespace paperproof::compare {

/// How the runs of a scene are planned.
struct Planning {
  bool full = false;                     ///< Nothing is left out, whatever the scene can need.
  Foreseen foreseen{};                   ///< From the scene's gravity and the input of the run.
  std::span<const KnobSetting> knobs{};  ///< Turned, of the techniques that have them.
};

/// What gravity and input of a scene say about every step.
[[nodiscard]] Foreseen foreseen_in(const Scene& scene, const Script& script);

/// The controller's plan, or with `Planning::full` one that omits nothing and finds pieces with a tree.
template <class Scalar>
[[nodiscard]] Plan plan_of(const Scenery<Scalar>& scenery, const Planning& planning);

struct MetricPlan {
  Measured measured;
  std::vector<MetricOmission> omitted;  ///< Those, and what has no cause in the scene.
};
[[nodiscard]] MetricPlan metrics_for(const Scene& scene, const Planning& planning);

/// Several lines for `paperproof plan`: broad phase, stages and metrics that are left out, each with its reason.
[[nodiscard]] std::string describe_plan(const Scene& scene, const Script& script);

}  // namespace paperproof::compare
