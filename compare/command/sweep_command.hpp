/// `paperproof sweep`: many Cases, on many cores and machines.
#pragma once

#include "studies/sweep.hpp"

#include "command/page_outputs.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

struct SweepArguments {
  std::string scene;
  std::vector<std::string> vary;   ///< As typed.
  std::vector<std::string> set;    ///< The same.
  std::vector<std::string> knobs;  ///< The same.
  std::vector<std::string> contenders;
  std::vector<std::string> scalars;
  std::optional<std::string> border;
  std::optional<std::uint64_t> seed;
  std::optional<int> steps;
  bool reference = true;
  std::string rows_path;  ///< Empty: none.
  PagePaths pages;
  std::string log_path;  ///< Of the progress; the same.
  int jobs = 0;          ///< 0: one for each core.
  int limit_s = 60;      ///< Of one case.
  std::string shard;     ///< `K/N`; empty: all.
  bool resume = false;
  bool quiet = false;
};

/// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee or a case failed.
/// @throws InputError before any output file is touched; std::runtime_error if one cannot be written.
int sweep_command(const SweepArguments& arguments);

}  // namespace paperproof::compare
