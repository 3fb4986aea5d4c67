#include "runs/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace paperproof::compare {
namespace {

using Cell = std::optional<std::string>;

struct Column {
  const char* heading;
  std::function<Cell(const Row&)> cell;
};

template <class Value>
Cell number(const std::optional<Value>& value, const char* format) {
  if (!value) return std::nullopt;
  return fmt::format(fmt::runtime(format), *value);
}

Cell cost(const Row& row) {
  if (!row.ns_per_step) return std::nullopt;
  return fmt::format("{:.0f}..{:.0f}", *row.ns_per_step, row.ns_per_step_max.value_or(*row.ns_per_step));
}

Cell memory(const Row& row) {
  if (!row.memory_bytes) return std::nullopt;
  return fmt::format("{:.3g} MB", static_cast<double>(*row.memory_bytes) * 1e-6);
}

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"contender",
       [](const Row& r) -> Cell {
         return r.scalar == "float" && !r.contender.starts_with("box2d") ? r.contender + " (float)" : r.contender;
       }},
      {"verdict", [](const Row& r) -> Cell { return std::string(name_of(r.verdict)); }},
      {"tunnels", [](const Row& r) { return number(r.tunnels, "{}"); }},
      {"inside", [](const Row& r) { return number(r.steps_ending_inside, "{}"); }},
      {"depth m", [](const Row& r) { return number(r.max_penetration_m, "{:.2g}"); }},
      {"gap m", [](const Row& r) { return number(r.max_contact_gap_m, "{:.2g}"); }},
      {"precision", [](const Row& r) { return number(r.contact_precision, "{:.3f}"); }},
      {"recall", [](const Row& r) { return number(r.contact_recall, "{:.3f}"); }},
      {"prec. Box2D", [](const Row& r) { return number(r.contact_precision_box2d, "{:.3f}"); }},
      {"rec. Box2D", [](const Row& r) { return number(r.contact_recall_box2d, "{:.3f}"); }},
      {"same sides", [](const Row& r) { return number(r.contact_agreement_box2d, "{:.4f}"); }},
      {"TOI error", [](const Row& r) { return number(r.toi_error_max, "{:.1e}"); }},
      {"snag", [](const Row& r) { return number(r.ghost_speed_loss, "{:.2g}"); }},
      {"rest p-p m", [](const Row& r) { return number(r.rest_peak_to_peak_m, "{:.2g}"); }},
      {"toggles", [](const Row& r) { return number(r.contact_toggles, "{:.3g}"); }},
      {"from Box2D m", [](const Row& r) { return number(r.max_position_difference_box2d_m, "{:.3g}"); }},
      {"ns/step", cost},
      {"memory", memory},
  };
  return all;
}

}  // namespace

std::string table(const std::vector<Row>& rows) {
  std::string text;
  std::vector<std::string> lines(rows.size() + 1);
  for (const Column& column : columns()) {
    std::vector<Cell> cells;
    for (const Row& row : rows) cells.push_back(column.cell(row));
    if (std::none_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.has_value(); })) continue;
    std::size_t width = std::string_view(column.heading).size();
    for (const Cell& cell : cells) width = std::max(width, cell ? cell->size() : 1);
    const bool words = lines[0].empty() || std::string_view(column.heading) == "verdict";
    const auto put = [&](std::string& line, std::string_view what) {
      if (!line.empty()) line += "  ";
      line += words ? fmt::format("{:<{}}", what, width) : fmt::format("{:>{}}", what, width);
    };
    put(lines[0], column.heading);
    for (std::size_t i = 0; i < rows.size(); ++i) put(lines[i + 1], cells[i] ? std::string_view(*cells[i]) : "-");
  }
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace paperproof::compare
