/// A free position for a character that movers press.
///
/// It is free at the end of the step, no farther away than the movers may push (step_push.hpp), and reached by one
/// straight uniform motion from a corner of the path. Two kinds of colliders may be passed from a corner inside of
/// them, but only to the side from which the character came: those that the step began inside of, and movers that
/// overlap since an earlier step.
#pragma once

#include "inlining.hpp"
#include "step/contact_geometry.hpp"
#include "step/free_position.hpp"
#include "step/step.hpp"
#include "step/step_push.hpp"
#include "step/step_response.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

#include <algorithm>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Whether a motion from a corner may pass the collider of a piece. One that has left the character by then is solid
/// again.
[[nodiscard]] inline bool may_pass(const Step& step, PieceIndex piece, std::size_t corner) {
  const PathPoint& at = step.result.path[corner];
  return step.memory.is(collider_of(step, piece), leaving | overlaps_since_start) &&
         overlaps_exactly(step.space, piece, step.movers.moving.motions, at.position, at.fraction);
}

/// The nearest free position that is reached from a corner.
/// @param gap that is left around the character [m].
[[nodiscard]] inline std::optional<Vec2> nearest_free_from(Step& step, std::size_t corner, Real gap, Real reach) {
  // The gap to a mover comes on top of its displacement.
  constexpr Real beyond = 16 * tolerances.stop;
  const Real whole = reach + beyond;
  // Mostly there is one nearby, among few pieces.
  const Real near = std::min<Real>(whole, step.space.hull_box().size().maxCoeff());
  FreePositionQuery query = query_here(step);
  query.from = step.result.path[corner].position;
  query.begin = static_cast<Real>(step.result.path[corner].fraction);
  query.end = 1;
  query.entered_from = step.moving.last_free;
  query.gap = gap;
  if (!(query.begin < 1)) return std::nullopt;
  for (const Real radius : {near, whole}) {
    query.reach = radius;
    const auto passable = [&](PieceIndex piece) { return may_pass(step, piece, corner); };
    const std::optional<Vec2> nearest = nearest_free(step.space, pieces_for(step, query, passable), query);
    if (nearest || near == whole) return nearest;
  }
  return std::nullopt;
}

/// Whether a piece is one of those that left no motion.
[[nodiscard]] inline bool presses(const Step& step, PieceIndex piece) {
  return std::ranges::any_of(step.memory.pressing, [&](const TouchedSurface& one) { return one.piece == piece; });
}

/// Whether a piece pushes or comes nearer, and is as near as a contact then. A face that a neighbour covers is none,
/// but for a character that passes through a mover: that may be the neighbour.
[[nodiscard]] inline bool is_contact(const Step& step, const Nearest& near) {
  const Vec2 motion_of_mover = step.movers.displacement(mover_of(step, near.piece));
  const bool pushes = dot(motion_of_mover, step.space.normal(near.piece, near.axis)) > tolerances.certain;
  return (near.when > 0 || pushes) && near.separation <= 2 * tolerances.stop &&
         (step.moving.overlapping > 0 || !step.space.covered(near.piece, near.axis));
}

/// By bisection, the largest fraction of a way for which a condition holds, as it does at `low`.
/// @param length of the way [m]. @param within so much of it the answer may be too small [m].
template <class Holds>
[[nodiscard]] Real last_where(Real low, Real high, Real length, Real within, const Holds& holds) {
  while ((high - low) * length > within) {  // 49 halvings at most, of 4e6 m
    const Real middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

/// Where a straight motion is nearest to a piece. The separation is the largest of several that are linear in time,
/// hence convex: bisection finds its least value.
/// @param stopped when surfaces left no motion, as a share of the way.
[[nodiscard]] inline Nearest nearest_on_way(const Step& step, PieceIndex piece, const Vec2& from, const Vec2& to,
                                            Real stopped) {
  const Vec2 displacement = to - from;
  const auto at = [&](Real when) { return best_axis(step.space, piece, Vec2(from + displacement * when)); };
  const auto falls = [&](const BestAxis& best) {
    const Vec2 n = step.space.normal(piece, best.axis);
    return displacement.x() * n.x() + displacement.y() * n.y() < 0;
  };
  Real when = 1;
  if (!falls(at(1))) {
    const auto falls_at = [&](Real time) { return falls(at(time)); };
    when = falls_at(0) ? last_where(0, 1, displacement.cwiseAbs().maxCoeff(), tolerances.certain, falls_at) : Real(0);
  }
  // What it goes along held it when it was stopped.
  if (when == 0 && presses(step, piece) && at(stopped).separation <= 2 * tolerances.stop) when = stopped;
  const BestAxis best = at(when);
  return {piece, best.axis, best.separation, when};
}

/// The next piece that the motion from a corner comes as near to as a contact.
/// @param last the one before; none for the first.
[[nodiscard]] inline std::optional<Nearest> next_near(Step& step, std::size_t corner, const PathPoint& to,
                                                      const std::optional<Nearest>& last) {
  const PathPoint from = step.result.path[corner];
  std::optional<Nearest> next;
  const auto before = [&](const Nearest& a, const Nearest& b) {
    return a.when != b.when ? a.when < b.when : step.space.info(a.piece).piece < step.space.info(b.piece).piece;
  };
  const auto stopped = static_cast<Real>(std::max(0.0, step.moving.stopped - from.fraction) / (1 - from.fraction));
  const Box2 box = Box2::between(from.position, to.position).inflated(tolerances.look);
  step.near.for_each_group(box, Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const Vec2 begin = from.position - step.movers.offset(mover, from.fraction);
    const Vec2 end = to.position - step.movers.offset(mover, to.fraction);
    const Motion motion = make_motion(step.space, begin, Vec2(end - begin));
    for (const PieceIndex piece : pieces) {
      if (ignored(step, piece) || may_pass(step, piece, corner) || !in_way(step, motion, piece)) continue;
      const Nearest near = nearest_on_way(step, piece, begin, end, stopped);
      if (is_contact(step, near) && (!last || before(*last, near)) && (!next || before(near, *next))) next = near;
    }
  });
  return next;
}

/// Takes back the path since a corner, and its contacts.
inline void go_back_to(Step& step, std::size_t corner) {
  const Reported& then = step.memory.reported_at[corner];
  while (step.result.path.size() > corner + 1) step.result.path.pop_back();
  while (step.result.contacts.size() > then.contacts) step.result.contacts.pop_back();
  step.latest_impact = then.impact;
  step.position = step.result.path[corner].position;
  step.time = step.result.path[corner].fraction;
  step.moving.anchored = false;
}

/// The response of a velocity to a contact, and to all that is touched still.
PAPERPROOF_COLD inline void respond_to_contact(Step& step, const Nearest& near, Desired& velocity) {
  step.found.clear();
  step.found.stops.push_back({near.piece, 0, 0, {near.axis, near.axis, false, false}});
  update_surfaces(step);
  const Desired had = velocity;
  const auto velocity_of = [&](const TouchedSurface& surface) { return step.movers.velocity(surface.mover); };
  if (!respond_to_touched(step, velocity, step.steered, false, velocity_of)) velocity = {Vec2::Zero(), Vec2::Zero()};
  if (squeeze(step)) limit_speed(step, had, velocity);
}

/// Goes straight to the free position, from a corner that is the last one of the path. Reports what this motion comes
/// near to: that is what stops or pushes the character, and its velocity answers to it. Each piece is a contact at the
/// moment when it is nearest, and that moment becomes a corner of the path.
inline void go_to_free_position(Step& step, std::size_t corner, const Vec2& end) {
  const PathPoint from = step.result.path[corner];
  const PathPoint to{end, 1};
  step.on_ground = step.wedged = false;
  Desired velocity = step.memory.reported_at[corner].velocity;
  step.steered = step.memory.reported_at[corner].steered;
  std::optional<Nearest> next;
  while ((next = next_near(step, corner, to, next))) {  // each piece once
    const Nearest near = *next;
    const bool within = near.when < 1;
    // No corner within a motion that needs an exact certificate: its position could not be rounded.
    if (within && (step.certify || step.result.path.size() + 1 >= step.memory.most_corners)) continue;
    const Vec2 there =
        within ? Vec2(Vec2(from.position) + Vec2(to.position - from.position) * near.when) : Vec2(to.position);
    const Real then = within ? from.fraction + (1 - from.fraction) * near.when : Real(1);
    const auto blocked = [&](PieceIndex piece) {
      return !may_pass(step, piece, corner) && blocks_exactly(step, piece, there, then);
    };
    if (within && any_near(step, {step.position, step.position}, blocked)) continue;
    step.position = there;
    step.time = then;
    push_corner(step, step.time);
    report_contact(step, near.piece, near.axis, step.time, step.result.contacts.size());
    if (!is_passed_through(step)) respond_to_contact(step, near, velocity);
  }
  step.velocity = velocity.wanted;
  step.position = to.position;
  step.time = 1;
  push_corner(step, step.time);
}

/// Moves to the nearest free position that is reached from the last corner from which any is: until there the motion is
/// that of every other step. False if there is none: then nothing has changed.
/// @param reach how far away it may be [m]. @param corners of the path at which it may begin: so many, the first ones.
[[nodiscard]] PAPERPROOF_COLD inline bool move_to_free_position(Step& step, Real reach, std::size_t corners) {
  if (step.moving.side_lost) return false;
  step.moving.stopped = step.time;
  step.memory.pressing = step.memory.surfaces;
  // Movers that overlap do not block the motion, but its end must be free of them.
  const std::uint8_t ignored_before = step.moving.ignored;
  step.moving.ignored &= static_cast<std::uint8_t>(~overlaps_since_start);
  std::optional<Vec2> found;
  std::size_t corner = corners;
  while (!found && corner-- > 0) found = nearest_free_from(step, corner, least_gap(step.position), reach);
  // Mostly there is also one with the gap that is kept everywhere else.
  if (found) found = nearest_free_from(step, corner, tolerances.stop, reach).value_or(*found);
  step.moving.ignored = ignored_before;
  if (!found) return false;
  step.moving.waits = false;
  go_back_to(step, corner);
  go_to_free_position(step, corner, *found);
  step.memory.surfaces.clear();
  return true;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
