#include "studies/stability.hpp"

#include "records/metric.hpp"
#include "records/verdict.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"

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

struct Region {
  const char* name;
  const char* question;
  const char* scene;
  const char* axes;
  const char* replicas_along = "";
  const char* full_axes = nullptr;  ///< Of the full grid; null: the same.
  bool has_slopes = false;
};

const std::vector<Region>& regions() {
  static const std::vector<Region> all{
      {"rest and steps", "A drop of 0.25 m, and rest for up to a million steps, every one of them judged.", "rest",
       "steps=1e3,1e4,1e5,1e6 gravity=30,1e3"},
      {"play and input",
       "Walks and jumps at random over slopes, kerbs, a ledge, a needle and a pit; a day is 5,184,000 steps at 60 Hz.",
       "playground", "steps=1e3,1e4,1e5 seed=1,2,3", "", "steps=1e3,1e4,1e5,5184000 seed=1,2", true},
      {"origin and speed", "Paper of 1 cm, far from the origin, hit fast.", "paper",
       "origin=0,1e3,1e4,1e5,1e6,1.9e6 speed=10,100,1e3,1e4,1e5"},
      {"far origin and step",
       "Walk, wall and jump, far from the origin: in float a step may be less than what can be told apart there.",
       "far", "origin=16,1e3,1e4,1e5,1e6 dt=1e-3,0.008333333333333333,0.016666666666666666", "origin"},
      {"gravity and step", "A drop of 0.25 m that has to come to rest.", "drop",
       "gravity=10,100,1e3,1e4,1e5,1e6 dt=1e-4,1e-3,0.01,0.1,1"},
      {"scale and thickness", "Paper in other sizes of the world: the character is as large as the scale says.",
       "paper", "scale=1e-4,1e-2,1,1e2,1e4 thickness=0,1e-6,1e-3,0.1"},
      {"speed and thickness", "Paper of any thickness at any speed.", "paper",
       "speed=10,30,100,300,1e3,1e4,1e5 thickness=0,1e-6,1e-3,1e-2,0.1,1"},
      {"mass ratio and step", "A heavy box on four light ones, and the character on top.", "stack",
       "mass_ratio=1,10,100,1e3,1e4 dt=0.0041666666666666666,0.016666666666666666,0.03333333333333333"},
      {"wedge and step", "A fall into a V.", "wedge", "angle=60,30,10,5,2,1 dt=1e-3,0.01,0.016666666666666666,0.1"},
      {"slope and step",
       "A character on a slope: it stands up to its climb limit of 50 degrees, and slides down beyond it.", "ramp",
       "angle=10,49,51,70,85,89,89.9 dt=1e-3,0.016666666666666666,0.1", "", nullptr, true},
      {"clearance and step", "A fall down a shaft that fits.", "shaft",
       "clearance=0,1e-9,1e-6,1e-3,0.05 dt=1e-3,0.016666666666666666,0.1"},
      {"perturbed start", "Walk, jump and wall, begun a little aside: the same sequence of events.", "replica_of",
       "aside=0,1e-12,1e-9,1e-6,1e-3 dt=0.016666666666666666", "aside"},
      {"pixels per frame and thickness",
       "Paper hit at up to 100,000 pixels per frame of a 30th of a second, where 32 pixels are a metre.", "paper",
       "speed=937.5,9375,93750 thickness=0,1e-9,1e-6,1e-3 dt=0.03333333333333333"},
      {"random steps", "Walk and wall in steps of random lengths, from 1e-4 s to the longest.", "random_steps",
       "longest=1e-3,1e-2,0.1,1 seed=1,2,3,4"},
      {"stiffness and step",
       "A plank on springs, up to the Nyquist frequency of the steps and beyond: at 60 Hz it is 7.1e5 N/m, at 1 kHz "
       "2e8.",
       "plank_on_springs",
       "stiffness=250,1e3,1e4,1e5,1e6,1e7,2e8 dt=1e-3,0.004166666666666667,0.016666666666666666,0.03333333333333333"},
      {"damping and step", "The same plank on stiff springs with more and more damping.", "plank_on_springs",
       "damping=0,10,1e3,1e5,1e7 dt=1e-3,0.004166666666666667,0.016666666666666666,0.03333333333333333 stiffness=1e5"},
      {"crowd and step", "Several in a tight room, each at random by itself.", "crowd",
       "characters=2,4,8,16 dt=0.008333333333333333,0.016666666666666666", "",
       "characters=2,4,8,16 dt=0.008333333333333333,0.016666666666666666,0.03333333333333333"},
  };
  return all;
}

struct Border {
  const char* name;
  const char* scene;
  const char* key;
  double least;
  double most;
  std::vector<Case::Setting> set{};
  /// Only this is asked: that no answer of the scene is missed by more [in its unit]. 0: all predicates are, and the
  /// answers to the letter.
  double most_off = 0;
};

/// Half of the way that the walk of `far` goes [m]: a character that is further from where it should be does not move.
constexpr double half_of_the_walk = 11.7;
/// The scenery of `far` begins 16 m before its origin and ends 3 m before it; the controller takes places to 2e6 m.
constexpr double farthest = 1.99e6;

const std::vector<Border>& borders() {
  static const std::vector<Border> all{
      {"far origin, to the letter", "far", "origin", 16, farthest},
      {"far origin, 240 Hz: moves at all",
       "far",
       "origin",
       16,
       farthest,
       {{"dt", "0.004166666666666667"}},
       half_of_the_walk},
      {"far origin, 1 kHz: moves at all", "far", "origin", 16, farthest, {{"dt", "0.001"}}, half_of_the_walk},
      {"speed onto paper of 1 mm", "paper", "speed", 0.1, 1e5, {{"thickness", "0.001"}}},
      {"gravity of a drop, 60 Hz", "drop", "gravity", 1, 1e7},
      {"step of a drop", "drop", "dt", 1e-4, 1, {{"gravity", "10"}}},
      {"longest of random steps", "random_steps", "longest", 1e-3, 1},
      {"mass ratio of a stack, 60 Hz", "stack", "mass_ratio", 1, 1e6},
      {"stiffness under a plank, 60 Hz", "plank_on_springs", "stiffness", 250, 1e9},
  };
  return all;
}

/// First, middle and last; of numbers of steps the least three, as a million steps take longer than all else.
SweepAxis thinned(SweepAxis axis) {
  const std::size_t count = axis.values.size();
  if (axis.key == "steps")
    axis.values.resize(std::min<std::size_t>(count, 3));
  else if (count > 3)
    axis.values = {axis.values.front(), axis.values[count / 2], axis.values.back()};
  return axis;
}

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

StudyPart part_of(const Region& region, GridSize size) {
  StudyPart part{region.name, {}, {}, Bad::does_not_hold, region.question};
  part.sweep.scene = region.scene;
  const bool whole = size == GridSize::full && region.full_axes != nullptr;
  for (const SweepAxis& axis : parse_axes(whole ? region.full_axes : region.axes)) {
    // What has one value is no axis of a picture.
    if (part.sweep.axes.size() == 2)
      part.sweep.set.push_back({axis.key, axis.values.front()});
    else
      part.sweep.axes.push_back(size == GridSize::quick ? thinned(axis) : axis);
  }
  part.run = [&region](const Sweep& sweep, std::size_t index) {
    return run_stable(sweep, index, region.replicas_along, region.has_slopes);
  };
  return part;
}

StudyPart part_of(const Border& border, GridSize size) {
  StudyPart part{border.name, {}, {}};
  part.sweep.scene = border.scene;
  part.sweep.set = border.set;
  part.sweep.border = border.key;
  part.sweep.border_range = {border.least, border.most};
  const auto run = [](const Case& at) {
    Row row = run_case(at);
    judge_stability(row);
    return row;
  };
  const auto holds = [&border](const Row& row) {
    return border.most_off > 0 ? row.answer_error && *row.answer_error <= border.most_off
                               : row.verdict == Verdict::holds;
  };
  const int strides = size == GridSize::quick ? quick_border_strides : border_strides;
  part.run = [=](const Sweep& sweep, std::size_t index) { return border_at(sweep, index, {run, holds, strides}); };
  return part;
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
  for (const Region& region : regions()) add_parts(part_of(region, size), who, parts);
  for (const Border& border : borders()) add_parts(part_of(border, size), who, parts);
  return parts;
}

std::vector<std::string> stability_paragraphs() {
  std::vector<std::string> all{
      "Stiff and extreme cases, judged step by step by exact arithmetic. A case does not hold where one of the "
      "predicates below fails, the scene's exact answer is missed, or the contender's limits are passed."};
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
