/// Whether the way of a step is made with the velocities that the step had.
#pragma once

#include "oracle/later_parts.hpp"
#include "oracle/step_view.hpp"

namespace paperproof::compare::detail {

/// How many stairs a walk climbs, at most 4: in the step it came to a face that stops it, too steep to walk on; a leg
/// goes straight up by no more than `step_height`, the next one takes no time, and after a third it is farther and
/// higher than it was; and the step ends on ground.
[[nodiscard]] int stairs_climbed(const StepView& at, const Wanted& wanted);

/// What is wrong with the legs of a step; zeros where nothing is.
struct LegFaults {
  /// It is known how fast all goes that is near: how a disc turns that is no scene's is not in a trace.
  bool knows_speeds = true;
  double way_gained = 0;    ///< So much longer the way is, in one direction, than anything made it [m],
  double speed_gained = 0;  ///< and so much faster [m/s]: where the speeds are known.
  /// How far the way leads beyond what the velocities of the step make of it, in the world [m]. Zero where something
  /// moves the character at once, of a stair, a snap, and a step that drops motion or goes in parts.
  Vec2d crept{Vec2d::Zero()};
  /// How far the last leg that takes time ends from where the velocity at the end of the step leads it [m]: what
  /// turns there may take it elsewhere by as much as its velocity is not known. Zero where something is met after the
  /// leg has begun, of a stair, a snap, a crush, and a step that drops motion or goes in parts.
  double end_error = 0;
  /// How far a leg ends from where the law leads it [m]. Zero of a step in parts, of one that drops motion or climbs a
  /// stair, and beside what pushes or turns.
  double leg_error = 0;
};

/// Holds the way of one step, leg by leg, against the law of motion, for a contender that promises it.
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
/// @param held it is stuck in what it begins inside of, so that it wants to go nowhere. @param begin the leg that is
/// looked at first. @param as_law the law of motion tells where each leg leads, and not only how far.
[[nodiscard]] LegFaults leg_faults(const StepView& at, const Wanted& wanted, const LaterParts& later, bool held,
                                   std::size_t begin, bool as_law);

}  // namespace paperproof::compare::detail
