/// StepSolver: room for a character that movers press.
///
/// Room is a position that is free when the step ends, no farther away than the movers go, and reached in a straight
/// uniform motion from some corner of the way so far. What the step began inside of may be passed on the way from
/// there, to the side from which the character came; what is on the character since an earlier step likewise.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/free_position.hpp"
#include "step/step_solver.hpp"

#include <algorithm>

namespace paperproof::octagon_sweep {

/// Goes to the nearest place where there is room, away from some corner of the way. False where there is none: then
/// nothing has changed.
/// @param reach how far away it may be at most [m].
/// @param corners so many of the path may be where it leaves the way.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::find_room(Scalar reach, std::size_t corners) noexcept {
  if (moving_.side_lost) return false;
  // What is on the character is not in the way, but there is no room where it still would be.
  const std::uint8_t ignored_before = moving_.ignored;
  moving_.ignored &= static_cast<std::uint8_t>(~lies_on);
  constexpr Tolerances<Scalar> tolerances{};
  Room room = nearest_room(tolerances.hit * Scalar(least_room), reach, corners);
  if (room.corner < corners) {
    // Where there is any, there mostly is as much as is kept everywhere else.
    const Room ample = nearest_room(tolerances.stop, reach, corners);
    if (ample.corner < corners) room = ample;
  }
  moving_.ignored = ignored_before;
  if (room.corner == corners) return false;
  go_on_until_bounded(room);
  go_back_to(room.corner);
  go_to(room.position);
  report_room(room.corner);
  return true;
}

/// Its corner is `corners` where there is none.
/// @param gap that is left around the character [m].
template <std::size_t Lanes, class Scalar>
typename StepSolver<Lanes, Scalar>::Room StepSolver<Lanes, Scalar>::nearest_room(Scalar gap, Scalar reach,
                                                                                 std::size_t corners) noexcept {
  /// What is kept from a mover comes on top of what the mover goes.
  constexpr Scalar beyond = 16 * Tolerances<Scalar>{}.stop;
  const Scalar whole = reach + beyond;
  // Room is looked for near first: mostly it is there, among few pieces.
  const Scalar near = std::min(whole, (space_.hull_box().upper - space_.hull_box().lower).maxCoeff());
  Room room{0, V::Zero(), corners};
  for (const Scalar radius : {near, whole}) {
    room.distance = radius;
    for (std::size_t corner = corners; corner-- > 0;) find_room_from(corner, gap, room);
    if (room.corner < corners || near == whole) break;
  }
  return room;
}

/// @param gap that is left around the character [m].
template <std::size_t Lanes, class Scalar>
FreePositionQuery<Scalar> StepSolver<Lanes, Scalar>::query_for_room(std::size_t corner, Scalar gap) const noexcept {
  const PathPoint<Scalar>& begin = result_.path[corner];
  return {.from = begin.position,
          .begin = begin.fraction,
          .near = position_,
          .end = 1,
          .last_free = {},
          .crushers = memory_.crushers,
          .entered_from = moving_.last_free,
          .movers = around_.movers,
          .drops = drops_,
          .gap = gap,
          .reach = 0};
}

/// Takes a position where there is room, if it is nearer than what is known.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::find_room_from(std::size_t corner, Scalar gap, Room& room) noexcept {
  FreePositionQuery<Scalar> query = query_for_room(corner, gap);
  if (!(query.begin < 1)) return;
  query.reach = room.distance;
  const std::span<PieceIndex> pieces = pieces_for(query, room.distance);
  query.passable = put_first(pieces, [&](PieceIndex piece) { return may_pass(piece, corner); });
  if (const std::optional<V> found = nearest_free<Lanes>(space_, pieces, query))
    room = {length_of(V(*found - position_)), *found, corner};
}

/// Who comes more slowly to where it was held may touch nothing there. Then it goes on in that direction, no faster
/// than before, until something is as near as a contact.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::go_on_until_bounded(Room& room) noexcept {
  const PathPoint<Scalar> from = result_.path[room.corner];
  memory_.near_the_way.clear();
  add_near_pieces(room.corner, {room.position, 1});
  if (!memory_.near_the_way.empty() || !(time_ > from.fraction)) return;
  const V way = room.position - from.position;
  Scalar low = 1;
  Scalar high = (1 - from.fraction) / (time_ - from.fraction);
  FreePositionQuery<Scalar> query = query_for_room(room.corner, Scalar(0));
  const std::span<PieceIndex> pieces = pieces_for(query, length_of(V(from.position + way * high - position_)));
  query.passable = put_first(pieces, [&](PieceIndex piece) { return may_pass(piece, room.corner); });
  while ((high - low) * length_of(way) > Tolerances<Scalar>{}.hit) {
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    (reaches<Lanes>(space_, pieces, query, V(from.position + way * middle)) ? low : high) = middle;
  }
  room.position = from.position + way * low;
}

/// What the step began inside of may be passed on the way from there, and what is on the character on any.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::may_pass(PieceIndex piece, std::size_t corner) const noexcept {
  return memory_.is(collider_of(piece), corner == 0 ? left | lies_on : lies_on);
}

/// The colliders that a step begins inside of.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::note_what_is_left() noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = collider_of(piece);
    if (memory_.is(collider, left) || !overlaps(piece, position_)) return;
    memory_.mark(collider, left);
    moving_.leaves_any = true;
  });
}

/// In one motion for the rest of the step, that is known to be clear.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::go_to(const V& end) noexcept {
  halt();
  position_ = end;
  time_ = 1;
  on_ground_ = wedged_ = false;
  push_corner(time_);
}

/// Takes back what was travelled since a corner.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::go_back_to(std::size_t corner) noexcept {
  while (result_.path.size() > corner + 1) result_.path.pop_back();
  while (result_.contacts.size() > memory_.contacts_at[corner]) result_.contacts.pop_back();
  position_ = result_.path[corner].position;
  time_ = result_.path[corner].fraction;
  moving_.anchored = false;
}

/// Whether a straight way from a corner, where the character is, is proved clear of everything that is nearer than
/// rounding there and may not be passed: the step may have begun so, and gone on from where its gaps were restored.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::is_proved(std::size_t corner, const V& target, Scalar end) noexcept {
  bool clear = true;
  for_each_near({position_, position_},
                [&](PieceIndex piece) { clear = clear && (may_pass(piece, corner) || !bars(piece, target, end)); });
  return clear;
}

/// The way to room is the nearest that is free: it is bounded by what it comes near to, and that is what holds or
/// pushes the character. Each is a contact at the moment when it is nearest, which becomes a corner of the way.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::report_room(std::size_t corner) noexcept {
  const PathPoint<Scalar> from = result_.path[corner];
  const PathPoint<Scalar> to = result_.path.back();
  memory_.near_the_way.clear();
  add_near_pieces(corner, to);
  std::sort(memory_.near_the_way.begin(), memory_.near_the_way.end(),
            [](const Nearest<Scalar>& a, const Nearest<Scalar>& b) { return a.when < b.when; });
  result_.path.pop_back();
  position_ = result_.path.back().position;
  time_ = result_.path.back().fraction;
  for (const Nearest<Scalar>& near : memory_.near_the_way) {
    const bool within = near.when < 1;
    // No corner within a way that only an exact certificate allows: it could not be rounded.
    if (within && (certify_ || result_.path.size() + 1 >= memory_.corners.capacity())) continue;
    const V there = within ? V(from.position + (to.position - from.position) * near.when) : to.position;
    const Scalar then = within ? from.fraction + (1 - from.fraction) * near.when : Scalar(1);
    if (within && !is_proved(corner, there, then)) continue;
    position_ = there;
    time_ = then;
    push_corner(time_);
    report_contact(near.piece, near.axis, time_, result_.contacts.size());
    memory_.contacts_at[result_.path.size() - 1] = result_.contacts.size();
  }
  position_ = to.position;
  time_ = 1;
  push_corner(time_);
}

/// All that may block, pushes or comes nearer on the way, and is then as near as a contact.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::add_near_pieces(std::size_t corner, const PathPoint<Scalar>& to) noexcept {
  const PathPoint<Scalar> from = result_.path[corner];
  const auto add = [&](const V& begin, const V& end, std::span<const PieceIndex> pieces) {
    const LocalMotion motion = make_motion<Lanes>(space_, begin, V(end - begin), Scalar(0));
    for (const PieceIndex piece : pieces) {
      if (ignored(piece) || may_pass(piece, corner) || !in_way(motion, piece)) continue;
      const Nearest<Scalar> near = nearest_on_way(piece, begin, end);
      const MoverIndex mover = mover_of(piece);
      const V n = space_.normal(piece, near.axis);
      V course = V::Zero();
      if (mover != no_mover) course = around_.course(mover);
      const bool pushes = n.x() * course.x() + n.y() * course.y() > Tolerances<Scalar>{}.certain;
      if ((near.when > 0 || pushes) && near.separation <= 2 * Tolerances<Scalar>{}.stop &&
          !space_.covered(piece, near.axis))
        memory_.near_the_way.push_back(near);
    }
  };
  const auto box_of = [&](const V& begin, const V& end) {
    return Box2<Scalar>{begin.cwiseMin(end), begin.cwiseMax(end)}.inflated(Tolerances<Scalar>{}.look);
  };
  add(from.position, to.position, neighbourhood_.around(box_of(from.position, to.position)));
  for (MoverIndex mover = 0; mover < around_.near; ++mover) {
    const V begin = from.position - around_.offset(mover, from.fraction);
    const V end = to.position - around_.offset(mover, to.fraction);
    const Box2<Scalar> box = space_.touched_from(box_of(begin, end));
    if (box.overlaps(around_.phases.whole(mover))) add(begin, end, around_.phases.query(mover, box, memory_.of_mover));
  }
}

/// The separation is the largest of some that are linear in time, hence convex: where it still falls it is nearest
/// later.
template <std::size_t Lanes, class Scalar>
Nearest<Scalar> StepSolver<Lanes, Scalar>::nearest_on_way(PieceIndex piece, const V& from, const V& to) const noexcept {
  const V way = to - from;
  const auto at = [&](Scalar when) { return best_axis<Lanes>(space_, piece, V(from + way * when)); };
  const auto falls = [&](const BestAxis<Scalar>& best) {
    const V n = space_.normal(piece, best.axis);
    return way.x() * n.x() + way.y() * n.y() < 0;
  };
  BestAxis<Scalar> best = at(1);
  if (falls(best)) return {piece, best.axis, best.separation, 1};
  Scalar low = 0;  // where it falls
  Scalar high = 1;
  best = at(0);
  if (!falls(best)) return {piece, best.axis, best.separation, 0};
  while ((high - low) * way.cwiseAbs().maxCoeff() > Tolerances<Scalar>{}.certain) {
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    const BestAxis<Scalar> there = at(middle);
    (falls(there) ? low : high) = middle;
    if (falls(there)) best = there;
  }
  return {piece, best.axis, best.separation, low};
}

}  // namespace paperproof::octagon_sweep
