/// Rows as pictures over two parameters.
#pragma once

#include "studies/chart_page.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace paperproof::compare {

/// One grid for each contender and number type: how many of the rows at each pair of values do not hold (a verdict
/// other than `holds`; what cannot run counts for nothing). The words of a cell are the reason and the command of its
/// first row that does not hold, or of its first row.
/// @param x,y keys in `parameters`; an empty `y` gives one line.
[[nodiscard]] std::vector<ChartGrid> grids_of(const nlohmann::ordered_json& rows, const std::string& title,
                                              const std::string& x, const std::string& y);

}  // namespace paperproof::compare
