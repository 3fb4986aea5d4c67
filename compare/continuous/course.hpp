/// The second reference (design §8): the motion that contenders' steps come to as they become short.
///
/// It goes from event to event: on each arc the acceleration is constant, so that the way is a parabola, and what ends
/// the arc is the least root of a linear or quadratic equation in closed form: an impact, the end of a surface, the
/// wanted speed, the greatest speed of falling, the top of a rise under a ceiling, a waypoint of a mover, an event of
/// the input. Nothing is stepped. Numbers have 30, 50 or 70 decimal digits: that results agree, to more digits the
/// more there are, is how it shows that rounding decides nothing. It shares no code with the controller, and none with
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
template <class Real>
struct Arc {
  Real begin{0};  ///< [s]
  Point<Real> place;
  Point<Real> velocity;
  Point<Real> acceleration;
  bool stands = false;
};

/// A velocity that changed at once, at a surface.
template <class Real>
struct Impact {
  Real time{0};  ///< [s]
  ColliderIndex collider = 0;
  Point<Real> before;  ///< Velocity [m/s].
  Point<Real> after;
};

template <class Real>
class Course {
 public:
  /// Where the character is. Times beyond the end are those of the last arc.
  [[nodiscard]] Point<Real> place_at(const Real& time) const;
  [[nodiscard]] Point<Real> velocity_at(const Real& time) const;
  /// The same, rounded.
  [[nodiscard]] Vec2d at(double time) const;

  std::vector<Arc<Real>> arcs;        ///< At least one.
  std::vector<Impact<Real>> impacts;  ///< In order of time; in steps without those at their beginnings.

 private:
  [[nodiscard]] const Arc<Real>& arc_at(const Real& time) const;
};

/// @param input what the character wants, by steps of the scene.
/// @throws NotCovered for: more than one character; gravity that is not straight down; one-way chains, conveyors,
///   circles and dropping through; coyote time, buffers and cuts of jumps; bodies and movers that turn; `snap`,
///   `step_height` and the article's rules for jumps; a start inside a solid; a map that is left; movers that are met
///   by anything but their walkable side, that meet the character between them and something else, or that fall faster
///   than the character; ground that the acceleration of the ground holds and that of the air does not; more than
///   20,000 events.
template <class Real>
[[nodiscard]] Course<Real> course_of(const Scene& scene, const std::vector<InputEvent>& input, Law law,
                                     Time time = Time::continuous);

/// The same in double: places are within an ulp of their coordinates, times the number of roundings in a parabola.
template <class Real>
[[nodiscard]] Course<double> rounded(const Course<Real>& course);

extern template class Course<double>;
extern template class Course<Number<30>>;
extern template class Course<Number<50>>;
extern template class Course<Number<70>>;

}  // namespace paperproof::compare::continuous
