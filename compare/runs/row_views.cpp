#include "runs/row_views.hpp"

#include "runs/view.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

template <class Value>
Cell in_format(const std::optional<Value>& value, const char* format) {
  return value ? Cell(fmt::format(fmt::runtime(format), *value)) : std::nullopt;
}

template <class Value>
std::function<Cell(const Row&)> number(std::optional<Value> Row::*metric, const char* format = "{}") {
  return [metric, format](const Row& row) { return in_format(row.*metric, format); };
}

/// Precision and recall in one cell.
std::function<Cell(const Row&)> shares(std::optional<double> Row::*precision, std::optional<double> Row::*recall) {
  return [precision, recall](const Row& row) -> Cell {
    if (!(row.*precision) && !(row.*recall)) return std::nullopt;
    return in_format(row.*precision, "{:.3f}").value_or("-") + " " + in_format(row.*recall, "{:.3f}").value_or("-");
  };
}

Cell cost(const Row& row) {
  if (!row.ns_per_step) return std::nullopt;
  return fmt::format("{:.0f}..{:.0f}", *row.ns_per_step, row.ns_per_step_median.value_or(*row.ns_per_step));
}

std::string excused(const Row& row) {
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
const std::vector<Column<Row>>& columns_of_table() {
  static const std::vector<Column<Row>> all{
      {"contender", called},
      {"verdict", [](const Row& row) { return std::string(name_of(row.verdict)); }},
      {"tunnels", number(&Row::tunnels)},
      {"clipped", number(&Row::clipped), true},
      {"by m", number(&Row::clipped_depth_max_m, "{:.2g}"), true},
      {"inside", number(&Row::steps_ending_inside)},
      {"depth m", number(&Row::max_penetration_m, "{:.2g}"), true},
      {"in crush", number(&Row::steps_inside_after_crush), true},
      {"hanging", number(&Row::hanging_steps), true},
      {"stuck", number(&Row::stuck_steps), true},
      {"refuted", number(&Row::stuck_refuted), true},
      {"no ground", number(&Row::ground_refuted), true},
      {"dropped", number(&Row::dropped_steps), true},
      {"lost", number(&Row::wanted_motion_lost, "{:.2g}"), true},
      {"crushes", number(&Row::crushes), true},
      {"false crush", number(&Row::crushes_refuted), true},
      {"sensor err.", number(&Row::sensor_errors), true},
      {"gap m", number(&Row::max_contact_gap_m, "{:.2g}")},
      {"excused", excused, true},
      {"prec. recall", shares(&Row::contact_precision, &Row::contact_recall)},
      {"with Box2D", shares(&Row::contact_precision_box2d, &Row::contact_recall_box2d)},
      {"TOI error", number(&Row::toi_error_max, "{:.1e}")},
      {"snag", number(&Row::ghost_speed_loss, "{:.2g}"), true},
      {"rest m", number(&Row::rest_peak_to_peak_m, "{:.2g}")},
      {"from Box2D m", number(&Row::max_position_difference_box2d_m, "{:.3g}")},
      {"since", number(&Row::first_difference_box2d_step)},
      {"memory", memory},
      {"ns/step", cost},
      {"bare", number(&Row::ns_per_step_bare, "{:.0f}")},
      {"impact ns", number(&Row::impact_step_ns, "{:.0f}")},
      {"cold", number(&Row::impact_step_cold_ns, "{:.0f}")},
  };
  return all;
}

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

/// Those of a contender, in every scene.
using OfContender = std::pair<std::string, std::vector<const Row*>>;

template <class Value>
std::vector<Value> values(const OfContender& of, std::optional<Value> Row::*metric) {
  std::vector<Value> all;
  for (const Row* row : of.second)
    if (row->*metric) all.push_back(*(row->*metric));
  return all;
}

std::string scenes_run(const OfContender& of) {
  return std::to_string(std::ranges::count_if(of.second, [](const Row* row) { return was_judged(*row); }));
}

/// Steps, and in how many scenes.
std::function<Cell(const OfContender&)> steps_of(std::optional<int> Row::*metric) {
  return [metric](const OfContender& of) -> Cell {
    const std::vector<int> counts = values(of, metric);
    if (counts.empty()) return std::nullopt;
    long long steps = 0;
    for (const int count : counts) steps += count;
    if (steps == 0) return "0";
    const auto scenes = std::ranges::count_if(counts, [](int count) { return count > 0; });
    return fmt::format("{} in {}", steps, scenes);
  };
}

Cell answers_met(const OfContender& of) {
  const std::vector<bool> met = values(of, &Row::answer_ok);
  if (met.empty()) return std::nullopt;
  return fmt::format("{} of {}", std::ranges::count(met, true), met.size());
}

std::function<Cell(const OfContender&)> median_of(std::optional<double> Row::*metric) {
  return [metric](const OfContender& of) -> Cell {
    std::vector<double> costs = values(of, metric);
    if (costs.empty()) return std::nullopt;
    const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
    std::nth_element(costs.begin(), middle, costs.end());
    return fmt::format("{:.0f}", *middle);
  };
}

std::function<Cell(const OfContender&)> runs_with(Verdict verdict) {
  return [verdict](const OfContender& of) {
    return std::to_string(std::ranges::count_if(of.second, [&](const Row* row) { return row->verdict == verdict; }));
  };
}

const std::vector<Column<OfContender>>& columns_of_summary() {
  static const std::vector<Column<OfContender>> all{
      {"contender", [](const OfContender& of) { return of.first; }},
      {"scenes", scenes_run},
      {"failed", runs_with(Verdict::failed), true},
      {"violates", runs_with(Verdict::violates), true},
      {"through", steps_of(&Row::tunnels), false, "steps that pass a solid"},
      {"clipped", steps_of(&Row::clipped), true, "steps that pass one with a rim only"},
      {"inside", steps_of(&Row::steps_ending_inside), false, "steps that end in one"},
      {"hanging", steps_of(&Row::hanging_steps), false, "steps that could have fallen, and did not"},
      {"answer met", answers_met},
      {"ns/step", median_of(&Row::ns_per_step), false, "median over the scenes"},
      {"bare", median_of(&Row::ns_per_step_bare), false, "Box2D with nothing recorded"},
  };
  return all;
}

}  // namespace

std::string table(const std::vector<Row>& rows) { return view(rows, columns_of_table()); }

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
  return view<Row>(rows, {{"contender", called},
                          {"what happens", outcome_of},
                          {"ns per step", number(&Row::ns_per_step, "{:.0f}")},
                          {"bare", number(&Row::ns_per_step_bare, "{:.0f}")},
                          {"ns at impact", number(&Row::impact_step_ns, "{:.0f}")},
                          {"cold", number(&Row::impact_step_cold_ns, "{:.0f}")}});
}

std::string summary_table(const std::vector<Row>& rows) {
  std::vector<OfContender> contenders;
  for (const Row& row : rows) entry_of(contenders, called(row)).push_back(&row);
  std::string legend;
  for (const Column<OfContender>& column : shown(contenders, columns_of_summary()))
    if (!column.meaning.empty())
      legend += fmt::format("{}{}: {}", legend.empty() ? "" : "; ", column.heading, column.meaning);
  const bool counts_scenes = legend.find("steps ") != std::string::npos;
  return view(contenders, columns_of_summary()) + legend +
         (counts_scenes ? "; \"3 in 2\": 3 steps, in 2 scenes.\n" : ".\n");
}

}  // namespace paperproof::compare
