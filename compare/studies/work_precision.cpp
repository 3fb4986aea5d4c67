#include "studies/work_precision.hpp"

#include "runs/contestant.hpp"
#include "runs/cost.hpp"
#include "runs/input_cursor.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

namespace paperproof::compare {
namespace {

constexpr double half_height = 0.625;
constexpr double half_width = 0.3125;
/// Errors below this are rounding, and say nothing about a knob [m].
constexpr double least_error = 1e-9;
constexpr double usual_dt = 1.0 / 60;
constexpr std::array lengths{1.0 / 15, 1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};

/// A motion with its scene and where it is at a time.
struct Motion {
  KnownMotion known;
  double duration;  ///< [s]
  Scene (*make)();
  Vec2d (*at)(double time);
  bool law_of_box2d = true;  ///< A frictionless body goes the same way.
};

Scene still(const Vec2d& position, const Vec2d& velocity, double gravity) {
  Scene scene;
  scene.gravity = {0, -gravity};
  scene.start.position = position;
  scene.start.velocity = velocity;
  return scene;
}

void add(Scene& scene, std::string id, std::vector<Vec2d> points) {
  scene.ids.push_back(std::move(id));
  scene.scenery.colliders.push_back({.points = std::move(points)});
}

void add_box(Scene& scene, std::string id, double left, double bottom, double right, double top) {
  add(scene, std::move(id), {{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

constexpr double root_3 = 1.7320508075688772;
/// Of the slope of 60 degrees that is slid down: how far its surface is from the character's position, along the normal
/// (sin 60, cos 60). The left foot is on it: (-5, -20) px.
constexpr double slope_support = half_height / 4 * root_3 / 2 + half_height / 2;
constexpr double start_gap = 1e-6;

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all{
      {{"flight", "thrown at (3, 8) m/s under 10 m/s²: x = 3 t, y = 8 t - 5 t²"},
       1.5,
       [] {
         Scene scene = still({0, 0}, {3, 8}, 10);
         add_box(scene, "floor", -5, -31, 5, -30);
         return scene;
       },
       [](double t) { return Vec2d(3 * t, 8 * t - 5 * t * t); }},
      {{"rest", "falls 2 m under 10 m/s² and rests: y = max(2 - 5 t², 0) above the floor"},
       1.2,
       [] {
         Scene scene = still({0, 2 + half_height}, {0, 0}, 10);
         add_box(scene, "floor", -4, -1, 4, 0);
         return scene;
       },
       [](double t) { return Vec2d(0, half_height + std::max(2 - 5 * t * t, 0.0)); }},
      {{"slide", "slides down 60 degrees without friction from rest: 5 sin(60) t² along the slope"},
       1,
       [] {
         const Vec2d normal(root_3 / 2, 0.5);
         Scene scene = still(normal * (slope_support + start_gap), {0, 0}, 10);
         add(scene, "slope", {{-10, 10 * root_3}, {-10, -10 * root_3}, {10, -10 * root_3}});
         return scene;
       },
       [](double t) {
         const double along = 5 * root_3 / 2 * t * t;
         return Vec2d(root_3 / 2 * (slope_support + start_gap) + along / 2,
                      (slope_support + start_gap) / 2 - along * root_3 / 2);
       }},
      {{"corridor", "flies at (6, 2) m/s without gravity into a wall 2 m away and along it: x = min(6 t, 2), y = 2 t"},
       1.5,
       [] {
         Scene scene = still({0, 0}, {6, 2}, 0);
         add_box(scene, "wall", 2 + half_width, -10, 3 + half_width, 20);
         add_box(scene, "other_wall", -4, -10, -3, 20);
         return scene;
       },
       [](double t) { return Vec2d(std::min(6 * t, 2.0), 2 * t); }},
      {{"bullet", "flies down at 200 m/s onto a plate of 5 cm 10 m below: stops there"},
       0.3,
       [] {
         Scene scene = still({0, 10 + half_height}, {0, -200}, 0);
         add_box(scene, "plate", -4, -0.05, 4, 0);
         return scene;
       },
       [](double t) { return Vec2d(0, half_height + std::max(10 - 200 * t, 0.0)); }},
      {{"lift", "stands on a lift that rises at 1.5 m/s: y = 1.5 t"},
       1.5,
       [] {
         Scene scene = still({0, half_height + start_gap / 2}, {0, 0}, 10);
         add_box(scene, "lift", -2, -0.5, 2, 0);
         scene.scenery.colliders.back().mover = 0;
         scene.movers.push_back({.id = "lift", .path = {{.time = 0, .at = {0, 0}}, {.time = 4, .at = {0, 6}}}});
         return scene;
       },
       [](double t) { return Vec2d(0, half_height + start_gap / 2 + 1.5 * t); }},
      {{"walk", "walks at 4 m/s up 30 degrees: x = 4 t, y = x tan(30); a frictionless body would slow down"},
       1,
       [] {
         constexpr double support = 5.0 / 32;  // the right foot stands on it
         Scene scene = still({0, half_height + support / root_3 + start_gap}, {4, 4 / root_3}, 10);
         scene.character.walk_speed = 4;
         scene.input = {{.step = 0, .move = 1, .jump = std::nullopt}};
         add(scene, "slope", {{-10, -10 / root_3}, {10, -10 / root_3}, {10, 10 / root_3}});
         return scene;
       },
       [](double t) { return Vec2d(4 * t, half_height + 5.0 / 32 / root_3 + start_gap + 4 * t / root_3); },
       false},
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
  std::unique_ptr<Contestant> contestant;
  double time_ns = 0;  ///< Per second of motion.
};

Scene scene_of(const Motion& motion, double dt) {
  Scene scene = motion.make();
  scene.name = motion.known.name;
  scene.dt = dt;
  scene.steps = static_cast<int>(std::lround(motion.duration / dt));
  return scene;
}

void add_curves(const Motion& motion, const std::string& contender, std::vector<Point>& points) {
  const auto add = [&](const std::string& scalar, const std::string& knob, double value, double dt,
                       const std::vector<KnobSetting>& knobs) {
    Point point;
    point.row.scene = motion.known.name;
    point.row.contender = contender;
    point.row.scalar = scalar;
    point.row.mode = "work_precision";
    point.row.parameters.emplace_back("dt_s", dt);
    if (knob != "dt_s") point.row.parameters.emplace_back(knob, value);
    point.knob = knob;
    point.value = value;
    point.dt = dt;
    point.knobs = knobs;
    points.push_back(std::move(point));
  };
  const std::string scalar = is_reference(contender) ? "float" : "double";
  for (const double dt : lengths) add(scalar, "dt_s", dt, dt, {});
  if (contender == "octagon_sweep")
    for (const double dt : lengths) add("float", "dt_s", dt, dt, {});
  for (const int parts : {8, 16, 64, 128, 256})
    if (has_knob(contender, "unit"))
      add(scalar, "unit_m", 1.0 / parts, usual_dt, {{"unit", fmt::format("{}", 1.0 / parts)}});
  for (const int pixels : {8, 16, 64, 128, 256})
    if (has_knob(contender, "raster_pixels_per_metre"))
      add(scalar, "pixel_m", 1.0 / pixels, usual_dt, {{"raster_pixels_per_metre", std::to_string(pixels)}});
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
      if (!motion_.law_of_box2d && is_reference(point.row.contender)) {
        point.row.verdict = Verdict::not_applicable;
        point.row.reason = "a frictionless body follows another law here: its distance would be no error";
        continue;
      }
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
        if (point.dt != dt || !point.contestant || point.row.verdict == Verdict::failed) continue;
        timed.push_back(&point);
        runs.push_back({point.contestant.get(), {}});
      }
      if (runs.empty()) continue;
      const std::vector<Costs> costs = measure_costs(runs, level->scene, level->script, level->scene.steps);
      for (std::size_t i = 0; i < timed.size(); ++i) {
        Row& row = timed[i]->row;
        row.ns_per_step = costs[i].full.ns_per_step_min;
        row.ns_per_step_median = costs[i].full.ns_per_step_median;
        row.ns_per_step_max = costs[i].full.ns_per_step_max;
        timed[i]->time_ns = costs[i].full.ns_per_step_min / dt;
      }
    }
    for (Point& point : points_) point.contestant.reset();
    mark_front();
  }

  void report(WorkPrecision& found) {
    std::vector<std::pair<std::string, std::string>> curves;
    for (const Point& point : points_) {
      const std::pair key{point.row.contender + " " + point.row.scalar, point.knob};
      if (std::find(curves.begin(), curves.end(), key) == curves.end()) curves.push_back(key);
    }
    for (const auto& [who, knob] : curves) add_curve(who, knob, found);
    found.sentences.push_back(sentence());
    for (Point& point : points_) found.points.push_back(std::move(point.row));
  }

 private:
  struct Level {
    explicit Level(Scene made) : scene(std::move(made)), script(script_of(scene)), scenery(scene.scenery) {}
    Scene scene;
    Script script;
    Scenery<double> scenery;
  };

  void measure_error(Point& point) {
    const Level& level = *scenes_.at(point.dt);
    const Planning planning{.foreseen = foreseen_in(level.scene, level.script), .knobs = point.knobs};
    const ScalarKind scalar = point.row.scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64;
    point.contestant = make_contestant(point.row.contender, scalar, level.scene, level.scenery, planning);
    point.row.knob = point.contestant->header().knob;
    InputCursor cursor(level.scene, level.script);
    std::vector<TraceStep> records(1);
    double largest = 0;
    double squares = 0;
    for (int step = 0; step < level.scene.steps; ++step) {
      records.front() = {};
      point.contestant->step(cursor.at(step), records);
      const Vec2d made = records.front().path.back().position + records.front().remainder;
      const double error = (made - motion_.at((step + 1) * point.dt)).norm();
      if (!std::isfinite(error)) throw std::runtime_error(fmt::format("step {}: a position that is no number", step));
      largest = std::max(largest, error);
      squares += error * error;
    }
    point.row.steps = level.scene.steps;
    point.row.error_max_m = largest;
    point.row.error_rms_m = std::sqrt(squares / level.scene.steps);
  }

  [[nodiscard]] static bool counts(const Point& point) { return point.row.error_max_m && point.row.ns_per_step; }

  void mark_front() {
    for (Point& point : points_) {
      if (!counts(point)) continue;
      point.row.on_front = std::none_of(points_.begin(), points_.end(), [&](const Point& other) {
        return counts(other) && *other.row.error_max_m <= *point.row.error_max_m && other.time_ns <= point.time_ns &&
               (*other.row.error_max_m < *point.row.error_max_m || other.time_ns < point.time_ns);
      });
    }
  }

  void add_curve(const std::string& who, const std::string& knob, WorkPrecision& found) const {
    std::vector<std::pair<double, double>> logs;
    const Point* first = nullptr;
    for (const Point& point : points_) {
      if (point.row.contender + " " + point.row.scalar != who || point.knob != knob) continue;
      if (first == nullptr) first = &point;
      if (point.row.error_max_m && *point.row.error_max_m > least_error)
        logs.emplace_back(std::log(point.value), std::log(*point.row.error_max_m));
    }
    Row row;
    row.scene = first->row.scene;
    row.contender = first->row.contender;
    row.scalar = first->row.scalar;
    row.mode = "work_precision";
    row.curve = knob;
    row.slope = slope_of(logs);
    if (first->row.verdict == Verdict::not_applicable) {
      row.verdict = first->row.verdict;
      row.reason = first->row.reason;
    }
    found.curves.push_back(std::move(row));
  }

  [[nodiscard]] std::string sentence() const {
    std::vector<std::string> front;
    const Point* best = nullptr;
    for (const Point& point : points_) {
      if (point.row.contender == "octagon_sweep" && point.row.scalar == "double" && counts(point) &&
          (best == nullptr || *point.row.error_max_m < *best->row.error_max_m))
        best = &point;
      const std::string who = point.row.contender + (point.row.scalar == "float" ? " (float)" : "");
      if (point.row.on_front.value_or(false) && std::find(front.begin(), front.end(), who) == front.end())
        front.push_back(who);
    }
    std::string text = fmt::format("{}: on the front are {}.", motion_.known.name, fmt::join(front, ", "));
    if (best == nullptr || std::find(front.begin(), front.end(), "octagon_sweep") != front.end()) return text;
    const Point* better = nullptr;
    for (const Point& point : points_)
      if (counts(point) && *point.row.error_max_m <= *best->row.error_max_m && point.time_ns < best->time_ns &&
          (better == nullptr || point.time_ns < better->time_ns))
        better = &point;
    if (better == nullptr) return text;
    return text + fmt::format(
                      " octagon_sweep is not: where its error is least, {:.2g} m, {} has {:.2g} m in {:.0f} % of the "
                      "time.",
                      *best->row.error_max_m, better->row.contender, *better->row.error_max_m,
                      100 * better->time_ns / best->time_ns);
  }

  const Motion& motion_;
  std::vector<Point> points_;
  std::map<double, std::unique_ptr<Level>> scenes_;
};

}  // namespace

std::span<const KnownMotion> known_motions() {
  static const std::vector<KnownMotion> all = [] {
    std::vector<KnownMotion> known;
    for (const Motion& motion : motions()) known.push_back(motion.known);
    return known;
  }();
  return all;
}

WorkPrecision study_work_precision(const std::vector<std::string>& wanted, const std::vector<std::string>& contenders,
                                   const std::function<void(double)>& progress) {
  std::vector<const Motion*> chosen;
  for (const std::string& name : wanted) {
    const auto found = std::find_if(motions().begin(), motions().end(),
                                    [&](const Motion& motion) { return motion.known.name == name; });
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

std::optional<double> slope_of(std::span<const std::pair<double, double>> log_points) {
  if (log_points.size() < 2) return std::nullopt;
  double x = 0;
  double y = 0;
  for (const auto& point : log_points) {
    x += point.first / static_cast<double>(log_points.size());
    y += point.second / static_cast<double>(log_points.size());
  }
  double above = 0;
  double below = 0;
  for (const auto& point : log_points) {
    above += (point.first - x) * (point.second - y);
    below += (point.first - x) * (point.first - x);
  }
  return below > 0 ? std::optional(above / below) : std::nullopt;
}

}  // namespace paperproof::compare
