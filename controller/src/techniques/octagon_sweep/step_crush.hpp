/// StepSolver: movers that leave no room.
///
/// Before that is said every position is looked for that is free when the step ends, no farther away than the movers
/// go, and reached in a straight uniform motion from some corner of the way so far. Where there is none the character
/// stays where it is, which is free of everything that stands still, and what presses goes through it. As long as it is
/// on the character, the character is stuck: it does not come out on another side, and only other movers move it.
#pragma once

#include "techniques/octagon_sweep/room.hpp"
#include "techniques/octagon_sweep/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Goes to the nearest place where there is room, away from some corner of the way. False where there is none: then
/// nothing has changed.
/// @param reach how far away it may be at most [m].
/// @param corners so many of the path may be where it leaves the way.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::find_room(Scalar reach, std::size_t corners) noexcept {
  neighbourhood_.forget();  // more than what is asked for could give another answer
  // What is on the character is not in the way, but there is no room where it still would be.
  const auto ignored_before = moving_.ignored;
  moving_.ignored.clear();
  for (std::size_t i = 0; i < ignored_before.size(); ++i)
    (i < moving_.on_it ? moving_.lying : moving_.ignored).push_back(ignored_before[i]);
  constexpr Tolerances<Scalar> tolerances{};
  /// Of the hit distance: room must be a little more than what counts as closed.
  constexpr Scalar least_room = Scalar(1.25);
  Room room = nearest_room(tolerances.hit * least_room, reach, corners);
  if (room.corner < corners) {
    // Where there is any, there mostly is as much as is kept everywhere else.
    const Room ample = nearest_room(tolerances.stop, reach, corners);
    if (ample.corner < corners) room = ample;
  }
  moving_.ignored = ignored_before;
  moving_.lying.clear();
  if (room.corner == corners) return false;
  go_back_to(room.corner);
  go_to(room.position);
  return true;
}

/// Its corner is `corners` where there is none.
/// @param gap that is left around the character [m].
template <Variant variant, class Scalar>
typename StepSolver<variant, Scalar>::Room StepSolver<variant, Scalar>::nearest_room(Scalar gap, Scalar reach,
                                                                                     std::size_t corners) noexcept {
  /// What is kept from a mover comes on top of what the mover goes.
  constexpr Scalar beyond = 16 * Tolerances<Scalar>{}.stop;
  const Scalar whole = reach + beyond;
  // Room is looked for near first: mostly it is there, among few pieces.
  const Scalar near = std::min(whole, (space_.hull_box().upper - space_.hull_box().lower).maxCoeff());
  Room room{0, V::Zero(), corners};
  for (const Scalar radius : {near, whole}) {
    room.distance = radius;
    for (std::size_t corner = corners; corner-- > 0;) find_room_from(corner, gap, radius, room);
    if (room.corner < corners || near == whole) break;
  }
  return room;
}

/// @param radius around the present position in which room is looked for [m].
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::find_room_from(std::size_t corner, Scalar gap, Scalar radius, Room& room) noexcept {
  const Surroundings<Scalar>& around = moving_.around;
  const PathPoint<Scalar> begin = result_.path[corner];
  if (!(begin.fraction < 1)) return;
  moving_.leaving = corner == 0;
  TakenPositions<Scalar> positions(space_, around.memory.room, gap);
  const auto add = [&](std::span<const PieceIndex> pieces, const V& from, const V& end) {
    return std::all_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
      if (ignored(piece)) return true;
      if (!left_behind(piece)) return positions.add(piece, from, end);
      positions.add_end(piece, end);
      return true;
    });
  };
  const auto box_of = [&](const V& from, const V& end) {
    return Box2<Scalar>{end, end}.inflated(radius).merged({from, from});
  };
  if (!add(neighbourhood_.around(box_of(begin.position, position_)), begin.position, position_)) return;
  for (MoverIndex mover = 0; mover < around.phases.size(); ++mover) {
    const V from = begin.position - around.offset(mover, begin.fraction);
    const V end = position_ - around.offset(mover, Scalar(1));
    const Box2<Scalar> box = space_.touched_from(box_of(from, end));
    if (!box.overlaps(around.phases.whole(mover))) continue;
    if (!add(around.phases.query(mover, box, around.memory.of_mover), from, end)) return;
  }
  positions.for_each_position(room.distance, [&](const V& w) { consider_room(corner, position_ + w, room); });
}

/// Takes a position where there is room, nearer than what is known and reached from a corner.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::consider_room(std::size_t corner, const V& end, Room& room) noexcept {
  const V here = position_;
  const Scalar now = time_;
  const Scalar distance = length_of(V(end - here));
  if (!(distance < room.distance) || !(end.cwiseAbs().maxCoeff() <= Tolerances<Scalar>{}.range)) return;
  time_ = 1;
  if (roomy(end) && goes_straight(corner, end) && stays_on_its_side(end)) {
    room.distance = distance;
    room.position = end;
    room.corner = corner;
  }
  position_ = here;
  time_ = now;
}

/// Whether nothing is near a position, where it is now.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::roomy(const V& q) noexcept {
  bool free = true;
  for_each_near({q, q}, [&](PieceIndex piece) {
    free = free && (space_.info(piece).one_way_axis != ObstacleInfo::not_one_way || ignored(piece) ||
                    best_axis<variant>(space_, piece, local(piece, q)).separation >= Tolerances<Scalar>{}.hit);
  });
  return free;
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
    return !ignored(piece) && !left_behind(piece) && stopped_by(motion, piece);
  });
}

template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stopped_by(const LocalMotion& motion, PieceIndex piece) const noexcept {
  if (!in_way(motion, piece)) return false;
  const Clearance<Scalar> clear = clearance<variant>(space_, motion, piece);
  return !clear.clear() && sweep_piece<variant>(space_, motion, piece, clear).hit;
}

/// What the step began inside of is not in the way while it is left, nor what is on the character.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::left_behind(PieceIndex piece) const noexcept {
  const auto among = [collider = space_.scenery().pieces()[piece].collider](const auto& some) {
    return std::find(some.begin(), some.end(), collider) != some.end();
  };
  return (moving_.leaving && among(moving_.left)) || among(moving_.lying);
}

/// The colliders that a step begins inside of.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::note_what_is_left() noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
    const auto& left = moving_.left;
    if (std::find(left.begin(), left.end(), collider) == left.end() && overlaps(piece, position_))
      moving_.left.push_back(collider);
  });
}

/// Whether a position at the end of the step is on the side of what is left from which the character came: the straight
/// way there from its last free position does not meet it. (Where that was is known as of the step's start.)
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stays_on_its_side(const V& end) noexcept {
  if (!moving_.last_free || (moving_.left.empty() && moving_.lying.empty())) return true;
  const std::span<const PieceInfo> pieces = space_.scenery().pieces();
  for (PieceIndex piece = 0; piece < space_.scenery().sensor_pieces().first; ++piece) {
    if (!left_behind(piece)) continue;
    V from = *moving_.last_free;
    V to = end;
    if (pieces[piece].mover != no_mover) {
      from -= moving_.around.offset(pieces[piece].mover, Scalar(0));
      to -= moving_.around.offset(pieces[piece].mover, Scalar(1));
    }
    if (stopped_by(make_motion<variant>(space_, from, V(to - from), Scalar(0)), piece)) return false;
  }
  return true;
}

/// In one motion for the rest of the step, that is known to be clear.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::go_to(const V& end) noexcept {
  halt();
  position_ = end;
  time_ = 1;
  on_ground_ = ended_in_crease_ = false;
  push_corner(time_);
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
  const auto crushing = [&](ColliderIndex collider) {
    return std::find(crushed.begin(), crushed.end(), collider) != crushed.end();
  };
  const auto ignored_before = moving_.ignored;
  moving_.ignored.clear();
  for (const ColliderIndex collider : ignored_before)
    if (!crushing(collider)) moving_.ignored.push_back(collider);
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

}  // namespace paperproof::octagon_sweep
