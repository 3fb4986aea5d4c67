#include "studies/stability.hpp"

#include "records/metric.hpp"
#include "records/verdict.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"
#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {
namespace {

/// Bounds, each with its reason.
constexpr double promised_drift = 1e-6;   ///< Of octagon_sweep in double [m]: the gap of the guarantee.
constexpr double visible_drift = 1e-4;    ///< Of others [m]: a 300th of a pixel at 32 pixels per metre.
constexpr double roundings_of_place = 2;  ///< In ulp: a place is kept to one, and read as a difference of two.
constexpr double deepest_body = 0.005;    ///< Box2D lets its bodies overlap by this much [m].
/// Strides in which a border is looked for before it is bisected.
constexpr int border_strides = 24;
constexpr int quick_border_strides = 6;

/// Adds a part for those that compute in double and in float, and one for those that have one number type alone.
void add_parts(StudyPart part, const std::vector<std::string>& contenders, std::vector<StudyPart>& parts) {
  for (const bool references : {false, true}) {
    part.sweep.contenders.clear();
    for (const std::string& name : contenders)
      if (is_reference(name) == references) part.sweep.contenders.push_back({name});
    part.sweep.scalars = references ? std::vector<std::string>{"double"} : std::vector<std::string>{"double", "float"};
    if (!part.sweep.contenders.empty()) parts.push_back(part);
  }
}

/// @param text of a part without a border.
void run_regions(const Json& text, StudyPart& part) {
  part.run = [along = text.value("replicas_along", ""), has_slopes = text.value("has_slopes", false)](
                 const Sweep& sweep, std::size_t index) { return run_stable(sweep, index, along, has_slopes); };
}

/// @param text of a part with one. With `most_off` only this is asked: that no answer of the scene is missed by more
/// [in its unit]; without it all predicates are, and the answers to the letter.
void run_borders(const Json& text, GridSize size, StudyPart& part) {
  const auto run = [](const Case& at) {
    Row row = run_case(at);
    judge_stability(row);
    return row;
  };
  const auto holds = [most_off = text.value("most_off", 0.0)](const Row& row) {
    return most_off > 0 ? row.answer_error && *row.answer_error <= most_off : row.verdict == Verdict::holds;
  };
  const int strides = size == GridSize::quick ? quick_border_strides : border_strides;
  part.run = [=](const Sweep& sweep, std::size_t index) { return border_at(sweep, index, {run, holds, strides}); };
}

/// How far apart numbers are at the place of a row [m].
double ulp_of(const Row& row) {
  const double place = std::abs(parameter_of(row, "origin_m").value_or(0)) + 1;
  return place * (row.scalar == "float" ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                        : std::numeric_limits<double>::epsilon());
}

/// @param words of the fault. @param promised by §6 of the guarantee.
void conclude(Row& row, bool holds, const std::string& words, bool promised = false) {
  if (!holds)
    add_fault(row, Axis::answer, promised && is_guaranteed(row) ? Verdict::violates : Verdict::flagged, words);
}

void judge_drift(Row& row) {
  if (!row.rest_peak_to_peak_m || row.characters) return;
  const double bound = std::max(is_guaranteed(row) ? promised_drift : visible_drift, roundings_of_place * ulp_of(row));
  row.drift_ok = *row.rest_peak_to_peak_m <= bound;
  conclude(row, *row.drift_ok, fmt::format("drifts by {:.3g} m at rest", *row.rest_peak_to_peak_m), true);
}

void judge_energy(Row& row) {
  const auto judge = [&row](const std::optional<double>& gained, const std::optional<double>& bound, const char* what) {
    if (!gained || !bound) return;
    const bool holds = *gained <= *bound;
    row.energy_ok = row.energy_ok.value_or(true) && holds;
    conclude(row, holds, fmt::format("gains {:.3g} {}, more than {:.3g}", *gained, what, *bound));
  };
  judge(row.energy_gained_j_kg, row.energy_bound_j_kg, "J/kg");
  judge(row.body_energy_gained_j, row.body_energy_bound_j, "J in bodies");
}

void take_events_of(const Row& expected, Row& row) {
  if (row.event_sequence.empty() || expected.event_sequence.empty()) return;
  row.events_ok = row.event_sequence == expected.event_sequence;
  conclude(row, *row.events_ok,
           fmt::format("{} events, and not the {} of the first replica", row.events.value_or(0),
                       expected.events.value_or(0)));
  settle(row);
}

}  // namespace

std::vector<StudyPart> stability_parts(GridSize size, const std::vector<std::string>& contenders) {
  const std::vector<std::string> who =
      contenders.empty() ? std::vector<std::string>{"octagon_sweep", "box2d"} : contenders;
  std::vector<StudyPart> parts;
  for (const Json& text : study_text("stability").at("parts")) {
    StudyPart part = part_of(text, size);
    part.sweep.border ? run_borders(text, size, part) : run_regions(text, part);
    add_parts(std::move(part), who, parts);
  }
  return parts;
}

std::vector<std::string> stability_predicates() {
  std::vector<std::string> all;
  for (const char* predicate : {"finite", "penetration_ok", "drift_ok", "energy_ok", "hanging_ok", "events_ok"})
    all.push_back(fmt::format("{}: {}.", predicate, find_metric(predicate)->meaning));
  return all;
}

void judge_stability(Row& row, bool has_slopes) {
  if (!was_judged(row)) return;
  row.penetration_ok = row.tunnels.value_or(0) == 0 && row.steps_ending_inside.value_or(0) == 0 &&
                       row.body_tunnels.value_or(0) == 0 && row.body_max_penetration_m.value_or(0) <= deepest_body;
  row.hanging_ok = row.hanging_steps.value_or(0) == 0 && row.stuck_refuted.value_or(0) == 0;
  if (!has_slopes || !is_reference(row.contender)) judge_drift(row);
  judge_energy(row);
  settle(row);
}

Row run_stable(const Sweep& sweep, std::size_t index, const std::string& replicas_along, bool has_slopes) {
  const Case one = sweep.at(index);
  Row row = run_case(one);
  judge_stability(row, has_slopes);
  const auto along = std::find_if(sweep.axes.begin(), sweep.axes.end(),
                                  [&](const SweepAxis& axis) { return axis.key == replicas_along; });
  if (along == sweep.axes.end() || !was_judged(row)) return row;
  Case first = one;
  for (Case::Setting& setting : first.parameters)
    if (setting.key == along->key) setting.value = along->values.front();
  take_events_of(run_case(first), row);
  return row;
}

}  // namespace paperproof::compare
