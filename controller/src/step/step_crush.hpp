/// Movers that crush.
///
/// A mover crushes the character where it leaves no free position (step_free_position.hpp). The character then stays
/// where it is, which is free of everything that stands still, and the mover passes through it: it is ignored for the
/// rest of the step. While it overlaps the character at the start of a later step, a way out is looked for, as out of
/// any solid, but only to the side from which the character came. Where there is none, the character is stuck. Another
/// mover that runs into it then moves it to a free position on that side, or crushes it, too.
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"
#include "step/step_free_position.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The longest way that a surface which is touched goes in the step [m].
[[nodiscard]] inline Real longest_way(const Step& step) {
  Real way = 0;
  for (const TouchedSurface& surface : step.memory.surfaces)
    way = std::max(way, length_of(step.movers.displacement(surface.mover)));
  return way;
}

/// Moves to a free position beside the movers that are touched, if there is one and nothing has crushed the character
/// yet. After a crush `undo_crushes` does that at the end of the step.
[[nodiscard]] PAPERPROOF_COLD inline bool goes_to_free_position(Step& step) {
  if (!step.result.crushed.empty()) return false;
  if (!move_to_free_position(step, push_left(step, longest_way(step)), step.result.path.size())) return false;
  step.memory.surfaces.clear();
  return true;
}

/// Whether the touched surfaces are not all of one direction.
[[nodiscard]] inline bool are_a_wedge(const Step& step) {
  const Vec2 first = step.memory.surfaces[0].normal;
  return std::ranges::any_of(step.memory.surfaces, [&](const TouchedSurface& surface) {
    return length_of(Vec2(surface.normal - first)) > same_plane;
  });
}

/// How fast a surface goes [m/s]: ground that may carry as a whole, with its belt; any other along its normal.
[[nodiscard]] inline Real speed_of(const Step& step, const TouchedSurface& surface) {
  const Vec2 velocity = step.movers.velocity(surface.mover);
  if (!walkable(step, surface.normal)) return std::abs(dot(velocity, surface.normal));
  return length_of(velocity) + std::abs(surface_speed(step, surface.piece));
}

/// A mover and another surface squeeze the character out as a wedge does: the blunter it is, the farther and the
/// faster.
///
/// - In the step it goes no farther than it wanted to, and they go, and `Tolerances::push`.
/// - It gets no faster than twice the fastest of them: so fast a wall pushes up a slope of 60 degrees. What it had it
///   keeps; of a walk that is its speed along the ground.
///
/// @param wants its velocity before the response. @param allowed by the response.
/// @return false if they would push it too far: then it goes to a free position, or is crushed.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool limit_push(const Step& step, const Vec2& wants,
                                                           DesiredMotion& allowed) {
  const std::vector<TouchedSurface>& surfaces = step.memory.surfaces;
  const auto pushes = [&](const TouchedSurface& surface) { return moves_in(step, surface); };
  if (!are_a_wedge(step) || std::ranges::none_of(surfaces, pushes)) return true;
  Real own = length_of(wants);
  Real speed = 0;
  for (const TouchedSurface& surface : surfaces) {
    if (walkable(step, surface.normal))
      own = std::max<Real>(own, std::abs(step.up.across_of(wants)) / step.up.up_of(surface.normal));
    speed = std::max(speed, speed_of(step, surface));
  }
  const Vec2 whole = step.position + allowed.displacement.wanted - step.start;
  const Real farthest = length_of(step.wanted) + longest_way(step) + static_cast<Real>(step.request.around.limits.push);
  if (length_of(whole) > farthest) return false;
  const Real most = std::max(own, 2 * speed) + std::abs(step.steered);
  const Real share = std::min(Real(1), most / length_of(allowed.velocity.wanted));
  allowed.velocity = {allowed.velocity.wanted * share, allowed.velocity.unsteered * share};
  return true;
}

/// After several crushes there may be a free position that was not there after the first one. Looks for it beside all
/// movers that crushed, no farther away than they may push; then nothing was crushed.
PAPERPROOF_COLD inline void undo_crushes(Step& step) {
  step.moving.ignored &= static_cast<std::uint8_t>(~crushes);
  Real way = 0;
  for (const ColliderIndex collider : step.result.crushed)
    way = std::max(way, length_of(displacement_of(step, collider)));
  step.memory.surfaces.clear();
  if (move_to_free_position(step, push_left(step, way), step.moving.corners_before_crush)) {
    for (const ColliderIndex collider : step.result.crushed) step.memory.unmark(collider, crushes);
    step.result.crushed.clear();
    step.result.status =
        step.moving.status_before_crush == StepStatus::dropped ? StepStatus::dropped : StepStatus::moved;
  }
  step.moving.ignored = passes_through;
}

/// Notes that the mover of a piece crushes the character.
/// @param since the character was free of the mover at this fraction of the step.
inline void crush(Step& step, PieceIndex piece, Real since) {
  const MoverIndex mover = mover_of(step, piece);
  if (ignored(step, piece) || mover == no_mover) return;
  if (step.result.crushed.empty()) {
    step.moving.corners_before_crush = step.result.path.size();
    step.moving.status_before_crush = step.result.status;
  }
  const ColliderIndex collider = collider_of(step, piece);
  step.memory.mark(collider, crushes);
  step.result.crushed.push_back(collider);
  step.result.status = StepStatus::crushed;
  remember(step, {collider, step.position, step.movers.remaining(mover, since)});
}

/// Lets every touched surface crush that moves into the character. False if there is none.
PAPERPROOF_COLD inline bool note_crushers(Step& step) {
  const std::size_t before = step.result.crushed.size();
  for (const TouchedSurface& surface : step.memory.surfaces)
    if (moves_in(step, surface)) crush(step, surface.piece, step.time);
  return step.result.crushed.size() > before;
}

/// Hands the crushers to the next step, those with a known side first.
inline void hand_on_crushers(Step& step) {
  for (const bool has_side : {true, false})
    for (const Crusher& known : step.memory.crushers)
      if (step.memory.is(known.collider, overlaps_at_end) && known.has_side == has_side)
        step.result.crushers.push_back(known);
}

/// Finds the movers that were ignored in this step and still overlap the character. If one of them overlapped at the
/// start, the character is stuck, unless it was crushed in this step. Hands the list to the next step.
PAPERPROOF_COLD inline void find_movers_that_still_overlap(Step& step) {
  step.moving.ignored = 0;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const ColliderIndex collider = collider_of(step, piece);
    if (step.memory.is(collider, passes_through) && !step.memory.is(collider, overlaps_at_end) &&
        overlaps(step, piece, step.position))
      step.memory.mark(collider, overlaps_at_end);
  });
  for (const ColliderIndex collider : step.memory.marked) {
    const bool has_it_stuck = step.memory.is(collider, overlaps_at_end) && !step.memory.is(collider, crushes);
    if (has_it_stuck && step.result.status != StepStatus::crushed) step.result.status = StepStatus::stuck;
  }
  hand_on_crushers(step);
}

/// The character stays where it is for the rest of the step, and movers that run into it crush it. Sweeps do not look
/// at surfaces that are touched and do not come closer: they would hide a mover that comes later.
/// @param may_move it moves to a free position instead, if there is one.
PAPERPROOF_COLD inline void wait(Step& step, bool may_move) {
  halt(step);
  step.memory.surfaces.clear();
  step.moving.waits = true;
  // Each round makes a touched surface of one more piece at least, and a touched one stops no sweep.
  for (sweep_along(step, Vec2::Zero()); step.found.hit; sweep_along(step, Vec2::Zero())) {
    update_surfaces(step);
    if (may_move && goes_to_free_position(step)) {
      step.moving.waits = false;
      return;
    }
    note_crushers(step);
  }
  step.moving.waits = false;
  step.moving.anchored = false;
  const Real since = step.time;
  step.time = 1;
  // Movers that overlap by no more than rounding, which no sweep sees, crush, too.
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (overlaps(step, piece, step.position)) crush(step, piece, since);
  });
  push_corner(step, step.time);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
