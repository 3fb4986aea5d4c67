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

/// Moves to a free position beside the movers that are touched, if there is one and nothing has crushed the character
/// yet. After a crush `undo_crushes` does that at the end of the step.
[[nodiscard]] PAPERPROOF_COLD inline bool goes_to_free_position(Step& step) {
  if (!step.result.crushed.empty()) return false;
  Real reach = 0;
  for (const TouchedSurface& surface : step.memory.surfaces)
    reach = std::max(reach, length_of(step.movers.displacement(surface.mover)));
  if (!move_to_free_position(step, reach, {0, step.result.path.size()})) return false;
  step.memory.surfaces.clear();
  return true;
}

/// Whether a circle would drive the character farther than both go: where it squeezes the character out along its
/// tangent, it leaves the character sooner.
[[nodiscard]] inline bool circle_flings(const Step& step, const Vec2& wanted, const Vec2& allowed) {
  const Real own = length_of(wanted) + std::abs(step.steered) * step.movers.dt + tolerances.touch;
  return std::any_of(step.memory.surfaces.begin(), step.memory.surfaces.end(), [&](const TouchedSurface& surface) {
    return step.space.is_circle(surface.piece) && moves_in(step, surface) &&
           length_of(allowed) > own + length_of(remaining_of(step, surface));
  });
}

/// Movers squeeze the character out as a wedge does. A blunt one would fling it: the speed that they give it is
/// limited.
/// @param wanted before the response. @param allowed by the response.
/// @return false if they would squeeze it out too far in this step: then it goes to a free position, or is crushed.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool limit_squeeze(const Step& step, const DesiredMotion& wanted,
                                                              DesiredMotion& allowed) {
  constexpr Real farthest = 32;  // times as far as they go
  constexpr Real fastest = 8;    // times as fast as they are
  Real way = 0;
  Real speed = 0;
  for (const TouchedSurface& surface : step.memory.surfaces) {
    if (!moves_in(step, surface)) continue;
    if (step.space.is_circle(surface.piece)) return true;
    way = std::max(way, length_of(remaining_of(step, surface)));
    speed = std::max(speed, length_of(step.movers.velocity(surface.mover)));
  }
  if (way == 0) return true;
  const Real own_way = length_of(wanted.displacement.wanted) + std::abs(step.steered) * step.movers.dt;
  if (length_of(allowed.displacement.wanted) > own_way + way * farthest + tolerances.touch) return false;
  const Real most = std::max(length_of(wanted.velocity.wanted), speed * fastest) + std::abs(step.steered);
  const Real now = length_of(allowed.velocity.wanted);
  if (now > most) allowed.velocity.wanted *= most / now;
  return true;
}

/// Moves to a free position beside a circle that would fling the character, if there is one that is no farther away.
/// A way out of what the step began inside of is kept.
/// @param allowed the response to what the last sweep met.
[[nodiscard]] PAPERPROOF_COLD inline bool goes_beside_circle(Step& step, const Vec2& allowed) {
  if (is_passed_through(step) || !circle_flings(step, Vec2(step.motion.displacement * (1 - step.found.stop)), allowed))
    return false;
  const bool has_left = std::any_of(step.memory.marked.begin(), step.memory.marked.end(),
                                    [&](ColliderIndex collider) { return step.memory.is(collider, leaving); });
  if (!move_to_free_position(step, length_of(allowed), {has_left ? std::size_t{1} : 0, step.result.path.size()}))
    return false;
  step.memory.surfaces.clear();
  return true;
}

/// After several crushes there may be a free position that was not there after the first one. Looks for it beside all
/// movers that crushed, no further away than one of them moves; then nothing was crushed.
PAPERPROOF_COLD inline void undo_crushes(Step& step) {
  step.moving.ignored &= static_cast<std::uint8_t>(~crushes);
  Real reach = 0;
  for (const ColliderIndex collider : step.result.crushed)
    reach = std::max(reach, length_of(displacement_of(step, collider)));
  step.memory.surfaces.clear();
  if (move_to_free_position(step, reach, {0, step.moving.corners_before_crush})) {
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
