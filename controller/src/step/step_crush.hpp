/// StepSolver: movers that leave no room.
///
/// Before that is said room is looked for (step_room.hpp). Where there is none the character stays where it is, which
/// is free of everything that stands still, and what presses goes through it. As long as it is on the character when a
/// step begins, a way out is looked for, as out of any solid, but not to another side than that from which the
/// character came. Where there is none the character is stuck: what else runs into it finds it room, free of all that
/// and on that side, or crushes it as well.
#pragma once

#include "step/step_room.hpp"

namespace paperproof::octagon_sweep {

/// Whether something goes through the character: nothing but room moves it then.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::pinned() const noexcept {
  return moving_.on_it > 0 || !result_.crushed.empty();
}

/// Room beside what holds the character, before it is crushed: later it is looked for beside all that crushed it.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::gives_way() noexcept {
  if (!result_.crushed.empty()) return false;
  Scalar reach = 0;
  for (const Hold<Scalar>& hold : memory_.holds)
    if (hold.mover != no_mover) reach = std::max(reach, length_of(around_.course(hold.mover)));
  if (!find_room(reach, result_.path.size())) return false;
  memory_.holds.clear();
  return true;
}

/// One crush after the other may leave a way to go that none of them left alone: with all that crushed in its place
/// again, and as far away as any of them goes.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::take_back_crushes() noexcept {
  if (result_.crushed.empty()) return;
  moving_.ignored &= static_cast<std::uint8_t>(~crushes);
  Scalar reach = 0;
  for (const ColliderIndex collider : result_.crushed) reach = std::max(reach, length_of(course_of(collider)));
  memory_.holds.clear();
  if (find_room(reach, moving_.corners_before_crush)) {
    for (const ColliderIndex collider : result_.crushed) memory_.unmark(collider, crushes);
    result_.crushed.clear();
    result_.status = moving_.status_before_crush == MoveStatus::dropped ? MoveStatus::dropped : MoveStatus::moved;
  }
  moving_.ignored = goes_through;
}

/// Whether a surface comes closer to a character that stays where it is: by less than rounding it takes no room.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::presses(const Hold<Scalar>& hold) const noexcept {
  return dot(rest_of(hold), hold.normal) > Tolerances<Scalar>{}.certain;
}

/// What runs into a character that stays where it is. False where nothing does.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::crush_what_presses() noexcept {
  const std::size_t before = result_.crushed.size();
  for (const Hold<Scalar>& hold : memory_.holds)
    if (presses(hold)) crush(hold.piece);
  return result_.crushed.size() > before;
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::crush(PieceIndex piece) noexcept {
  const MoverIndex mover = mover_of(piece);
  if (ignored(piece) || mover == no_mover) return;
  const ColliderIndex collider = collider_of(piece);
  name_as_crushing(collider);
  remember({collider, position_, around_.rest(mover, time_)});
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::name_as_crushing(ColliderIndex collider) noexcept {
  if (result_.crushed.empty()) {
    moving_.corners_before_crush = result_.path.size();
    moving_.status_before_crush = result_.status;
  }
  memory_.mark(collider, crushes);
  result_.crushed.push_back(collider, memory_.crushed);
  result_.status = MoveStatus::crushed;
}

/// Lets every mover near the position through for whose pieces the condition holds. True if there was one.
template <std::size_t Lanes, class Scalar>
template <class Condition>
bool StepSolver<Lanes, Scalar>::let_through(const Condition& condition) noexcept {
  bool any = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (mover_of(piece) == no_mover || ignored(piece) || !condition(piece)) return;
    memory_.mark(collider_of(piece), lies_on);
    any = true;
  });
  return any;
}

/// Looks up each overlapping mover in the state's list. The list may come from other scenery, so unknown entries are
/// skipped. A mover that is not in the list is taken to have come at the last free position; if the list is full, its
/// side counts as lost.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::let_through_what_is_on_it(const MoveRequest<Scalar>& request) noexcept {
  const bool any = let_through([this](PieceIndex piece) { return overlaps(piece, position_); });
  const bool full = request.crushers.size() == Crushers<Scalar>::capacity();
  moving_.on_it = 0;
  for (const ColliderIndex collider : memory_.marked) {
    if (!memory_.is(collider, lies_on)) continue;
    ++moving_.on_it;
    Crusher<Scalar> now{collider, request.last_free, course_of(collider), !full};
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

/// By a way out of it, as of any solid, to the side from which the character came.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::leaves_what_is_on_it(const MoveRequest<Scalar>& request) noexcept {
  if (moving_.side_lost) return false;
  moving_.ignored &= static_cast<std::uint8_t>(~lies_on);
  const std::optional<V> out = find_way_out(request);
  if (out) {
    note_what_is_left();
    for (const ColliderIndex collider : memory_.marked) memory_.unmark(collider, lies_on);
    moving_.on_it = 0;
    start_ = position_ = *out;
    push_corner(0);
  }
  moving_.ignored = goes_through;
  return out.has_value();
}

/// How far the mover of a collider goes in the step [m].
template <std::size_t Lanes, class Scalar>
Vec2<Scalar> StepSolver<Lanes, Scalar>::course_of(ColliderIndex collider) const noexcept {
  return around_.course(mover_of_collider(collider));
}

/// @param now `displacement` is by the end of the step.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::remember(const Crusher<Scalar>& now) noexcept {
  for (Crusher<Scalar>& known : memory_.crushers) {
    if (known.collider != now.collider) continue;
    known = now;
    return;
  }
  memory_.crushers.push_back(now);
}

/// Marks the colliders that were let through and still overlap the character at the end of the step; such a step is
/// `stuck` unless it is `crushed`. Forgets the others.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::end_wait() noexcept {
  if (memory_.marked.empty()) return;
  moving_.ignored = 0;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = collider_of(piece);
    if (memory_.is(collider, goes_through) && !memory_.is(collider, still) && overlaps(piece, position_))
      memory_.mark(collider, still);
  });
  for (const ColliderIndex collider : memory_.marked) {
    const bool has_it_stuck = memory_.is(collider, still) && !memory_.is(collider, crushes);
    if (has_it_stuck && result_.status != MoveStatus::crushed) result_.status = MoveStatus::stuck;
  }
  hand_on_crushers();
}

/// Hands on movers that carry before others (which in a crowd may be another character in the next step), and within
/// each those with a known side first.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::hand_on_crushers() noexcept {
  const auto hand_on = [this](bool carries, bool has_side) {
    for (const Crusher<Scalar>& known : memory_.crushers)
      if (memory_.is(known.collider, still) && known.has_side == has_side &&
          space_.scenery().collider(known.collider).carries == carries)
        result_.crushers.push_back(known);
  };
  for (const bool carries : {true, false})
    for (const bool has_side : {true, false}) hand_on(carries, has_side);
}

/// The character keeps its position for the rest of the step, and what runs into it crushes. What is touched and does
/// not come closer is looked past: what runs into the character later would be hidden behind it.
/// @param may_give_way it goes where there is room instead.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::stay(bool may_give_way) noexcept {
  halt();
  memory_.holds.clear();
  moving_.looks_past_holds = true;
  for (look_along(V::Zero()); found_.hit; look_along(V::Zero())) {
    update_holds();
    if (may_give_way && gives_way()) {
      moving_.looks_past_holds = false;
      return;
    }
    crush_what_presses();
  }
  moving_.looks_past_holds = false;
  moving_.anchored = false;
  const Scalar since = time_;
  time_ = 1;
  crush_what_came_in(since);
  push_corner(time_);
}

/// What was nearer than rounding may come in by no more than rounding, which no sweep sees.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::crush_what_came_in(Scalar since) noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const MoverIndex mover = mover_of(piece);
    if (mover == no_mover || ignored(piece) || !overlaps(piece, position_)) return;
    name_as_crushing(collider_of(piece));
    remember({collider_of(piece), position_, around_.rest(mover, since)});
  });
}

/// The whole step, where that is asked for.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::keep_place(const MoveRequest<Scalar>& request) noexcept {
  push_corner(0);
  let_through_what_is_on_it(request);
  stay(false);
  end_wait();
  if (result_.status == MoveStatus::moved && overlaps(position_)) result_.status = MoveStatus::stuck;
  result_.position = position_;
  result_.velocity = velocity_;
}

}  // namespace paperproof::octagon_sweep
