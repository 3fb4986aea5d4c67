/// `paperproof judge`: whether a run, as its trace has it, holds the guarantee.
#pragma once

#include "scenes/parameters.hpp"

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

struct JudgeOptions {
  std::vector<std::string> traces;
  /// Holds every trace against every clause, whatever its header promises.
  bool all_clauses = false;
  /// Scene that the traces are of: what it says stands instead of what their headers say. Empty: the headers are taken.
  std::string scene;
  std::vector<ParameterSetting> settings;  ///< Parameters of the scene that are turned, as they were in the run.
  std::optional<int> steps;                ///< Of the run, whatever scene and header say.
};

/// Prints a line for each trace, and one for each clause that was broken.
/// @return 1 where a clause is broken that the trace's contender promises (or `all_clauses` asks for), else 0.
/// @throws InputError for a file that is no trace, or none of the scene.
int judge_command(const JudgeOptions& options);

}  // namespace paperproof::compare
