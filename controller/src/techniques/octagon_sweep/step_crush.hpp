/// StepSolver: movers that leave no room.
///
/// Before that is said room is looked for (step_room.hpp). Where there is none the character stays where it is, which
/// is free of everything that stands still, and what presses goes through it. As long as it is on the character, the
/// character is stuck, and does not come out on another side: what else runs into it finds it room, free of all that
/// and on the side from which it came, or crushes it as well.
#pragma once

#include "techniques/octagon_sweep/step_room.hpp"

namespace paperproof::octagon_sweep {

/// Whether something goes through the character: nothing but room moves it then.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::pinned() const noexcept {
  return moving_.on_it > 0 || !result_.crushed.empty();
}

/// Room beside what holds the character, before it is crushed: later it is looked for beside all that crushed it.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::gives_way() noexcept {
  if (!result_.crushed.empty()) return false;
  Scalar reach = 0;
  for (const Hold<Scalar>& hold : moving_.holds)
    if (hold.mover != no_mover) reach = std::max(reach, length_of(moving_.around.course(hold.mover)));
  const FixedVector<Hold<Scalar>, 32> holds = moving_.holds;
  moving_.holds.clear();
  if (find_room(reach, result_.path.size())) return true;
  moving_.holds = holds;
  return false;
}

/// One crush after the other may leave a way to go that none of them left alone: with all that crushed in its place
/// again, and as far away as any of them goes.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::take_back_crushes() noexcept {
  const auto& crushed = result_.crushed;
  if (crushed.empty()) return;
  const auto ignored_before = moving_.ignored;
  moving_.ignored.clear();
  for (const ColliderIndex collider : ignored_before)
    if (!contains(crushed, collider)) moving_.ignored.push_back(collider);
  Scalar reach = 0;
  const std::vector<ColliderDef>& colliders = space_.scenery().as_run().colliders;
  for (const ColliderIndex collider : crushed)
    reach = std::max(reach, length_of(moving_.around.course(colliders[collider].mover)));
  moving_.holds.clear();
  if (find_room(reach, moving_.corners_before_crush)) {
    result_.crushed.clear();
    result_.status = moving_.status_before_crush == MoveStatus::dropped ? MoveStatus::dropped : MoveStatus::moved;
  } else {
    moving_.ignored = ignored_before;
  }
}

/// What runs into a character that stays where it is. False where nothing does.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::crush_what_presses() noexcept {
  const std::size_t before = result_.crushed.size();
  for (const Hold<Scalar>& hold : moving_.holds)
    if (!behind(hold.normal, rest_of(hold)).allows(V::Zero())) crush(hold.piece);
  return result_.crushed.size() > before;
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::crush(PieceIndex piece) noexcept {
  const MoverIndex mover = mover_of(piece);
  if (ignored(piece) || mover == no_mover) return;
  const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
  moving_.ignored.push_back(collider);
  name_as_crushing(collider);
  remember({collider, position_, moving_.around.rest(mover, time_)});
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::name_as_crushing(ColliderIndex collider) noexcept {
  if (result_.crushed.empty()) {
    moving_.corners_before_crush = result_.path.size();
    moving_.status_before_crush = result_.status;
  }
  result_.crushed.push_back(collider);
  result_.status = MoveStatus::crushed;
}

/// Lets every mover near the position through for whose pieces the condition holds. True if there was one.
template <Variant variant, class Scalar>
template <class Condition>
bool StepSolver<variant, Scalar>::let_through(const Condition& condition) noexcept {
  const std::size_t before = moving_.ignored.size();
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (mover_of(piece) != no_mover && !ignored(piece) && condition(piece))
      moving_.ignored.push_back(space_.scenery().pieces()[piece].collider);
  });
  return moving_.ignored.size() > before;
}

/// What the character remembers of it from the steps before is looked up: that may be of other scenery, and name what
/// is not here. What it does not remember came over it at its last free position, as far as it has one.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::let_through_what_is_on_it(const MoveRequest<Scalar>& request) noexcept {
  const bool any = let_through([this](PieceIndex piece) { return overlaps(piece, position_); });
  moving_.on_it = moving_.ignored.size();
  for (const ColliderIndex collider : moving_.ignored) {
    const auto known = std::find_if(request.pressers.begin(), request.pressers.end(),
                                    [&](const Presser<Scalar>& before) { return before.collider == collider; });
    if (known != request.pressers.end())
      remember({collider, known->from, known->gone + course_of(collider)});
    else if (request.has_last_free)
      remember({collider, request.last_free, course_of(collider)});
  }
  return any;
}

/// How far the mover of a collider goes in the step [m].
template <Variant variant, class Scalar>
Vec2<Scalar> StepSolver<variant, Scalar>::course_of(ColliderIndex collider) const noexcept {
  return moving_.around.course(mover_of_collider(collider));
}

/// @param now `gone` is by the end of the step.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::remember(const Presser<Scalar>& now) noexcept {
  for (Presser<Scalar>& known : moving_.pressers) {
    if (known.collider != now.collider) continue;
    known = now;
    return;
  }
  moving_.pressers.push_back(now);
}

/// Null for what is not remembered.
template <Variant variant, class Scalar>
const Presser<Scalar>* StepSolver<variant, Scalar>::presser(ColliderIndex collider) const noexcept {
  for (const Presser<Scalar>& known : moving_.pressers)
    if (known.collider == collider) return &known;
  return nullptr;
}

/// What of all that was let through is on the character where the step ends. What was when it began has it stuck; what
/// was only as near as that crushes it. Whatever is off again is forgotten.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::end_wait() noexcept {
  if (moving_.ignored.empty()) return;
  const auto let_through = moving_.ignored;
  moving_.ignored.clear();
  FixedVector<ColliderIndex, MoveResult<Scalar>::max_crushed> still;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
    if (contains(let_through, collider) && !contains(still, collider) && overlaps(piece, position_))
      still.push_back(collider);
  });
  for (std::size_t i = 0; i < let_through.size(); ++i) {
    const ColliderIndex collider = let_through[i];
    if (!contains(still, collider) || contains(result_.crushed, collider)) continue;
    if (i >= moving_.on_it) {
      name_as_crushing(collider);
      remember({collider, start_, course_of(collider)});
    } else if (result_.status != MoveStatus::crushed) {
      result_.status = MoveStatus::stuck;
    }
  }
  for (const Presser<Scalar>& known : moving_.pressers)
    if (contains(still, known.collider)) result_.pressers.push_back(known);
}

/// The character keeps its position for the rest of the step, and what runs into it crushes.
/// @param may_give_way it goes where there is room instead.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::stay(bool may_give_way) noexcept {
  halt();
  moving_.holds.clear();
  while (true) {
    look_along(V::Zero());
    update_holds();
    const auto before = moving_.ignored.size();
    if (may_give_way && found_.hit && gives_way()) return;
    for (const Hold<Scalar>& hold : moving_.holds) crush(hold.piece);
    moving_.holds.clear();
    if (moving_.ignored.size() == before) break;  // nothing more, or no room to name it
  }
  moving_.anchored = false;
  time_ = 1;
  push_corner(time_);
}

/// The whole step, where that is asked for.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::keep_place(const MoveRequest<Scalar>& request) noexcept {
  push_corner(0);
  let_through_what_is_on_it(request);
  stay(false);
  end_wait();
  if (result_.status == MoveStatus::moved && overlaps(position_)) result_.status = MoveStatus::stuck;
  result_.position = position_;
  result_.velocity = velocity_;
}

}  // namespace paperproof::octagon_sweep
