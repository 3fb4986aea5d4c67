/// StepSolver: movers that crush.
///
/// A mover crushes the character where it leaves no free position (step_free_position.hpp). The character then stays
/// where it is, which is free of everything that stands still, and the mover passes through it: it is ignored for the
/// rest of the step. While it overlaps the character at the start of a later step, a way out is looked for, as out of
/// any solid, but only to the side from which the character came. Where there is none, the character is stuck. Another
/// mover that runs into it then moves it to a free position on that side, or crushes it, too.
#pragma once

#include "step/step_free_position.hpp"

namespace paperproof::octagon_sweep {

/// Whether a mover passes through the character. It then moves only to a free position.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::is_passed_through() const noexcept {
  return moving_.overlapping > 0 || !result_.crushed.empty();
}

/// Moves to a free position beside the movers that are touched, if there is one and nothing has crushed the character
/// yet. After a crush `undo_crushes` does that at the end of the step.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::goes_to_free_position() noexcept {
  if (!result_.crushed.empty()) return false;
  Scalar reach = 0;
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces)
    if (surface.mover != no_mover) reach = std::max(reach, length_of(movers_.displacement(surface.mover)));
  if (!find_free_position(reach, {0, result_.path.size()})) return false;
  memory_.surfaces.clear();
  return true;
}

/// Whether a circle would drive the character farther than both go: where it squeezes the character out along its
/// tangent, it leaves the character sooner.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::circle_flings(const V& wanted, const V& allowed) const noexcept {
  const Scalar own = length_of(wanted) + std::abs(steered_) * dt_ + Tolerances<Scalar>{}.touch;
  return std::any_of(memory_.surfaces.begin(), memory_.surfaces.end(), [&](const TouchedSurface<Scalar>& surface) {
    return space_.is_circle(surface.piece) && moves_in(surface) &&
           length_of(allowed) > own + length_of(remaining_of(surface));
  });
}

/// Movers squeeze the character out as a wedge does. A blunt one would fling it: the speed that they give it is
/// limited.
/// @param wanted before the response. @param allowed by the response.
/// @return false if they would squeeze it out so far in this step that they crush it instead.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::limit_squeeze(const DesiredMotion<Scalar>& wanted,
                                                  DesiredMotion<Scalar>& allowed) const noexcept {
  constexpr Scalar farthest = 32;  // times as far as they go
  constexpr Scalar fastest = 8;    // times as fast as they are
  Scalar way = 0;
  Scalar speed = 0;
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces) {
    if (!moves_in(surface)) continue;
    if (space_.is_circle(surface.piece)) return true;
    way = std::max(way, length_of(remaining_of(surface)));
    speed = std::max(speed, length_of(velocity_of(surface)));
  }
  if (way == 0) return true;
  const Scalar own_way = length_of(wanted.displacement.wanted) + std::abs(steered_) * dt_;
  if (length_of(allowed.displacement.wanted) > own_way + way * farthest + Tolerances<Scalar>{}.touch) return false;
  const Scalar most = std::max(length_of(wanted.velocity.wanted), speed * fastest) + std::abs(steered_);
  const Scalar now = length_of(allowed.velocity.wanted);
  if (now > most) allowed.velocity.wanted *= most / now;
  return true;
}

/// Moves to a free position beside a circle that would fling the character, if there is one that is no farther away.
/// A way out of what the step began inside of is kept.
/// @param allowed the response to what the last sweep met.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::goes_beside_circle(const V& allowed) noexcept {
  if (is_passed_through() || !circle_flings(V(motion_.displacement * (1 - found_.stop)), allowed)) return false;
  const bool has_left = std::any_of(memory_.marked.begin(), memory_.marked.end(),
                                    [this](ColliderIndex collider) { return memory_.is(collider, leaving); });
  if (!find_free_position(length_of(allowed), {has_left ? std::size_t{1} : 0, result_.path.size()})) return false;
  memory_.surfaces.clear();
  return true;
}

/// After several crushes there may be a free position that was not there after the first one. Looks for it beside all
/// movers that crushed, no further away than one of them moves; then nothing was crushed.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::undo_crushes() noexcept {
  moving_.ignored &= static_cast<std::uint8_t>(~crushes);
  Scalar reach = 0;
  for (const ColliderIndex collider : result_.crushed) reach = std::max(reach, length_of(displacement_of(collider)));
  memory_.surfaces.clear();
  if (find_free_position(reach, {0, moving_.corners_before_crush})) {
    for (const ColliderIndex collider : result_.crushed) memory_.unmark(collider, crushes);
    result_.crushed.clear();
    result_.status = moving_.status_before_crush == MoveStatus::dropped ? MoveStatus::dropped : MoveStatus::moved;
  }
  moving_.ignored = does_not_block;
}

/// Whether a surface moves into a character that stays where it is, by more than rounding.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::moves_in(const TouchedSurface<Scalar>& surface) const noexcept {
  return dot(remaining_of(surface), surface.normal) > Tolerances<Scalar>{}.certain;
}

/// Lets every touched surface crush that moves into the character. False if there is none.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::note_crushers() noexcept {
  const std::size_t before = result_.crushed.size();
  for (const TouchedSurface<Scalar>& surface : memory_.surfaces)
    if (moves_in(surface)) crush(surface.piece, time_);
  return result_.crushed.size() > before;
}

/// Notes that the mover of a piece crushes the character.
/// @param since the character was free of the mover at this fraction of the step.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::crush(PieceIndex piece, Scalar since) noexcept {
  const MoverIndex mover = mover_of(piece);
  if (ignored(piece) || mover == no_mover) return;
  if (result_.crushed.empty()) {
    moving_.corners_before_crush = result_.path.size();
    moving_.status_before_crush = result_.status;
  }
  const ColliderIndex collider = collider_of(piece);
  memory_.mark(collider, crushes);
  result_.crushed.push_back(collider, memory_.crushed);
  result_.status = MoveStatus::crushed;
  remember({collider, position_, movers_.remaining(mover, since)});
}

/// Ignores the movers that overlap the character, and finds each of them in the list of the state. The list may come
/// from another scenery: unknown entries are skipped. A mover that is not in the list came at the last free position;
/// if the list is full, its side is not known. True if there is a mover that was not ignored yet.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::ignore_overlapping_movers(const StepRequest<Scalar>& request) noexcept {
  bool any = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (mover_of(piece) == no_mover || ignored(piece) || !overlaps(piece, position_)) return;
    memory_.mark(collider_of(piece), overlaps_since_start);
    any = true;
  });
  const bool full = request.crushers.size() == Crushers<Scalar>::capacity();
  moving_.overlapping = 0;
  for (const ColliderIndex collider : memory_.marked) {
    if (!memory_.is(collider, overlaps_since_start)) continue;
    ++moving_.overlapping;
    Crusher<Scalar> now{collider, request.last_free, displacement_of(collider), !full};
    const auto known = std::find_if(request.crushers.begin(), request.crushers.end(),
                                    [&](const Crusher<Scalar>& before) { return before.collider == collider; });
    if (known != request.crushers.end())
      now = {collider, known->last_free, known->displacement + now.displacement, known->has_side};
    else if (!request.has_last_free && !full)
      continue;
    remember(now);
    moving_.side_lost = moving_.side_lost || !now.has_side;
  }
  return any;
}

/// Leaves the movers that overlap, as any solid, to the side from which the character came. False if there is no way
/// out.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::leaves_overlapping_movers(const StepRequest<Scalar>& request) noexcept {
  if (moving_.side_lost) return false;
  moving_.ignored &= static_cast<std::uint8_t>(~overlaps_since_start);
  const std::optional<V> out = find_way_out(request);
  if (out) {
    note_colliders_left();
    for (const ColliderIndex collider : memory_.marked) memory_.unmark(collider, overlaps_since_start);
    moving_.overlapping = 0;
    start_ = position_ = *out;
    push_corner(0);
  }
  moving_.ignored = does_not_block;
  return out.has_value();
}

/// Displacement of the mover of a collider in the step [m].
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::displacement_of(ColliderIndex collider) const noexcept {
  const MoverIndex mover = space_.scenery().collider(collider).mover;
  return mover == no_mover ? V(V::Zero()) : movers_.displacement(mover);
}

/// @param now its displacement is that at the end of the step.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::remember(const Crusher<Scalar>& now) noexcept {
  for (Crusher<Scalar>& known : memory_.crushers) {
    if (known.collider != now.collider) continue;
    known = now;
    return;
  }
  memory_.crushers.push_back(now);
}

/// Finds the movers that were ignored in this step and still overlap the character. If one of them overlapped at the
/// start, the character is stuck, unless it was crushed in this step. Hands the list to the next step.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::find_movers_that_still_overlap() noexcept {
  moving_.ignored = 0;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = collider_of(piece);
    if (memory_.is(collider, passes_through) && !memory_.is(collider, overlaps_at_end) && overlaps(piece, position_))
      memory_.mark(collider, overlaps_at_end);
  });
  for (const ColliderIndex collider : memory_.marked) {
    const bool has_it_stuck = memory_.is(collider, overlaps_at_end) && !memory_.is(collider, crushes);
    if (has_it_stuck && result_.status != MoveStatus::crushed) result_.status = MoveStatus::stuck;
  }
  hand_on_crushers();
}

/// Movers that carry come first, as the others may be other characters of a crowd, which change from step to step. Of
/// each kind those come first whose side is known.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::hand_on_crushers() noexcept {
  const auto hand_on = [this](bool carries, bool has_side) {
    for (const Crusher<Scalar>& known : memory_.crushers)
      if (memory_.is(known.collider, overlaps_at_end) && known.has_side == has_side &&
          space_.scenery().collider(known.collider).carries == carries)
        result_.crushers.push_back(known);
  };
  for (const bool carries : {true, false})
    for (const bool has_side : {true, false}) hand_on(carries, has_side);
}

/// The character stays where it is for the rest of the step, and movers that run into it crush it. Sweeps do not look
/// at surfaces that are touched and do not come closer: they would hide a mover that comes later.
/// @param may_move it moves to a free position instead, if there is one.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::wait(bool may_move) noexcept {
  halt();
  memory_.surfaces.clear();
  moving_.waits = true;
  // Each round makes a touched surface of one more piece at least, and a touched one stops no sweep.
  for (sweep_along(V::Zero()); found_.hit; sweep_along(V::Zero())) {
    update_surfaces();
    if (may_move && goes_to_free_position()) {
      moving_.waits = false;
      return;
    }
    note_crushers();
  }
  moving_.waits = false;
  moving_.anchored = false;
  const Scalar since = time_;
  time_ = 1;
  // Movers that overlap by no more than rounding, which no sweep sees, crush, too.
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (overlaps(piece, position_)) crush(piece, since);
  });
  push_corner(time_);
}

/// The whole step of `Part::stay`.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::stay_in_place(const StepRequest<Scalar>& request) noexcept {
  push_corner(0);
  ignore_overlapping_movers(request);
  wait(false);
  if (!memory_.marked.empty()) find_movers_that_still_overlap();
  if (result_.status == MoveStatus::moved && overlaps(position_)) result_.status = MoveStatus::stuck;
  result_.position = position_;
  result_.velocity = velocity_;
}

}  // namespace paperproof::octagon_sweep
