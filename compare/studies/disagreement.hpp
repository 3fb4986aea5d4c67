/// The ledger of disagreement over many scenes: where octagon_sweep and Box2D differ, and why.
#pragma once

#include "records/row.hpp"
#include "studies/sweep.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// One run of a scene, free or in lockstep, with a ledger.
struct DisagreementCase {
  std::string scene;      ///< As it was asked for.
  std::size_t index = 0;  ///< Of the scenes that this name gives.
  bool lockstep = false;
};

/// Every built-in scene and every family.
[[nodiscard]] std::vector<std::string> registered_scenes();

/// Each scene that the names give, free and in lockstep.
/// @throws InputError where one cannot be used.
[[nodiscard]] std::vector<DisagreementCase> disagreement_cases(const std::vector<std::string>& names);

/// The row of octagon_sweep, with its ledger. What goes wrong is a row that says so.
[[nodiscard]] Row run_disagreement(const DisagreementCase& one);

/// The cases as a study runs them. @param all is to live as long.
[[nodiscard]] StudyCases cases_of(const std::vector<DisagreementCase>& all);

/// What the study must not find, over all its runs.
struct Leftovers {
  int unexplained = 0;
  int remaining_lockstep = 0;
  int errors_of_ours = 0;
  int failed_runs = 0;

  [[nodiscard]] bool any() const { return unexplained + remaining_lockstep + errors_of_ours + failed_runs > 0; }
};
/// In one line, zeros included: `holds: …` or `fails: …`.
[[nodiscard]] std::string words_of(const Leftovers& found);

/// What shows a step in the report: `paperproof compare SCENE --contender octagon_sweep --mode lockstep …`.
[[nodiscard]] std::string replay_command(std::string_view scene, std::string_view mode, int step);

}  // namespace paperproof::compare
