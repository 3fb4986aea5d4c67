/// `paperproof work-precision`, `paperproof stability`, `paperproof study scale` and `paperproof study disagreement`:
/// one question over a range, as numbers and as a picture.
///
/// All throw InputError for arguments that cannot be used, and std::runtime_error where an output cannot be written.
#pragma once

#include "command/page_output.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace paperproof::compare {

struct StudyArguments {
  std::vector<std::string> motions;     ///< Of `work-precision`; empty: all.
  std::vector<std::string> contenders;  ///< Empty: all; of `stability` octagon_sweep and Box2D.
  std::string rows_path;                ///< Empty: none.
  std::string report_path;              ///< Empty: none.
  std::string log_path;                 ///< Empty: none.
  int jobs = 0;                         ///< Not of `work-precision`; 0: one for each core.
  std::string grid = "quick";           ///< Of `stability`: quick, standard or full.
  bool quiet = false;                   ///< No table, no progress.
};

/// Error against run time. Refuses a build with assertions, which take time of their own.
/// @return the exit status: 0, or 1 if a run failed.
int work_precision_command(const StudyArguments& arguments);

/// Stiff and extreme cases.
/// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee.
int stability_command(const StudyArguments& arguments);

struct DisagreementArguments {
  std::vector<std::string> scenes;  ///< Empty: every registered one.
  std::string rows_path;            ///< Empty: none.
  std::string report_path;          ///< Empty: none.
  std::string log_path;             ///< Empty: none.
  int jobs = 0;                     ///< 0: one for each core.
  bool quiet = false;               ///< No table, no progress.
};

/// Every event on which octagon_sweep and Box2D differ, with its cause, in free runs and in lockstep.
/// @return the exit status: 0, or 1 if an event is an error of ours, or a run failed.
int study_disagreement_command(const DisagreementArguments& arguments);

struct ScaleArguments {
  std::vector<std::size_t> grid{100, 1'000, 10'000, 100'000, 1'000'000};  ///< Numbers of pieces.
  std::string rows_path;                                                  ///< Empty: none.
  std::string report_path;                                                ///< Empty: none.
  bool quiet = false;                                                     ///< No table, no progress.
};

/// The cost of a step against the number of pieces, for each broad phase.
/// @return the exit status: 0, or 1 if two broad phases moved the character differently.
/// @throws std::invalid_argument for a grid that cannot be.
int study_scale_command(const ScaleArguments& arguments);

}  // namespace paperproof::compare
