/// StepSolver: the sweep to the earliest impact, and the contacts there.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::offset(PieceIndex piece, Scalar time) const noexcept {
  const MoverIndex mover = mover_of(piece);
  return mover == no_mover ? V(V::Zero()) : movers_.offset(mover, time);
}

template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::local(PieceIndex piece, const V& p) const noexcept {
  return mover_of(piece) == no_mover ? p : V(p - offset(piece));
}

template <std::size_t Lanes, class Scalar, class Up>
template <class Visit>
void StepSolver<Lanes, Scalar, Up>::for_each_near(const Box2<Scalar>& box, const Visit& visit) noexcept {
  for (const PieceIndex piece : neighbourhood_.around(box)) visit(piece);
  const Box2<Scalar> world = space_.touched_from(box);
  for (MoverIndex mover = 0; mover < movers_.count; ++mover) {
    const V shift = movers_.offset(mover, time_);
    const Box2<Scalar> shifted{world.lower - shift, world.upper - shift};
    if (!shifted.overlaps(movers_.phases.whole(mover))) continue;
    for (const PieceIndex piece : movers_.phases.query(mover, shifted, memory_.of_mover))
      if (!ignored(piece)) visit(piece);
  }
}

template <std::size_t Lanes, class Scalar, class Up>
template <class Condition>
bool StepSolver<Lanes, Scalar, Up>::any_near(const Box2<Scalar>& box, const Condition& condition) noexcept {
  bool any = false;
  for_each_near(box, [&](PieceIndex piece) { any = any || condition(piece); });
  return any;
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::sweep_along(const V& displacement) noexcept {
  motion_ = make_motion<Lanes>(space_, position_, displacement);
  found_.clear();
  sweep<Covered::as_any>(motion_, neighbourhood_.around(motion_.box(), displacement));
  sweep_movers<Covered::as_any>();
  if (stops_at_covered()) [[unlikely]]
    sweep_again();
  order_stops();
}

/// Repeats the last sweep after a covered facet came first. Covered facets yield to those that cover them.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::sweep_again() noexcept {
  found_.clear();
  sweep<Covered::yields>(motion_, neighbourhood_.around(motion_.box(), motion_.displacement));
  sweep_movers<Covered::yields>();
}

/// Whether a covered facet stopped the last sweep.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::stops_at_covered() const noexcept {
  if (!found_.hit) return false;
  if (found_.stops.size() == 1) return found_.stops[0].axes.covered;  // the usual case
  return std::any_of(found_.stops.begin(), found_.stops.end(),
                     [](const Stop<Scalar>& stop) { return stop.axes.covered; });
}

template <std::size_t Lanes, class Scalar, class Up>
template <Covered covered>
void StepSolver<Lanes, Scalar, Up>::sweep(const LocalMotion& motion, std::span<const PieceIndex> pieces) noexcept {
  for (const PieceIndex piece : pieces) {
    const Scalar kept = kept_by_box(space_, motion, piece);
    found_.least_kept = std::min(found_.least_kept, kept);
    if (kept >= Tolerances<Scalar>{}.hit || !in_way(motion, piece)) continue;
    if (ignored(piece) || slides_along_touched(motion, piece)) continue;
    const Clearance<Scalar> clear = clearance(space_, motion, piece);
    found_.least_separation = std::min(found_.least_separation, clear.start);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece<covered>(space_, motion, piece, clear, up_);
    if (hit.hit) keep_stop({piece, hit.stop, 0, hit.axes}, motion.length);
  }
}

/// The motion of the last sweep, relative to a mover.
/// @param offset of the mover when the motion began. @param displacement relative to it.
template <std::size_t Lanes, class Scalar, class Up>
typename StepSolver<Lanes, Scalar, Up>::LocalMotion StepSolver<Lanes, Scalar, Up>::motion_relative_to(
    const V& offset, const V& displacement) const noexcept {
  LocalMotion seen = make_motion<Lanes>(space_, V(motion_.from - offset), displacement);
  seen.lost = lost_by(motion_.from, offset);
  return seen;
}

/// Sweeps the last motion against every mover, relative to it.
template <std::size_t Lanes, class Scalar, class Up>
template <Covered covered>
void StepSolver<Lanes, Scalar, Up>::sweep_movers() noexcept {
  // A sweep looks this far beyond the end of a motion, at most (it measures by the larger component).
  constexpr Scalar look = 2 * Tolerances<Scalar>{}.look;
  for (MoverIndex mover = 0; mover < movers_.count; ++mover) {
    const V offset = movers_.offset(mover, time_);
    const V from = motion_.from - offset;
    const V displacement = movers_.relative(motion_.displacement, mover, time_);
    const V to = from + displacement;
    const Box2<Scalar> box = space_.touched_from(Box2<Scalar>{from.cwiseMin(to), from.cwiseMax(to)}.inflated(look));
    if (!box.overlaps(movers_.phases.whole(mover))) continue;
    sweep<covered>(motion_relative_to(offset, displacement), movers_.phases.query(mover, box, memory_.of_mover));
  }
}

/// Keeps a stop if it is among the first; stops at almost the same time count as one impact.
/// @param length of the motion, as the piece sees it [m].
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::keep_stop(Stop<Scalar> stop, Scalar length) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  stop.together = length > 0 ? (tolerances.touch - tolerances.stop) / length : Scalar(0);
  if (found_.hit && stop.stop > found_.stop + stop.together) return;
  if (!found_.hit || stop.stop < found_.stop) {
    found_.stop = stop.stop;
    std::size_t kept = 0;
    for (const Stop<Scalar>& other : found_.stops)
      if (other.stop <= found_.stop + other.together) found_.stops[kept++] = other;
    while (found_.stops.size() > kept) found_.stops.pop_back();
  }
  found_.hit = true;
  found_.stops.push_back(stop);
}

/// Puts the stop first whose normal points up most; of equals the one with the lowest index.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::order_stops() noexcept {
  if (found_.stops.size() < 2) return;
  const auto less_up = [this](const Stop<Scalar>& a, const Stop<Scalar>& b) {
    return up_.up_of(space_.normal(a.piece, a.axes.normal)) < up_.up_of(space_.normal(b.piece, b.axes.normal));
  };
  std::swap(found_.stops[0], *std::max_element(found_.stops.begin(), found_.stops.end(), less_up));
}

/// Advances along the motion of the last sweep up to fraction `stop`. False where that cannot be certified, or leaves
/// the range: then nothing has changed.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::advance(Scalar stop) noexcept {
  if (stop == 0) return true;
  V target = motion_.from + motion_.displacement * stop;
  Scalar end = time_ + (1 - time_) * stop;
  if (stop == 1) end = 1;
  if (moving_.anchored) note_motion_on_ground();
  if (moving_.anchored) target = anchor(end);
  const Scalar furthest = std::max(std::abs(target.x()), std::abs(target.y()));
  if (!(furthest <= Tolerances<Scalar>{}.range)) return false;
  if (certify_ && !certified(target, end)) return false;
  position_ = target;
  on_ground_ = false;
  time_ = end;
  push_corner(time_);
  return true;
}

/// Whether the straight motion to `target` is proved clear of every piece that is nearer than rounding at its start.
/// For pieces that are further away the sweep is proof enough.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::certified(const V& target, Scalar end) noexcept {
  return !any_near({position_, position_}, [&](PieceIndex piece) { return blocks_exactly(piece, target, end); });
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::blocks_exactly(PieceIndex piece, const V& target, Scalar end) const noexcept {
  return best_axis<Lanes>(space_, piece, local(piece, position_)).separation < Tolerances<Scalar>{}.certain &&
         !exactly_clear(piece, position_, target, end);
}

/// Reports the contacts of one moment, the earliest impact first.
/// @param begin when the motion of the last sweep began.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::report(Scalar begin) noexcept {
  const std::size_t before = result_.contacts.size();
  on_ground_ = false;
  for (const Stop<Scalar>& stop : found_.stops) {
    const V normal = space_.normal(stop.piece, stop.axes.normal);
    if (walkable(normal) && !on_ground_) {
      met_ground_ = on_ground_ = true;
      ground_ = stop.piece;
      ground_axis_ = stop.axes.normal;
    }
    Scalar fraction = fraction_of(stop, begin);
    if (begin == 0 && before > 0) [[unlikely]]
      fraction = fraction_after_contacts(stop.piece, fraction);
    report_contact(stop.piece, stop.axes.normal, fraction, before);
  }
  if (found_.stops.overflowed()) [[unlikely]]
    report_more(begin, before);
  // What the character touched when the motion began holds up nothing: the motion need not have closed that gap.
  if (found_.stop > 0)
    for (std::size_t i = before; i < result_.contacts.size(); ++i)
      latest_impact_ = std::max(latest_impact_, result_.contacts[i].fraction);
  note_reported();
}

/// Notes what was reported up to the last corner of the path.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::note_reported() noexcept {
  memory_.reported_at[result_.path.size() - 1] = {result_.contacts.size(), latest_impact_};
}

/// Reports one contact for each collider and normal: the same polygon may be floor and wall. No contact gets an earlier
/// fraction than an impact that came before, although a motion stops a little before its time of impact.
/// @param this_moment index of the first contact of the present moment. Among those the earlier impact counts.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::report_contact(PieceIndex piece, std::size_t axis, Scalar fraction,
                                                   std::size_t this_moment) noexcept {
  auto& contacts = result_.contacts;
  fraction = std::max(fraction, latest_impact_);
  const ColliderIndex collider = collider_of(piece);
  const V normal = space_.normal(piece, axis);
  Contact<Scalar>* const known = std::find_if(contacts.begin(), contacts.end(), [&](const Contact<Scalar>& other) {
    return other.collider == collider && dot(other.normal, normal) > 1 - same_plane<Scalar>;
  });
  if (known != contacts.end() && (known < contacts.begin() + this_moment || known->fraction <= fraction)) return;
  const ContactPlace<Scalar> place = contact_place(space_, piece, axis, normal, local(piece, position_));
  const Contact<Scalar> contact{.collider = collider,
                                .point = place.point + offset(piece),
                                .normal = normal,
                                .fraction = fraction,
                                .separation = place.separation,
                                .side = up_.side_of(normal)};
  if (known != contacts.end())
    *known = contact;
  else
    contacts.push_back(contact, memory_.contacts);
}

/// Reports all pieces that stopped the last sweep, where there were too many to keep.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::report_more(Scalar begin, std::size_t this_moment) noexcept {
  const auto report_hit = [&](const LocalMotion& motion, PieceIndex piece) {
    constexpr Tolerances<Scalar> tolerances{};
    if (ignored(piece) || !in_way(motion, piece)) return;
    const Clearance<Scalar> clear = clearance(space_, motion, piece);
    if (clear.clear()) return;
    const Scalar together = motion.length > 0 ? (tolerances.touch - tolerances.stop) / motion.length : Scalar(0);
    const PieceHit<Scalar> hit = sweep_piece(space_, motion, piece, clear, up_);
    if (hit.hit && hit.stop <= found_.stop + together)
      report_contact(piece, hit.axes.normal, fraction_of({piece, hit.stop, together, hit.axes}, begin), this_moment);
  };
  for (const PieceIndex piece : neighbourhood_.around(motion_.box(), motion_.displacement)) report_hit(motion_, piece);
  for (MoverIndex mover = 0; mover < movers_.count; ++mover) {
    const LocalMotion motion = motion_seen_by(mover, begin);
    const PieceRange pieces = space_.scenery().pieces_of_mover(mover);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece) report_hit(motion, piece);
  }
}

/// Puts the contacts in order of fraction; those of one fraction stay as they were met.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::order_contacts() noexcept {
  const auto begin = result_.contacts.begin();
  for (auto contact = begin; contact != result_.contacts.end(); ++contact) {
    const auto place =
        std::upper_bound(begin, contact, contact->fraction,
                         [](Scalar fraction, const Contact<Scalar>& other) { return fraction < other.fraction; });
    std::rotate(place, contact, contact + 1);
  }
}

/// Reports a contact with a piece that is touched now.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::report_touched(PieceIndex piece) noexcept {
  const std::size_t axis = best_axis<Lanes>(space_, piece, local(piece, position_)).axis;
  report_contact(piece, axis, time_, result_.contacts.size());
}

/// Time of impact with the collider of a piece in the last sweep, as a fraction of the step.
/// @param begin when that motion began.
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::fraction_of(const Stop<Scalar>& stop, Scalar begin) noexcept {
  const V& from = begin == 0 ? start_ : motion_.from;
  const MoverIndex mover = mover_of(stop.piece);
  if (mover != no_mover) {
    const V shift = movers_.offset(mover, begin);
    return begin + (1 - begin) * impact_of(stop, motion_seen_by(mover, begin), V(from - shift));
  }
  return begin + (1 - begin) * impact_of(stop, motion_, from);
}

/// The fraction of a contact that is met before any time has passed, by a motion that other contacts have turned.
/// Either the wanted motion comes to it before it comes to them, or it comes after the first of them.
/// @param turned time of impact of the motion that was turned.
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::fraction_after_contacts(PieceIndex piece, Scalar turned) noexcept {
  Scalar first = 1;
  for (const Contact<Scalar>& contact : result_.contacts) first = std::min(first, contact.fraction);
  const MoverIndex mover = mover_of(piece);
  const V offset = mover == no_mover ? V(V::Zero()) : movers_.offset(mover, 0);
  const V way = mover == no_mover ? wanted_ : V(wanted_ - movers_.displacement(mover));
  LocalMotion motion = make_motion<Lanes>(space_, V(start_ - offset), way);
  motion.lost = lost_by(start_, offset);
  if (in_way(motion, piece)) {
    const Clearance<Scalar> clear = clearance(space_, motion, piece);
    const PieceHit<Scalar> hit = clear.clear() ? PieceHit<Scalar>{} : sweep_piece(space_, motion, piece, clear, up_);
    const Scalar wanted = hit.hit ? time_of_impact(space_, motion.from, way, piece, hit.axes) : first;
    if (wanted < first) return wanted;
  }
  return std::max(first, turned);
}

/// Time of impact with the collider of a piece, as a fraction of the motion. A motion that grazes a rim stops long
/// before its time of impact: another piece of the same collider may be hit in between.
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::impact_of(const Stop<Scalar>& stop, const LocalMotion& motion,
                                                const V& from) noexcept {
  Scalar earliest = time_of_impact(space_, from, motion.displacement, stop.piece, stop.axes);
  if ((earliest - stop.stop) * motion.length <= 2 * Tolerances<Scalar>{}.stop) return earliest;
  if (!space_.info(stop.piece).whole_collider)
    earliest = std::min(earliest, impact_with_another_piece(stop, motion, from));
  return earliest;
}

/// The earliest time of impact with the other pieces of a collider; infinite where none is hit.
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::impact_with_another_piece(const Stop<Scalar>& stop, const LocalMotion& motion,
                                                                const V& from) noexcept {
  Scalar earliest = std::numeric_limits<Scalar>::infinity();
  const std::span<const PieceInfo> pieces = space_.scenery().pieces();
  for (const PieceIndex other : pieces_along(motion, pieces[stop.piece].mover)) {
    if (other == stop.piece || pieces[other].collider != pieces[stop.piece].collider) continue;
    if (!in_way(motion, other)) continue;
    const Clearance<Scalar> clear = clearance(space_, motion, other);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece(space_, motion, other, clear, up_);
    if (hit.hit) earliest = std::min(earliest, time_of_impact(space_, from, motion.displacement, other, hit.axes));
  }
  return earliest;
}

/// Pieces that a motion may hit, of one mover or, for `no_mover`, of the scenery that stands still.
template <std::size_t Lanes, class Scalar, class Up>
std::span<const PieceIndex> StepSolver<Lanes, Scalar, Up>::pieces_along(const LocalMotion& motion,
                                                                        MoverIndex mover) noexcept {
  if (mover != no_mover) return movers_.phases.query(mover, space_.touched_from(motion.box()), memory_.of_mover);
  return neighbourhood_.around(motion.box(), motion.displacement);
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::push_corner(Scalar fraction) noexcept {
  if (!result_.path.empty() && result_.path.back().fraction == fraction && result_.path.back().position == position_)
    return;
  result_.path.push_back({position_, fraction}, memory_.corners);
  note_reported();
}

}  // namespace paperproof::octagon_sweep
