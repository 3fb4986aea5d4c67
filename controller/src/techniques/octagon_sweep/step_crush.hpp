/// StepSolver: movers that leave no room.
///
/// Before that is said every position is looked for that is free when the step ends, no farther away than the movers
/// go, and reached in a straight uniform motion from some corner of the way so far. Where there is none the character
/// stays where it is, which is free of everything that stands still, and what presses goes through it. As long as it is
/// on the character, the character is stuck: it does not come out on another side, and only other movers move it.
#pragma once

#include "techniques/octagon_sweep/open_facets.hpp"
#include "techniques/octagon_sweep/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Goes to the nearest place where there is room. False where there is none: then nothing has changed.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::find_room() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  /// Of the hit distance: room must be a little more than what counts as closed.
  constexpr Scalar least_room = Scalar(1.25);
  moving_.holds_before = moving_.holds;
  moving_.holds.clear();
  if (find_room(tolerances.stop) || find_room(tolerances.hit * least_room)) return true;
  moving_.holds = moving_.holds_before;
  return false;
}

/// @param gap that is left around the character [m].
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::find_room(Scalar gap) noexcept {
  const V here = position_;
  const Scalar now = time_;
  const Scalar reach = longest_course() + 2 * Tolerances<Scalar>{}.stop;
  time_ = 1;
  const std::span<const PieceIndex> candidates = all_near(Box2<Scalar>{here, here}.inflated(reach + gap));
  OpenFacets<Scalar> facets(space_, here, gap);
  for (const PieceIndex piece : candidates) facets.add(piece, offset(piece));

  std::optional<V> room;
  std::size_t from = 0;
  Scalar nearest = reach;
  const auto consider = [&](const V& q) {
    const Scalar distance = length_of(V(q - here));
    if (!(distance <= nearest) || (room && distance == nearest)) return;
    time_ = 1;
    if (!roomy(candidates, q)) return;
    for (std::size_t corner = result_.path.size(); corner-- > moving_.first_corner;) {
      if (!goes_straight(corner, q)) continue;
      room = q;
      from = corner;
      nearest = distance;
      return;
    }
  };
  for (std::size_t corner = moving_.first_corner; corner < result_.path.size(); ++corner) {
    const PathPoint<Scalar> at = result_.path[corner];
    consider(at.position);
    for (const Hold<Scalar>& hold : moving_.holds_before)
      if (hold.mover != no_mover) consider(at.position + moving_.around.rest(hold.mover, at.fraction));
  }
  facets.for_each_position(consider);

  position_ = here;
  time_ = now;
  if (!room) return false;
  go_back_to(from);
  look_along(*room - position_);
  halt();
  return advance(1);
}

/// Whether nothing is near a position, where it is now.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::roomy(std::span<const PieceIndex> candidates, const V& q) const noexcept {
  return std::none_of(candidates.begin(), candidates.end(), [&](PieceIndex piece) {
    return space_.info(piece).one_way_axis == ObstacleInfo::not_one_way &&
           best_axis<variant>(space_, piece, local(piece, q)).separation < Tolerances<Scalar>{}.hit;
  });
}

/// Whether the rest of the step can be one straight motion from a corner of the path.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::goes_straight(std::size_t corner, const V& end) noexcept {
  const Surroundings<Scalar>& around = moving_.around;
  position_ = result_.path[corner].position;
  time_ = result_.path[corner].fraction;
  if (!(time_ < 1) || (certify_ && !certified(end))) return false;
  const V way = end - position_;
  const LocalMotion motion = make_motion<variant>(space_, position_, way, Scalar(0));
  if (!passes(motion, pieces_along(motion, no_mover))) return false;
  for (MoverIndex mover = 0; mover < around.phases.size(); ++mover) {
    const V from = position_ - around.offset(mover, time_);
    const LocalMotion seen = make_motion<variant>(space_, from, around.relative(way, mover, time_), Scalar(0));
    if (space_.touched_from(seen.box()).overlaps(around.phases.whole(mover)) &&
        !passes(seen, pieces_along(seen, mover)))
      return false;
  }
  return true;
}

/// Whether a motion comes to its end.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::passes(const LocalMotion& motion, std::span<const PieceIndex> pieces) const noexcept {
  return std::none_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
    if (ignored(piece) || !blocks<variant>(space_, motion, piece)) return false;
    const Clearance<Scalar> clear = clearance<variant>(space_, motion, piece);
    return !clear.clear() && sweep_piece<variant>(space_, motion, piece, clear).hit;
  });
}

/// Takes back what was travelled since a corner.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::go_back_to(std::size_t corner) noexcept {
  while (result_.path.size() > corner + 1) result_.path.pop_back();
  while (result_.contacts.size() > moving_.contacts_at[corner]) result_.contacts.pop_back();
  position_ = result_.path[corner].position;
  time_ = result_.path[corner].fraction;
  moving_.anchored = false;
}

/// Of the movers that hold the character [m].
template <Variant variant, class Scalar>
Scalar StepSolver<variant, Scalar>::longest_course() const noexcept {
  Scalar longest = 0;
  for (const Hold<Scalar>& hold : moving_.holds_before)
    if (hold.mover != no_mover) longest = std::max(longest, length_of(moving_.around.course(hold.mover)));
  return longest;
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
    if (may_give_way && found_.hit && find_room()) return;
    for (const Hold<Scalar>& hold : moving_.holds) crush(hold.piece);
    moving_.holds.clear();
    if (moving_.ignored.size() == before) break;  // nothing more, or no room to name it
  }
  moving_.anchored = false;
  time_ = 1;
  push_corner(time_);
}

}  // namespace paperproof::octagon_sweep
