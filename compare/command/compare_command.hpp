/// `paperproof compare`: run scenes, print tables, write rows, traces and the report.
#pragma once

#include "runs/run.hpp"
#include "scenes/parameters.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

struct CompareArguments {
  std::vector<std::string> scenes;         ///< Built-in names or files.
  std::vector<ParameterSetting> settings;  ///< Parameters that are turned, of each scene.
  RunOptions run;
  std::string files_from;   ///< A file with more names, or "-" for standard input; empty: none.
  bool keep_going = false;  ///< An input that cannot be used is a row, and the others run.
  std::string rows_path;    ///< Empty: none.
  std::string report_path;  ///< Empty: none.
  std::string strip_path;   ///< A drawing of the runs of one scene; empty: none.
  bool all_tables = false;  ///< Of every scene, where there are several.
  bool explain = false;     ///< What each contender is excused, after the results.
  bool quiet = false;       ///< No table, no progress.
  bool json = false;        ///< Rows on standard output instead of tables.
};

/// Parses `random:SEED`.
/// @throws InputError
[[nodiscard]] std::uint64_t parse_random_input(const std::string& text);

/// @param contenders that are asked for; none: all.
/// @throws InputError for what is no knob, no value of it, a knob of none of the contenders, or one turned twice.
[[nodiscard]] std::vector<KnobSetting> parse_knobs(const std::vector<std::string>& texts,
                                                   const std::vector<std::string>& contenders);

/// @param asked the option, or the command, that the names stand behind.
/// @throws InputError naming the contender and those there are.
void check_contenders(const std::vector<std::string>& names, std::string_view asked = "--contender");

/// @return the exit status: 0; 1 if octagon_sweep in double broke its guarantee or a contender failed; else 2 if an
///   input could not be used (`keep_going`).
/// @throws InputError before any output file is touched; std::runtime_error if one cannot be written.
int compare_scenes(CompareArguments arguments);

}  // namespace paperproof::compare
