/// Stairs. A walker climbs kerbs, and follows its ground down.
///
/// Both are motions beside the law of motion, off unless the character asks for them, made after the step's own motion,
/// in no time and by the same sweeps. They add no speed.
///
/// A stair may end where the walker only rests on it, and stands as on level ground: see `rests_on_stair`.
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"
#include "step/step_free_position.hpp"
#include "step/step_ground.hpp"
#include "step/step_ride.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Sweeps, and advances as far as the way is free. @return false where that cannot be certified.
[[nodiscard]] inline bool go_along(Step& step, const Vec2& displacement) {
  sweep_along(step, displacement);
  return advance(step, step.found.hit ? step.found.stop : Real(1));
}

/// What ends a way straight down; the last sweep is that way.
[[nodiscard]] inline std::optional<TouchedSurface> ground_below(Step& step, Real down) {
  sweep_along(step, step.up.in_world({0, -down}));
  if (!step.found.hit) return std::nullopt;
  return surface_at(step, step.found.stops[0].piece, step.found.stops[0].axes.normal);
}

/// Goes down to what `ground_below` found, and stands there. @return false if it cannot; it may have gone down then.
/// @param speed sideways [m/s], which the walker keeps.
[[nodiscard]] inline bool step_down_to(Step& step, TouchedSurface ground, Real speed) {
  if (!advance(step, step.found.stop)) return false;
  if (rests_on_stair(step, ground))  // that stops no wanted motion
    ground.normal = upward(step);
  else if (walkable(step, ground.normal))
    report_contact(step, ground.piece, ground.axis, step.time, step.result.contacts.size());
  else
    return false;
  const Vec2 carried = ground_velocity(step, ground.piece, ground.normal);
  if (falls_away(step, carried)) return false;
  note_ground(step, GroundState::walkable, ground.piece, ground.normal);
  const Vec2 followed = HalfPlane{step.up.seen(ground.normal)}.along(speed - step.up.across_of(carried));
  step.velocity = in_world(step.up, followed, ground.normal) + carried;
  return true;
}

/// Makes the last climb rise no higher than where it ends, if the way there is free: whoever stands on the walker is
/// lifted no farther.
/// @param corner of the path at which it begins.
PAPERPROOF_COLD inline void lower_climb(Step& step, std::size_t corner) {
  auto& path = step.result.path;
  const Vec2 from = path[corner].position;
  const Vec2 low = from + step.up.in_world({0, step.up.up_of(Vec2(step.position - from))});
  if (!exactly_clear(step, from, low) || !exactly_clear(step, low, step.position)) return;
  path[corner + 1].position = low;
  path[corner + 2] = path.back();
  while (path.size() > corner + 3) path.pop_back();
  note_reported(step);
}

/// Goes up, on sideways, and down to ground that is higher. @return false if it does not end there.
[[nodiscard]] inline bool climb_by(Step& step, Real rise, Real sideways, Real speed) {
  const Vec2 before = step.position;
  if (!go_along(step, step.up.in_world({0, rise})) || !go_along(step, step.up.in_world({sideways, 0}))) return false;
  const Vec2 by = step.up.seen(Vec2(step.position - before));
  const auto ground = ground_below(step, by.y());
  const bool is_higher =
      (1 - step.found.stop) * by.y() > tolerances.touch && by.x() * sideways > tolerances.touch * std::abs(sideways);
  return ground && is_higher && step_down_to(step, *ground, speed);
}

/// A walk that was stopped waits until the step ends: what comes then takes no time.
inline void end_motion(Step& step) {
  step.time = 1;
  push_corner(step, 1);
}

/// Climbs what stopped a walk, if there is walkable ground at most `step_height` higher: up, on sideways, and down.
/// @param wanted displacement of the whole step [m]. @param speed sideways, as wanted [m/s].
PAPERPROOF_COLD inline void climb_stairs(Step& step, const Vec2& wanted, Real speed) {
  constexpr std::size_t most_legs = 5;  // up, on, down; the snap, and the end of the step
  if (!step.climbs || step.result.status != StepStatus::moved || is_passed_through(step)) return;
  for (int stair = 0; stair < most_stairs; ++stair) {
    const Real left = step.up.across_of(Vec2(wanted - (step.position - Vec2(step.request.state.position))));
    const bool goes_on = left * speed > 0 && std::abs(left) > tolerances.touch;
    const bool is_stopped = std::ranges::any_of(step.result.contacts, [&](const auto& contact) {
      return step.up.across_of(contact.normal) * left < 0 && step.up.up_of(contact.normal) >= -along_plane &&
             !walkable(step, contact.normal);
    });
    if (!goes_on || !is_stopped || step.result.path.size() + most_legs > step.memory.most_corners) return;
    end_motion(step);
    const std::size_t corner = step.result.path.size() - 1;
    note_reported(step);
    bool is_climbed = false;
    // There may be a lintel above a low stair.
    for (const Real share : {Real(1), Real(0.5), Real(0.25), Real(0.125)}) {
      is_climbed = climb_by(step, step.settings.step_height * share, left, speed);
      if (is_climbed) break;
      go_back_to(step, corner);
    }
    if (!is_climbed) return;
    lower_climb(step, corner);
  }
}

/// How far a circle may fall away below a rider that this step took along a tangent of it [m]; zero where no circle
/// carries the character.
[[nodiscard]] PAPERPROOF_COLD inline Real falls_away_below_rider(const Step& step) {
  if (step.moving.ride.ground == Ride::none || !step.space.is_circle(step.moving.ridden)) return 0;
  const Vec2 motion = step.velocity - step.movers.velocity(step.moving.carrier);
  const Real radius = step.space.circle(step.moving.ridden).radius;
  return std::min(falls_away_from_tangent(step, step.moving.ridden, motion) * step.movers.dt, radius) +
         2 * tolerances.touch;
}

/// Whether the motion leaves ground just below by no more than rounded vertices bend it, and gravity takes the motion
/// there: see `leaves`.
[[nodiscard]] inline bool hardly_leaves(const Step& step, const TouchedSurface& ground) {
  const Vec2 wanted = step.wanted - step.movers.displacement(ground.mover);
  return enters(wanted, ground.normal) && !leaves(step, ground.piece, ground.normal);
}

/// Follows the ground down where a walk has left it, over a crest as well: as far as `snap` allows, and at seams that
/// hardly bend. Beyond such a seam the walk is above its ground by up to `touch` more than before.
PAPERPROOF_COLD inline void follow_ground_down(Step& step) {
  constexpr Real bend = 4 * tolerances.touch;  // straight down: enough on ground as steep as 60 degrees
  if (is_passed_through(step)) return;         // a crushed character does not move
  const Real snap =
      step.movers.active ? std::max(step.settings.snap, falls_away_below_rider(step)) : step.settings.snap;
  const auto ground = ground_below(step, std::max(snap, bend));
  if (!ground || !(snap > 0 || hardly_leaves(step, *ground))) return;
  end_motion(step);
  const std::size_t corner = step.result.path.size() - 1;
  if (!step_down_to(step, *ground, step.up.across_of(step.velocity))) go_back_to(step, corner);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
