/// StepSolver: a free position for a character that movers press.
///
/// It is free at the end of the step, no further away than the movers move, and reached by one straight uniform motion
/// from a corner of the path. Two kinds of colliders may be passed, but only to the side from which the character came:
/// those that the step began inside of, in a motion from its start; and movers that overlap since an earlier step.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/free_position.hpp"
#include "step/step_solver.hpp"

#include <algorithm>

namespace paperproof::octagon_sweep {

/// Moves to the nearest free position. False if there is none: then nothing has changed.
/// @param reach how far away it may be [m].
/// @param corners of the path at which the motion may begin.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::find_free_position(Scalar reach, Corners corners) noexcept {
  if (moving_.side_lost) return false;
  // Movers that overlap do not block the motion, but its end must be free of them.
  const std::uint8_t ignored_before = moving_.ignored;
  moving_.ignored &= static_cast<std::uint8_t>(~overlaps_since_start);
  constexpr Tolerances<Scalar> tolerances{};
  std::optional<FreePosition> found = nearest_free_position(tolerances.hit * Scalar(least_gap), reach, corners);
  if (found) {
    // Mostly there is also one with the gap that is kept everywhere else.
    if (const auto ample = nearest_free_position(tolerances.stop, reach, corners)) found = ample;
  }
  moving_.ignored = ignored_before;
  if (!found) return false;
  extend_until_contact(*found);
  go_back_to(found->corner);
  go_to(found->position);
  report_free_position(found->corner);
  return true;
}

/// @param gap that is left around the character [m].
template <std::size_t Lanes, class Scalar, class Up>
auto StepSolver<Lanes, Scalar, Up>::nearest_free_position(Scalar gap, Scalar reach, Corners corners) noexcept
    -> std::optional<FreePosition> {
  // The gap to a mover comes on top of its displacement.
  constexpr Scalar beyond = 16 * Tolerances<Scalar>{}.stop;
  const Scalar whole = reach + beyond;
  // Mostly there is one nearby, among few pieces.
  const Scalar near = std::min(whole, (space_.hull_box().upper - space_.hull_box().lower).maxCoeff());
  for (const Scalar radius : {near, whole}) {
    FreePosition found{radius, V::Zero(), corners.end};
    for (std::size_t corner = corners.end; corner-- > corners.first;) search_from(corner, gap, found);
    if (found.corner < corners.end) return found;
    if (near == whole) break;
  }
  return std::nullopt;
}

/// @param gap that is left around the character [m].
template <std::size_t Lanes, class Scalar, class Up>
FreePositionQuery<Scalar> StepSolver<Lanes, Scalar, Up>::query_from(std::size_t corner, Scalar gap) const noexcept {
  const PathPoint<Scalar>& begin = result_.path[corner];
  return {.from = begin.position,
          .begin = begin.fraction,
          .near = position_,
          .end = 1,
          .last_free = {},
          .crushers = memory_.crushers,
          .entered_from = moving_.last_free,
          .movers = movers_.motions,
          .drops = drops_,
          .gap = gap,
          .reach = 0};
}

/// Takes a free position that is reached from a corner, if it is nearer than the one found so far.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::search_from(std::size_t corner, Scalar gap, FreePosition& found) noexcept {
  FreePositionQuery<Scalar> query = query_from(corner, gap);
  if (!(query.begin < 1)) return;
  query.reach = found.distance;
  const std::span<PieceIndex> pieces = pieces_for(query, found.distance);
  query.passable = put_first(pieces, [&](PieceIndex piece) { return may_pass(piece, corner); });
  if (const std::optional<V> nearest = nearest_free<Lanes>(space_, pieces, query))
    found = {length_of(V(*nearest - position_)), *nearest, corner};
}

/// A character that arrives later at a place where it was stopped may touch nothing there. It then goes on in the same
/// direction, no faster than before, until something is as near as a contact.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::extend_until_contact(FreePosition& found) noexcept {
  const PathPoint<Scalar> from = result_.path[found.corner];
  if (!(time_ > from.fraction) || next_near(found.corner, {found.position, 1}, {})) return;
  const V displacement = found.position - from.position;
  Scalar low = 1;
  Scalar high = (1 - from.fraction) / (time_ - from.fraction);
  FreePositionQuery<Scalar> query = query_from(found.corner, Scalar(0));
  const std::span<PieceIndex> pieces = pieces_for(query, length_of(V(from.position + displacement * high - position_)));
  query.passable = put_first(pieces, [&](PieceIndex piece) { return may_pass(piece, found.corner); });
  while ((high - low) * length_of(displacement) > Tolerances<Scalar>{}.hit) {  // 46 halvings at most, of 4e6 m
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    (reaches<Lanes>(space_, pieces, query, V(from.position + displacement * middle)) ? low : high) = middle;
  }
  found.position = from.position + displacement * low;
}

/// Whether a motion from a corner may pass the collider of a piece.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::may_pass(PieceIndex piece, std::size_t corner) const noexcept {
  return memory_.is(collider_of(piece), corner == 0 ? leaving | overlaps_since_start : overlaps_since_start);
}

/// Notes the colliders that the step begins inside of.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::note_colliders_left() noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const ColliderIndex collider = collider_of(piece);
    if (memory_.is(collider, leaving) || !overlaps(piece, position_)) return;
    memory_.mark(collider, leaving);
  });
}

/// One motion for the rest of the step, which is known to be clear.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::go_to(const V& end) noexcept {
  halt();
  position_ = end;
  time_ = 1;
  on_ground_ = wedged_ = false;
  push_corner(time_);
}

/// Takes back the path since a corner, and its contacts.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::go_back_to(std::size_t corner) noexcept {
  while (result_.path.size() > corner + 1) result_.path.pop_back();
  while (result_.contacts.size() > memory_.reported_at[corner].contacts) result_.contacts.pop_back();
  latest_impact_ = memory_.reported_at[corner].impact;
  position_ = result_.path[corner].position;
  time_ = result_.path[corner].fraction;
  moving_.anchored = false;
}

/// Reports what the motion to the free position comes near to: that is what stops or pushes the character. Each piece
/// is a contact at the moment when it is nearest, and that moment becomes a corner of the path.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::report_free_position(std::size_t corner) noexcept {
  const PathPoint<Scalar> from = result_.path[corner];
  const PathPoint<Scalar> to = result_.path.back();
  result_.path.pop_back();
  position_ = result_.path.back().position;
  time_ = result_.path.back().fraction;
  std::optional<Nearest<Scalar>> next;
  while ((next = next_near(corner, to, next))) {  // each piece once
    const Nearest<Scalar> near = *next;
    const bool within = near.when < 1;
    // No corner within a motion that needs an exact certificate: its position could not be rounded.
    if (within && (certify_ || result_.path.size() + 1 >= memory_.corners.capacity())) continue;
    const V there = within ? V(from.position + (to.position - from.position) * near.when) : to.position;
    const Scalar then = within ? from.fraction + (1 - from.fraction) * near.when : Scalar(1);
    const auto blocked = [&](PieceIndex piece) {
      return !may_pass(piece, corner) && blocks_exactly(piece, there, then);
    };
    if (within && any_near({position_, position_}, blocked)) continue;
    position_ = there;
    time_ = then;
    push_corner(time_);
    report_contact(near.piece, near.axis, time_, result_.contacts.size());
    note_reported();
  }
  position_ = to.position;
  time_ = 1;
  push_corner(time_);
}

/// The next piece that the motion from a corner comes as near to as a contact.
/// @param last the one before; none for the first.
template <std::size_t Lanes, class Scalar, class Up>
std::optional<Nearest<Scalar>> StepSolver<Lanes, Scalar, Up>::next_near(
    std::size_t corner, const PathPoint<Scalar>& to, const std::optional<Nearest<Scalar>>& last) noexcept {
  const PathPoint<Scalar> from = result_.path[corner];
  std::optional<Nearest<Scalar>> next;
  const auto before = [](const Nearest<Scalar>& a, const Nearest<Scalar>& b) {
    return a.when != b.when ? a.when < b.when : a.piece < b.piece;
  };
  const auto look_at = [&](const V& begin, const V& end, std::span<const PieceIndex> pieces) {
    const LocalMotion motion = make_motion<Lanes>(space_, begin, V(end - begin), Scalar(0));
    for (const PieceIndex piece : pieces) {
      if (ignored(piece) || may_pass(piece, corner) || !in_way(motion, piece)) continue;
      const Nearest<Scalar> near = nearest_on_way(piece, begin, end);
      if (is_contact(near) && (!last || before(*last, near)) && (!next || before(near, *next))) next = near;
    }
  };
  const auto box_of = [&](const V& begin, const V& end) {
    return Box2<Scalar>{begin.cwiseMin(end), begin.cwiseMax(end)}.inflated(Tolerances<Scalar>{}.look);
  };
  look_at(from.position, to.position, neighbourhood_.around(box_of(from.position, to.position)));
  for (MoverIndex mover = 0; mover < movers_.count; ++mover) {
    const V begin = from.position - movers_.offset(mover, from.fraction);
    const V end = to.position - movers_.offset(mover, to.fraction);
    const Box2<Scalar> box = space_.touched_from(box_of(begin, end));
    if (box.overlaps(movers_.phases.whole(mover)))
      look_at(begin, end, movers_.phases.query(mover, box, memory_.of_mover));
  }
  return next;
}

/// Whether a piece pushes or comes nearer, and is as near as a contact then.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::is_contact(const Nearest<Scalar>& near) const noexcept {
  const MoverIndex mover = mover_of(near.piece);
  const V motion_of_mover = mover == no_mover ? V(V::Zero()) : movers_.displacement(mover);
  const bool pushes = dot(motion_of_mover, space_.normal(near.piece, near.axis)) > Tolerances<Scalar>{}.certain;
  return (near.when > 0 || pushes) && near.separation <= 2 * Tolerances<Scalar>{}.stop &&
         !space_.covered(near.piece, near.axis);
}

/// Where a straight motion is nearest to a piece. The separation is the largest of several that are linear in time,
/// hence convex: bisection finds its least value.
template <std::size_t Lanes, class Scalar, class Up>
Nearest<Scalar> StepSolver<Lanes, Scalar, Up>::nearest_on_way(PieceIndex piece, const V& from,
                                                              const V& to) const noexcept {
  const V displacement = to - from;
  const auto at = [&](Scalar when) { return best_axis<Lanes>(space_, piece, V(from + displacement * when)); };
  const auto falls = [&](const BestAxis<Scalar>& best) {
    const V n = space_.normal(piece, best.axis);
    return displacement.x() * n.x() + displacement.y() * n.y() < 0;
  };
  BestAxis<Scalar> best = at(1);
  if (falls(best)) return {piece, best.axis, best.separation, 1};
  Scalar low = 0;  // where it falls
  Scalar high = 1;
  best = at(0);
  if (!falls(best)) return {piece, best.axis, best.separation, 0};
  while ((high - low) * displacement.cwiseAbs().maxCoeff() > Tolerances<Scalar>{}.certain) {  // 49 halvings at most
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    const BestAxis<Scalar> there = at(middle);
    (falls(there) ? low : high) = middle;
    if (falls(there)) best = there;
  }
  return {piece, best.axis, best.separation, low};
}

}  // namespace paperproof::octagon_sweep
