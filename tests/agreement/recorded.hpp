/// A step of a controller as a trace has it.
#pragma once

#include "oracle/judge.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/crowd.hpp>

#include <span>

namespace paperproof::test {

/// @param state after the step.
template <class Scalar>
[[nodiscard]] compare::TraceStep recorded(const StepReport<Scalar>& report, const CharacterState<Scalar>& state,
                                          std::span<const MoverMotion<Scalar>> motions) {
  compare::TraceStep record;
  for (const PathPoint<Scalar>& corner : report.move.path)
    record.path.push_back({corner.position.template cast<double>(), static_cast<double>(corner.fraction)});
  record.requested = report.requested.template cast<double>();
  record.steered = static_cast<double>(report.steered);
  record.velocity = state.velocity.template cast<double>();
  record.grounded = state.grounded;
  record.jumping = state.jumping;
  if (state.ride.ground != Ride<Scalar>::none)
    record.ride = {state.ride.ground, state.ride.velocity.template cast<double>()};
  record.ground_velocity = state.ground.velocity.template cast<double>();
  for (const Contact<Scalar>& contact : report.move.contacts)
    record.contacts.push_back({.collider = contact.collider,
                               .point = contact.point.template cast<double>(),
                               .normal = contact.normal.template cast<double>(),
                               .fraction = static_cast<double>(contact.fraction),
                               .separation = static_cast<double>(contact.separation),
                               .side = contact.side});
  for (const MoverMotion<Scalar>& m : motions)
    record.movers.push_back({m.from.template cast<double>(), m.to.template cast<double>()});
  record.crushed.assign(report.move.crushed.begin(), report.move.crushed.end());
  record.stuck = report.status == StepStatus::stuck;
  record.dropped = report.status == StepStatus::dropped;
  record.dropped_through.assign(report.dropped_through.begin(), report.dropped_through.end());
  return record;
}

/// The same of a character of a crowd, with the others that it met.
[[nodiscard]] inline compare::TraceStep recorded(const CrowdMember<double>& member, const CharacterState<double>& state,
                                                 std::span<const MoverMotion<double>> motions,
                                                 CharacterIndex character) {
  compare::TraceStep record = recorded(member.step, state, motions);
  record.character = character;
  record.met.assign(member.met.begin(), member.met.end());
  return record;
}

}  // namespace paperproof::test
