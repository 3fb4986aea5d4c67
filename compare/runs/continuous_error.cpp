#include "runs/continuous_error.hpp"

#include "runs/contender.hpp"
#include "runs/peers.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// A scene of more corners is left without: each facet is made with 50 digits, at some ten microseconds.
constexpr std::size_t most_corners = 20000;

/// So near to an exact course [m] it is there: the largest skin and Box2D's slop.
constexpr double near_course = 0.025;
/// Who falls less than this share of what is wanted hangs, as the judge has it.
constexpr double least_share = 0.5;

Courses courses_of(const Scene& scene, const std::vector<InputEvent>& input, continuous::Law law) {
  const auto course = [&](continuous::Time time) -> std::optional<continuous::Course<double>> {
    try {
      return continuous::rounded(continuous::course_of(scene, input, law, time));
    } catch (const continuous::NotCovered&) {
      return std::nullopt;
    }
  };
  return {course(continuous::Time::continuous), course(continuous::Time::in_steps)};
}

}  // namespace

ContinuousCourses::ContinuousCourses(const Scene& scene, const std::vector<InputEvent>& input, int steps)
    : times_(scene) {
  std::size_t corners = 0;
  for (const ColliderDef& collider : scene.scenery.colliders) corners += collider.points.size();
  if (corners > most_corners) return;
  Scene run = scene;
  run.steps = steps;
  walking_ = courses_of(run, input, continuous::Law::octagon_sweep);
  frictionless_ = courses_of(run, input, continuous::Law::frictionless);
}

std::vector<const Courses*> ContinuousCourses::of(std::string_view contender) const {
  if (find_peer(contender) != nullptr) return {&walking_, &frictionless_};
  return {is_reference(contender) ? &frictionless_ : &walking_};
}

ContinuousError::ContinuousError(const std::vector<const Courses*>& courses) {
  for (const Courses* one : courses) beside_.push_back({one});
}

void ContinuousError::add(const Vec2d& position, double time) {
  ++count_;
  const auto from = [&](const continuous::Course<double>& course) { return (position - course.place_at(time)).norm(); };
  for (Beside& one : beside_) {
    if (one.courses->steps) one.largest_of_law = std::max(one.largest_of_law, from(*one.courses->steps));
    if (!one.courses->motion) continue;
    const double error = from(*one.courses->motion);
    one.largest = std::max(one.largest, error);
    one.squares += error * error;
  }
}

void ContinuousError::add_hanging(const Vec2d& from, double asked, double begin, double end) {
  hanging_by_law_ += std::ranges::any_of(beside_, [&](const Beside& one) {
    if (!one.courses->steps) return false;
    const Vec2d there = one.courses->steps->place_at(begin);
    const double fell = there.y() - one.courses->steps->place_at(end).y();
    return (from - there).norm() <= near_course && fell < least_share * asked;
  });
}

void ContinuousError::write(Row& row) const {
  if (hanging_by_law_ > 0) row.hanging_by_law = hanging_by_law_;
  const auto nearest = std::ranges::min_element(beside_, {}, &Beside::off);
  if (count_ == 0 || nearest == beside_.end()) return;
  if (nearest->courses->steps) row.error_law_max_m = nearest->largest_of_law;
  if (!nearest->courses->motion) return;
  row.error_max_m = nearest->largest;
  row.error_rms_m = std::sqrt(nearest->squares / count_);
}

}  // namespace paperproof::compare
