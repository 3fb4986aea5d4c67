/// The response of the step to the surfaces that are touched: see response.hpp.
#pragma once

#include "inlining.hpp"
#include "step/half_planes.hpp"
#include "step/response.hpp"
#include "step/step.hpp"
#include "step/step_ground.hpp"
#include "step/step_ride.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// @param desired a slide that enters the surface by rounding.
PAPERPROOF_COLD inline void keep_on_surface(const Vec2& normal, DesiredMotion& desired) {
  desired = DesiredMotion::plain(rounded_slide(desired.displacement.wanted, normal),
                                 rounded_slide(desired.velocity.wanted, normal));
}

/// The response of a motion or velocity, relative to the first surface. Ground that carries, and what goes with it,
/// counts with its whole motion, also before it is touched; any other surface only with its motion along its normal.
/// @param steered see `respond`. @param on_stair the first surface is a stair: level ground as well.
/// @param motion_of gives the motion of a surface. @return false if the surfaces leave no motion.
template <class MotionOf>
[[nodiscard]] inline bool respond_to_touched(Step& step, Desired& desired, Real& steered, bool on_stair,
                                             const MotionOf& motion_of) {
  std::vector<HalfPlane>& planes = step.memory.planes;
  planes.clear();
  const TouchedSurface& first = step.memory.surfaces[0];
  const auto carries = [&](const TouchedSurface& touched) {
    return walkable(step, touched.normal) && mover_of(step, touched.piece) != no_mover;
  };
  const Vec2 origin = motion_of(first);
  Real fastest = 0;  // of the surfaces
  if (on_stair) add_plane({{0, 1}, 0, true}, planes);
  for (const TouchedSurface& surface : step.memory.surfaces) {
    const Vec2 motion = motion_of(surface);
    fastest = std::max(fastest, length_of(motion));
    const bool is_carried_along =
        surface.mover != no_mover &&
        (carries(surface) || surface.mover == step.moving.carrier || (surface.mover == first.mover && carries(first)));
    const Vec2 rest = is_carried_along ? motion : Vec2(surface.normal * dot(surface.normal, motion));
    add_plane({step.up.seen(surface.normal), dot(surface.normal, Vec2(motion - origin)), walkable(step, surface.normal),
               step.up.seen(Vec2(rest - origin))},
              planes);
  }
  const Real rounding = along_plane * (length_of(desired.unsteered) + 2 * fastest);
  const std::optional<Desired> result =
      respond({step.up.seen(Vec2(desired.wanted - origin)), step.up.seen(Vec2(desired.unsteered - origin))}, steered,
              step.after_walk, planes, rounding);
  if (!result) return false;
  const auto in_world_again = [&](const Vec2& w) -> Vec2 {
    return (planes.size() == 1 ? in_world(step.up, w, first.normal) : Vec2(step.up.in_world(w))) + origin;
  };
  desired = {in_world_again(result->wanted), in_world_again(result->unsteered)};
  return true;
}

/// Notes that a fall ends between the surfaces that are touched.
/// @param ground the one that points up most.
PAPERPROOF_COLD inline void note_wedge(Step& step, const TouchedSurface& ground) {
  step.wedged = true;
  step.ground = ground.piece;
  step.ground_axis = ground.axis;
}

/// Whether the character can fall straight down between two rims that it touches, farther than touches reach: a shaft
/// may be a little wider than the character. If it is off the middle, it shifts there.
/// @param aside unit vector, across the fall.
[[nodiscard]] PAPERPROOF_COLD inline bool shift_to_fall(Step& step, const Vec2& displacement, const Vec2& aside) {
  const Real length = std::max(length_of(displacement), std::numeric_limits<Real>::min());
  const Vec2 way = displacement * std::max(Real(1), 2 * tolerances.touch / length);
  const auto falls = [&] {
    sweep_along(step, way);
    return !step.found.hit || step.found.stop * step.motion.length > tolerances.touch;
  };
  if (falls()) return true;
  if (step.certify) return false;
  const auto room = [&](const Vec2& normal) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const TouchedSurface& surface : step.memory.surfaces)
      if (dot(surface.normal, normal) > 0)
        least = std::min(
            least, separation_along(step.space, surface.piece, normal, local(step, surface.piece, step.position)));
    return least;
  };
  const Real by = (room(-aside) - room(aside)) / 2;
  if (!(std::abs(by) <= tolerances.touch)) return false;
  const Vec2 here = step.position;
  step.position += aside * by;
  if (exactly_clear(step, here, step.position) && falls()) {
    push_corner(step, step.time);
    return true;
  }
  step.position = here;
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

/// Surfaces that hold a fall may be the rims of a shaft that is hardly wider than the character.
[[nodiscard]] PAPERPROOF_COLD inline bool slips_between_rims(Step& step, DesiredMotion& desired) {
  for (const TouchedSurface& surface : step.memory.surfaces)
    if (step.movers.displacement(surface.mover) != Vec2::Zero()) return false;
  const Vec2 displacement = step.up.in_world({0, step.fall * step.movers.dt * (1 - step.time)});
  const Vec2 falls = step.up.in_world({0, step.fall});
  if (!shift_to_fall(step, displacement, step.up.in_world({1, 0})))
    return step.up.is_slanted() && fall_along_a_side(step, displacement, falls, desired);
  desired = DesiredMotion::plain(displacement, falls);
  return true;
}

/// Whether surfaces that go almost alike leave hardly anything of a fall, and none of them is ground below the
/// character: steep ones on both sides, such as a slope and a crate that rests, or ground that the character is beside.
[[nodiscard]] PAPERPROOF_COLD inline bool holds_fall(const Step& step, const DesiredMotion& desired) {
  const Vec2 velocity = step.movers.velocity(step.memory.surfaces[0].mover);
  const Real hardly = Real(0.1) * (step.up.up_of(velocity) - step.fall);
  if (!(hardly > 0 && length_of(Vec2(desired.velocity.unsteered - velocity)) <= hardly)) return false;
  Real left = 0;
  Real right = 0;
  bool beside = false;
  for (const TouchedSurface& surface : step.memory.surfaces) {
    const bool is_ground = walkable(step, surface.normal);
    if (is_ground && !is_beside(step, surface.piece, surface.axis)) return false;
    beside = beside || is_ground;
    const Real across = step.up.across_of(surface.normal);
    left = std::min(left, across);
    right = std::max(right, across);
    if (!(length_of(Vec2(step.movers.velocity(surface.mover) - velocity)) <= hardly)) return false;
  }
  return (beside || (left < 0 && right > 0)) && step.up.up_of(step.memory.surfaces[0].normal) > 0;
}

/// The response to all touched surfaces. False where they leave no motion.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool respond_to_all(Step& step, DesiredMotion& desired) {
  const TouchedSurface& first = step.memory.surfaces[0];
  const bool on_stair = rests_on_stair(step, first);
  step.after_walk = step.after_walk || on_stair;
  if (step.steered == 0) desired = DesiredMotion::plain(desired.displacement.wanted, desired.velocity.wanted);
  const auto remaining = [&](const TouchedSurface& surface) { return remaining_of(step, surface); };
  const auto velocity = [&](const TouchedSurface& surface) { return step.movers.velocity(surface.mover); };
  Real steered_way = step.steered * step.movers.dt * (1 - step.time);
  if (!respond_to_touched(step, desired.displacement, steered_way, on_stair, remaining)) return false;
  if (!respond_to_touched(step, desired.velocity, step.steered, on_stair, velocity))
    desired.velocity = {Vec2::Zero(), Vec2::Zero()};
  if (step.memory.surfaces.size() > 1) {
    if (!on_stair && holds_fall(step, desired) && !slips_between_rims(step, desired)) note_wedge(step, first);
  } else if (first.mover == no_mover && !walkable(step, first.normal) &&
             (enters(desired.displacement.wanted, first.normal) || enters(desired.velocity.wanted, first.normal))) {
    // A slow slide may still enter the surface by rounding. A motion along walkable ground does not.
    keep_on_surface(first.normal, desired);
  }
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
  if (step.after_walk && !on_ground) step.after_walk = touches_ground(step);
  bool possible = true;
  const auto is_same_ground = [&](const TouchedSurface& surface) {
    return surface.mover == no_mover && surface.normal == first.normal;
  };
  if (on_ground && !step.up.is_turned() && std::ranges::all_of(step.memory.surfaces, is_same_ground)) {
    const HalfPlane ground{first.normal, 0, true};
    follow(ground, step.steered * step.movers.dt * (1 - step.time), desired.displacement);
    follow(ground, step.steered, desired.velocity);
  } else {
    possible = respond_to_all(step, desired);
  }
  step.after_walk = step.after_walk || on_ground;
  return possible;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
