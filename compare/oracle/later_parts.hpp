/// What the later parts of a step add, where it goes in parts as what turns near it does.
#pragma once

#include "oracle/intent.hpp"
#include "records/trace.hpp"

namespace paperproof::compare::detail {

/// Where something turns, a character waits at the beginning of each part of a step, for less than this share of it.
inline constexpr double waited_in_part = 2e-6;

/// Each of n parts of a step falls and steers for its share of the time, so that `Wanted`, what the first of them would
/// come to in the whole step, is not what all of them want together. With v the velocity before the step and g gravity
/// the whole step falls
///
///     v dt + g dt² (n + 1) / (2 n),
///
/// in which the first part has v dt + g dt² / n; a fall that is limited falls less. How far later parts steer depends
/// on the ground of each: there is a range. All zero for a step in one part.
struct LaterParts {
  Vec2d velocity{Vec2d::Zero()};  ///< So much is added by the end of the step, but for steering [m/s].
  Vec2d way{Vec2d::Zero()};       ///< So far it leads in the step, but for steering [m].
  double slower = 0;              ///< Across up, steering adds no less than this by the end, which is not positive,
  double faster = 0;              ///< and no more than this [m/s].
  double most_steered = 0;        ///< The most that acceleration allows by the end [m/s].
  double asked = 0;               ///< The speed that steering ends at, across up, on ground at rest [m/s].
  double jump = 0;                ///< Up, a jump adds no more than this [m/s]: who lands may jump in the next part.
  double dt = 0;                  ///< Of the step [s].

  [[nodiscard]] bool any() const { return velocity != Vec2d::Zero() || slower < 0 || faster > 0; }
  /// The most that steering may add, whatever its direction [m/s].
  [[nodiscard]] double steered() const { return std::max(-slower, faster); }
  /// The way that a change of speed adds, at most: a speed that grows evenly adds half of what one adds that is there
  /// at once. @param change by the end of the step, not negative [m/s]. @return [m].
  [[nodiscard]] double steered_way(double change) const { return std::min(change * dt, most_steered * dt / 2); }
  /// The farthest that it leads, or that all parts lead away from an even straight way [m].
  [[nodiscard]] double bend() const { return way.norm() + steered_way(steered()); }
  /// What all parts want together, but for the steering of later ones.
  [[nodiscard]] Wanted whole(Wanted first) const {
    first.displacement += way;
    first.velocity += velocity;
    return first;
  }
};

[[nodiscard]] LaterParts later_parts(const TraceHeader& header, const TraceStep& step, const Wanted& first);

}  // namespace paperproof::compare::detail
