#include "studies/work_precision.hpp"

#include "runs/contender.hpp"
#include "runs/continuous_error.hpp"
#include "runs/cost.hpp"
#include "runs/input_cursor.hpp"
#include "runs/scene_plan.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
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

/// One run: a contender with one value of a knob.
struct Point {
  Row row;
  std::string knob;  ///< The key in `parameters` that the curve is over.
  double value = 0;
  double dt = usual_dt;
  std::vector<KnobSetting> knobs;
  std::unique_ptr<Contender> contender;
};

Point point_of(const Motion& motion, const std::string& contender, const std::string& scalar, double dt) {
  Point point;
  point.row.scene = motion.name;
  point.row.contender = contender;
  point.row.scalar = scalar;
  point.row.mode = "work_precision";
  point.row.parameters.emplace_back("dt_s", dt);
  point.knob = "dt_s";
  point.value = dt;
  point.dt = dt;
  return point;
}

void add_curves(const Motion& motion, const std::string& contender, std::vector<Point>& points) {
  const std::string scalar = is_reference(contender) ? "float" : "double";
  for (const double dt : lengths) points.push_back(point_of(motion, contender, scalar, dt));
  if (contender == "octagon_sweep")
    for (const double dt : lengths) points.push_back(point_of(motion, contender, "float", dt));
  for (const CurveKnob& knob : curve_knobs()) {
    if (!has_knob(contender, knob.name)) continue;
    for (const double value : knob.values) {
      Point point = point_of(motion, contender, scalar, usual_dt);
      point.knob = knob.key;
      point.value = knob.inverted ? 1 / value : value;
      point.row.parameters.emplace_back(knob.key, point.value);
      point.knobs = {{std::string(knob.name), fmt::format("{}", value)}};
      points.push_back(std::move(point));
    }
  }
}

class MotionStudy {
 public:
  MotionStudy(const Motion& motion, const std::vector<std::string>& contenders) : motion_(motion) {
    for (const std::string& contender : contenders) add_curves(motion, contender, points_);
    for (const Point& point : points_)
      if (!scenes_.contains(point.dt)) {
        auto scene = std::make_unique<Level>(scene_of(motion, point.dt));
        scenes_.emplace(point.dt, std::move(scene));
      }
  }

  void measure_errors() {
    for (Point& point : points_) {
      try {
        measure_error(point);
      } catch (const NotApplicable& reason) {
        point.row.verdict = Verdict::not_applicable;
        point.row.reason = reason.what();
      } catch (const std::exception& error) {
        point.row.verdict = Verdict::failed;
        point.row.reason = error.what();
      }
    }
  }

  void measure_costs_of_all() {
    for (const auto& [dt, level] : scenes_) {
      std::vector<Point*> timed;
      std::vector<TimedRun> runs;
      for (Point& point : points_) {
        if (point.dt != dt || !point.contender || point.row.verdict == Verdict::failed) continue;
        timed.push_back(&point);
        runs.push_back({point.contender.get(), {}});
      }
      if (runs.empty()) continue;
      const std::vector<Costs> costs = measure_costs(runs, level->scene, level->script, level->scene.steps);
      for (std::size_t i = 0; i < timed.size(); ++i) {
        Row& row = timed[i]->row;
        row.ns_per_step = costs[i].full.ns_per_step_min;
        row.ns_per_step_median = costs[i].full.ns_per_step_median;
        row.ns_per_step_max = costs[i].full.ns_per_step_max;
      }
    }
    for (Point& point : points_) point.contender.reset();
  }

  void report(WorkPrecision& found) {
    std::vector<Row> rows;
    for (const Point& point : points_) rows.push_back(point.row);
    mark_front(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) points_[i].row.on_front = rows[i].on_front;
    std::vector<const Point*> firsts;  // of each curve
    for (const Point& point : points_)
      if (std::none_of(firsts.begin(), firsts.end(), [&](const Point* first) { return same_curve(*first, point); }))
        firsts.push_back(&point);
    for (const Point* first : firsts) found.curves.push_back(curve_of(*first));
    found.sentences.push_back(words_of_front(std::string(motion_.name), rows));
    found.points.insert(found.points.end(), rows.begin(), rows.end());
  }

 private:
  struct Level {
    explicit Level(Scene made)
        : scene(std::move(made)),
          script(script_of(scene)),
          scenery(scene.scenery),
          courses(scene, scene.input, scene.steps) {}
    Scene scene;
    Script script;
    Scenery scenery;
    ContinuousCourses courses;
  };

  void measure_error(Point& point) {
    const Level& level = *scenes_.at(point.dt);
    const Planning planning{.knobs = point.knobs};
    const ScalarKind scalar = point.row.scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64;
    point.contender = make_contender(point.row.contender, scalar, level.scene, level.scenery, planning);
    point.row.knob = point.contender->header().knob;
    ContinuousError error(level.courses.of(point.row.contender));
    InputCursor cursor(level.scene, level.script);
    std::vector<TraceStep> records(1);
    for (int step = 0; step < level.scene.steps; ++step) {
      records.front() = {};
      point.contender->step(cursor.at(step), records);
      const Vec2d made = records.front().path.back().position + records.front().remainder;
      if (!made.allFinite()) throw std::runtime_error(fmt::format("step {}: a position that is no number", step));
      error.add(made, level.courses.end(step));
    }
    point.row.steps = level.scene.steps;
    error.write(point.row);
  }

  [[nodiscard]] static bool same_curve(const Point& a, const Point& b) {
    return a.row.contender == b.row.contender && a.row.scalar == b.row.scalar && a.knob == b.knob;
  }

  [[nodiscard]] Row curve_of(const Point& first) const {
    std::vector<std::pair<double, double>> logs;
    bool on_front = false;
    for (const Point& point : points_) {
      if (!same_curve(point, first)) continue;
      on_front = on_front || point.row.on_front.value_or(false);
      if (point.row.error_max_m && *point.row.error_max_m > least_error)
        logs.emplace_back(std::log(point.value), std::log(*point.row.error_max_m));
    }
    Row row;
    row.scene = first.row.scene;
    row.contender = first.row.contender;
    row.scalar = first.row.scalar;
    row.mode = "work_precision";
    row.curve = first.knob;
    row.slope = slope_of(logs);
    if (first.row.ns_per_step) row.on_front = on_front;
    if (first.row.verdict == Verdict::not_applicable) {
      row.verdict = first.row.verdict;
      row.reason = first.row.reason;
    }
    return row;
  }

  const Motion& motion_;
  std::vector<Point> points_;
  std::map<double, std::unique_ptr<Level>> scenes_;
};

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
  WorkPrecision found;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(chosen.size()));
    MotionStudy study(*chosen[i], names);
    study.measure_errors();
    study.measure_costs_of_all();
    study.report(found);
  }
  return found;
}

}  // namespace paperproof::compare
