#include "runs/continuous_error.hpp"

#include "runs/contender.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// A scene of more corners is left without: each facet is made with 50 digits, at some ten microseconds.
constexpr std::size_t most_corners = 20000;

bool is_small(const Scene& scene) {
  std::size_t corners = 0;
  for (const ColliderDef& collider : scene.scenery.colliders) corners += collider.points.size();
  return corners <= most_corners;
}

Courses courses_of(const Scene& scene, const std::vector<InputEvent>& input, continuous::Law law) {
  const auto course = [&](continuous::Time time) -> std::optional<continuous::Course<double>> {
    try {
      return continuous::rounded(continuous::course_of<continuous::Number<50>>(scene, input, law, time));
    } catch (const continuous::NotCovered&) {
      return std::nullopt;
    }
  };
  return {course(continuous::Time::continuous), course(continuous::Time::in_steps)};
}

}  // namespace

ContinuousCourses::ContinuousCourses(const Scene& scene, const std::vector<InputEvent>& input, int steps)
    : times_(scene) {
  if (!is_small(scene)) return;
  Scene run = scene;
  run.steps = steps;
  walking_ = courses_of(run, input, continuous::Law::octagon_sweep);
  frictionless_ = courses_of(run, input, continuous::Law::frictionless);
}

const Courses& ContinuousCourses::of(std::string_view contender) const {
  return is_reference(contender) ? frictionless_ : walking_;
}

void ContinuousError::add(const Vec2d& position, double time) {
  if (courses_ == nullptr) return;
  ++count_;
  const auto from = [&](const continuous::Course<double>& course) { return (position - course.at(time)).norm(); };
  if (courses_->steps) largest_of_law_ = std::max(largest_of_law_, from(*courses_->steps));
  if (!courses_->motion) return;
  const double error = from(*courses_->motion);
  largest_ = std::max(largest_, error);
  squares_ += error * error;
}

void ContinuousError::write(Row& row) const {
  if (count_ == 0) return;
  if (courses_->steps) row.error_law_max_m = largest_of_law_;
  if (!courses_->motion) return;
  row.error_max_m = largest_;
  row.error_rms_m = std::sqrt(squares_ / count_);
}

}  // namespace paperproof::compare
