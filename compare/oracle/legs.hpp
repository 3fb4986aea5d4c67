/// Whether the way of a step is made with the velocities that the step had.
#pragma once

#include "oracle/crush.hpp"
#include "oracle/later_parts.hpp"
#include "oracle/met_surfaces.hpp"

namespace paperproof::compare::detail {

/// The parts of solids and of other characters within so many metres of a corner of the way.
[[nodiscard]] std::vector<NearPart> parts_near(const ExactScenery& scenery, const TraceStep& step, const Others& others,
                                               std::size_t corner, double within);

/// How many stairs a walk climbs, at most 4: beside a face that stops it, too steep to walk on, a leg goes straight up
/// by no more than `step_height`, the next one takes no time, and the step ends on ground.
[[nodiscard]] int stairs_climbed(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step,
                                 const Others& others, const Wanted& wanted);

/// Holds the way of one step, leg by leg, against the law of motion, for a contender that promises it. Lives for one
/// step.
///
/// **Bounds.** `controlled_bounds` gives the velocities that a step can have: of what is wanted, at all that comes
/// within `contact_reach` of the way. At the end it has one of them. No leg goes farther in any of the four directions,
/// along and across up, than its share of the time at these. What all legs together go farther is no more than the
/// rules allow that move a character at once, each in its own direction: the gap is restored by 2e-6 m and, on a leg
/// that aims at it, by 1e-6 m, along the normal of what is near; ground that hardly bends is followed by 2.8e-6 m, and
/// at the end by `snap` where a walk may, straight down; a walk climbs 4 stairs, up and down by `step_height` each, and
/// goes on as it wanted in between; and what comes against the character and touches it pushes it as far as it goes
/// itself, and by `push_beyond_motion` more towards something that looks at it. Other characters do that by no more
/// than they want themselves, or hand on (`Others`).
///
/// **Direction.** While nothing that moves is near, each leg leads along the wanted motion, or what the law of response
/// makes of it at the contacts that the way has come to by then: what is steered into a wall goes nowhere else.
class LegJudge {
 public:
  LegJudge(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step, const Wanted& wanted,
           const Others& others, const LaterParts& later);

  /// How much longer the way is than anything made it [m].
  /// @param first the leg that is looked at first. @param held it is stuck, so that it wants to go nowhere.
  [[nodiscard]] double way_gained(std::size_t first, bool held) const;
  /// How much faster it is, in one direction, than anything made it [m/s].
  [[nodiscard]] double speed_gained(bool held) const;
  /// How far a leg ends from where the law leads it [m]. Not of a step in parts, nor of one that drops motion.
  [[nodiscard]] double leg_error() const;

 private:
  [[nodiscard]] std::vector<NearPart> near(std::size_t corner, double within) const {
    return parts_near(scenery_, step_, others_, corner, within);
  }
  [[nodiscard]] ControlledRange wanted_velocities() const;
  [[nodiscard]] const std::vector<MetSurface>& surfaces() const;
  [[nodiscard]] Box2<double> velocities(bool held, std::span<const MetSurface> surfaces) const;
  [[nodiscard]] double farther(std::size_t first, bool held, const Box2<double>& speeds, double push) const;
  [[nodiscard]] double pushed() const;
  [[nodiscard]] bool is_beside_what_moves() const;
  [[nodiscard]] double rounding() const;
  [[nodiscard]] double snapped() const;
  [[nodiscard]] bool is_pushed() const;
  [[nodiscard]] bool is_squeezed() const;

  const TraceHeader& header_;
  const ExactScenery& scenery_;
  const TraceStep& step_;
  const Wanted& first_;  ///< By the first part of the step.
  const Wanted wanted_;  ///< By all parts of the step, but for what later ones steer.
  const Others& others_;
  const LaterParts& later_;
  Vec2d up_;
  Vec2d right_;
  double dt_;                                                ///< [s]
  mutable std::optional<std::vector<MetSurface>> surfaces_;  ///< Asked for once.
};

}  // namespace paperproof::compare::detail
