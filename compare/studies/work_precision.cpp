#include "studies/work_precision.hpp"

#include "runs/contender.hpp"
#include "runs/continuous_error.hpp"
#include "runs/run.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// Errors below this are rounding, and say nothing about a knob [m].
constexpr double least_error = 1e-9;
constexpr double usual_dt = 1.0 / 60;
constexpr std::array lengths{longest_step, 1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};

/// A knob of contenders, as a curve goes over it at the usual length of a step.
struct CurveKnob {
  std::string_view name;  ///< On the command line,
  std::string_view key;   ///< and in `parameters`.
  std::vector<double> values;
  bool inverted = false;  ///< `parameters` has the reciprocal: the side of a pixel.
};

const std::vector<CurveKnob>& curve_knobs() {
  static const std::vector<CurveKnob> all{
      {"unit", "unit_m", {1.0 / 8, 1.0 / 16, 1.0 / 64, 1.0 / 128, 1.0 / 256}},
      {"raster_pixels_per_metre", "pixel_m", {8, 16, 64, 128, 256}, true},
      {"square", "square_m", {1, 0.5, 0.25, 0.125}},
      {"iterations", "iterations", {1, 2, 8}},
      {"substeps", "substeps", {2, 4, 8}},
  };
  return all;
}

/// The runs of contenders with one length of a step and one value of a knob: they are judged, and take turns where they
/// are timed.
struct Runs {
  std::vector<std::string> contenders{};
  ScalarKind scalar = ScalarKind::binary64;
  double dt = usual_dt;
  std::string_view over = "dt_s";  ///< The key in `parameters` that the curve is over,
  double value = usual_dt;         ///< and what it is there.
  std::vector<KnobSetting> knobs{};
};

std::vector<Runs> runs_of(const std::vector<std::string>& contenders) {
  std::vector<Runs> all;
  for (const double dt : lengths) all.push_back({.contenders = contenders, .dt = dt, .value = dt});
  if (std::find(contenders.begin(), contenders.end(), "octagon_sweep") != contenders.end())
    for (const double dt : lengths)
      all.push_back({.contenders = {"octagon_sweep"}, .scalar = ScalarKind::binary32, .dt = dt, .value = dt});
  for (const CurveKnob& knob : curve_knobs()) {
    std::vector<std::string> having;
    std::copy_if(contenders.begin(), contenders.end(), std::back_inserter(having),
                 [&](const std::string& name) { return has_knob(name, knob.name); });
    if (having.empty()) continue;
    for (const double value : knob.values)
      all.push_back({.contenders = having,
                     .over = knob.key,
                     .value = knob.inverted ? 1 / value : value,
                     .knobs = {{std::string(knob.name), fmt::format("{}", value)}}});
  }
  return all;
}

/// Of a point: the key in `parameters` that its curve is over, and what it is there. It stands last.
const std::pair<std::string, double>& knob_of(const Row& point) { return point.parameters.back(); }

std::vector<Row> points_of(const Motion& motion, const Runs& runs) {
  RunOptions options;
  options.contenders = runs.contenders;
  options.scalars = {runs.scalar};
  options.knobs = runs.knobs;
  options.reference = false;
  options.continuous = true;
  std::vector<Row> points = run_scene(scene_of(motion, runs.dt), options).rows;
  for (Row& point : points) {
    point.mode = "work_precision";
    point.parameters = {{"dt_s", runs.dt}};
    if (runs.over != "dt_s") point.parameters.emplace_back(runs.over, runs.value);
  }
  return points;
}

/// What steps alone make of the continuous motion. Nobody runs it, and it has no cost.
Row law_point(const Motion& motion, double dt) {
  const Scene scene = scene_of(motion, dt);
  const ContinuousCourses courses(scene, scene.input, scene.steps);
  const Courses& both = *courses.of("octagon_sweep").front();
  ContinuousError error({&both});
  for (int step = 0; step < scene.steps; ++step)
    error.add(both.steps.value().place_at(courses.end(step)), courses.end(step));
  Row row;
  row.scene = motion.name;
  row.contender = law_of_steps;
  row.mode = "work_precision";
  row.steps = scene.steps;
  row.parameters = {{"dt_s", dt}};
  error.write(row);
  return row;
}

bool same_curve(const Row& a, const Row& b) {
  return a.contender == b.contender && a.scalar == b.scalar && knob_of(a).first == knob_of(b).first;
}

Row curve_of(const Row& first, const std::vector<Row>& points) {
  std::vector<std::optional<std::pair<double, double>>> logs;
  bool on_front = false;
  for (const Row& point : points) {
    if (!same_curve(point, first)) continue;
    on_front = on_front || point.on_front.value_or(false);
    logs.emplace_back();
    if (has_error(point) && *point.error_max_m > least_error)
      logs.back() = {std::log(knob_of(point).second), std::log(*point.error_max_m)};
  }
  Row row;
  row.scene = first.scene;
  row.contender = first.contender;
  row.scalar = first.scalar;
  row.mode = first.mode;
  row.curve = knob_of(first).first;
  if (const std::optional<Slope> slope = slope_within_a_regime(logs)) {
    row.slope = slope->value;
    row.slope_within = slope->within;
  }
  if (first.ns_per_step) row.on_front = on_front;
  if (first.verdict == Verdict::not_applicable) {
    row.verdict = first.verdict;
    row.reason = first.reason;
  }
  return row;
}

void add_motion(const Motion& motion, const std::vector<Runs>& all, WorkPrecision& found) {
  std::vector<Row> points;
  for (const Runs& runs : all)
    for (Row& point : points_of(motion, runs)) points.push_back(std::move(point));
  for (const double dt : lengths) points.push_back(law_point(motion, dt));
  mark_front(points);
  for (auto point = points.begin(); point != points.end(); ++point)
    if (std::none_of(points.begin(), point, [&](const Row& before) { return same_curve(before, *point); }))
      found.curves.push_back(curve_of(*point, points));  // it is the first of its curve
  found.sentences.push_back(words_of_front(std::string(motion.name), points));
  found.points.insert(found.points.end(), points.begin(), points.end());
}

}  // namespace

WorkPrecision study_work_precision(const std::vector<std::string>& wanted, const std::vector<std::string>& contenders,
                                   const std::function<void(double)>& progress) {
  std::vector<const Motion*> chosen;
  for (const std::string& name : wanted) {
    const auto found =
        std::find_if(motions().begin(), motions().end(), [&](const Motion& motion) { return motion.name == name; });
    if (found == motions().end()) throw std::invalid_argument(fmt::format("no motion is called {}", name));
    chosen.push_back(&*found);
  }
  if (chosen.empty())
    for (const Motion& motion : motions()) chosen.push_back(&motion);
  std::vector<std::string> names = contenders;
  if (names.empty())
    for (const std::string_view name : contender_names()) names.emplace_back(name);
  const std::vector<Runs> all = runs_of(names);
  WorkPrecision found;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(chosen.size()));
    add_motion(*chosen[i], all, found);
  }
  return found;
}

}  // namespace paperproof::compare
