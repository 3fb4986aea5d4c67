/// `paperproof work-precision`, `paperproof stability` and `paperproof study bullet`.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

struct PrecisionArguments {
  std::vector<std::string> motions;     ///< Of `work-precision`; empty: all.
  std::vector<std::string> contenders;  ///< Empty: all; of `stability` octagon_sweep and Box2D.
  std::string rows_path;                ///< Empty: none.
  std::string report_path;              ///< The same.
  int jobs = 0;                         ///< Not of `work-precision`; 0: one for each core.
  std::string grid = "quick";           ///< Of `study bullet`: quick, standard or full.
  bool quiet = false;
};

/// @return the exit status: 0, or 1 if a run failed.
/// @throws InputError for what there is not, and in a build with assertions: its times mean nothing.
int work_precision_command(const PrecisionArguments& arguments);

/// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee.
int stability_command(const PrecisionArguments& arguments);

/// Who gets through paper: rates over a grid, and the lowest speeds beside theory.
/// @return the exit status: 0, or 1 if octagon_sweep in double got through.
int study_bullet_command(const PrecisionArguments& arguments);

}  // namespace paperproof::compare
