/// `paperproof compare`: run scenes, print tables, write rows, traces and the report.
#pragma once

#include "runs/run.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

struct CompareArguments {
  std::vector<std::string> scenes;  ///< Built-in names or files.
  RunOptions run;
  std::string rows_path;    ///< Empty: none.
  std::string report_path;  ///< Empty: none.
  bool quiet = false;       ///< No table, no progress.
  bool json = false;        ///< Rows on standard output instead of tables.
};

/// Parses `random:SEED`.
/// @throws InputError
[[nodiscard]] std::uint64_t parse_random_input(const std::string& text);

/// @throws InputError naming the contender and those there are.
void check_contenders(const std::vector<std::string>& names);

/// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee or a contender failed.
/// @throws InputError before any output file is touched; std::runtime_error if one cannot be written.
int compare_scenes(CompareArguments arguments);

}  // namespace paperproof::compare
