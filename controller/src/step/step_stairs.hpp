/// StepSolver: stairs. A walker climbs kerbs, and follows its ground down.
///
/// Both are motions beside the law of motion, off unless the character asks for them, made after the step's own motion,
/// in no time and by the same sweeps. They add no speed.
///
/// A hull that is narrower at the foot touches the corner of a stair with its slanted side before its foot is on the
/// stair. There it may rest if a little ahead, where its foot would be, there is walkable ground.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Sweeps, and advances as far as the way is free. @return false where that cannot be certified.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::go_along(const V& displacement) noexcept {
  sweep_along(displacement);
  return advance(found_.hit ? found_.stop : Scalar(1));
}

/// How far the hull and its foot reach to a side.
template <std::size_t Lanes, class Scalar, class Up>
FootReach<Scalar> StepSolver<Lanes, Scalar, Up>::foot_reach(Scalar side) const noexcept {
  Scalar low = std::numeric_limits<Scalar>::infinity();
  for (const V& point : space_.hull()) low = std::min(low, up_.up_of(point));
  FootReach<Scalar> reach{-std::numeric_limits<Scalar>::infinity(), -std::numeric_limits<Scalar>::infinity()};
  for (const V& point : space_.hull()) {
    const Scalar across = side * up_.across_of(point);
    reach.hull = std::max(reach.hull, across);
    if (up_.up_of(point) - low <= Tolerances<Scalar>{}.touch) reach.foot = std::max(reach.foot, across);
  }
  return reach;
}

/// The ground that ends a way straight down: walkable, or the corner of a stair whose ground lies ahead. The last sweep
/// is then that way down.
/// @param side of what is ahead: 1, -1, or 0 if nothing is. @param down how far [m].
/// @param lean how far a stair may lean back [m].
template <std::size_t Lanes, class Scalar, class Up>
std::optional<TouchedSurface<Scalar>> StepSolver<Lanes, Scalar, Up>::ground_below(Scalar side, Scalar down,
                                                                                  Scalar lean) noexcept {
  const V from = position_;
  const auto ground = [&]() -> std::optional<TouchedSurface<Scalar>> {
    sweep_along(up_.in_world({0, -down}));
    if (!found_.hit) return std::nullopt;
    const TouchedSurface<Scalar> surface = surface_at(found_.stops[0].piece, found_.stops[0].axes.normal);
    return up_.up_of(surface.normal) > 0 ? std::optional(surface) : std::nullopt;
  };
  std::optional<TouchedSurface<Scalar>> below = ground();
  if (!below || walkable(below->normal) || side == 0) return below;
  // Where the foot is just over the corner; farther, as this may be the corner of the stair behind; and behind the edge
  // of a stair that leans back.
  const V there = local(below->piece, V(from + motion_.displacement * found_.stop));
  const V corner = contact_place(space_, below->piece, below->axis, below->normal, there).point;
  const FootReach<Scalar> reach = foot_reach(side);
  const Scalar overhang = std::max(reach.hull - reach.foot, foot_reach(-side).hull - foot_reach(-side).foot);
  const Scalar over = side * up_.across_of(V(corner - there)) - reach.foot + 2 * Tolerances<Scalar>{}.touch;
  for (const Scalar ahead : {over, overhang, overhang / 2, overhang / 4, lean}) {
    if (ahead <= 0) continue;
    sweep_along(up_.in_world({side * ahead, 0}));
    position_ += motion_.displacement * found_.stop;
    below = ground();
    position_ = from;
    if (below && walkable(below->normal)) break;
  }
  if (below) ground();
  return below;
}

/// Stands on ground that `ground_below` found, at the end of the way down.
/// @param speed sideways [m/s], which the walker keeps.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::step_down_to(const TouchedSurface<Scalar>& ground, Scalar speed) noexcept {
  const V carried = carried_velocity(ground.piece, ground.normal);
  if (!walkable(ground.normal) || falls_away(ground_velocity(ground.piece, ground.normal)) || !advance(found_.stop))
    return false;
  const Stop<Scalar>& stop = found_.stops[0];
  note_ground(GroundState::walkable, stop.piece, ground.normal);
  if (walkable(space_.normal(stop.piece, stop.axes.normal)))  // the corner of a stair stops no wanted motion
    report_contact(stop.piece, stop.axes.normal, time_, result_.contacts.size());
  const V followed = follow(speed - up_.across_of(carried), up_.seen(ground.normal));
  velocity_ = in_world(up_, followed, ground.normal) + carried;
  return true;
}

/// Goes up, on sideways, and down to ground that is higher. @return false if it does not end there.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::climb_by(Scalar rise, Scalar sideways, Scalar speed) noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  const V before = position_;
  if (!go_along(up_.in_world({0, rise})) || !go_along(up_.in_world({sideways, 0}))) return false;
  const V by = up_.seen(V(position_ - before));
  const auto ground = ground_below(std::copysign(Scalar(1), sideways), by.y(), by.y());
  const bool is_higher = (1 - found_.stop) * by.y() > touch && by.x() * sideways > touch * std::abs(sideways);
  return ground && is_higher && step_down_to(*ground, speed);
}

/// Climbs what stopped a walk, if there is walkable ground at most `step_height` higher: up, on sideways, and down.
/// @param wanted displacement of the whole step [m]. @param speed sideways, as wanted [m/s].
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::climb_stairs(const StepRequest<Scalar>& request, const V& wanted,
                                                 Scalar speed) noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  constexpr std::size_t most_legs = 5;  // up, on, down; the snap, and the end of the step
  if (!request.grounded || !climbs_ || result_.status != MoveStatus::moved || is_passed_through()) return;
  for (int stair = 0; stair < most_stairs; ++stair) {
    const Scalar left = up_.across_of(V(wanted - (position_ - request.position)));
    const bool is_steered = left * up_.across_of(request.velocity) > 0 && std::abs(left) > touch;
    const bool is_stopped = std::any_of(result_.contacts.begin(), result_.contacts.end(), [&](const auto& contact) {
      return up_.across_of(contact.normal) * left < 0 && up_.up_of(contact.normal) >= -along_plane<Scalar> &&
             !walkable(contact.normal);
    });
    if (!is_steered || !is_stopped || result_.path.size() + most_legs > memory_.corners.capacity()) return;
    push_corner(time_);
    const std::size_t corner = result_.path.size() - 1;
    note_reported();
    bool is_climbed = false;
    // There may be a lintel above a low stair.
    for (const Scalar share : {Scalar(1), Scalar(0.5), Scalar(0.25), Scalar(0.125)}) {
      is_climbed = climb_by(settings_.step_height * share, left, speed);
      if (is_climbed) break;
      go_back_to(corner);
    }
    if (!is_climbed) return;
  }
}

/// How far a circle may fall away below a rider that this step took along a tangent of it [m]; zero where no circle
/// carries the character.
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::falls_away_below_rider() const noexcept {
  if (moving_.ride.ground == Ride<Scalar>::none || !space_.is_circle(moving_.ridden)) return 0;
  V motion = velocity_;
  if (moving_.carrier != no_mover) motion -= movers_.displacement(moving_.carrier) / movers_.dt;
  const Scalar radius = space_.scenery().circle(moving_.ridden).radius;
  return std::min(falls_away_from_tangent(moving_.ridden, motion) * dt_, radius) + 2 * Tolerances<Scalar>{}.touch;
}

/// Whether the motion leaves ground just below by no more than rounded vertices bend it, and gravity takes the motion
/// there: see `leaves`.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::hardly_leaves(const TouchedSurface<Scalar>& ground) const noexcept {
  const V wanted = ground.mover == no_mover ? wanted_ : V(wanted_ - movers_.displacement(ground.mover));
  return enters(wanted, ground.normal) && !leaves(ground.piece, ground.normal);
}

/// Follows the ground down where a walk has left it: as far as `snap` allows, and at seams that hardly bend. Beyond
/// such a seam the walk is above its ground by up to `touch` more than before.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::follow_ground_down(const StepRequest<Scalar>& request) noexcept {
  constexpr Scalar bend = 4 * Tolerances<Scalar>{}.touch;  // straight down: enough on ground as steep as 60 degrees
  if (is_passed_through()) return;                         // a crushed character does not move
  const V left_ground = moving_.ride.velocity;             // of the ground that was walked on
  // A character that rises has left the ground on purpose, unless it only climbs: a walk goes on over a crest.
  if (up_.up_of(velocity_) > up_.up_of(left_ground) && !climbs_) return;
  const Scalar snap = movers_.active ? std::max(settings_.snap, falls_away_below_rider()) : settings_.snap;
  const Scalar down = std::max(snap, bend);
  const Scalar walked = up_.across_of(V(position_ - request.position - left_ground * request.dt));
  const Scalar side = walked == 0 || snap == 0 ? Scalar(0) : std::copysign(Scalar(1), walked);
  const auto ground = ground_below(side, down, 0);
  if (ground && ((snap > 0 && found_.stop * down <= snap) || hardly_leaves(*ground)))
    step_down_to(*ground, up_.across_of(velocity_));
}

}  // namespace paperproof::octagon_sweep
