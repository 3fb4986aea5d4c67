#include "runs/summary.hpp"

#include "records/metric.hpp"
#include "runs/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

namespace paperproof::compare {
namespace {

using Rows = std::vector<const Row*>;

std::vector<double> values(const Rows& rows, std::string_view key) {
  std::vector<double> all;
  for (const Row* row : rows)
    if (const std::optional<double> value = value_of(*find_metric(key), *row)) all.push_back(*value);
  return all;
}

/// Those of a contender, in every scene.
std::vector<std::pair<std::string, Rows>> by_contender(const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, Rows>> all;
  for (const Row& row : rows) {
    const std::string name = called(row);
    auto entry = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
    if (entry == all.end()) entry = all.emplace(all.end(), name, Rows{});
    entry->second.push_back(&row);
  }
  return all;
}

Cell scenes_run(const Rows& rows) {
  return std::to_string(std::count_if(rows.begin(), rows.end(), [](const Row* row) { return was_judged(*row); }));
}

/// Steps, and in how many scenes.
std::function<Cell(const Rows&)> steps_of(std::string_view key) {
  return [key](const Rows& rows) -> Cell {
    const std::vector<double> counts = values(rows, key);
    if (counts.empty()) return std::nullopt;
    double steps = 0;
    for (const double count : counts) steps += count;
    if (steps == 0) return "0";
    const auto scenes = std::count_if(counts.begin(), counts.end(), [](double count) { return count > 0; });
    return fmt::format("{:.0f} in {}", steps, scenes);
  };
}

Cell answers_met(const Rows& rows) {
  const std::vector<double> met = values(rows, "answer_ok");
  if (met.empty()) return std::nullopt;
  return fmt::format("{} of {}", std::count(met.begin(), met.end(), 1.0), met.size());
}

std::function<Cell(const Rows&)> median_of(std::string_view key) {
  return [key](const Rows& rows) -> Cell {
    std::vector<double> costs = values(rows, key);
    if (costs.empty()) return std::nullopt;
    const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
    std::nth_element(costs.begin(), middle, costs.end());
    return fmt::format("{:.0f}", *middle);
  };
}

std::function<Cell(const Rows&)> runs_with(Verdict verdict) {
  return [verdict](const Rows& rows) -> Cell {
    const auto count = std::count_if(rows.begin(), rows.end(), [&](const Row* row) { return row->verdict == verdict; });
    if (count == 0) return std::nullopt;
    return std::to_string(count);
  };
}

struct SummaryColumn {
  const char* heading;
  const char* meaning;  ///< For the last line; empty where the heading says it.
  std::function<Cell(const Rows&)> cell;
};

const std::vector<SummaryColumn>& summary_columns() {
  static const std::vector<SummaryColumn> all{
      {"scenes", "", scenes_run},
      {"failed", "", runs_with(Verdict::failed)},
      {"violates", "", runs_with(Verdict::violates)},
      {"through", "steps that pass a solid", steps_of("tunnels")},
      {"inside", "steps that end in one", steps_of("steps_ending_inside")},
      {"hanging", "steps that could have fallen, and did not", steps_of("hanging_steps")},
      {"answer met", "", answers_met},
      {"ns/step", "median over the scenes", median_of("ns_per_step")},
      {"bare", "Box2D with nothing recorded", median_of("ns_per_step_bare")},
  };
  return all;
}

}  // namespace

std::string summary_table(const std::vector<Row>& rows) {
  const auto contenders = by_contender(rows);
  TextColumn names{"contender", {}, true};
  for (const auto& [name, own] : contenders) names.cells.emplace_back(name);
  std::vector<TextColumn> shown{std::move(names)};
  std::string legend;
  for (const SummaryColumn& column : summary_columns()) {
    std::vector<Cell> cells;
    for (const auto& [name, own] : contenders) cells.push_back(column.cell(own));
    if (std::none_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.has_value(); })) continue;
    shown.push_back({column.heading, std::move(cells)});
    if (*column.meaning != '\0')
      legend += fmt::format("{}{}: {}", legend.empty() ? "" : "; ", column.heading, column.meaning);
  }
  const bool counts_scenes = legend.find("steps ") != std::string::npos;
  return aligned(shown) + legend + (counts_scenes ? "; \"3 in 2\": 3 steps, in 2 scenes.\n" : ".\n");
}

}  // namespace paperproof::compare
