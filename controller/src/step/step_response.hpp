/// The response to the surfaces that are touched.
///
/// A surface with normal n whose mover is displaced by d in the rest of the step allows the displacements w with
/// n·w >= n·d; d is zero where nothing moves. The response to one surface is that of response.hpp, relative to its
/// mover. If it enters another surface, the two are answered one after the other; then surfaces of one body together;
/// and last the nearest motion is taken that all surfaces allow.
#pragma once

#include "inlining.hpp"
#include "step/half_planes.hpp"
#include "step/response.hpp"
#include "step/step.hpp"
#include "step/step_crush.hpp"
#include "step/step_ground.hpp"
#include "step/step_ride.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

[[nodiscard]] inline HalfPlane half_plane_of(const Vec2& normal, const Vec2& motion) {
  return {normal, normal.x() * motion.x() + normal.y() * motion.y()};
}

/// @param desired a slide that enters the surface by rounding.
PAPERPROOF_COLD inline void keep_on_surface(const Vec2& normal, DesiredMotion& desired) {
  desired = DesiredMotion::plain(rounded_slide(desired.displacement.wanted, normal),
                                 rounded_slide(desired.velocity.wanted, normal));
}

[[nodiscard]] inline bool allowed(const Step& step, const DesiredMotion& desired, const TouchedSurface& surface) {
  return half_plane_of(surface.normal, remaining_of(step, surface)).allows(desired.displacement.wanted) &&
         half_plane_of(surface.normal, step.movers.velocity(surface.mover)).allows(desired.velocity.wanted);
}

[[nodiscard]] inline bool allowed(const Step& step, const DesiredMotion& desired) {
  return std::all_of(step.memory.surfaces.begin(), step.memory.surfaces.end(),
                     [&](const TouchedSurface& surface) { return allowed(step, desired, surface); });
}

/// The response to one surface, relative to its motion. Walkable ground that carries counts with its whole motion, as
/// do walls and slopes that go with it, also before it is touched; any other surface only with its motion along its
/// normal.
/// @param after_walk see `Surface`.
[[nodiscard]] inline DesiredMotion response_to(const Step& step, const TouchedSurface& surface,
                                               const DesiredMotion& desired, bool after_walk) {
  const Surface at{surface.normal, walkable(step, surface.normal), after_walk};
  const TouchedSurface& ground = step.memory.surfaces[0];
  const auto carries = [&](const TouchedSurface& touched) {
    return walkable(step, touched.normal) && mover_of(step, touched.piece) != no_mover;
  };
  const bool is_carried_along =
      carries(surface) || surface.mover == step.moving.carrier || (surface.mover == ground.mover && carries(ground));
  const auto response = [&](const Desired& given, const Vec2& motion_of_surface, Real steered) -> Desired {
    Vec2 frame = motion_of_surface;
    if (!is_carried_along) frame = surface.normal * half_plane_of(surface.normal, motion_of_surface).least;
    const Desired relative{given.wanted - frame, given.unsteered - frame};
    if (dot(relative.wanted, surface.normal) >= 0) return given;
    const Desired result = respond(step.up, relative, steered, at);
    return {result.wanted + frame, result.unsteered + frame};
  };
  return {response(desired.displacement, remaining_of(step, surface), step.steered * step.movers.dt * (1 - step.time)),
          response(desired.velocity, step.movers.velocity(surface.mover), step.steered)};
}

/// Nothing if there is no motion that all surfaces allow.
[[nodiscard]] inline std::optional<DesiredMotion> nearest_allowed_to(const Step& step, const Vec2& displacement,
                                                                     const Vec2& velocity) {
  std::vector<HalfPlane>& displacements = step.memory.displacement_planes;
  std::vector<HalfPlane>& velocities = step.memory.velocity_planes;
  displacements.clear();
  velocities.clear();
  for (const TouchedSurface& surface : step.memory.surfaces) {
    add_plane(half_plane_of(surface.normal, remaining_of(step, surface)), displacements);
    add_plane(half_plane_of(surface.normal, step.movers.velocity(surface.mover)), velocities);
  }
  const auto allowed_displacement = nearest_allowed(displacement, {displacements.begin(), displacements.end()});
  if (!allowed_displacement) return std::nullopt;
  const auto allowed_velocity = nearest_allowed(velocity, {velocities.begin(), velocities.end()});
  return DesiredMotion::plain(*allowed_displacement, allowed_velocity.value_or(Vec2::Zero()));
}

/// Takes the nearest motion to a fall that all surfaces allow, if that falls further than what is desired so far.
inline void prefer_fall(const Step& step, const Vec2& displacement, const Vec2& velocity, DesiredMotion& desired) {
  const auto falling = nearest_allowed_to(step, displacement, velocity);
  if (falling && step.up.up_of(falling->displacement.wanted) < step.up.up_of(desired.displacement.wanted))
    desired = *falling;
}

/// Lets the character fall between two surfaces that part, where the responses to one after the other would stop it.
PAPERPROOF_COLD inline void fall_between(const Step& step, DesiredMotion& desired) {
  prefer_fall(step, step.up.in_world({0, step.fall * step.movers.dt * (1 - step.time)}),
              step.up.in_world({0, step.fall}), desired);
}

/// Notes that a fall ends between the surfaces that are touched.
/// @param ground the one that points up most.
PAPERPROOF_COLD inline void note_wedge(Step& step, const TouchedSurface& ground) {
  step.wedged = true;
  step.ground = ground.piece;
  step.ground_axis = ground.axis;
}

/// The response to the first surface, and to a second one that the first response enters. False if that enters a third.
[[nodiscard]] inline bool respond_one_by_one(const Step& step, DesiredMotion& desired) {
  const DesiredMotion wanted = desired;
  const TouchedSurface& first = step.memory.surfaces[0];
  const DesiredMotion alone = response_to(step, first, wanted, step.after_walk);
  desired = alone;
  if (allowed(step, desired)) return true;
  for (const TouchedSurface& surface : step.memory.surfaces) {
    if (allowed(step, alone, surface)) continue;
    desired = response_to(step, surface, alone, step.after_walk || walkable(step, first.normal));
    if (allowed(step, desired)) return true;
    desired = response_to(step, first, response_to(step, surface, wanted, step.after_walk),
                          step.after_walk || walkable(step, surface.normal));
    if (!allowed(step, desired)) continue;
    if (remaining_of(step, surface) != remaining_of(step, first)) fall_between(step, desired);
    return true;
  }
  desired = wanted;
  return false;
}

/// Whether the character can fall straight down between two rims that it touches: a shaft may be a little wider than
/// the character. If it is off the middle, it shifts sideways by at most the clearance of the narrowest opening that
/// counts.
/// @param aside unit vector, across the fall.
[[nodiscard]] PAPERPROOF_COLD inline bool shift_to_fall(Step& step, const Vec2& displacement, const Vec2& aside) {
  const auto falls = [&] {
    sweep_along(step, displacement);
    return !step.found.hit || step.found.stop * step.motion.length > tolerances.touch;
  };
  if (falls()) return true;
  if (step.certify) return false;
  for (const Real by : {tolerances.hit, -tolerances.hit, 2 * tolerances.hit, -2 * tolerances.hit}) {
    const Vec2 here = step.position;
    step.position += aside * by;
    if (exactly_clear(step, here, step.position) && falls()) {
      push_corner(step, step.time);
      return true;
    }
    step.position = here;
  }
  return false;
}

/// The same along one of the sides of the character, or of its box: where up is slanted a shaft of its width goes
/// aslant.
[[nodiscard]] PAPERPROOF_COLD inline bool fall_along_a_side(Step& step, const Vec2& displacement, const Vec2& velocity,
                                                            DesiredMotion& desired) {
  for (std::size_t axis = 0; axis < step.space.lanes(); ++axis) {
    const Vec2 normal = step.space.normal(step.memory.surfaces[0].piece, axis);
    const Vec2 along{-normal.y(), normal.x()};
    if (!(step.up.up_of(along) < 0)) continue;  // each direction belongs to two axes, or to none
    const Vec2 way = along * dot(displacement, along);
    if (!shift_to_fall(step, way, normal)) continue;
    desired = DesiredMotion::plain(way, along * dot(velocity, along));
    return true;
  }
  return false;
}

/// Surfaces with one motion that stop the character together: a fall may still slip down between them. Otherwise the
/// motion ends there, relative to them. False if their motions differ.
[[nodiscard]] inline bool respond_in_crease(Step& step, DesiredMotion& desired) {
  const TouchedSurface& first = step.memory.surfaces[0];
  const DesiredMotion alone = response_to(step, first, desired, step.after_walk);
  for (const TouchedSurface& surface : step.memory.surfaces)
    if (!allowed(step, alone, surface) && remaining_of(step, surface) != remaining_of(step, first)) return false;
  const Vec2 velocity = step.movers.velocity(first.mover);
  const DesiredMotion with_body = DesiredMotion::plain(remaining_of(step, first), velocity);
  if (!allowed(step, with_body)) return false;
  const Real fall = step.fall - step.up.up_of(velocity);
  const bool on_ground = std::any_of(step.memory.surfaces.begin(), step.memory.surfaces.end(),
                                     [&](const TouchedSurface& surface) { return walkable(step, surface.normal); });
  desired = with_body;
  if (fall < 0) note_wedge(step, first);
  if (fall >= 0 || on_ground) return true;
  const Vec2 displacement = step.up.in_world({0, fall * step.movers.dt * (1 - step.time)});
  const Vec2 falls = step.up.in_world({0, fall});
  const std::optional<DesiredMotion> falling =
      nearest_allowed_to(step, with_body.displacement.wanted + displacement, velocity + falls);
  const auto slips = [&] {
    return step.up.up_of(falling->velocity.wanted) - step.up.up_of(velocity) <
           along_plane * (fall - length_of(velocity));
  };
  if (falling && slips())
    desired = *falling;
  else if (velocity == Vec2::Zero() && shift_to_fall(step, displacement, step.up.in_world({1, 0})))
    desired = DesiredMotion::plain(displacement, falls);
  else if (velocity != Vec2::Zero() || !step.up.is_slanted() || !fall_along_a_side(step, displacement, falls, desired))
    return true;
  step.wedged = false;
  return true;
}

/// The nearest motion that all surfaces allow. Steering and horizontal momentum count only where they do not slow a
/// fall: between two steep surfaces they would become a climb. False if the surfaces leave no motion.
[[nodiscard]] inline bool respond_together(const Step& step, DesiredMotion& desired) {
  const Desired displacement = desired.displacement;
  const Desired velocity = desired.velocity;
  const auto wanted = nearest_allowed_to(step, displacement.wanted, velocity.wanted);
  if (!wanted) return false;
  desired = *wanted;
  prefer_fall(step, displacement.unsteered, velocity.unsteered, desired);
  const auto upwards = [&](const Vec2& v) { return step.up.in_world({0, step.up.up_of(v)}); };
  if (step.up.up_of(displacement.unsteered) < 0)
    prefer_fall(step, upwards(displacement.unsteered), upwards(velocity.unsteered), desired);
  return true;
}

/// The response to one surface that stands still: the usual case.
PAPERPROOF_INLINE void respond_to_surface(const Step& step, const Vec2& normal, DesiredMotion& desired) {
  const Surface at{normal, walkable(step, normal), step.after_walk};
  if (step.steered == 0 && !step.up.is_turned()) {
    desired.displacement.wanted = respond(desired.displacement.wanted, at);
    desired.velocity.wanted = respond(desired.velocity.wanted, at);
  } else {
    if (step.steered == 0) desired = DesiredMotion::plain(desired.displacement.wanted, desired.velocity.wanted);
    desired.displacement = respond(step.up, desired.displacement, step.steered * step.movers.dt * (1 - step.time), at);
    desired.velocity = respond(step.up, desired.velocity, step.steered, at);
  }
  // A slow slide may still enter the surface by rounding. A motion along walkable ground does not.
  if (!at.walkable && (enters(desired.displacement.wanted, normal) || enters(desired.velocity.wanted, normal)))
    keep_on_surface(normal, desired);
}

/// Whether steep surfaces that move apart hardly, or close in, hold a fall between them: a slope and a crate that
/// rests, for example.
[[nodiscard]] PAPERPROOF_COLD inline bool ends_fall_in_wedge(const Step& step, const DesiredMotion& desired) {
  constexpr Real hardly = Real(0.1);
  Real left = 0;
  Real right = 0;
  Real fastest = 0;
  for (const TouchedSurface& surface : step.memory.surfaces) {
    if (walkable(step, surface.normal)) return false;
    const Real across = step.up.across_of(surface.normal);
    left = std::min(left, across);
    right = std::max(right, across);
    fastest = std::max(fastest, length_of(step.movers.velocity(surface.mover)));
  }
  const bool holds = left < 0 && right > 0 && step.up.up_of(step.memory.surfaces[0].normal) > 0;
  const Real speed = length_of(desired.velocity.wanted);
  return holds && step.fall < 0 && speed <= hardly * -step.fall && fastest <= hardly * -step.fall;
}

/// The response to several surfaces, or to one that moves.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool respond_to_all(Step& step, DesiredMotion& desired) {
  if (step.steered == 0) desired = DesiredMotion::plain(desired.displacement.wanted, desired.velocity.wanted);
  if (!respond_one_by_one(step, desired) && !respond_in_crease(step, desired) && !respond_together(step, desired))
    return false;
  if (step.movers.active && !step.wedged && ends_fall_in_wedge(step, desired))
    note_wedge(step, step.memory.surfaces[0]);
  return true;
}

/// False where the surfaces leave no motion.
[[nodiscard]] inline bool respond_to_surfaces(Step& step, DesiredMotion& desired) {
  const TouchedSurface& first = step.memory.surfaces[0];
  step.wedged = false;
  if (step.movers.active && step.up.across_of(desired.velocity.wanted) == 0 && carries_from_now(step, first)) {
    begin_to_ride(step, first);
    desired = DesiredMotion::plain(ground_rest(step, first.piece, first.normal), step.moving.ride.velocity);
    step.steered = 0;
  }
  const bool on_ground = walkable(step, first.normal);
  if (step.after_walk && !on_ground && step.up.up_of(desired.velocity.wanted) > 0)
    step.after_walk = touches_ground(step);
  bool possible = true;
  if (step.memory.surfaces.size() == 1 && first.mover == no_mover)
    respond_to_surface(step, first.normal, desired);
  else
    possible = respond_to_all(step, desired);
  step.after_walk = step.after_walk || on_ground;
  return possible;
}

/// There were too many sweeps, or the path has no room for more corners but the last. Tries to end the step with the
/// present motion, with the motion of a touched surface, or at a free position.
PAPERPROOF_COLD inline void last_resort(Step& step, const Vec2& displacement) {
  if (step.result.status == StepStatus::moved) step.result.status = StepStatus::dropped;
  if (!step.movers.active) return;
  const auto goes = [&](const Vec2& last) {
    sweep_along(step, last);
    return !step.found.hit && advance(step, 1);
  };
  if (goes(displacement)) return;
  if (!is_passed_through(step)) {
    for (const TouchedSurface& surface : step.memory.surfaces)
      if (goes(remaining_of(step, surface))) return;
  }
  wait(step, true);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
