/// Runs the contenders of a scene side by side and judges every step.
#pragma once

#include "records/scene_result.hpp"
#include "runs/contender.hpp"
#include "scenes/scene.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

enum class Mode : std::uint8_t {
  free,      ///< Each side runs on its own from the same start.
  lockstep,  ///< Before each step the twin is put where the controller is; one step is compared.
};

struct RunOptions {
  std::vector<std::string> contenders;  ///< Empty: all of them.
  std::vector<ScalarKind> scalars{ScalarKind::binary64};
  Mode mode = Mode::free;
  std::optional<int> steps;  ///< Instead of the scene's.
  std::optional<std::uint64_t> random_input;
  std::vector<KnobSetting> knobs;  ///< Turned, of the techniques that have them.
  bool full_plan = false;          ///< Nothing is left out of the techniques, whatever the scene can need.
  bool reference = true;           ///< Run the Box2D twin beside the contenders.
  bool measure_cost = true;
  bool continuous = false;   ///< Rows say how far the run is from continuous motion, where the reference has a law.
  bool ledger = false;       ///< Attribute every event on which a contender and the twin differ to a cause.
  std::string trace_stem{};  ///< Empty: no traces.
  int max_replay_steps = 0;  ///< Kept per run for the report; 0: none.
  /// Called with 0 before the first step, and then now and then with the share of the steps that is done.
  std::function<void(double)> progress{};
};

/// The contenders that run, the reference among them where it is wanted.
[[nodiscard]] std::vector<std::string> contenders_of(const RunOptions& options);

/// One scene with everything that was found: a row per run, failures included, and the sentence that says who is right.
/// @throws std::runtime_error only where a trace cannot be written; what goes wrong inside a run is a row.
[[nodiscard]] ReportScene run_scene(const Scene& scene, const RunOptions& options);

}  // namespace paperproof::compare
