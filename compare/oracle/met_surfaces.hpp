/// What a step met, from its trace: surfaces, how they move, and when they were left.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/intent.hpp"
#include "oracle/met_surface.hpp"
#include "records/trace.hpp"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace paperproof::compare {

/// Whether the law walks on ground with this unit normal. The law has an edge here: ground that is steeper than the
/// climb limit by 1e-8 rad (float: 1e-5) is walked on still, and what is steeper is not (§4 of the design;
/// `Tolerances::climb`).
[[nodiscard]] bool is_walked_on(const Vec2d& normal, const TraceHeader& header, const Vec2d& up);

/// The solids in one step, with what turns standing where it is at the moment that is asked about. Header, solids and
/// step must outlive it.
class SolidsInStep {
 public:
  SolidsInStep(const TraceHeader& header, const ExactScenery& solids, const TraceStep& step)
      : header_(header), solids_(solids), step_(step) {}
  /// @param fraction of the step.
  [[nodiscard]] const ExactScenery& at(double fraction) const;
  /// The smallest separation from a collider over the corners of the way [m].
  [[nodiscard]] double gap_on_way(ColliderIndex collider) const;
  /// How far the step takes a point of a collider [m]. @param fraction of the step at which the point is there.
  [[nodiscard]] Vec2d moved(ColliderIndex collider, const Vec2d& point, double fraction) const;
  /// What turns has no one velocity in a step: that of a point turns by the angle that the collider turns by, and those
  /// of two points that are `apart` [m] differ by that share of it. By so much a velocity is not known [m/s]. Of a disc
  /// it is how fast its rim goes along itself; infinite where no script says how it turns.
  /// @param moved how far the step takes the point [m].
  [[nodiscard]] double spread(ColliderIndex collider, const Vec2d& moved, double apart) const;

  /// How fast what turns may carry who stands on a face of it where the step ends [m/s].
  struct Carrying {
    Vec2d velocity{Vec2d::Zero()};  ///< Of a point of the face, but for a conveyor's surface.
    double across = 0;              ///< By so much that of another point of it differs along the normal,
    double along = 0;               ///< and by so much along the face.
  };
  /// As it goes in the whole step, and as it goes in the last stretch between two instants.
  /// @param apart the points may be [m].
  [[nodiscard]] std::vector<Carrying> carrying(ColliderIndex collider, const Vec2d& point, double apart) const;

  [[nodiscard]] const TraceHeader& header() const noexcept { return header_; }
  [[nodiscard]] const TraceStep& step() const noexcept { return step_; }

 private:
  const TraceHeader& header_;
  const ExactScenery& solids_;
  const TraceStep& step_;
  mutable std::map<double, std::unique_ptr<ExactScenery>> turned_;
};

/// The velocity of the surface of a conveyor, relative to its mover [m/s]; zero of what is none.
[[nodiscard]] Vec2d conveyed(const ColliderDef& collider, const Vec2d& normal);

/// What a surface imparts of its velocity: ground carries; walls impart nothing along themselves [m/s].
[[nodiscard]] Vec2d imparted(const Vec2d& velocity, const Vec2d& normal, bool walkable);

/// Of a surface that goes along with its mover and may be a conveyor [m/s].
[[nodiscard]] Vec2d velocity_of(const SolidsInStep& solids, const Contact& touch);

/// Whether a step begins as a walk on the ground, so that what rises in it is a climb: a rise that is steeper than any
/// walkable ground is a jump.
[[nodiscard]] bool begins_as_walk(const TraceHeader& header, const TraceStep& step, const Wanted& wanted);

/// See `ControlledStep`.
[[nodiscard]] std::vector<Vec2d> sides_of(const TraceHeader& header, const Vec2d& up);

/// The surfaces of the contacts, in their order, for the law of octagon_sweep.
/// @param contacts of the step: those reported, or of these the ones that exact arithmetic confirms.
[[nodiscard]] std::vector<MetSurface> met_surfaces(const SolidsInStep& solids, std::span<const Contact> contacts,
                                                   const Wanted& wanted);

}  // namespace paperproof::compare
