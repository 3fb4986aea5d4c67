/// How far the runs of a scene are from continuous motion.
#pragma once

#include "continuous/course.hpp"
#include "records/row.hpp"
#include "scenes/step_times.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// The exact courses of a law, rounded; each is absent where the reference has no law for the scene.
struct Courses {
  std::optional<continuous::Course<double>> motion;
  std::optional<continuous::Course<double>> steps;  ///< By the law of steps.
};

/// Those of a scene: of octagon_sweep's law, and of Box2D's.
class ContinuousCourses {
 public:
  /// @param input of the scene's only character. @param steps that run.
  ContinuousCourses(const Scene& scene, const std::vector<InputEvent>& input, int steps);

  /// That which a contender's motion comes to as its steps become short: Box2D has a law of its own, all others have
  /// that of design §4.
  [[nodiscard]] const Courses& of(std::string_view contender) const;
  /// When a step ends [s].
  [[nodiscard]] double end(int step) const { return times_.end(step); }

 private:
  StepTimes times_;
  Courses walking_;
  Courses frictionless_;
};

/// Of one run.
class ContinuousError {
 public:
  /// @param courses null: nothing is written.
  explicit ContinuousError(const Courses* courses = nullptr) : courses_(courses) {}

  /// @param position at the end of a step, at a time [s].
  void add(const Vec2d& position, double time);
  /// Writes `error_max_m`, `error_rms_m` and `error_law_max_m`.
  void write(Row& row) const;

 private:
  const Courses* courses_;
  double largest_ = 0;
  double largest_of_law_ = 0;
  double squares_ = 0;
  int count_ = 0;
};

}  // namespace paperproof::compare
