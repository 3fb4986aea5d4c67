#include "runs/headline.hpp"

#include "runs/text_columns.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

std::string moment(double fraction, int step) {
  return fmt::format("{:.3f}", fraction) + (step > 0 ? fmt::format(" of step {}", step) : "");
}

std::string on_steps(int count) { return count == 1 ? "" : fmt::format(" on {}", counted(count, "step")); }

/// The first impact depends on the run: a contender that is off the wanted way before meets something else. So it is
/// that of a contender with a guarantee, where one ran.
const Row* row_of_first_impact(const std::vector<Row>& rows) {
  const Row* best = nullptr;
  for (const Row& row : rows) {
    if (!row.exact_first_impact_step || !row.exact_first_impact_fraction) continue;
    if (best == nullptr || is_guaranteed(row.contender, row.scalar)) best = &row;
  }
  return best;
}

Cell whole(const std::optional<double>& value) {
  if (!value) return std::nullopt;
  return fmt::format("{:.0f}", *value);
}

}  // namespace

std::string outcome_of(const Row& row) {
  if (row.verdict == Verdict::not_applicable) return "cannot run";
  if (row.verdict == Verdict::failed) return "failed";
  if (row.tunnels.value_or(0) > 0) return "through" + on_steps(*row.tunnels);
  if (row.steps_ending_inside.value_or(0) > 0) return "ends inside" + on_steps(*row.steps_ending_inside);
  if (row.hanging_steps.value_or(0) > 0) return "hangs" + on_steps(*row.hanging_steps);
  if (!row.first_contact_step || !row.first_contact_fraction) return "meets nothing";
  return "stopped at " + moment(*row.first_contact_fraction, *row.first_contact_step);
}

std::string exact_answer(const std::vector<Row>& rows) {
  const Row* row = row_of_first_impact(rows);
  if (row == nullptr) return "";
  const std::string& what = row->exact_first_impact;
  return fmt::format("exact arithmetic: {} is met at {}", what.empty() ? "a solid" : what,
                     moment(*row->exact_first_impact_fraction, *row->exact_first_impact_step));
}

std::string headline(const std::vector<Row>& rows) {
  TextColumn who{"contender", {}, true};
  TextColumn outcome{"what happens", {}, true};
  TextColumn cost{"ns per step", {}};
  TextColumn bare{"bare", {}};
  for (const Row& row : rows) {
    who.cells.emplace_back(called(row));
    outcome.cells.emplace_back(outcome_of(row));
    cost.cells.push_back(whole(row.ns_per_step));
    bare.cells.push_back(whole(row.ns_per_step_bare));
  }
  std::vector<TextColumn> columns{std::move(who), std::move(outcome)};
  for (TextColumn* column : {&cost, &bare})
    if (std::any_of(column->cells.begin(), column->cells.end(), [](const Cell& cell) { return cell.has_value(); }))
      columns.push_back(std::move(*column));
  return aligned(columns);
}

}  // namespace paperproof::compare
