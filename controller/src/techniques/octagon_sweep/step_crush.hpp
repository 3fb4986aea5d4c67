/// StepSolver: movers that leave no room.
///
/// Before that is said room is looked for (step_room.hpp). Where there is none the character stays where it is, which
/// is free of everything that stands still, and what presses goes through it. As long as it is on the character, the
/// character is stuck: it does not come out on another side, and only other movers move it.
#pragma once

#include "techniques/octagon_sweep/step_room.hpp"

namespace paperproof::octagon_sweep {

/// Room beside what holds the character, before it is crushed.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::gives_way() noexcept {
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

/// What runs into a character that stays where it is.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::crush_what_presses() noexcept {
  for (const Hold<Scalar>& hold : moving_.holds)
    if (!behind(hold.normal, rest_of(hold)).allows(V::Zero())) crush(hold.piece);
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::crush(PieceIndex piece) noexcept {
  if (ignored(piece) || mover_of(piece) == no_mover) return;
  const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
  if (result_.crushed.empty()) {
    moving_.corners_before_crush = result_.path.size();
    moving_.status_before_crush = result_.status;
  }
  moving_.ignored.push_back(collider);
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

template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::let_through_what_is_on_it() noexcept {
  const bool any = let_through([this](PieceIndex piece) { return overlaps(piece, position_); });
  moving_.on_it = moving_.ignored.size();
  return any;
}

/// What the character brings from the steps before. It may have been remembered among other scenery: what names
/// nothing that moves here is forgotten.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::recall_pressers(std::span<const Presser<Scalar>> before) noexcept {
  const std::vector<ColliderDef>& colliders = space_.scenery().as_run().colliders;
  for (const Presser<Scalar>& presser : before)
    if (presser.collider < colliders.size() && colliders[presser.collider].mover < moving_.around.movers.size())
      moving_.pressers.push_back(presser);
}

/// What has come over a character since its last free position goes on, also once it is off again.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::note_pressers() noexcept {
  const std::vector<ColliderDef>& colliders = space_.scenery().as_run().colliders;
  const auto went = [&](ColliderIndex collider) { return moving_.around.course(colliders[collider].mover); };
  const Pressers<Scalar>& before = moving_.pressers;
  for (const Presser<Scalar>& presser : before)
    result_.pressers.push_back({presser.collider, presser.gone + went(presser.collider)});
  for (const ColliderIndex collider : moving_.ignored) {
    const bool known = std::any_of(before.begin(), before.end(),
                                   [&](const Presser<Scalar>& presser) { return presser.collider == collider; });
    if (!known) result_.pressers.push_back({collider, went(collider)});
  }
}

/// What was on the character when the step began, and still is, has it stuck. What was only as near as that crushes it.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::end_wait() noexcept {
  if (moving_.ignored.size() == result_.crushed.size()) return;
  const auto let_through = moving_.ignored;
  moving_.ignored.clear();
  for (const ColliderIndex collider : result_.crushed) moving_.ignored.push_back(collider);
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
    const auto* const found = std::find(let_through.begin(), let_through.end(), collider);
    if (found == let_through.end() || !overlaps(piece, position_)) return;
    if (static_cast<std::size_t>(found - let_through.begin()) >= moving_.on_it)
      crush(piece);
    else if (result_.status != MoveStatus::crushed)
      result_.status = MoveStatus::stuck;
  });
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
void StepSolver<variant, Scalar>::keep_place() noexcept {
  push_corner(0);
  let_through_what_is_on_it();
  stay(false);
  note_pressers();
  end_wait();
  if (result_.status == MoveStatus::moved && overlaps(position_)) result_.status = MoveStatus::stuck;
  result_.position = position_;
  result_.velocity = velocity_;
}

}  // namespace paperproof::octagon_sweep
