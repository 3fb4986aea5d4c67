/// Runs a random run and has it judged; runs a family, and counts what happened in it.
#pragma once

#include "campaign/families.hpp"
#include "campaign/happening.hpp"
#include "records/clause.hpp"
#include "runs/contender.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace paperproof::compare {

struct RunSettings {
  std::string contender = "octagon_sweep";
  ScalarKind scalar = ScalarKind::binary64;
  std::string trace_stem{};  ///< Empty: no trace is written.
};

/// What one run came to, or many.
struct Findings {
  int steps = 0;
  int records = 0;  ///< Of all characters.
  /// What steps broke of the guarantee. A launch continues no step: `continuity` is not asked for.
  Breaches breaches{};
  std::vector<int> happened = std::vector<int>(happenings().size());  ///< Records of each happening.
  int runs = 0;                                                       ///< Of a family.
  int left_out = 0;      ///< Of them those that would begin inside something, and must not.
  std::string failed{};  ///< Why the run could not be made; empty where it could.

  void add(const Findings& other);
};

/// The scene with a name, and one for each collider.
[[nodiscard]] Scene with_names(Scene scene, const std::string& name);

/// The input of a step, with gravity and up of the run in it.
[[nodiscard]] StepInput with_up(const RandomRun& run, int step, StepInput input);

/// @param name of the run in its trace. The run ends early where its character leaves it, where a step is refused, and
///   with the first step in which something crushes that goes more than 3 m in it.
/// @return no steps where the run would begin inside something, and must not.
[[nodiscard]] Findings run_and_judge(const RandomRun& run, const std::string& name, const RunSettings& settings = {});

/// Makes runs of a family, until its share of the steps is reached.
/// @param each is called with the seed of every run and what it came to.
[[nodiscard]] Findings run_family(const Family& family, int steps, const RunSettings& settings = {},
                                  const std::function<void(std::uint64_t, const Findings&)>& each = {});

/// A line for each clause that was broken. @param begin stands before each.
[[nodiscard]] std::string describe(const Breaches& breaches, const std::string& begin);

/// A sentence for each happening that is rarer or more frequent than its family says. Chance is allowed for.
[[nodiscard]] std::vector<std::string> uncovered(const Family& family, const Findings& findings);

}  // namespace paperproof::compare
