/// Cells of heat maps that can be replayed.
#pragma once

#include "records/scene_result.hpp"
#include "report/chart_page.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// Replays of one heat map. Many: a large page, whose cases take long to run again.
inline constexpr std::size_t most_replays_of_map = 100;

/// Whose case a page replays, in the order of their worth: on both sides of the border between cells where none is bad
/// and cells where some are, then of the others those with a bad case, then the rest; of those that are too many some,
/// spread evenly.
[[nodiscard]] std::vector<ChartGrid::Cell*> cells_to_replay(ChartGrid& grid, std::size_t most = most_replays_of_map);

/// `{"parameters":[["speed [m/s]","40"],…],"replay":…}`: see `replay_json`.
[[nodiscard]] std::string cell_replay_json(const ReportScene& excerpt);

}  // namespace paperproof::compare
