/// `paperproof campaign` and `paperproof replay`: random runs, judged by every clause of the guarantee.
#pragma once

#include "campaign/campaign.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace paperproof::compare {

struct CampaignArguments {
  std::vector<std::string> families;  ///< `movers/tiles`, or `movers` for all of them. Empty: every family.
  int steps = 2000;                   ///< Of a family; slow ones take a share.
  RunSettings settings;
};

/// Prints a table for each kind of runs: steps, what happened in what share of them, and which clauses were broken;
/// then a line for each run that broke one.
/// @return 1 where a family does not cover what it must, or a run could not be made; else 0, whatever was broken.
/// @throws InputError where there is no such family.
int campaign_command(const CampaignArguments& arguments);

struct ReplayArguments {
  std::string family;
  std::uint64_t seed = 0;
  RunSettings settings;
  std::string scene_path;  ///< Where the scene goes as JSON; empty: nowhere.
};

/// Repeats one run of a family, and prints what it breaks.
/// @return 1 where it breaks a clause that its contender promises, else 0. @throws InputError as `campaign_command`.
int replay_command(const ReplayArguments& arguments);

}  // namespace paperproof::compare
