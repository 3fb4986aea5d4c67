/// StepSolver: stairs. A walker climbs kerbs, and follows its ground down.
///
/// Both are motions beside the law of motion, off unless the character asks for them, made after the step's own motion,
/// in no time and by the same sweeps. They add no speed.
///
/// A hull that is narrower at the foot touches the corner of a stair with its slanted side before its foot is on the
/// stair. There it may rest if a little ahead, where its foot would be, there is walkable ground.
#pragma once

#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Sweeps, and advances as far as the way is free. @return false where that cannot be certified.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::go_along(const V& displacement) noexcept {
  sweep_along(displacement);
  return advance(found_.hit ? found_.stop : Scalar(1));
}

/// The ground that ends a way straight down: walkable, or the corner of a stair whose ground lies ahead. The last sweep
/// is then that way down.
/// @param ahead to which side [m]; zero: nowhere. @param down how far [m]
template <std::size_t Lanes, class Scalar>
std::optional<TouchedSurface<Scalar>> StepSolver<Lanes, Scalar>::ground_below(Scalar ahead, Scalar down) noexcept {
  const V from = position_;
  const auto ground = [&]() -> std::optional<TouchedSurface<Scalar>> {
    sweep_along({0, -down});
    if (!found_.hit) return std::nullopt;
    const TouchedSurface<Scalar> surface = surface_at(found_.stops[0].piece, found_.stops[0].axes.normal);
    return surface.normal.y() > 0 ? std::optional(surface) : std::nullopt;
  };
  std::optional<TouchedSurface<Scalar>> below = ground();
  if (!below || walkable(below->normal) || ahead == 0 || settings_.overhang == 0) return below;
  sweep_along({ahead, 0});
  position_ += motion_.displacement * found_.stop;
  below = ground();
  position_ = from;
  if (below) ground();
  return below;
}

/// Stands on ground that `ground_below` found, at the end of the way down.
/// @param speed sideways [m/s], which the walker keeps.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::step_down_to(const TouchedSurface<Scalar>& ground, Scalar speed) noexcept {
  if (!walkable(ground.normal) || !advance(found_.stop)) return false;
  note_ground(GroundState::walkable, ground.piece, ground.normal);
  const Stop<Scalar>& stop = found_.stops[0];
  if (walkable(space_.normal(stop.piece, stop.axes.normal)))  // the corner of a stair stops no wanted motion
    report_contact(stop.piece, stop.axes.normal, time_, result_.contacts.size());
  const V carried = ground_velocity(ground.piece, ground.normal);
  velocity_ = follow(speed - carried.x(), ground.normal) + carried;
  return true;
}

/// Climbs what stopped a walk, if there is walkable ground at most `step_height` higher: up, on sideways, and down.
/// @param wanted displacement of the whole step [m]. @param speed sideways, as wanted [m/s].
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::climb_stairs(const MoveRequest<Scalar>& request, const V& wanted,
                                             Scalar speed) noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  constexpr std::size_t most_legs = 5;  // up, on, down; the snap, and the end of the step
  if (!request.grounded || !climbs_ || result_.status != MoveStatus::moved || is_passed_through()) return;
  for (int stair = 0; stair < most_stairs; ++stair) {
    const Scalar left = wanted.x() - (position_.x() - request.position.x());
    const bool is_steered = left * request.velocity.x() > 0 && std::abs(left) > touch;
    const bool is_stopped = std::any_of(result_.contacts.begin(), result_.contacts.end(), [&](const auto& contact) {
      return contact.normal.x() * left < 0 && contact.normal.y() >= 0 && !walkable(contact.normal);
    });
    if (!is_steered || !is_stopped || result_.path.size() + most_legs > memory_.corners.capacity()) return;
    push_corner(time_);
    const std::size_t corner = result_.path.size() - 1;
    memory_.contacts_at[corner] = result_.contacts.size();
    const V before = position_;
    bool is_climbed = go_along({0, settings_.step_height}) && go_along({left, 0}) &&
                      (position_.x() - before.x()) * left > touch * std::abs(left);
    if (is_climbed) {
      const auto ground = ground_below(std::copysign(settings_.overhang, left), position_.y() - before.y());
      is_climbed = ground && (1 - found_.stop) * (position_.y() - before.y()) > touch && step_down_to(*ground, speed);
    }
    if (!is_climbed) return go_back_to(corner);
  }
}

/// Follows the ground down where a walk has left it, and there is ground at most `snap` below.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::follow_ground_down(const MoveRequest<Scalar>& request) noexcept {
  if (!request.grounded || result_.grounded) return;
  if (is_passed_through()) return;              // a crushed character does not move
  const V left_ground = moving_.ride.velocity;  // of the ground that was walked on
  // A character that rises has left the ground on purpose, unless it only climbs: a walk goes on over a crest.
  if (velocity_.y() > left_ground.y() && !climbs_) return;
  const Scalar walked = position_.x() - request.position.x() - left_ground.x() * request.dt;
  const Scalar ahead = walked == 0 ? Scalar(0) : std::copysign(settings_.overhang, walked);
  if (const auto ground = ground_below(ahead, settings_.snap)) step_down_to(*ground, velocity_.x());
}

}  // namespace paperproof::octagon_sweep
