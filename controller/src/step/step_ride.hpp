/// StepSolver: being carried.
///
/// What stands on a mover or a conveyor goes with it, up, down and sideways, however suddenly it turns: only a jump, a
/// step off the edge, another body, or ground that falls faster than the character may (`max_fall_speed`) parts them.
/// A rider that does not move on its ground is anchored to it: its position is the mover's offset plus its place there.
///
/// A character that comes down on moving ground keeps its speed in the world, unless it has none sideways: then it is
/// carried at once, sideways and down. With its fall alone instead of the ground's, it would be left behind in the air
/// by what goes down a slope, and land again, and so on.
#pragma once

#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::surface_speed(PieceIndex piece) const noexcept {
  const Scenery<Scalar>& scenery = space_.scenery();
  return static_cast<Scalar>(scenery.collider(scenery.pieces()[piece].collider).surface_speed);
}

template <std::size_t Lanes, class Scalar, class Up>
MoverIndex StepSolver<Lanes, Scalar, Up>::carrier_of(PieceIndex piece) const noexcept {
  return space_.scenery().collider(collider_of(piece)).carries ? mover_of(piece) : no_mover;
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::carries(PieceIndex piece) const noexcept {
  return carrier_of(piece) != no_mover || surface_speed(piece) != 0;
}

/// Of a surface of a piece, conveyor included [m/s].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::ground_velocity(PieceIndex piece, const V& normal) const noexcept {
  return velocity_with(mover_of(piece), piece, normal);
}

/// Of what stands on a surface of a piece [m/s].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::carried_velocity(PieceIndex piece, const V& normal) const noexcept {
  return velocity_with(carrier_of(piece), piece, normal);
}

template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::velocity_with(MoverIndex mover, PieceIndex piece,
                                                          const V& normal) const noexcept {
  V velocity = V{normal.y(), -normal.x()} * surface_speed(piece);
  if (mover != no_mover) velocity += movers_.displacement(mover) / movers_.dt;
  return velocity;
}

/// How far the surface of a piece takes a rider in the rest of the step [m].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::ground_rest(PieceIndex piece, const V& normal) const noexcept {
  const MoverIndex mover = carrier_of(piece);
  const Scalar along = surface_speed(piece) * movers_.dt * (1 - time_);
  V rest = V{normal.y(), -normal.x()} * along;
  if (mover != no_mover) rest += movers_.remaining(mover, time_);
  return rest;
}

/// The surface that carries the character here: of the collider that it rides already, or, where it does not stand on
/// anything else, the one of the others whose normal points up most.
template <std::size_t Lanes, class Scalar, class Up>
std::optional<TouchedSurface<Scalar>> StepSolver<Lanes, Scalar, Up>::carrier_here(ColliderIndex ridden,
                                                                                  bool walkable_only) noexcept {
  std::optional<TouchedSurface<Scalar>> carrier;
  bool rides = false;
  bool stands_still = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (passes_one_way(piece)) return;
    const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
    const V normal = space_.normal(piece, best.axis);
    if (std::abs(best.separation) > Tolerances<Scalar>{}.touch || up_.up_of(normal) <= 0) return;
    if ((walkable_only && !walkable(normal)) || !may_block(piece, position_)) return;
    if (!carries(piece)) {
      stands_still = stands_still || walkable(normal);
      return;
    }
    const bool known = collider_of(piece) == ridden;
    if (carrier && (known < rides || (known == rides && up_.up_of(normal) <= up_.up_of(carrier->normal)))) return;
    carrier = surface_at(piece, best.axis);
    rides = known;
  });
  if (!rides && stands_still) return std::nullopt;
  return carrier;
}

/// The desired displacement in the world [m]; that of a rider includes the motion of its ground. Sets the velocity.
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::begin_ride(const StepRequest<Scalar>& request) noexcept {
  constexpr Scalar noise = std::numeric_limits<Scalar>::epsilon() * 4;
  const bool riding = request.ride.ground != Ride<Scalar>::none;
  const bool at_rest = up_.across_of(request.velocity) == 0 && up_.up_of(request.velocity) <= 0;
  std::optional<TouchedSurface<Scalar>> ground;
  if (riding || at_rest) ground = carrier_here(request.ride.ground, !riding);
  if (riding && ground && collider_of(ground->piece) != request.ride.ground) ground.reset();
  V carried = V::Zero();
  if (ground) carried = carried_velocity(ground->piece, ground->normal);
  if (!ground || falls_away(carried)) {
    velocity_ += request.ride.velocity;
    return request.displacement + request.ride.velocity * request.dt;
  }
  begin_to_ride(*ground);
  if (riding) {
    const V there = offset(ground->piece) + request.ride.place;
    const Scalar size = std::max(there.cwiseAbs().maxCoeff(), offset(ground->piece).cwiseAbs().maxCoeff());
    if ((there - position_).cwiseAbs().maxCoeff() <= noise * size) moving_.ride.place = request.ride.place;
  }
  velocity_ += carried;
  return request.displacement + ground_rest(ground->piece, ground->normal);
}

/// Whether ground that the character lands on without horizontal speed carries it from now on.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::carries_from_now(const TouchedSurface<Scalar>& ground) const noexcept {
  return walkable(ground.normal) && carries(ground.piece) && moving_.ride.ground == Ride<Scalar>::none &&
         !falls_away(carried_velocity(ground.piece, ground.normal));
}

/// From now on this ground carries the character.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::begin_to_ride(const TouchedSurface<Scalar>& ground) noexcept {
  moving_.ride.ground = collider_of(ground.piece);
  moving_.ride.velocity = carried_velocity(ground.piece, ground.normal);
  moving_.ride.place = position_ - offset(ground.piece);
  moving_.carrier = carrier_of(ground.piece);
  moving_.ridden = ground.piece;
  moving_.anchored = true;
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::note_motion_on_ground() noexcept {
  V relative = motion_.displacement;
  if (moving_.carrier != no_mover) relative = movers_.relative(motion_.displacement, moving_.carrier, time_);
  moving_.anchored = relative.x() == 0 && relative.y() == 0;
}

/// Position of an anchored rider at a fraction of the step.
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::anchor(Scalar time) const noexcept {
  if (moving_.carrier == no_mover) return position_;
  return movers_.offset(moving_.carrier, time) + moving_.ride.place;
}

/// Without gravity nothing holds the character to ground that it only touches: that does not carry it.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::end_ride() noexcept {
  if (!result_.grounded || result_.contacts.empty()) return;
  const std::optional<TouchedSurface<Scalar>> ground = carrier_here(moving_.ride.ground, false);
  if (!ground) return;
  const ColliderIndex collider = collider_of(ground->piece);
  result_.ride.ground = collider;
  result_.ride.velocity = carried_velocity(ground->piece, ground->normal);
  const bool stayed = moving_.anchored && moving_.ride.ground == collider;
  result_.ride.place = stayed ? moving_.ride.place : V(position_ - offset(ground->piece));
}

}  // namespace paperproof::octagon_sweep
