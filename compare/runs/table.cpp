#include "runs/table.hpp"

#include "runs/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

namespace paperproof::compare {
namespace {

struct Column {
  const char* heading;
  std::function<Cell(const Row&)> cell;
  bool trouble = false;  ///< Left out where it is zero for everyone.
};

template <class Value>
Cell number(const std::optional<Value>& value, const char* format) {
  if (!value) return std::nullopt;
  return fmt::format(fmt::runtime(format), *value);
}

/// Precision and recall in one cell.
Cell shares(const std::optional<double>& precision, const std::optional<double>& recall) {
  if (!precision && !recall) return std::nullopt;
  return number(precision, "{:.3f}").value_or("-") + " " + number(recall, "{:.3f}").value_or("-");
}

Cell cost(const Row& row) {
  if (!row.ns_per_step) return std::nullopt;
  return fmt::format("{:.0f}..{:.0f}", *row.ns_per_step, row.ns_per_step_median.value_or(*row.ns_per_step));
}

Cell excused(const Row& row) {
  int total = 0;
  for (const auto& [exemption, often] : row.exempted) total += often;
  return std::to_string(total);
}

Cell memory(const Row& row) {
  if (!row.memory_bytes) return std::nullopt;
  const auto bytes = static_cast<double>(*row.memory_bytes);
  if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
  return bytes < 1e6 ? fmt::format("{:.1f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6);
}

/// What a reader looks for first. The rest of a row stands in the report and in the rows' JSON.
const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"contender",
       [](const Row& r) -> Cell {
         const bool says_float = r.scalar == "float" && !r.contender.starts_with("box2d");
         return r.contender + (says_float ? " (float)" : "") + (r.knob.empty() ? "" : " " + r.knob);
       }},
      {"verdict", [](const Row& r) -> Cell { return std::string(name_of(r.verdict)); }},
      {"tunnels", [](const Row& r) { return number(r.tunnels, "{}"); }},
      {"inside", [](const Row& r) { return number(r.steps_ending_inside, "{}"); }},
      {"depth m", [](const Row& r) { return number(r.max_penetration_m, "{:.2g}"); }, true},
      {"in crush", [](const Row& r) { return number(r.steps_inside_after_crush, "{}"); }, true},
      {"hanging", [](const Row& r) { return number(r.hanging_steps, "{}"); }, true},
      {"stuck", [](const Row& r) { return number(r.stuck_steps, "{}"); }, true},
      {"refuted", [](const Row& r) { return number(r.stuck_refuted, "{}"); }, true},
      {"no ground", [](const Row& r) { return number(r.ground_refuted, "{}"); }, true},
      {"dropped", [](const Row& r) { return number(r.dropped_steps, "{}"); }, true},
      {"lost", [](const Row& r) { return number(r.wanted_motion_lost, "{:.2g}"); }, true},
      {"crushes", [](const Row& r) { return number(r.crushes, "{}"); }, true},
      {"false crush", [](const Row& r) { return number(r.crushes_refuted, "{}"); }, true},
      {"sensor err.", [](const Row& r) { return number(r.sensor_errors, "{}"); }, true},
      {"gap m", [](const Row& r) { return number(r.max_contact_gap_m, "{:.2g}"); }},
      {"excused", excused, true},
      {"prec. recall", [](const Row& r) { return shares(r.contact_precision, r.contact_recall); }},
      {"with Box2D", [](const Row& r) { return shares(r.contact_precision_box2d, r.contact_recall_box2d); }},
      {"TOI error", [](const Row& r) { return number(r.toi_error_max, "{:.1e}"); }},
      {"snag", [](const Row& r) { return number(r.ghost_speed_loss, "{:.2g}"); }, true},
      {"rest m", [](const Row& r) { return number(r.rest_peak_to_peak_m, "{:.2g}"); }},
      {"from Box2D m", [](const Row& r) { return number(r.max_position_difference_box2d_m, "{:.3g}"); }},
      {"since", [](const Row& r) { return number(r.first_difference_box2d_step, "{}"); }},
      {"memory", memory},
      {"ns/step", cost},
      {"bare", [](const Row& r) { return number(r.ns_per_step_bare, "{:.0f}"); }},
  };
  return all;
}

}  // namespace

std::string table(const std::vector<Row>& rows) {
  std::vector<TextColumn> shown;
  for (const Column& column : columns()) {
    std::vector<Cell> cells;
    for (const Row& row : rows) cells.push_back(column.cell(row));
    const auto says_something = [&](const Cell& cell) { return cell && !(column.trouble && *cell == "0"); };
    if (std::none_of(cells.begin(), cells.end(), says_something)) continue;
    const bool words = shown.empty() || std::string_view(column.heading) == "verdict";
    shown.push_back({column.heading, std::move(cells), words});
  }
  return aligned(shown);
}

}  // namespace paperproof::compare
