/// StepSolver: room for a character that movers press.
///
/// Room is a position that is free when the step ends, no farther away than the movers go, and reached in a straight
/// uniform motion from some corner of the way so far. What the step began inside of may be passed on the way from
/// there, to the side from which the character came; what is on the character since an earlier step likewise.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/room.hpp"
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
  neighbourhood_.forget();  // more than what is asked for could give another answer
  // What is on the character is not in the way, but there is no room where it still would be.
  const std::uint8_t ignored_before = moving_.ignored;
  moving_.ignored &= static_cast<std::uint8_t>(~lies_on);
  moving_.seeks_room = true;
  constexpr Tolerances<Scalar> tolerances{};
  Room room = nearest_room(tolerances.hit * Scalar(least_room), reach, corners);
  if (room.corner < corners) {
    // Where there is any, there mostly is as much as is kept everywhere else.
    const Room ample = nearest_room(tolerances.stop, reach, corners);
    if (ample.corner < corners) room = ample;
  }
  moving_.ignored = ignored_before;
  moving_.seeks_room = false;
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
    for (std::size_t corner = corners; corner-- > 0;) find_room_from(corner, gap, radius, room);
    if (room.corner < corners || near == whole) break;
  }
  return room;
}

/// @param radius around the present position in which room is looked for [m].
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::find_room_from(std::size_t corner, Scalar gap, Scalar radius, Room& room) noexcept {
  const PathPoint<Scalar> begin = result_.path[corner];
  if (!(begin.fraction < 1)) return;
  moving_.leaving = corner == 0;
  TakenPositions<Scalar> positions(space_, memory_.room, gap);
  const auto add = [&](std::span<const PieceIndex> pieces, const V& from, const V& end) {
    return std::all_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
      if (ignored(piece) || dropped(piece)) return true;
      if (!left_behind(piece)) return positions.add(piece, from, end);
      const std::optional<V> side = is_lying(piece) ? came_from(piece) : std::nullopt;
      if (!side || !positions.add(piece, *side, end)) positions.add_end(piece, end);
      return true;
    });
  };
  const auto box_of = [&](const V& from, const V& end) {
    return Box2<Scalar>{end, end}.inflated(radius).merged({from, from});
  };
  if (!add(neighbourhood_.around(box_of(begin.position, position_)), begin.position, position_)) return;
  for (MoverIndex mover = 0; mover < around_.near; ++mover) {
    const V from = begin.position - around_.offset(mover, begin.fraction);
    const V end = position_ - around_.offset(mover, Scalar(1));
    Box2<Scalar> places = box_of(from, end);
    for (const Presser<Scalar>& known : memory_.pressers) {
      const V side = known.from + (known.gone - around_.offset(mover, Scalar(1)));
      if (moving_.on_it > 0 && mover_of_collider(known.collider) == mover) places = places.merged({side, side});
    }
    const Box2<Scalar> box = space_.touched_from(places);
    if (!box.overlaps(around_.phases.whole(mover))) continue;
    if (!add(around_.phases.query(mover, box, memory_.of_mover), from, end)) return;
  }
  positions.for_each_position(room.distance, [&](const V& w) { consider_room(corner, position_ + w, room); });
}

/// Takes a position where there is room, nearer than what is known and reached from a corner.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::consider_room(std::size_t corner, const V& end, Room& room) noexcept {
  const Scalar distance = length_of(V(end - position_));
  if (!(distance < room.distance) || !leads_to_room(corner, end)) return;
  room.distance = distance;
  room.position = end;
  room.corner = corner;
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::leads_to_room(std::size_t corner, const V& end) noexcept {
  if (!(end.cwiseAbs().maxCoeff() <= Tolerances<Scalar>{}.range)) return false;
  const V here = position_;
  const Scalar now = time_;
  time_ = 1;
  const bool leads = roomy(end) && goes_straight(corner, end) && stays_on_its_side(end);
  position_ = here;
  time_ = now;
  return leads;
}

/// Who comes more slowly to where it was held may touch nothing there. Then it goes on in that direction, no faster
/// than before, until something is as near as a contact.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::go_on_until_bounded(Room& room) noexcept {
  const PathPoint<Scalar> from = result_.path[room.corner];
  memory_.near_the_way.clear();
  add_near_pieces(from, {room.position, 1});
  if (!memory_.near_the_way.empty() || !(time_ > from.fraction)) return;
  const V way = room.position - from.position;
  Scalar low = 1;
  Scalar high = (1 - from.fraction) / (time_ - from.fraction);
  while ((high - low) * length_of(way) > Tolerances<Scalar>{}.hit) {
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    (leads_to_room(room.corner, from.position + way * middle) ? low : high) = middle;
  }
  room.position = from.position + way * low;
}

/// Whether nothing is near a position, where it is now.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::roomy(const V& q) noexcept {
  bool free = true;
  for_each_near({q, q}, [&](PieceIndex piece) {
    free = free && (space_.info(piece).one_way_axis != ObstacleInfo::not_one_way || ignored(piece) ||
                    best_axis<Lanes>(space_, piece, local(piece, q)).separation >= Tolerances<Scalar>{}.hit);
  });
  return free;
}

/// Whether the rest of the step can be one straight motion from a corner of the path.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::goes_straight(std::size_t corner, const V& end) noexcept {
  position_ = result_.path[corner].position;
  time_ = result_.path[corner].fraction;
  if (!(time_ < 1) || !is_proved(end, Scalar(1))) return false;
  const V way = end - position_;
  const LocalMotion motion = make_motion<Lanes>(space_, position_, way, Scalar(0));
  if (!passes(motion, pieces_along(motion, no_mover))) return false;
  for (MoverIndex mover = 0; mover < around_.near; ++mover) {
    const V from = position_ - around_.offset(mover, time_);
    const LocalMotion seen = make_motion<Lanes>(space_, from, around_.relative(way, mover, time_), Scalar(0));
    if (space_.touched_from(seen.box()).overlaps(around_.phases.whole(mover)) &&
        !passes(seen, pieces_along(seen, mover)))
      return false;
  }
  return true;
}

/// Whether a motion comes to its end.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::passes(const LocalMotion& motion, std::span<const PieceIndex> pieces) const noexcept {
  return std::none_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
    return !ignored(piece) && !left_behind(piece) && stopped_by(motion, piece);
  });
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stopped_by(const LocalMotion& motion, PieceIndex piece) const noexcept {
  const Clearance<Scalar> clear = clearance(space_, motion, piece);
  return !clear.clear() && in_way(motion, piece) && sweep_piece(space_, motion, piece, clear).hit;
}

/// What the step began inside of is not in the way while it is left, nor what is on the character.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::left_behind(PieceIndex piece) const noexcept {
  return (moving_.leaving && memory_.is(collider_of(piece), left)) || is_lying(piece);
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::is_lying(PieceIndex piece) const noexcept {
  return moving_.seeks_room && memory_.is(collider_of(piece), lies_on);
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

/// Where the character was last free of what is left, as a piece of it sees that when the step ends: it moves on with
/// it.
template <std::size_t Lanes, class Scalar>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar>::came_from(PieceIndex piece) const noexcept {
  const PieceInfo& info = space_.scenery().pieces()[piece];
  if (info.mover == no_mover) return moving_.last_free;
  const V shift = around_.offset(info.mover, Scalar(1));
  if (const Presser<Scalar>* const known = presser(info.collider)) return V(known->from + (known->gone - shift));
  if (!moving_.last_free) return std::nullopt;
  return V(*moving_.last_free + (around_.course(info.mover) - shift));
}

/// Whether a position at the end of the step is on the side of what is left from which the character came: the straight
/// way there does not meet it.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stays_on_its_side(const V& end) noexcept {
  if (!moving_.leaves_any && moving_.on_it == 0) return true;
  const auto leads_through = [&](PieceIndex piece) {
    const std::optional<V> from = came_from(piece);
    const V to = end - offset(piece, Scalar(1));
    return from && stopped_by(make_motion<Lanes>(space_, *from, V(to - *from), Scalar(0)), piece);
  };
  for (const ColliderIndex collider : memory_.marked) {
    const PieceRange pieces = space_.scenery().pieces_of(collider);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
      if (left_behind(piece) && leads_through(piece)) return false;
  }
  return true;
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

/// Whether a straight way from here is proved clear of everything that is nearer than rounding here and is not left:
/// the step may have begun so, and gone on from where its gaps were restored.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::is_proved(const V& target, Scalar end) noexcept {
  bool clear = true;
  for_each_near({position_, position_},
                [&](PieceIndex piece) { clear = clear && (left_behind(piece) || !bars(piece, target, end)); });
  return clear;
}

/// The way to room is the nearest that is free: it is bounded by what it comes near to, and that is what holds or
/// pushes the character. Each is a contact at the moment when it is nearest, which becomes a corner of the way.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::report_room(std::size_t corner) noexcept {
  const PathPoint<Scalar> from = result_.path[corner];
  const PathPoint<Scalar> to = result_.path.back();
  memory_.near_the_way.clear();
  add_near_pieces(from, to);
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
    if (within && !is_proved(there, then)) continue;
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
void StepSolver<Lanes, Scalar>::add_near_pieces(const PathPoint<Scalar>& from, const PathPoint<Scalar>& to) noexcept {
  const auto add = [&](const V& begin, const V& end, std::span<const PieceIndex> pieces) {
    const LocalMotion motion = make_motion<Lanes>(space_, begin, V(end - begin), Scalar(0));
    for (const PieceIndex piece : pieces) {
      if (ignored(piece) || left_behind(piece) || !in_way(motion, piece)) continue;
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
    if (box.overlaps(around_.phases.whole(mover)))
      add(begin, end, around_.phases.query(mover, box, memory_.of_mover));
  }
}

/// The separation is the largest of some that are linear in time, hence convex: where it still falls it is nearest
/// later.
template <std::size_t Lanes, class Scalar>
Nearest<Scalar> StepSolver<Lanes, Scalar>::nearest_on_way(PieceIndex piece, const V& from,
                                                            const V& to) const noexcept {
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
