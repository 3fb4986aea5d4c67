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
constexpr std::chrono::seconds longest_case{60};

/// Adds the run of another contender on the same case, over the same steps.
void add_beside(Case one, const std::string& contender, ReportScene& excerpt) {
  if (one.contender == contender || excerpt.runs.empty() || excerpt.runs.front().steps.empty()) return;
  const std::vector<TraceStep>& steps = excerpt.runs.front().steps;
  one.contender = contender;
  one.peer.clear();
  ReportScene other = excerpt_of(one, steps_around, steps[steps.size() / 2].step);
  for (ReportRun& run : other.runs) excerpt.runs.push_back(std::move(run));
}

/// Empty: there is none.
std::string replay_of(const ChartGrid::Cell& cell, const std::string& beside) {
  const std::optional<Case> one = case_of_command(cell.command);
  if (!one || one->mode != "free") return "";
  ReportScene excerpt = excerpt_of(*one, steps_around);
  if (!beside.empty()) add_beside(*one, beside, excerpt);
  const bool through = excerpt.rows.front().tunnels.value_or(0) > 0;
  return excerpt.runs.empty() || through != cell.through ? "" : cell_replay_json(excerpt);
}

/// A table has the replays of all of its cells.
std::size_t most_of(const ChartGrid& grid) {
  return grid.beside.empty() ? most_replays_of_map : grid.xs.size() * grid.ys.size();
}

}  // namespace

void add_cell_replays(ChartPage& page, int jobs) {
  std::vector<std::pair<std::size_t, ChartGrid::Cell*>> chosen;  // with the map
  for (std::size_t map = 0; map < page.grids.size(); ++map)
    for (ChartGrid::Cell* cell : cells_to_replay(page.grids[map], most_of(page.grids[map])))
      chosen.emplace_back(map, cell);
  std::vector<std::size_t> bytes(page.grids.size());
  Jobs all;
  all.count = chosen.size();
  all.run = [&](std::size_t job) {
    const auto [map, cell] = chosen[job];
    return replay_of(*cell, page.grids[map].beside);
  };
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
