/// Being carried.
///
/// What stands on a mover or a conveyor goes with it, up, down and sideways, however suddenly it turns: only a jump, a
/// step off the edge, another body, or ground that falls faster than the character may (`max_fall_speed`) parts them.
/// A rider that does not move on its ground is anchored to it: its position is the mover's offset plus its place there.
///
/// A character that comes down on moving ground keeps its speed in the world, unless it has none sideways: then it is
/// carried at once, sideways and down. With its fall alone instead of the ground's, it would be left behind in the air
/// by what goes down a slope, and land again, and so on. Ground that comes under a character which stands on something
/// else lifts it, and does not take it along: across it goes on as it did, until it is steered.
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Of a surface of a piece, and of what stands on it, conveyor included [m/s].
[[nodiscard]] inline Vec2 ground_velocity(const Step& step, PieceIndex piece, const Vec2& normal) {
  Vec2 velocity = Vec2{normal.y(), -normal.x()} * surface_speed(step, piece);
  if (mover_of(step, piece) != no_mover) velocity += step.movers.velocity(mover_of(step, piece));
  return velocity;
}

/// How far the surface of a piece takes a rider in the rest of the step [m].
[[nodiscard]] inline Vec2 ground_rest(const Step& step, PieceIndex piece, const Vec2& normal) {
  const MoverIndex mover = mover_of(step, piece);
  const Real along = surface_speed(step, piece) * step.movers.dt * (1 - step.time);
  Vec2 rest = Vec2{normal.y(), -normal.x()} * along;
  if (mover != no_mover) rest += step.movers.remaining(mover, step.time);
  return rest;
}

/// The surface that carries the character here: of the collider that it rides already, or, where it does not stand on
/// anything else, the one of the others whose normal points up most.
[[nodiscard]] inline std::optional<TouchedSurface> carrier_here(Step& step, ColliderIndex ridden) {
  std::optional<TouchedSurface> carrier;
  bool rides = false;
  bool stands_still = false;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const std::optional<TouchedSurface> surface = touched_here(step, piece);
    if (!surface || step.up.up_of(surface->normal) <= 0) return;
    const Vec2 normal = surface->normal;
    if (!carries(step, piece)) {
      stands_still = stands_still || walkable(step, normal);
      return;
    }
    const bool known = collider_of(step, piece) == ridden;
    if (carrier && (known < rides || (known == rides && step.up.up_of(normal) <= step.up.up_of(carrier->normal))))
      return;
    carrier = surface;
    rides = known;
  });
  return rides || !stands_still ? carrier : std::nullopt;
}

/// From now on this ground carries the character.
PAPERPROOF_COLD inline void begin_to_ride(Step& step, const TouchedSurface& ground) {
  step.moving.ride.ground = collider_of(step, ground.piece);
  step.moving.ride.velocity = ground_velocity(step, ground.piece, ground.normal);
  step.moving.ride.place = step.position - offset(step, ground.piece);
  step.moving.carrier = mover_of(step, ground.piece);
  step.moving.ridden = ground.piece;
  step.moving.anchored = true;
}

/// The desired displacement in the world [m]; that of a rider includes the motion of its ground. Sets the velocity.
[[nodiscard]] PAPERPROOF_COLD inline Vec2 begin_ride(Step& step) {
  const StepRequest& request = step.request;
  const Ride& ride = request.state.ride;
  constexpr Real noise = std::numeric_limits<Real>::epsilon() * 4;
  std::optional<TouchedSurface> ground;
  if (ride.ground != Ride::none) ground = carrier_here(step, ride.ground);
  if (ground && collider_of(step, ground->piece) != ride.ground) ground.reset();
  Vec2 carried = Vec2::Zero();
  if (ground) carried = ground_velocity(step, ground->piece, ground->normal);
  if (!ground || falls_away(step, carried)) {
    step.velocity += ride.velocity;
    return request.displacement + ride.velocity * request.dt;
  }
  begin_to_ride(step, *ground);
  const Vec2 there = offset(step, ground->piece) + ride.place;
  const Real size = std::max(there.cwiseAbs().maxCoeff(), offset(step, ground->piece).cwiseAbs().maxCoeff());
  if ((there - step.position).cwiseAbs().maxCoeff() <= noise * size) step.moving.ride.place = ride.place;
  step.velocity += carried;
  return request.displacement + ground_rest(step, ground->piece, ground->normal);
}

/// Whether ground that the character lands on without horizontal speed carries it from now on.
[[nodiscard]] PAPERPROOF_COLD inline bool carries_from_now(const Step& step, const TouchedSurface& ground) {
  return walkable(step, ground.normal) && carries(step, ground.piece) && step.moving.ride.ground == Ride::none &&
         !falls_away(step, ground_velocity(step, ground.piece, ground.normal));
}

/// Without gravity nothing holds the character to ground that it only touches: that does not carry it.
PAPERPROOF_COLD inline void end_ride(Step& step) {
  if (!step.result.grounded || step.result.contacts.empty()) return;
  const std::optional<TouchedSurface> ground = carrier_here(step, step.moving.ride.ground);
  if (!ground) return;
  const ColliderIndex collider = collider_of(step, ground->piece);
  step.result.ride.ground = collider;
  step.result.ride.velocity = ground_velocity(step, ground->piece, ground->normal);
  const bool stayed = step.moving.anchored && step.moving.ride.ground == collider;
  step.result.ride.place = stayed ? Vec2(step.moving.ride.place) : Vec2(step.position - offset(step, ground->piece));
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
