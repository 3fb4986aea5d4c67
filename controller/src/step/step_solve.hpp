/// The whole step, its loop of sweep and response, and the ground at its end.
#pragma once

#include "inlining.hpp"
#include "step/response.hpp"
#include "step/step.hpp"
#include "step/step_crush.hpp"
#include "step/step_ground.hpp"
#include "step/step_push.hpp"
#include "step/step_response.hpp"
#include "step/step_ride.hpp"
#include "step/step_stairs.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Whether such a displacement is none, and nothing moves: then nothing that is touched is entered.
[[nodiscard]] PAPERPROOF_INLINE bool lies_still(const Step& step, const Vec2& displacement) {
  return !step.movers.active && displacement.x() == 0 && displacement.y() == 0;
}

/// Stops a motion at ground that is touched now and at the end of the motion. Under tiny gravity a walk enters its
/// ground by less than the sweep sees. It would leave the ground, sink until the sweep hits it, and be put back, over
/// and over.
PAPERPROOF_COLD inline void stop_at_touched_ground(Step& step) {
  if (lies_still(step, step.motion.displacement)) return;
  const Vec2 from = step.position;
  const Real begin = step.time;
  step.position += step.motion.displacement;
  step.time = 1;
  const bool ends_on_ground = touches_ground(step);
  step.position = from;
  step.time = begin;
  if (!ends_on_ground) return;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const std::optional<TouchedSurface> ground = touched_ground(step, piece);
    if (!ground || step.space.covered(piece, ground->axis)) return;
    const Vec2 displacement = step.movers.relative(step.motion.displacement, ground->mover, step.time);
    const Motion motion = make_motion(step.space, local(step, piece, step.position), displacement);
    if (!enters(displacement, ground->normal) || !in_way(step, motion, piece)) return;
    keep_stop(step, {piece, 0, 0, {ground->axis, ground->axis, false, false}}, motion.length);
  });
  order_stops(step);
}

/// Reads what the step wants, and whether it begins as a walk on the ground.
inline void begin_motion(Step& step) {
  const StepRequest& request = step.request;
  step.position = step.start = request.state.position;
  step.velocity = request.velocity;
  step.steered = request.steered;
  step.leaves_ground_above = request.next_dt > 0 ? tolerances.touch / static_cast<Real>(request.next_dt) : Real(0);
  // A rise that is steeper than any walkable ground is no climb.
  step.after_walk = step.climbs =
      request.state.grounded &&
      step.up.up_of(request.velocity) <= std::abs(step.up.across_of(request.velocity)) * step.settings.walkable_tangent;
}

/// The desired motion, with and without this step's steering.
[[nodiscard]] inline DesiredMotion desired_motion(const Step& step) {
  const Vec2 steered = step.up.in_world({step.steered, 0});
  return {{step.motion.displacement, step.motion.displacement - steered * step.movers.dt},
          {step.velocity, step.velocity - steered}};
}

/// Ends the step here. The velocity still becomes one that the touched surfaces allow: otherwise it would grow from
/// step to step.
PAPERPROOF_COLD inline void end_at_surfaces(Step& step, DesiredMotion& desired) {
  if (respond_to_surfaces(step, desired))
    step.velocity = desired.velocity.wanted;
  else
    halt(step);
}

/// Ends the step here, as the exact certificate or the range forbids the motion. Reports each piece that blocks it.
PAPERPROOF_COLD inline void cut_short(Step& step) {
  if (step.result.status == StepStatus::moved) step.result.status = StepStatus::dropped;
  const Vec2 target = step.motion.from + step.motion.displacement * step.found.stop;
  const Real end = step.time + (1 - step.time) * step.found.stop;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (blocks_exactly(step, piece, target, end)) report_touched(step, piece);
  });
  halt(step);
  if (step.movers.active) wait(step, true);
}

/// A slide along a surface that is nearer than `stop`, changed so that it ends at that gap.
[[nodiscard]] inline Vec2 with_gap_restored(const Step& step, const Vec2& displacement, const Stop& at) {
  if (displacement.x() == 0 && displacement.y() == 0) return displacement;
  const Real gap = step.space.separation(at.piece, at.axes.normal, local(step, at.piece, step.position));
  if (!(gap < tolerances.stop - tolerances.restore) || gap < 0) return displacement;
  return displacement + step.space.normal(at.piece, at.axes.normal) * (tolerances.stop - gap);
}

/// Advances to the earliest impact, responds to all touched surfaces, and sweeps again with what is left of the
/// displacement.
PAPERPROOF_FLATTEN inline void travel(Step& step) {
  const std::size_t most_corners = step.memory.most_corners - 3;
  const std::size_t most_sweeps = 4 * most_corners;  // several impacts may come at one moment
  DesiredMotion desired = desired_motion(step);
  step.fall = step.up.up_of(desired.velocity.unsteered);
  Vec2 displacement = step.motion.displacement;  // of the next sweep: it may also restore the gap to a surface
  bool may_aim = true;
  int impacts = 0;
  for (std::size_t sweeps = 0; sweeps < most_sweeps && step.result.path.size() < most_corners; ++sweeps) {
    if (lies_still(step, displacement)) return;
    if (sweeps > 0) sweep_along(step, displacement);
    if (step.found.hit && step.found.stop == 0 && displacement != desired.displacement.wanted) {
      // The gap cannot be restored here: give that up for this step.
      displacement = desired.displacement.wanted;
      may_aim = false;
      continue;
    }
    const Real begin = step.time;
    if (!advance(step, step.found.hit ? step.found.stop : Real(1))) return cut_short(step);
    if (!step.found.hit) return;
    const Stop first = step.found.stops[0];  // the response may sweep again
    report(step, begin);
    note_velocity(step, desired.velocity);
    if (step.found.stop * step.motion.length > tolerances.touch)
      step.fall = step.up.up_of(step.steered != 0 ? desired.velocity.unsteered : desired.velocity.wanted);
    update_surfaces(step);
    const Real left = 1 - step.found.stop;
    desired.displacement.wanted *= left;
    if (step.steered != 0) desired.displacement.unsteered *= left;
    if (++impacts == step.settings.iterations) {
      if (step.result.status == StepStatus::moved) step.result.status = StepStatus::dropped;
      if (!step.movers.active) return end_at_surfaces(step, desired);
      // The rest of the displacement is dropped. Movers still push the character.
      desired = DesiredMotion::plain(Vec2::Zero(), Vec2::Zero());
      step.steered = 0;
    }
    const bool is_answered = !is_passed_through(step) && respond_to_surfaces(step, desired);
    if (!is_answered || (step.movers.active && !limit_push(step, desired))) {
      if (goes_to_free_position(step)) return;
      if (!note_crushers(step)) return wait(step, true);
      desired = DesiredMotion::plain(Vec2::Zero(), Vec2::Zero());
      step.steered = 0;
    }
    step.velocity = desired.velocity.wanted;
    note_velocity(step, desired.velocity);
    displacement = may_aim ? with_gap_restored(step, desired.displacement.wanted, first) : desired.displacement.wanted;
  }
  last_resort(step, displacement);
}

PAPERPROOF_COLD inline void look_for_ground(Step& step) {
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (step.result.grounded) return;
    const auto ground = stood_on(step, piece);
    if (ground && (step.request.state.grounded || !is_beside(step, piece, ground->axis)))
      note_ground(step, GroundState::walkable, piece, ground->normal);
  });
  const auto is_steep = [&](const Vec2& normal) { return step.up.up_of(normal) > 0 && !walkable(step, normal); };
  if (step.result.grounded ||
      std::ranges::none_of(step.result.contacts, [&](const Contact& contact) { return is_steep(contact.normal); }))
    return;
  std::optional<TouchedSurface> slide;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const std::optional<TouchedSurface> surface = touched_here(step, piece);
    if (!surface || !is_steep(surface->normal) || step.space.covered(piece, surface->axis)) return;
    if (!slide || step.up.up_of(surface->normal) > step.up.up_of(slide->normal)) slide = surface;
  });
  if (!slide) return;
  if (rests_on_stair(step, *slide))
    note_ground(step, GroundState::walkable, slide->piece, upward(step));
  else
    note_ground(step, GroundState::steep, slide->piece, slide->normal);
}

/// What the character stands on at the end of the step: walkable ground that it touches and that its motion does not
/// leave, or a wedge that ended its fall; or what it slides down.
PAPERPROOF_INLINE void find_ground(Step& step) {
  if (step.on_ground || step.wedged || (step.met_ground && stood_on(step, step.ground))) {  // the usual case
    const Vec2 normal = step.space.normal(step.ground, step.ground_axis);
    note_ground(step, walkable(step, normal) ? GroundState::walkable : GroundState::wedge, step.ground, normal);
  } else if (!step.result.contacts.empty() ||
             (step.leaves_ground_above > 0 && step.found.least_kept <= tolerances.touch)) {
    look_for_ground(step);  // in most steps in the air nothing is near
  }
}

/// Lands on the ground that the character touches at the end of a step in which no sweep hit it, and reports it:
/// gravity presses onto it by less than the sweep sees, or a fall ends just there. Ground that the wanted motion does
/// not enter stops nothing, and carries nobody: a character that jumps and hits a ceiling at once stands again, and its
/// only contact is the ceiling. Nor does a one-way surface that the step began beneath.
PAPERPROOF_COLD inline void land(Step& step, const Vec2& wanted) {
  if (lies_still(step, wanted)) return;
  step.memory.surfaces.clear();
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const std::optional<TouchedSurface> ground = stood_on(step, piece);
    if (!ground || !may_block(step, piece, step.start, Real(0)) ||
        !enters(step.movers.relative(wanted, ground->mover, Real(0)), ground->normal))
      return;
    step.memory.surfaces.push_back(*ground);
    report_touched(step, piece);
  });
  if (step.memory.surfaces.empty()) return;
  DesiredMotion desired = desired_motion(step);
  end_at_surfaces(step, desired);
}

inline void look_at_movers(Step& step) {
  step.near.look_at(step.movers.moving);
  step.movers.active = step.movers.active || !step.movers.moving.motions.empty();
}

inline void solve(Step& step) {
  const StepRequest& request = step.request;
  begin_motion(step);
  Vec2 wanted = request.displacement;
  if (step.movers.active) wanted = begin_ride(step);
  step.wanted = wanted;
  const Real walk = step.up.across_of(step.velocity);
  step.memory.reported_at[0] = {};
  const PathPoint start{step.position, 0};  // of one without a name g++ 12 makes a call
  step.result.path.push_back(start);
  sweep_along(step, wanted);
  const bool near = step.found.least_separation < tolerances.hit;
  if (near) look_at_movers(step);  // the way out of a solid may be longer than the step
  if (near && !prepare_start(step)) {
    step.result.status = StepStatus::stuck;
    halt(step);
    if (step.movers.active) {
      note_colliders_left(step);
      wait(step, false);
      if (!step.result.crushed.empty()) undo_crushes(step);
    }
  } else {
    if (step.movers.active) {
      if (near) step.moving.ride.place += step.position - request.state.position;  // the gap was restored
      if (step.moving.overlapping > 0) {
        halt(step);
        wanted = Vec2::Zero();
        step.steered = 0;
        step.moving.anchored = false;
      }
      note_velocity(step, desired_motion(step).velocity);
    }
    if (near) sweep_along(step, wanted);
    if (request.state.grounded && !step.found.hit) stop_at_touched_ground(step);
    travel(step);
    if (!step.result.crushed.empty()) undo_crushes(step);
    find_ground(step);
    if (step.result.grounded && !step.met_ground && !step.wedged) land(step, wanted);
    if (step.settings.step_height > 0) climb_stairs(step, wanted, walk);
    if (step.climbs && !step.result.grounded) follow_ground_down(step);  // a launch leaves the ground
    if (step.movers.active) end_ride(step);
  }
  if (!step.memory.marked.empty()) find_movers_that_still_overlap(step);
  if (step.result.contacts.size() > 1) order_contacts(step);
  push_corner(step, 1);
  step.result.position = step.position;
  step.result.velocity = step.velocity;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
