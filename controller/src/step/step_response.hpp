/// StepSolver: the response to the surfaces that are touched.
///
/// A surface with normal n whose mover is displaced by d in the rest of the step allows the displacements w with
/// n·w >= n·d; d is zero where nothing moves. The response to one surface is that of response.hpp, relative to its
/// mover. If it enters another surface, the two are answered one after the other; then surfaces of one body together;
/// and last the nearest motion is taken that all surfaces allow.
#pragma once

#include "step/half_planes.hpp"
#include "step/response.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Whether a mover crushed the character, or overlaps it since an earlier step: it is ignored for the rest of the step.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::ignored(PieceIndex piece) const noexcept {
  return memory_.is(collider_of(piece), moving_.ignored);
}

/// Whether a motion does not enter the surface of a piece that is touched. Its axis alone is then proof that the motion
/// is clear of the piece.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::slides_along_touched(const LocalMotion& motion, PieceIndex piece) const noexcept {
  constexpr Scalar noise = std::numeric_limits<Scalar>::epsilon() * 32;
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces) {
    if (surface.piece != piece) continue;
    if (moving_.waits) return true;
    const Scalar start = dot(surface.normal, motion.from) - surface.offset;
    const Scalar out = surface.normal.x() * motion.displacement.x() + surface.normal.y() * motion.displacement.y();
    Scalar size = std::abs(motion_.displacement.x()) + std::abs(motion_.displacement.y());
    if (surface.mover != no_mover) size += movers_.displacement(surface.mover).cwiseAbs().sum();
    return start >= Tolerances<Scalar>{}.certain && (out >= -noise * size || start + out >= Tolerances<Scalar>{}.hit);
  }
  return false;
}

/// Adds the surfaces that stopped the last sweep, and drops those that are no longer touched. The first of them is the
/// one that points up most.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::update_surfaces() noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  const auto less_up = [this](const TouchedSurface<Scalar>& a, const TouchedSurface<Scalar>& b) {
    return up_.up_of(a.normal) < up_.up_of(b.normal);
  };
  auto& surfaces = memory_.surfaces;
  surfaces.swap(memory_.surfaces_before);
  surfaces.clear();
  for (const Stop<Scalar>& stop : found_.stops) surfaces.push_back(surface_at(stop.piece, stop.axes.normal));
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces_before) {
    const bool again = std::any_of(found_.stops.begin(), found_.stops.end(),
                                   [&surface](const Stop<Scalar>& stop) { return stop.piece == surface.piece; });
    if (again || ignored(surface.piece)) continue;
    const V at = local(surface.piece, position_);
    const bool touched = best_axis<Lanes>(space_, surface.piece, at).separation <= touch &&
                         std::abs(space_.separation(surface.piece, surface.axis, at)) <= touch;
    if (touched || moving_.waits) surfaces.push_back(surface);
  }
  if (surfaces.size() > 1) std::swap(surfaces[0], *std::max_element(surfaces.begin(), surfaces.end(), less_up));
}

/// Displacement of a surface in the rest of the step [m].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::remaining_of(const TouchedSurface<Scalar>& surface) const noexcept {
  if (surface.mover == no_mover) return V::Zero();
  return movers_.remaining(surface.mover, time_);
}

/// Velocity of a surface [m/s].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::velocity_of(const TouchedSurface<Scalar>& surface) const noexcept {
  if (surface.mover == no_mover) return V::Zero();
  return movers_.displacement(surface.mover) / movers_.dt;
}

template <class Scalar>
[[nodiscard]] HalfPlane<Scalar> half_plane_of(const Vec2<Scalar>& normal, const Vec2<Scalar>& motion) noexcept {
  return {normal, normal.x() * motion.x() + normal.y() * motion.y()};
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::allowed(const DesiredMotion<Scalar>& desired,
                                            const TouchedSurface<Scalar>& surface) const noexcept {
  return half_plane_of(surface.normal, remaining_of(surface)).allows(desired.displacement.wanted) &&
         half_plane_of(surface.normal, velocity_of(surface)).allows(desired.velocity.wanted);
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::allowed(const DesiredMotion<Scalar>& desired) const noexcept {
  return std::all_of(memory_.surfaces.begin(), memory_.surfaces.end(),
                     [&](const TouchedSurface<Scalar>& surface) { return allowed(desired, surface); });
}

/// The response to one surface, relative to its motion. Walkable ground that carries counts with its whole motion, as
/// do walls and slopes that go with it, also before it is touched; any other surface only with its motion along its
/// normal.
/// @param after_walk see `Surface`.
template <std::size_t Lanes, class Scalar, class Up>
DesiredMotion<Scalar> StepSolver<Lanes, Scalar, Up>::response_to(const TouchedSurface<Scalar>& surface,
                                                                 const DesiredMotion<Scalar>& desired,
                                                                 bool after_walk) const noexcept {
  const Surface<Scalar> at{surface.normal, walkable(surface.normal), after_walk};
  const TouchedSurface<Scalar>& ground = memory_.surfaces[0];
  const auto carries = [this](const TouchedSurface<Scalar>& touched) {
    return walkable(touched.normal) && carrier_of(touched.piece) != no_mover;
  };
  const bool is_carried_along =
      carries(surface) || surface.mover == moving_.carrier || (surface.mover == ground.mover && carries(ground));
  const auto response = [&](const Desired<Scalar>& given, const V& motion_of_surface,
                            Scalar steered) -> Desired<Scalar> {
    V frame = motion_of_surface;
    if (!is_carried_along) frame = surface.normal * half_plane_of(surface.normal, motion_of_surface).least;
    const Desired<Scalar> relative{given.wanted - frame, given.unsteered - frame};
    if (dot(relative.wanted, surface.normal) >= 0) return given;
    const Desired<Scalar> result = respond(up_, relative, steered, at);
    return {result.wanted + frame, result.unsteered + frame};
  };
  return {response(desired.displacement, remaining_of(surface), steered_ * dt_ * (1 - time_)),
          response(desired.velocity, velocity_of(surface), steered_)};
}

/// The response to the first surface, and to a second one that the first response enters. False if that enters a third.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::respond_one_by_one(DesiredMotion<Scalar>& desired) const noexcept {
  const DesiredMotion<Scalar> wanted = desired;
  const TouchedSurface<Scalar>& first = memory_.surfaces[0];
  const DesiredMotion<Scalar> alone = response_to(first, wanted, after_walk_);
  desired = alone;
  if (allowed(desired)) return true;
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces) {
    if (allowed(alone, surface)) continue;
    desired = response_to(surface, alone, after_walk_ || walkable(first.normal));
    if (allowed(desired)) return true;
    desired = response_to(first, response_to(surface, wanted, after_walk_), after_walk_ || walkable(surface.normal));
    if (!allowed(desired)) continue;
    if (remaining_of(surface) != remaining_of(first)) fall_between(desired);
    return true;
  }
  desired = wanted;
  return false;
}

/// What was lost at both surfaces in turns must not hold up a fall between surfaces that part.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::fall_between(DesiredMotion<Scalar>& desired) const noexcept {
  const auto falling = nearest_allowed_to(up_.in_world({0, fall_ * dt_ * (1 - time_)}), up_.in_world({0, fall_}));
  if (falling && up_.up_of(falling->displacement.wanted) < up_.up_of(desired.displacement.wanted)) desired = *falling;
}

/// Surfaces with one motion that stop the character together: a fall may still slip down between them. Otherwise the
/// motion ends there, relative to them. False if their motions differ.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::respond_in_crease(DesiredMotion<Scalar>& desired) noexcept {
  const TouchedSurface<Scalar>& first = memory_.surfaces[0];
  const DesiredMotion<Scalar> alone = response_to(first, desired, after_walk_);
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces)
    if (!allowed(alone, surface) && remaining_of(surface) != remaining_of(first)) return false;
  const V velocity = velocity_of(first);
  const DesiredMotion<Scalar> with_body = DesiredMotion<Scalar>::plain(remaining_of(first), velocity);
  if (!allowed(with_body)) return false;
  const Scalar fall = fall_ - up_.up_of(velocity);
  const bool on_ground =
      std::any_of(memory_.surfaces.begin(), memory_.surfaces.end(),
                  [this](const TouchedSurface<Scalar>& surface) { return walkable(surface.normal); });
  desired = with_body;
  wedged_ = fall < 0;
  if (wedged_) {
    ground_ = first.piece;
    ground_axis_ = first.axis;
  }
  if (fall >= 0 || on_ground) return true;
  const V displacement = up_.in_world({0, fall * dt_ * (1 - time_)});
  const V falls = up_.in_world({0, fall});
  const std::optional<DesiredMotion<Scalar>> falling =
      nearest_allowed_to(with_body.displacement.wanted + displacement, velocity + falls);
  const auto slips = [&] {
    return up_.up_of(falling->velocity.wanted) - up_.up_of(velocity) <
           along_plane<Scalar> * (fall - length_of(velocity));
  };
  if (falling && slips())
    desired = *falling;
  else if (velocity == V::Zero() && shift_to_fall(displacement, up_.in_world({1, 0})))
    desired = DesiredMotion<Scalar>::plain(displacement, falls);
  else if (velocity != V::Zero() || !up_.is_slanted() || !fall_along_a_side(displacement, falls, desired))
    return true;
  wedged_ = false;
  return true;
}

/// The nearest motion that all surfaces allow. Steering and horizontal momentum count only where they do not slow a
/// fall: between two steep surfaces they would become a climb. False if the surfaces leave no motion.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::respond_together(DesiredMotion<Scalar>& desired) const noexcept {
  const Desired<Scalar> displacement = desired.displacement;
  const Desired<Scalar> velocity = desired.velocity;
  const auto wanted = nearest_allowed_to(displacement.wanted, velocity.wanted);
  if (!wanted) return false;
  desired = *wanted;
  const auto falls_by = [&](const V& down, const V& velocity_of_fall) {
    const auto falling = nearest_allowed_to(down, velocity_of_fall);
    if (falling && up_.up_of(falling->displacement.wanted) < up_.up_of(desired.displacement.wanted)) desired = *falling;
  };
  falls_by(displacement.unsteered, velocity.unsteered);
  const auto upwards = [this](const V& v) { return up_.in_world({0, up_.up_of(v)}); };
  if (up_.up_of(displacement.unsteered) < 0) falls_by(upwards(displacement.unsteered), upwards(velocity.unsteered));
  return true;
}

/// Nothing if there is no motion that all surfaces allow.
template <std::size_t Lanes, class Scalar, class Up>
std::optional<DesiredMotion<Scalar>> StepSolver<Lanes, Scalar, Up>::nearest_allowed_to(
    const V& displacement, const V& velocity) const noexcept {
  std::vector<HalfPlane<Scalar>>& displacements = memory_.displacement_planes;
  std::vector<HalfPlane<Scalar>>& velocities = memory_.velocity_planes;
  displacements.clear();
  velocities.clear();
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces) {
    add_plane(half_plane_of(surface.normal, remaining_of(surface)), displacements);
    add_plane(half_plane_of(surface.normal, velocity_of(surface)), velocities);
  }
  const auto allowed_displacement = nearest_allowed<Scalar>(displacement, {displacements.begin(), displacements.end()});
  if (!allowed_displacement) return std::nullopt;
  const auto allowed_velocity = nearest_allowed<Scalar>(velocity, {velocities.begin(), velocities.end()});
  return DesiredMotion<Scalar>::plain(*allowed_displacement, allowed_velocity.value_or(V::Zero()));
}

/// @param desired a slide that enters the surface by rounding.
template <class Scalar>
[[gnu::cold, gnu::noinline]] void keep_on_surface(const Vec2<Scalar>& normal, DesiredMotion<Scalar>& desired) noexcept {
  desired = DesiredMotion<Scalar>::plain(rounded_slide(desired.displacement.wanted, normal),
                                         rounded_slide(desired.velocity.wanted, normal));
}

/// The response to one surface that stands still: the usual case.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::respond_to_surface(const V& normal, DesiredMotion<Scalar>& desired) const noexcept {
  const Surface<Scalar> at{normal, walkable(normal), after_walk_};
  constexpr bool upright = std::is_same_v<Up, Upright<Scalar>>;
  if (!upright && steered_ == 0)
    desired = DesiredMotion<Scalar>::plain(desired.displacement.wanted, desired.velocity.wanted);
  if (!upright || steered_ != 0) {
    desired.displacement = respond(up_, desired.displacement, steered_ * dt_ * (1 - time_), at);
    desired.velocity = respond(up_, desired.velocity, steered_, at);
  } else {
    desired.displacement.wanted = respond(desired.displacement.wanted, at);
    desired.velocity.wanted = respond(desired.velocity.wanted, at);
  }
  // A slow slide may still enter the surface by rounding. A motion along walkable ground does not.
  if (!at.walkable && (enters(desired.displacement.wanted, normal) || enters(desired.velocity.wanted, normal)))
    keep_on_surface(normal, desired);
}

/// The response to several surfaces, or to one that moves.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::respond_to_all(DesiredMotion<Scalar>& desired) noexcept {
  if (steered_ == 0) desired = DesiredMotion<Scalar>::plain(desired.displacement.wanted, desired.velocity.wanted);
  if (!respond_one_by_one(desired) && !respond_in_crease(desired) && !respond_together(desired)) return false;
  if (movers_.active && !wedged_ && ends_fall_in_wedge(desired)) {
    wedged_ = true;
    ground_ = memory_.surfaces[0].piece;
    ground_axis_ = memory_.surfaces[0].axis;
  }
  return true;
}

/// Whether steep surfaces that move apart hardly, or close in, hold a fall between them: a slope and a crate that
/// rests, for example.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::ends_fall_in_wedge(const DesiredMotion<Scalar>& desired) const noexcept {
  constexpr Scalar hardly = Scalar(0.1);
  Scalar left = 0;
  Scalar right = 0;
  Scalar fastest = 0;
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces) {
    if (walkable(surface.normal)) return false;
    const Scalar across = up_.across_of(surface.normal);
    left = std::min(left, across);
    right = std::max(right, across);
    fastest = std::max(fastest, length_of(velocity_of(surface)));
  }
  const bool holds = left < 0 && right > 0 && up_.up_of(memory_.surfaces[0].normal) > 0;
  const Scalar speed = length_of(desired.velocity.wanted);
  return holds && fall_ < 0 && speed <= hardly * -fall_ && fastest <= hardly * -fall_;
}

/// False where the surfaces leave no motion.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::respond_to_surfaces(DesiredMotion<Scalar>& desired) noexcept {
  const TouchedSurface<Scalar>& first = memory_.surfaces[0];
  wedged_ = false;
  if (movers_.active && up_.across_of(desired.velocity.wanted) == 0 && carries_from_now(first)) {
    begin_to_ride(first);
    desired = DesiredMotion<Scalar>::plain(ground_rest(first.piece, first.normal), moving_.ride.velocity);
    steered_ = 0;
  }
  const bool on_ground = walkable(first.normal);
  if (after_walk_ && !on_ground && up_.up_of(desired.velocity.wanted) > 0) after_walk_ = touches_ground();
  bool possible = true;
  if (memory_.surfaces.size() == 1 && first.mover == no_mover)
    respond_to_surface(first.normal, desired);
  else
    possible = respond_to_all(desired);
  after_walk_ = after_walk_ || on_ground;
  return possible;
}

/// There were too many sweeps, or the path has no room for more corners but the last. Tries to end the step with the
/// present motion, with the motion of a touched surface, or at a free position.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::last_resort(const V& displacement) noexcept {
  if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
  if (!movers_.active) return;
  const auto goes = [this](const V& last) {
    sweep_along(last);
    return !found_.hit && advance(1);
  };
  if (goes(displacement)) return;
  if (!is_passed_through()) {
    for (const TouchedSurface<Scalar>& surface : memory_.surfaces)
      if (goes(remaining_of(surface))) return;
  }
  wait(true);
}

}  // namespace paperproof::octagon_sweep
