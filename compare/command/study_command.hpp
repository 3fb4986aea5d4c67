/// The commands that put one question over a range of cases, and show numbers and a picture: `sweep`, `stability`,
/// `study` and `work-precision`.
///
/// Their exit status is 0, or 1 if octagon_sweep in double broke its guarantee or a case failed. All throw InputError
/// for arguments that cannot be used, before any output file is touched, and std::runtime_error where an output cannot
/// be written.
#pragma once

#include "command/study_run.hpp"
#include "studies/prepared_studies.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What the options say of the cases, as typed.
struct CaseArguments {
  std::vector<std::string> contenders;
  std::vector<std::string> scalars;
  std::vector<std::string> knobs;
};

struct SweepArguments {
  RunArguments run;
  CaseArguments cases;
  std::string scene;
  std::vector<std::string> vary;      ///< As typed.
  std::vector<std::string> set;       ///< The same.
  std::optional<std::string> border;  ///< The same.
  std::optional<std::uint64_t> seed;
  std::optional<int> steps;
  bool reference = true;
};
int sweep_command(const SweepArguments& arguments);

struct StudyArguments {
  RunArguments run;
  CaseArguments cases;
  std::string grid;
};
int study_command(const PreparedStudy& study, const StudyArguments& arguments);

struct DisagreementArguments {
  RunArguments run;
  std::vector<std::string> scenes;  ///< Empty: every registered one.
};
/// Every event on which octagon_sweep and Box2D differ, with its cause, in free runs and in lockstep. The status is 1,
/// too, where an event is an error of ours, or is left without a cause.
int study_disagreement_command(const DisagreementArguments& arguments);

struct ScaleArguments {
  RunArguments run;                                                       ///< Rows and pages alone.
  std::vector<std::size_t> grid{100, 1'000, 10'000, 100'000, 1'000'000};  ///< Numbers of pieces.
};
/// The cost of a step against the number of pieces, for each broad phase. The status is 1 if two of them moved the
/// character differently.
/// @throws std::invalid_argument for a grid that cannot be.
int study_scale_command(const ScaleArguments& arguments);

struct PrecisionArguments {
  RunArguments run;                     ///< Rows and pages alone.
  std::vector<std::string> motions;     ///< Empty: all.
  std::vector<std::string> contenders;  ///< The same.
};
/// Error against run time. Refuses a build with assertions, which take time of their own.
int work_precision_command(const PrecisionArguments& arguments);

}  // namespace paperproof::compare
