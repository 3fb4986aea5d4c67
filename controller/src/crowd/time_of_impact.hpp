/// The time of impact of two characters that follow polylines.
#pragma once

#include "crowd/pair_space.hpp"

#include <paperproof/report.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace paperproof::crowd {

/// Corners in order of time. Fractions are those of the step; two equal ones in a row are a leg that takes no time (out
/// of a solid, down to the ground).
using Path = std::span<const PathPoint>;

struct Impact {
  bool happens = false;             ///< The rest is valid only where it is true.
  double stop = 0;                  ///< When both are stopped, as a fraction of the step.
  double time = 0;                  ///< Time of impact, likewise, at most 1.
  Vec2d normal{Vec2d::Zero()};      ///< Unit, from the second towards the first.
  Vec2d first_rate{Vec2d::Zero()};  ///< Velocity of the first then, in metres per step.
  Vec2d second_rate{Vec2d::Zero()};
  /// One of them moves on a leg that takes no time: its rate is the length of that leg, and the other's is zero.
  bool instant = false;
};

/// The position at a time on the leg that begins at corner `k`, or before it [m].
[[nodiscard]] inline Vec2d position_on_leg(Path path, std::size_t k, double time) noexcept {
  const PathPoint& from = path[k];
  if (k + 1 == path.size() || time <= from.fraction) return from.position;
  const PathPoint& to = path[k + 1];
  if (time >= to.fraction) return to.position;
  return from.position + (to.position - from.position) * ((time - from.fraction) / (to.fraction - from.fraction));
}

/// A position that only goes forward along a path.
class PathCursor {
 public:
  /// At `time`, before the legs that take no time then.
  PathCursor(Path path, double time) noexcept : path_(path) {
    while (leg_end() < time) ++corner_;
    position_ = position_on_leg(path_, corner_, time);
    rounded_ = is_between_corners(time);
  }
  [[nodiscard]] bool at_end() const noexcept { return corner_ + 1 >= path_.size(); }
  /// Fraction of the step; infinity at the end.
  [[nodiscard]] double leg_end() const noexcept {
    return at_end() ? std::numeric_limits<double>::infinity() : path_[corner_ + 1].fraction;
  }
  [[nodiscard]] bool leg_takes_no_time() const noexcept { return !at_end() && path_[corner_].fraction == leg_end(); }

  [[nodiscard]] Leg stay() const noexcept { return {.from = position_, .to = position_}; }
  /// @param time at most `leg_end()`.
  [[nodiscard]] Leg advance_to(double time) noexcept {
    const bool ends_leg = leg_end() <= time;
    const bool ends_rounded = is_between_corners(time);
    const Leg leg{.from = position_,
                  .to = ends_leg ? path_[corner_ + 1].position : position_on_leg(path_, corner_, time),
                  .rounded = rounded_ || ends_rounded};
    position_ = leg.to;
    rounded_ = ends_rounded;
    if (ends_leg) ++corner_;
    return leg;
  }

 private:
  [[nodiscard]] bool is_between_corners(double time) const noexcept {
    return !at_end() && time > path_[corner_].fraction && time < leg_end() &&
           path_[corner_].position != path_[corner_ + 1].position;
  }

  Path path_;
  std::size_t corner_ = 0;
  Vec2d position_{Vec2d::Zero()};
  bool rounded_ = false;
};

/// @param begin,end of both legs, as fractions of the step.
[[nodiscard]] inline Impact impact_of(const PairSweep& sweep, const Leg& first, const Leg& second, double begin,
                                      double end) noexcept {
  const bool instant = !(end > begin);
  const double duration = instant ? 1.0 : end - begin;
  return {.happens = true,
          .stop = begin + (end - begin) * sweep.stop,
          .time = std::min(begin + (end - begin) * sweep.impact, 1.0),
          .normal = sweep.normal,
          .first_rate = (first.to - first.from) / duration,
          .second_rate = (second.to - second.from) / duration,
          .instant = instant};
}

/// The first impact from a time on: see `PairSpace::sweep`. Between corners the relative motion is straight. Legs that
/// take no time are made one after the other, those of the first path first. Each round ends a leg.
[[nodiscard]] inline Impact first_impact(const PairSpace& space, Path first_path, Path second_path, double from,
                                         double hit_distance, const UpFrame& up) noexcept {
  PathCursor first(first_path, from);
  PathCursor second(second_path, from);
  double now = from;
  while (!first.at_end() || !second.at_end()) {
    Leg first_leg = first.stay();
    Leg second_leg = second.stay();
    double next = now;
    if (first.leg_takes_no_time()) {
      first_leg = first.advance_to(first.leg_end());
    } else if (second.leg_takes_no_time()) {
      second_leg = second.advance_to(second.leg_end());
    } else {
      next = std::min(first.leg_end(), second.leg_end());
      first_leg = first.advance_to(next);
      second_leg = second.advance_to(next);
    }
    const PairSweep sweep = space.sweep(first_leg, second_leg, hit_distance, up);
    if (sweep.hits) return impact_of(sweep, first_leg, second_leg, now, next);
    now = next;
  }
  return {};
}

}  // namespace paperproof::crowd
