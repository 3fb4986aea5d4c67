/// `paperproof sweep` and the prepared studies: many Cases, on many cores and machines.
#pragma once

#include "command/study_run.hpp"
#include "studies/prepared_studies.hpp"

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

/// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee or a case failed.
/// @throws InputError before any output file is touched; std::runtime_error if one cannot be written.
int sweep_command(const SweepArguments& arguments);

struct PreparedArguments {
  RunArguments run;
  CaseArguments cases;
  std::string grid = "quick";
};
/// `study corner`, `study seam`, `study squeeze`. As `sweep_command`.
int study_prepared_command(const PreparedStudy& study, const PreparedArguments& arguments);

/// `study bullet`: rates of tunnelling over grids, and the lowest speeds beside theory. As `sweep_command`.
int study_bullet_command(const PreparedArguments& arguments);

/// Turns the knobs and takes the number types that the options ask for, in every part; leaves contenders out that they
/// do not name. @throws InputError where they name what there is not.
void apply(const CaseArguments& arguments, std::vector<StudyPart>& parts);

}  // namespace paperproof::compare
