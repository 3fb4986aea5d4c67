/// Replays of the Cases behind the cells of heat maps.
#pragma once

#include "report/chart_page.hpp"

namespace paperproof::compare {

/// Runs the Case of a cell again, in child processes, and gives the page a short replay of it: see `cells_to_replay`.
/// A case gets none if it cannot run here, or if the new run disagrees with its row about passing a solid.
/// @param jobs processes; 0: one for each core.
void add_cell_replays(ChartPage& page, int jobs);

}  // namespace paperproof::compare
