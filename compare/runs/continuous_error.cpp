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

std::optional<continuous::Course<double>> course_of(const Scene& scene, const std::vector<InputEvent>& input,
                                                    continuous::Law law) {
  try {
    return continuous::rounded(continuous::course_of<continuous::Number<50>>(scene, input, law));
  } catch (const continuous::NotCovered&) {
    return std::nullopt;
  }
}

}  // namespace

ContinuousCourses::ContinuousCourses(const Scene& scene, const std::vector<InputEvent>& input, int steps)
    : times_(scene) {
  if (!is_small(scene)) return;
  Scene run = scene;
  run.steps = steps;
  walking_ = course_of(run, input, continuous::Law::octagon_sweep);
  frictionless_ = course_of(run, input, continuous::Law::frictionless);
}

const continuous::Course<double>* ContinuousCourses::of(std::string_view contender) const {
  const std::optional<continuous::Course<double>>& course = is_reference(contender) ? frictionless_ : walking_;
  return course ? &*course : nullptr;
}

void ContinuousError::add(const Vec2d& position, double time) {
  if (course_ == nullptr) return;
  const double error = (position - course_->at(time)).norm();
  largest_ = std::max(largest_, error);
  squares_ += error * error;
  ++count_;
}

void ContinuousError::write(Row& row) const {
  if (count_ == 0) return;
  row.error_max_m = largest_;
  row.error_rms_m = std::sqrt(squares_ / count_);
}

}  // namespace paperproof::compare
