#include "report/cell_replay.hpp"

#include "report/json_text.hpp"
#include "report/replay.hpp"
#include "report/row_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {

std::vector<ChartGrid::Cell*> cells_to_replay(ChartGrid& grid, std::size_t most) {
  std::vector<ChartGrid::Cell*> at_border;
  std::vector<ChartGrid::Cell*> bad;
  std::vector<ChartGrid::Cell*> rest;
  for (std::size_t row = 0; row < grid.cells.size(); ++row)
    for (std::size_t column = 0; column < grid.cells[row].size(); ++column) {
      ChartGrid::Cell& cell = grid.cells[row][column];
      if (cell.all == 0) continue;
      (is_at_border(grid, column, row) ? at_border : cell.bad > 0 ? bad : rest).push_back(&cell);
    }
  std::vector<ChartGrid::Cell*> chosen;
  for (const std::vector<ChartGrid::Cell*>* some : {&at_border, &bad, &rest}) {
    const std::size_t count = std::min(some->size(), most - chosen.size());
    for (std::size_t i = 0; i < count; ++i) chosen.push_back((*some)[i * some->size() / count]);
  }
  return chosen;
}

std::string cell_replay_json(const ReportScene& excerpt) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  for (const auto& [key, value] : excerpt.rows.front().parameters)
    parameters.push_back({axis_words(key), fmt::format("{:.6g}", value)});
  return "{\"parameters\":" + script_safe(dumped(parameters)) + ",\"replay\":" + replay_json(excerpt, 0) + '}';
}

}  // namespace paperproof::compare
