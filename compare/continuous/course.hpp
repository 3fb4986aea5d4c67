/// The second reference (design §8): the motion that contenders' steps come to as they become short.
///
/// It goes from event to event: on each arc the acceleration is constant, so that the way is a parabola, and what ends
/// the arc is the least root of a linear or quadratic equation in closed form: an impact, the end of a surface, the
/// wanted speed, the greatest speed of falling, the top of a rise under a ceiling, a waypoint of a mover, an event of
/// the input. Nothing is stepped. Numbers have 50 decimal digits. It shares no code with the controller, and none with
/// the exact judge.
///
/// The same solver goes by the exact law of steps (design §4), so that the error of steps and that of a contender's
/// collision are told apart: forces act at once as a step begins, and in between nothing accelerates. Movers go
/// straight between their places at the ends of steps.
///
/// What acts on arcs and at events is in continuous/law.hpp.
#pragma once

#include "continuous/law.hpp"
#include "scenes/scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof::compare::continuous {

enum class Time : std::uint8_t {
  continuous,
  in_steps,  ///< Those of the scene.
};

/// A scene or a moment that the reference has no law for; `what()` says which, in words.
class NotCovered : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From one event to the next.
template <class Number>
struct Arc {
  Number begin{0};  ///< [s]
  Eigen::Matrix<Number, 2, 1> place;
  Eigen::Matrix<Number, 2, 1> velocity;
  Eigen::Matrix<Number, 2, 1> acceleration;
};

template <class Number>
struct Course {
  std::vector<Arc<Number>> arcs;  ///< At least one.
  int impacts = 0;  ///< Velocities that changed at once, at a surface; in steps without those at their beginnings.

  /// Where the character is. Times beyond the end are those of the last arc.
  [[nodiscard]] Eigen::Matrix<Number, 2, 1> place_at(const Number& time) const {
    const auto after = std::ranges::upper_bound(arcs, time, {}, &Arc<Number>::begin);
    const Arc<Number>& arc = after == arcs.begin() ? arcs.front() : *(after - 1);
    const Number t = time - arc.begin;
    return arc.place + arc.velocity * t + arc.acceleration * Number(t * t / 2);
  }
};

/// @param input what the character wants, by steps of the scene.
/// @throws NotCovered for: more than one character; gravity that is not straight down; one-way chains, conveyors,
///   circles and dropping through; coyote time, buffers and cuts of jumps; bodies and movers that turn; `snap`,
///   `step_height` and the article's rules for jumps; a start inside a solid; a map that is left; movers that are met
///   by anything but their walkable side, that meet the character between them and something else, or that fall faster
///   than the character; ground that the acceleration of the ground holds and that of the air does not; more than
///   20,000 events.
[[nodiscard]] Course<Real> course_of(const Scene& scene, const std::vector<InputEvent>& input, Law law,
                                     Time time = Time::continuous);

/// The same in double: places are within an ulp of their coordinates, times the number of roundings in a parabola.
[[nodiscard]] Course<double> rounded(const Course<Real>& course);

}  // namespace paperproof::compare::continuous
