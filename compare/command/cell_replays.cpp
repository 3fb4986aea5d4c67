#include "command/cell_replays.hpp"

#include "records/case.hpp"
#include "report/cell_replay.hpp"
#include "runs/run_case.hpp"
#include "studies/processes.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {
namespace {

/// Steps before and after the one that matters.
constexpr int steps_around = 4;
/// Of all replays of a page, in equal shares for its maps [bytes]. Large: a page that opens slowly.
constexpr std::size_t most_bytes = 4'000'000;
constexpr std::chrono::seconds longest_case{20};

/// Empty: there is none.
std::string replay_of(const ChartGrid::Cell& cell) {
  const std::optional<Case> one = case_of_command(cell.command);
  if (!one || one->mode != "free") return "";
  const ReportScene excerpt = excerpt_of(*one, steps_around);
  const bool through = excerpt.rows.front().tunnels.value_or(0) > 0;
  return excerpt.runs.empty() || through != cell.through ? "" : cell_replay_json(excerpt);
}

}  // namespace

void add_cell_replays(ChartPage& page, int jobs) {
  std::vector<std::pair<std::size_t, ChartGrid::Cell*>> chosen;  // with the map
  for (std::size_t map = 0; map < page.grids.size(); ++map)
    for (ChartGrid::Cell* cell : cells_to_replay(page.grids[map])) chosen.emplace_back(map, cell);
  std::vector<std::size_t> bytes(page.grids.size());
  Jobs all;
  all.count = chosen.size();
  all.run = [&](std::size_t job) { return replay_of(*chosen[job].second); };
  all.lost = [](std::size_t, const std::string&) { return std::string(); };
  all.take = [&](std::size_t job, const std::string& replay) {
    const auto [map, cell] = chosen[job];
    if (replay.empty() || bytes[map] + replay.size() > most_bytes / page.grids.size()) return;
    bytes[map] += replay.size();
    cell->replay = page.replays.size();
    page.replays.push_back(replay);
  };
  run_in_processes(all, {processes_for(jobs), longest_case});
}

}  // namespace paperproof::compare
