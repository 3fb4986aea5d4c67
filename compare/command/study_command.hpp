/// `paperproof study`: one question over a range, as numbers and as a picture.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace paperproof::compare {

struct StudyArguments {
  std::vector<std::size_t> grid{100, 1'000, 10'000, 100'000, 1'000'000};  ///< Numbers of pieces.
  std::string rows_path;                                                  ///< Empty: none.
  std::string report_path;                                                ///< Empty: none.
  bool quiet = false;                                                     ///< No table, no progress.
};

/// `study scale`: the cost of a step against the number of pieces, for each broad phase.
/// @return the exit status: 0, or 1 if two broad phases moved the character differently.
/// @throws std::invalid_argument for a grid that cannot be; InputError for one file that is to be two;
///   std::runtime_error if an output cannot be written.
int study_scale_command(const StudyArguments& arguments);

}  // namespace paperproof::compare
