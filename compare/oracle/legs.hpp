/// Whether the way of a step is made with the velocities that the step had.
#pragma once

#include "oracle/crush.hpp"
#include "oracle/later_parts.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/response_laws.hpp"

#include <map>

namespace paperproof::compare::detail {

/// The parts of solids within so many metres of a corner of the way.
[[nodiscard]] std::vector<NearPart> parts_near(const ExactScenery& scenery, const TraceStep& step,
                                               const WhatTurns& turns, std::size_t corner, double within);

/// How deep the character is in parts, together [m].
[[nodiscard]] double depth_in(std::span<const NearPart> parts);

/// Who begins inside of what turns is put aside by at most so many times the depth.
inline constexpr double most_of_depth = 4;

/// How many stairs a walk climbs, at most 4: in the step it came to a face that stops it, too steep to walk on; a leg
/// goes straight up by no more than `step_height`, the next one takes no time, and after a third it is farther and
/// higher than it was; and the step ends on ground.
[[nodiscard]] int stairs_climbed(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step,
                                 const WhatTurns& turns, const Wanted& wanted);

/// Holds the way of one step, leg by leg, against the law of motion, for a contender that promises it. Lives for one
/// step.
///
/// **Bounds.** `controlled_bounds` gives the velocities that the step can have at all surfaces within `contact_reach`
/// of its way. The velocity at the end is one of them. In each of four directions, along and across up, no leg is
/// longer than its share of the time at these velocities. Some rules move a character at once. All legs together are
/// longer by no more than these rules allow, each in its own direction:
/// - The gap is restored by 2e-6 m, and by 1e-6 m for each surface near the way, along the normals.
/// - Ground that hardly bends is followed by 2.8e-6 m, straight down. A walk follows ground by `snap`.
/// - A walk climbs at most 4 stairs, each up and down by `step_height`, and goes on to where it would have come.
/// - What moves and touches the character pushes it as far as the law of response has it pushed that wants nothing;
///   where two surfaces hold it, at most `push_beyond_motion` farther than they go. Where they leave it no motion it
///   goes as far to any free place, and not where its velocity leads.
///
/// **Direction.** While nothing near comes against it, or turns, each leg leads along the wanted motion, or what the
/// law of response makes of it at the contacts that the way has come to by then: what is steered into a wall goes
/// nowhere else.
class LegJudge {
 public:
  /// @param held it is stuck in what it begins inside of, so that it wants to go nowhere.
  LegJudge(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step, const Wanted& wanted,
           const WhatTurns& turns, const LaterParts& later, bool held);

  /// Whether it is known how fast all goes that is near: how a disc turns that is no scene's is not in a trace.
  [[nodiscard]] bool knows_speeds() const;
  /// How much longer the way is, in one direction, than anything made it [m].
  /// @param first the leg that is looked at first.
  [[nodiscard]] double way_gained(std::size_t first) const;
  /// How much faster it is, in one direction, than anything made it [m/s].
  [[nodiscard]] double speed_gained() const;
  /// How far the way leads beyond what the velocities of the step make of it, in the world [m]. Zero where something
  /// moves the character at once, of a stair, a snap, and a step that drops motion or goes in parts.
  [[nodiscard]] Vec2d crept() const;
  /// How far the last leg that takes time ends from where the velocity at the end of the step leads it [m]: what
  /// turns there may take it elsewhere by as much as its velocity is not known. Zero where something is met after the
  /// leg has begun, of a stair, a snap, a crush, and a step that drops motion or goes in parts.
  [[nodiscard]] double end_error() const;
  /// How far a leg ends from where the law leads it [m]. Zero of a step in parts, of one that drops motion or climbs a
  /// stair, and beside what pushes or turns.
  [[nodiscard]] double leg_error() const;

 private:
  [[nodiscard]] std::vector<NearPart> near(std::size_t corner, double within) const {
    return parts_near(scenery_, step_, turns_, corner, within);
  }
  [[nodiscard]] ControlledRange wanted_velocities(const Vec2d& carried) const;
  [[nodiscard]] std::vector<MetSurface> near_surfaces() const;
  [[nodiscard]] Box2 velocities(std::span<const MetSurface> surfaces, const Vec2d& carried) const;
  [[nodiscard]] Box2 asked(std::span<const MetSurface> surfaces) const;
  [[nodiscard]] double farther(std::size_t first, const Box2& speeds, const Box2& push) const;
  [[nodiscard]] Vec2d own_carrier() const;
  [[nodiscard]] std::map<ColliderIndex, double> pushes() const;
  [[nodiscard]] double most_pushed() const;
  [[nodiscard]] double pushed_too_far(std::size_t first, double wanted) const;
  [[nodiscard]] bool must_evade() const;
  [[nodiscard]] bool is_moved_at_once() const;
  [[nodiscard]] bool goes_by_law() const;
  [[nodiscard]] double room_at(std::size_t surfaces) const;
  [[nodiscard]] double rounding() const;
  [[nodiscard]] double snapped() const;
  [[nodiscard]] double waited() const;
  [[nodiscard]] bool is_pushed() const;

  const TraceHeader& header_;
  const ExactScenery& scenery_;
  const TraceStep& step_;
  const Wanted& first_;  ///< By the first part of the step.
  const Wanted wanted_;  ///< By all parts of the step, but for what later ones steer.
  const WhatTurns& turns_;
  const LaterParts& later_;
  Vec2d up_;
  Vec2d right_;
  double dt_;  ///< [s]
  bool held_;
  const int stairs_;                        ///< See `stairs_climbed`.
  const std::vector<MetSurface> surfaces_;  ///< All that is near the way, as an upright character sees it.
  const Box2 speeds_;                       ///< What the step may have at them, across and along up [m/s].
};

}  // namespace paperproof::compare::detail
