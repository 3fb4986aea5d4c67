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

  /// Those that a contender's motion may come to as its steps become short: Box2D has a law of its own, all others have
  /// that of design §4; of a peer either is right.
  [[nodiscard]] std::vector<const Courses*> of(std::string_view contender) const;
  /// When a step ends [s]. Before the first: 0.
  [[nodiscard]] double end(int step) const { return step < 0 ? 0 : times_.end(step); }

 private:
  StepTimes times_;
  Courses walking_;
  Courses frictionless_;
};

/// Of one run.
class ContinuousError {
 public:
  /// @param courses of them the one counts that the run stays nearest to; none: nothing is written.
  explicit ContinuousError(const std::vector<const Courses*>& courses = {});

  /// @param position at the end of a step, at a time [s].
  void add(const Vec2d& position, double time);
  /// @param from where a step that hangs begins. @param asked so far it wanted to fall [m]. @param begin, @param end of
  ///   the step [s].
  void add_hanging(const Vec2d& from, double asked, double begin, double end);
  /// Writes `error_max_m`, `error_rms_m`, `error_law_max_m` and `hanging_by_law`.
  void write(Row& row) const;

 private:
  struct Beside {
    const Courses* courses;
    double largest = 0;
    double largest_of_law = 0;
    double squares = 0;
    /// From the law of steps, or from the motion where there is none.
    [[nodiscard]] double off() const { return courses->steps ? largest_of_law : largest; }
  };

  std::vector<Beside> beside_;
  int count_ = 0;
  int hanging_by_law_ = 0;
};

}  // namespace paperproof::compare
