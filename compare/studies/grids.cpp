#include "studies/grids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

std::optional<double> value_of(const ordered_json& row, const std::string& key) {
  if (!row.contains("parameters") || !row["parameters"].contains(key)) return std::nullopt;
  return row["parameters"][key].get<double>();
}

std::vector<double> values_of(const ordered_json& rows, const std::string& key) {
  std::vector<double> values;
  for (const ordered_json& row : rows)
    if (const std::optional<double> value = value_of(row, key)) values.push_back(*value);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<std::string> texts_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(fmt::format("{:.4g}", value));
  return texts;
}

std::string who(const ordered_json& row) {
  const std::string contender = row.value("contender", "");
  const bool is_float = row.value("scalar", "") == "float" && !contender.starts_with("box2d");
  return is_float ? contender + " in float" : contender;
}

std::size_t place_in(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

void add(const ordered_json& row, ChartGrid::Cell& cell) {
  const std::string verdict = row.value("verdict", "");
  if (verdict == "not_applicable") return;
  const bool first_bad = verdict != "holds" && cell.bad == 0;
  if (cell.all == 0 || first_bad)
    cell.words = fmt::format("{}{}{} — {}", verdict, row.contains("reason") ? ": " : "", row.value("reason", ""),
                             row.value("command", ""));
  ++cell.all;
  cell.bad += verdict != "holds";
}

}  // namespace

std::vector<ChartGrid> grids_of(const ordered_json& rows, const std::string& title, const std::string& x,
                                const std::string& y) {
  const std::vector<double> xs = values_of(rows, x);
  const std::vector<double> ys = y.empty() ? std::vector<double>{0} : values_of(rows, y);
  std::vector<ChartGrid> grids;
  std::vector<std::string> names;
  for (const ordered_json& row : rows) {
    const std::optional<double> across = value_of(row, x);
    const std::optional<double> up = y.empty() ? std::optional(0.0) : value_of(row, y);
    if (!across || !up) continue;
    const std::string name = who(row);
    auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      found = names.insert(names.end(), name);
      grids.push_back({title + (title.empty() ? "" : ": ") + name, x, y, texts_of(xs),
                       y.empty() ? std::vector<std::string>{""} : texts_of(ys),
                       std::vector(ys.size(), std::vector<ChartGrid::Cell>(xs.size()))});
    }
    ChartGrid& grid = grids[static_cast<std::size_t>(found - names.begin())];
    add(row, grid.cells[place_in(ys, *up)][place_in(xs, *across)]);
  }
  return grids;
}

}  // namespace paperproof::compare
