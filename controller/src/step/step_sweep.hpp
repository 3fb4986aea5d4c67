/// The sweep to the earliest impact, and the contacts there.
#pragma once

#include "inlining.hpp"
#include "step/certificate.hpp"
#include "step/contact_geometry.hpp"
#include "step/step.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Whether a motion does not enter the surface of a piece that is touched. Its axis alone is then proof that the motion
/// is clear of the piece.
[[nodiscard]] inline bool slides_along_touched(const Step& step, const Motion& motion, PieceIndex piece) {
  constexpr Real noise = std::numeric_limits<Real>::epsilon() * 32;
  for (const TouchedSurface& surface : step.memory.surfaces) {
    if (surface.piece != piece) continue;
    if (step.moving.waits) return true;
    const Real start = dot(surface.normal, motion.from) - surface.offset;
    const Real out = surface.normal.x() * motion.displacement.x() + surface.normal.y() * motion.displacement.y();
    Real size = std::abs(step.motion.displacement.x()) + std::abs(step.motion.displacement.y());
    size += step.movers.displacement(surface.mover).cwiseAbs().sum();
    return start >= tolerances.certain && (out >= -noise * size || start + out >= tolerances.hit);
  }
  return false;
}

/// Whether the character is beside a surface that it touches: another face keeps it clear of the piece as well.
[[nodiscard]] PAPERPROOF_COLD inline bool is_beside(const Step& step, PieceIndex piece, std::size_t touched) {
  if (step.space.is_circle(piece)) return false;
  const Vec2 at = local(step, piece, step.position);
  const Vec2 normal = step.space.normal(piece, touched);
  for (std::size_t axis = 0; axis < step.space.axis_count(piece); ++axis)
    if (step.space.separation(piece, axis, at) >= tolerances.hit &&
        dot(step.space.normal(piece, axis), normal) < 1 - same_plane)
      return true;
  return false;
}

/// Whether a surface is touched that did not stop the last sweep: that would count anew.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool is_still_touched(const Step& step, const TouchedSurface& surface) {
  const bool again =
      std::ranges::any_of(step.found.stops, [&surface](const Stop& stop) { return stop.piece == surface.piece; });
  if (again || ignored(step, surface.piece)) return false;
  const Vec2 at = local(step, surface.piece, step.position);
  return step.moving.waits || (best_axis(step.space, surface.piece, at).separation <= tolerances.touch &&
                               std::abs(step.space.separation(surface.piece, surface.axis, at)) <= tolerances.touch);
}

/// Adds the surfaces that stopped the last sweep, and drops those that are no longer touched. The first of them is the
/// one that points up most.
inline void update_surfaces(Step& step) {
  const auto less_up = [&](const TouchedSurface& a, const TouchedSurface& b) {
    return step.up.up_of(a.normal) < step.up.up_of(b.normal);
  };
  auto& surfaces = step.memory.surfaces;
  std::erase_if(surfaces, [&](const TouchedSurface& surface) { return !is_still_touched(step, surface); });
  const std::ptrdiff_t kept = std::ssize(surfaces);
  for (const Stop& stop : step.found.stops) surfaces.push_back(surface_at(step, stop.piece, stop.axes.normal));
  std::rotate(surfaces.begin(), surfaces.begin() + kept, surfaces.end());
  if (surfaces.size() > 1) std::swap(surfaces[0], *std::ranges::max_element(surfaces, less_up));
}

PAPERPROOF_COLD inline void note_motion_on_ground(Step& step) {
  const Vec2 relative = step.movers.relative(step.motion.displacement, step.moving.carrier, step.time);
  step.moving.anchored = relative.x() == 0 && relative.y() == 0;
}

/// Position of an anchored rider at a fraction of the step.
[[nodiscard]] PAPERPROOF_COLD inline Vec2 anchor(const Step& step, Real time) {
  if (step.moving.carrier == no_mover) return step.position;
  return step.movers.offset(step.moving.carrier, time) + step.moving.ride.place;
}

/// Calls `visit(piece)` for every piece that may be touched from positions in a box, at any time of the step.
template <class Visit>
inline void for_each_near(Step& step, const Box2& box, const Visit& visit) {
  step.near.for_each_group(box, Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex) {
    for (const PieceIndex piece : pieces)
      if (!ignored(step, piece)) visit(piece);
  });
}

/// Whether `condition(piece)` holds for one of them.
template <class Condition>
[[nodiscard]] inline bool any_near(Step& step, const Box2& box, const Condition& condition) {
  bool any = false;
  for_each_near(step, box, [&](PieceIndex piece) { any = any || condition(piece); });
  return any;
}

/// Whether a straight motion from now to a fraction of the step is clear of a piece, exactly.
[[nodiscard]] inline bool exactly_clear(const Step& step, PieceIndex piece, const Vec2& begin, const Vec2& target,
                                        Real end) {
  const Vec2 from = local(step, piece, begin);
  const Vec2 to = target - offset(step, piece, end);
  if (one_axis_separates(step.space, piece, from, to)) return true;
  const Motion motion = make_motion(step.space, from, Vec2(to - from), lost_by(begin, offset(step, piece)));
  if (!in_way(step, motion, piece)) return true;
  return clear_of_exactly(step.space, piece, step.movers.moving.motions, begin, step.time, target, end);
}

/// Whether a straight motion that takes no time is clear of every piece, exactly.
[[nodiscard]] inline bool exactly_clear(Step& step, const Vec2& from, const Vec2& to) {
  return !any_near(step, Box2::between(from, to),
                   [&](PieceIndex piece) { return !exactly_clear(step, piece, from, to, step.time); });
}

/// The motion of the last sweep, relative to a mover; for `no_mover` it is that motion itself.
/// @param begin when it began.
[[nodiscard]] inline Motion motion_seen_by(const Step& step, MoverIndex mover, Real begin) {
  if (mover == no_mover) return step.motion;
  const Vec2 offset = step.movers.offset(mover, begin);
  const Vec2 displacement = step.movers.relative(step.motion.displacement, mover, begin);
  return make_motion(step.space, Vec2(step.motion.from - offset), displacement, lost_by(step.motion.from, offset));
}

/// Keeps a stop if it is among the first; stops at almost the same time count as one impact.
/// @param length of the motion, as the piece sees it [m].
inline void keep_stop(Step& step, Stop stop, Real length) {
  stop.together = length > 0 ? (tolerances.touch - tolerances.stop) / length : Real(0);
  if (step.found.hit && stop.stop > step.found.stop + stop.together) return;
  if (!step.found.hit || stop.stop < step.found.stop) {
    step.found.stop = stop.stop;
    std::size_t kept = 0;
    for (const Stop& other : step.found.stops)
      if (other.stop <= step.found.stop + other.together) step.found.stops[kept++] = other;
    while (step.found.stops.size() > kept) step.found.stops.pop_back();
  }
  step.found.hit = true;
  step.found.stops.push_back(stop);
}

/// Sweeps the last motion against what may be in its way, relative to each mover. `found` keeps the first stops.
template <Covered covered>
PAPERPROOF_INLINE void sweep(Step& step) {
  const auto against = [&](const Motion& motion, std::span<const PieceIndex> pieces) {
    for (const PieceIndex piece : pieces) {
      const Real kept = kept_by_box(step.space, motion, piece);
      step.found.least_kept = std::min(step.found.least_kept, kept);
      if (kept >= tolerances.hit || !in_way(step, motion, piece)) continue;
      if (ignored(step, piece) || slides_along_touched(step, motion, piece)) continue;
      const Clearance clear = clearance(step.space, motion, piece);
      step.found.least_separation = std::min(step.found.least_separation, clear.start);
      if (clear.clear()) continue;
      const PieceHit hit = sweep_piece<covered>(step.space, motion, piece, clear, step.up);
      if (hit.hit) keep_stop(step, {piece, hit.stop, 0, hit.axes}, motion.length);
    }
  };
  step.found.clear();
  const Box2 box = step.motion.box();
  against(step.motion, step.near.standing(box, step.motion.displacement));
  step.near.for_each_moving(box, [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    against(motion_seen_by(step, mover, step.time), pieces);
  });
}

/// Repeats the last sweep after a covered facet came first. Covered facets yield to those that cover them.
PAPERPROOF_COLD inline void sweep_again(Step& step) { sweep<Covered::yields>(step); }

/// Whether a covered facet stopped the last sweep.
[[nodiscard]] inline bool stops_at_covered(const Step& step) {
  return std::ranges::any_of(step.found.stops, [](const Stop& stop) { return stop.axes.covered; });
}

/// Puts the stop with the most upward normal first. Of equal ones it is the one with the lowest index.
inline void order_stops(Step& step) {
  if (step.found.stops.size() < 2) return;
  const auto less_up = [&](const Stop& a, const Stop& b) {
    return step.up.up_of(step.space.normal(a.piece, a.axes.normal)) <
           step.up.up_of(step.space.normal(b.piece, b.axes.normal));
  };
  std::swap(step.found.stops[0], *std::ranges::max_element(step.found.stops, less_up));
}

/// Sweeps from the present position. Motion and result are in `motion` and `found`.
PAPERPROOF_FLATTEN inline void sweep_along(Step& step, const Vec2& displacement) {
  set_motion(step.motion, step.space, step.position, displacement);
  sweep<Covered::as_any>(step);
  if (stops_at_covered(step)) [[unlikely]]
    sweep_again(step);
  order_stops(step);
}

[[nodiscard]] inline bool blocks_exactly(const Step& step, PieceIndex piece, const Vec2& target, Real end) {
  return best_axis(step.space, piece, local(step, piece, step.position)).separation < tolerances.certain &&
         !exactly_clear(step, piece, step.position, target, end);
}

/// Whether the straight motion to `target` is proved clear of every piece that is nearer than rounding at its start.
/// For pieces that are further away the sweep is proof enough.
[[nodiscard]] PAPERPROOF_COLD inline bool certified(Step& step, const Vec2& target, Real end) {
  return !any_near(step, {step.position, step.position},
                   [&](PieceIndex piece) { return blocks_exactly(step, piece, target, end); });
}

/// Advances along the motion of the last sweep up to fraction `stop`. False where that cannot be certified, or leaves
/// the range: then nothing has changed.
[[nodiscard]] inline bool advance(Step& step, Real stop) {
  if (stop == 0) return true;
  Vec2 target = step.motion.from + step.motion.displacement * stop;
  Real end = step.time + (1 - step.time) * stop;
  if (stop == 1) end = 1;
  if (step.moving.anchored) note_motion_on_ground(step);
  if (step.moving.anchored) target = anchor(step, end);
  const Real furthest = std::max(std::abs(target.x()), std::abs(target.y()));
  if (!(furthest <= tolerances.range)) return false;
  if (step.certify && !certified(step, target, end)) return false;
  step.position = target;
  step.on_ground = false;
  step.time = end;
  push_corner(step, step.time);
  return true;
}

/// Reports one contact for each collider and normal: the same polygon may be floor and wall. No contact gets an earlier
/// fraction than an impact that came before, although a motion stops a little before its time of impact.
/// @param this_moment index of the first contact of the present moment. Among those the earlier impact counts.
inline void report_contact(Step& step, PieceIndex piece, std::size_t axis, Real fraction, std::size_t this_moment) {
  auto& contacts = step.result.contacts;
  fraction = std::max(fraction, step.latest_impact);
  const ColliderIndex collider = collider_of(step, piece);
  const Vec2 normal = step.space.normal(piece, axis);
  const auto known = std::ranges::find_if(contacts, [&](const Contact& other) {
    return other.collider == collider && dot(other.normal, normal) > 1 - same_plane;
  });
  if (known != contacts.end() &&
      (known < contacts.begin() + static_cast<std::ptrdiff_t>(this_moment) || known->fraction <= fraction))
    return;
  const Contact contact =
      contact_with(step.space, step.up, piece, axis, local(step, piece, step.position), offset(step, piece), fraction);
  if (known != contacts.end())
    *known = contact;
  else
    contacts.push_back(contact);
}

/// The earliest time of impact with the other pieces of a collider; infinite where none is hit.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline Real impact_with_another_piece(Step& step, const Stop& stop,
                                                                          const Motion& motion, const Vec2& from) {
  Real earliest = std::numeric_limits<Real>::infinity();
  for_each_near(step, step.motion.box(), [&](PieceIndex other) {
    if (other == stop.piece || collider_of(step, other) != collider_of(step, stop.piece)) return;
    if (!in_way(step, motion, other)) return;
    const PieceHit hit = find_hit(step.space, motion, other, step.up);
    if (hit.hit) earliest = std::min(earliest, time_of_impact(step.space, from, motion.displacement, other, hit.axes));
  });
  return earliest;
}

/// Time of impact with the collider of a piece, as a fraction of the motion. A motion that grazes a rim stops long
/// before its time of impact: another piece of the same collider may be hit in between.
[[nodiscard]] inline Real impact_of(Step& step, const Stop& stop, const Motion& motion, const Vec2& from) {
  Real earliest = time_of_impact(step.space, from, motion.displacement, stop.piece, stop.axes);
  if ((earliest - stop.stop) * motion.length <= 2 * tolerances.stop) return earliest;
  if (!step.space.info(stop.piece).whole_collider)
    earliest = std::min(earliest, impact_with_another_piece(step, stop, motion, from));
  return earliest;
}

/// Time of impact with the collider of a piece in the last sweep, as a fraction of the step.
/// @param begin when that motion began.
[[nodiscard]] inline Real fraction_of(Step& step, const Stop& stop, Real begin) {
  const Vec2& from = begin == 0 ? step.start : step.motion.from;
  const MoverIndex mover = mover_of(step, stop.piece);
  if (mover == no_mover) return begin + (1 - begin) * impact_of(step, stop, step.motion, from);
  const Vec2 shift = step.movers.offset(mover, begin);
  return begin + (1 - begin) * impact_of(step, stop, motion_seen_by(step, mover, begin), Vec2(from - shift));
}

/// Reports all pieces that stopped the last sweep, where there were too many to keep.
PAPERPROOF_COLD inline void report_more(Step& step, Real begin, std::size_t this_moment) {
  step.near.for_each_group(step.motion.box(), Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const Motion motion = motion_seen_by(step, mover, begin);
    const Real together = motion.length > 0 ? (tolerances.touch - tolerances.stop) / motion.length : Real(0);
    for (const PieceIndex piece : pieces) {
      if (ignored(step, piece) || !in_way(step, motion, piece)) continue;
      const PieceHit hit = find_hit(step.space, motion, piece, step.up);
      if (!hit.hit || hit.stop > step.found.stop + together) continue;
      const Real fraction = fraction_of(step, {piece, hit.stop, together, hit.axes}, begin);
      report_contact(step, piece, hit.axes.normal, fraction, this_moment);
    }
  });
}

/// The fraction of a contact that is met before any time has passed, by a motion that other contacts have turned.
/// Either the wanted motion comes to it before it comes to them, or it comes after the first of them.
/// @param turned time of impact of the motion that was turned.
[[nodiscard]] PAPERPROOF_COLD inline Real fraction_after_contacts(Step& step, PieceIndex piece, Real turned) {
  Real first = 1;
  for (const Contact& contact : step.result.contacts) first = std::min<Real>(first, contact.fraction);
  const Vec2 at_first = offset(step, piece, 0);
  const Vec2 way = step.wanted - step.movers.displacement(mover_of(step, piece));
  const Motion motion = make_motion(step.space, Vec2(step.start - at_first), way, lost_by(step.start, at_first));
  if (in_way(step, motion, piece)) {
    const PieceHit hit = find_hit(step.space, motion, piece, step.up);
    const Real wanted = hit.hit ? time_of_impact(step.space, motion.from, way, piece, hit.axes) : first;
    if (wanted < first) return wanted;
  }
  return std::max(first, turned);
}

/// Reports the contacts of one moment, the earliest impact first, and notes the ground among them.
/// @param begin when the motion of the last sweep began.
PAPERPROOF_FLATTEN inline void report(Step& step, Real begin) {
  const std::size_t before = step.result.contacts.size();
  step.on_ground = false;
  for (const Stop& stop : step.found.stops) {
    const Vec2 normal = step.space.normal(stop.piece, stop.axes.normal);
    if (walkable(step, normal) && !step.on_ground) {
      step.met_ground = step.on_ground = true;
      step.ground = stop.piece;
      step.ground_axis = stop.axes.normal;
    }
    Real fraction = fraction_of(step, stop, begin);
    if (begin == 0 && before > 0) [[unlikely]]
      fraction = fraction_after_contacts(step, stop.piece, fraction);
    report_contact(step, stop.piece, stop.axes.normal, fraction, before);
  }
  if (step.found.stops.overflowed()) [[unlikely]]
    report_more(step, begin, before);
  // What the character touched when the motion began holds up nothing: the motion need not have closed that gap.
  if (step.found.stop > 0)
    for (std::size_t i = before; i < step.result.contacts.size(); ++i)
      step.latest_impact = std::max<Real>(step.latest_impact, step.result.contacts[i].fraction);
  note_reported(step);
}

/// Puts the contacts in order of fraction; those of one fraction stay as they were met.
PAPERPROOF_COLD inline void order_contacts(Step& step) {
  const auto begin = step.result.contacts.begin();
  for (auto contact = begin; contact != step.result.contacts.end(); ++contact) {
    const auto place = std::upper_bound(begin, contact, contact->fraction,
                                        [](Real fraction, const Contact& other) { return fraction < other.fraction; });
    std::rotate(place, contact, contact + 1);
  }
}

/// Reports a contact with a piece that is touched now.
PAPERPROOF_COLD inline void report_touched(Step& step, PieceIndex piece) {
  const std::size_t axis = best_axis(step.space, piece, local(step, piece, step.position)).axis;
  report_contact(step, piece, axis, step.time, step.result.contacts.size());
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
