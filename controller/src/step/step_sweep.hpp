/// StepSolver: what is in the way, and going up to it.
#pragma once

#include "step/contact_geometry.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <Variant variant, class Scalar>
Vec2<Scalar> StepSolver<variant, Scalar>::offset(PieceIndex piece, Scalar time) const noexcept {
  if constexpr (variant.movers) {
    const MoverIndex mover = space_.scenery().pieces()[piece].mover;
    if (mover != no_mover) return moving_.around.offset(mover, time);
  }
  return V::Zero();
}

template <Variant variant, class Scalar>
Vec2<Scalar> StepSolver<variant, Scalar>::local(PieceIndex piece, const V& p) const noexcept {
  if constexpr (variant.movers) return p - offset(piece);
  return p;
}

template <Variant variant, class Scalar>
template <class Visit>
void StepSolver<variant, Scalar>::for_each_near(const Box2<Scalar>& box, const Visit& visit) noexcept {
  for (const PieceIndex piece : neighbourhood_.around(box)) visit(piece);
  if constexpr (variant.movers) {
    const Box2<Scalar> world = space_.touched_from(box);
    for (MoverIndex mover = 0; mover < moving_.around.phases.size(); ++mover) {
      const V shift = moving_.around.offset(mover, time_);
      const Box2<Scalar> shifted{world.lower - shift, world.upper - shift};
      if (!shifted.overlaps(moving_.around.phases.whole(mover))) continue;
      for (const PieceIndex piece : moving_.around.phases.query(mover, shifted, moving_.around.memory.of_mover))
        if (!ignored(piece)) visit(piece);
    }
  }
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::look_along(const V& way) noexcept {
  motion_ = make_motion<variant>(space_, position_, way);
  found_.clear();
  sweep<Covered::as_any>(motion_, neighbourhood_.around(motion_.box(), way));
  if constexpr (variant.movers) look_at_movers<Covered::as_any>();
  if (stops_at_covered()) [[unlikely]]
    look_again();
  order_stops();
}

/// Along the motion of the last sweep, where a covered facet came first.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::look_again() noexcept {
  found_.clear();
  sweep<Covered::yields>(motion_, neighbourhood_.around(motion_.box(), motion_.way));
  if constexpr (variant.movers) look_at_movers<Covered::yields>();
}

/// Whether a covered facet is the first to stop the motion of the last sweep.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stops_at_covered() const noexcept {
  if (!found_.hit) return false;
  if (found_.stops.size() == 1) return found_.stops[0].axes.covered;  // mostly
  return std::any_of(found_.stops.begin(), found_.stops.end(),
                     [](const Stop<Scalar>& stop) { return stop.axes.covered; });
}

template <Variant variant, class Scalar>
template <Covered covered>
void StepSolver<variant, Scalar>::sweep(const LocalMotion& motion, std::span<const PieceIndex> pieces) noexcept {
  for (const PieceIndex piece : pieces) {
    if constexpr (variant.movers)
      if (ignored(piece) || kept_clear_by_hold(motion, piece)) continue;
    if (clear_of_box<variant>(space_, motion, piece) || !in_way(motion, piece)) continue;
    const Clearance<Scalar> clear = clearance<variant>(space_, motion, piece);
    found_.least_separation = std::min(found_.least_separation, clear.start);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece<variant, covered>(space_, motion, piece, clear);
    if (hit.hit) keep({piece, hit.stop, 0, hit.axes}, motion.length);
  }
}

/// Pieces that stop the motion together with the first are met together with it.
/// @param length of the motion, as the piece sees it [m].
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::keep(Stop<Scalar> stop, Scalar length) noexcept {
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

/// Puts first the stop whose normal points up most (of equals the lowest index).
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::order_stops() noexcept {
  if (found_.stops.size() < 2) return;
  const auto less_up = [this](const Stop<Scalar>& a, const Stop<Scalar>& b) {
    return space_.normal(a.piece, a.axes.normal).y() < space_.normal(b.piece, b.axes.normal).y();
  };
  std::swap(found_.stops[0], *std::max_element(found_.stops.begin(), found_.stops.end(), less_up));
}

/// Moves along the motion up to `stop`. False where that cannot be certified or leaves the range: then nothing moved.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::advance(Scalar stop) noexcept {
  if (stop == 0) return true;
  V target = motion_.from + motion_.way * stop;
  Scalar end = time_ + (1 - time_) * stop;
  if constexpr (variant.movers) {
    if (stop == 1) end = 1;
    note_motion_on_ground();
    if (moving_.anchored) target = anchor(end);
  }
  const Scalar furthest = std::max(std::abs(target.x()), std::abs(target.y()));
  if (!(furthest <= Tolerances<Scalar>{}.range)) return false;
  if (certify_ && !certified(target, end)) return false;
  position_ = target;
  on_ground_ = false;
  time_ = end;
  push_corner(time_);
  return true;
}

/// Whether the straight way up to a fraction of the step meets nothing that is nearer than rounding where it begins:
/// for all else the sweep's word is enough.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::certified(const V& target, Scalar end) noexcept {
  bool clear = true;
  for_each_near({position_, position_}, [&](PieceIndex piece) { clear = clear && !bars(piece, target, end); });
  return clear;
}

template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::bars(PieceIndex piece, const V& target, Scalar end) const noexcept {
  return best_axis<variant>(space_, piece, local(piece, position_)).separation < Tolerances<Scalar>{}.certain &&
         !clear_way(piece, position_, target, end);
}

/// Adds the contacts of one moment, the earliest impact first.
/// @param begin when the motion of the last sweep began.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::report(Scalar begin) noexcept {
  const std::size_t before = result_.contacts.size();
  on_ground_ = false;
  for (const Stop<Scalar>& stop : found_.stops) {
    const V normal = space_.normal(stop.piece, stop.axes.normal);
    if (walkable(normal)) {
      met_ground_ = on_ground_ = true;
      ground_ = stop.piece;
    }
    report_contact(stop.piece, stop.axes.normal, fraction_of(stop, begin), before);
  }
  if (found_.stops.overflowed()) [[unlikely]]
    report_more(begin, before);
  if constexpr (variant.movers) memory().contacts_at[result_.path.size() - 1] = result_.contacts.size();
  if (result_.contacts.size() - before > 1)
    std::sort(result_.contacts.begin() + before, result_.contacts.end(),
              [](const Contact<Scalar>& a, const Contact<Scalar>& b) { return a.fraction < b.fraction; });
}

/// One contact for each collider and normal: a polygon may hold the character by its floor and by its wall. What is met
/// later has no earlier fraction, although a motion stops a little before its time of impact.
/// @param this_moment the first contact of the present moment: of those the earlier impact counts.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::report_contact(PieceIndex piece, std::size_t axis, Scalar fraction,
                                                 std::size_t this_moment) noexcept {
  auto& contacts = result_.contacts;
  for (std::size_t i = 0; i < this_moment; ++i) fraction = std::max(fraction, contacts[i].fraction);
  const ColliderIndex collider = space_.scenery().pieces()[piece].collider;
  const V normal = space_.normal(piece, axis);
  Contact<Scalar>* const known = std::find_if(contacts.begin(), contacts.end(), [&](const Contact<Scalar>& other) {
    return other.collider == collider && dot(other.normal, normal) > 1 - same_plane<Scalar>;
  });
  if (known != contacts.end() && (known < contacts.begin() + this_moment || known->fraction <= fraction)) return;
  const ContactPlace<Scalar> place = contact_place(space_, piece, axis, local(piece, position_));
  const Contact<Scalar> contact{.collider = collider,
                                .point = place.point + offset(piece),
                                .normal = normal,
                                .fraction = fraction,
                                .separation = place.separation,
                                .side = side_of_normal(normal.x(), normal.y())};
  if (known != contacts.end())
    *known = contact;
  else
    contacts.push_back(contact, neighbourhood_.memory().contacts);
}

/// All pieces that stopped the motion of the last sweep, where there were too many to keep.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::report_more(Scalar begin, std::size_t this_moment) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const auto report_all = [&](const LocalMotion& motion, std::span<const PieceIndex> pieces) {
    const Scalar together = motion.length > 0 ? (tolerances.touch - tolerances.stop) / motion.length : Scalar(0);
    for (const PieceIndex piece : pieces) {
      if constexpr (variant.movers)
        if (ignored(piece)) continue;
      if (!in_way(motion, piece)) continue;
      const Clearance<Scalar> clear = clearance<variant>(space_, motion, piece);
      if (clear.clear()) continue;
      const PieceHit<Scalar> hit = sweep_piece<variant>(space_, motion, piece, clear);
      if (hit.hit && hit.stop <= found_.stop + together)
        report_contact(piece, hit.axes.normal, fraction_of({piece, hit.stop, together, hit.axes}, begin), this_moment);
    }
  };
  report_all(motion_, neighbourhood_.around(motion_.box(), motion_.way));
  if constexpr (variant.movers) {
    const Surroundings<Scalar>& around = moving_.around;
    for (MoverIndex mover = 0; mover < around.phases.size(); ++mover) {
      const V from = motion_.from - around.offset(mover, begin);
      const LocalMotion motion = make_motion<variant>(space_, from, around.relative(motion_.way, mover, begin));
      const std::span<const PieceIndex> found = pieces_along(motion, mover);
      // Finding a fraction may ask again.
      std::copy(found.begin(), found.end(), around.memory.all.begin());
      report_all(motion, std::span(around.memory.all).first(found.size()));
    }
  }
}

/// A contact with a piece that holds the character where it is now.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::report_touched(PieceIndex piece) noexcept {
  const std::size_t axis = best_axis<variant>(space_, piece, local(piece, position_)).axis;
  report_contact(piece, axis, time_, result_.contacts.size());
}

/// When the collider of a piece is met by the motion of the last sweep, as a fraction of the step.
/// @param begin when that motion began.
template <Variant variant, class Scalar>
Scalar StepSolver<variant, Scalar>::fraction_of(const Stop<Scalar>& stop, Scalar begin) noexcept {
  const V& from = begin == 0 ? start_ : motion_.from;
  if constexpr (variant.movers) {
    const MoverIndex mover = mover_of(stop.piece);
    if (mover != no_mover) {
      const V shift = moving_.around.offset(mover, begin);
      const V way = moving_.around.relative(motion_.way, mover, begin);
      const LocalMotion motion = make_motion<variant>(space_, V(motion_.from - shift), way);
      return begin + (1 - begin) * impact_of(stop, motion, V(from - shift));
    }
  }
  return begin + (1 - begin) * impact_of(stop, motion_, from);
}

/// The time of impact of the collider, as a fraction of the motion. Where its piece is met long after it was stopped
/// at, as a rim that is grazed, another piece of the same collider may be met in between.
template <Variant variant, class Scalar>
Scalar StepSolver<variant, Scalar>::impact_of(const Stop<Scalar>& stop, const LocalMotion& motion,
                                              const V& from) noexcept {
  Scalar earliest = time_of_impact(space_, from, motion.way, stop.piece, stop.axes);
  if ((earliest - stop.stop) * motion.length <= 2 * Tolerances<Scalar>{}.stop) return earliest;
  if (!space_.info(stop.piece).whole_collider)
    earliest = std::min(earliest, impact_with_another_piece(stop, motion, from));
  return earliest;
}

/// The earliest time of impact of the other pieces of a collider; infinite where none is met.
template <Variant variant, class Scalar>
Scalar StepSolver<variant, Scalar>::impact_with_another_piece(const Stop<Scalar>& stop, const LocalMotion& motion,
                                                              const V& from) noexcept {
  Scalar earliest = std::numeric_limits<Scalar>::infinity();
  const std::span<const PieceInfo> pieces = space_.scenery().pieces();
  for (const PieceIndex other : pieces_along(motion, pieces[stop.piece].mover)) {
    if (other == stop.piece || pieces[other].collider != pieces[stop.piece].collider) continue;
    if (!in_way(motion, other)) continue;
    const Clearance<Scalar> clear = clearance<variant>(space_, motion, other);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece<variant>(space_, motion, other, clear);
    if (hit.hit) earliest = std::min(earliest, time_of_impact(space_, from, motion.way, other, hit.axes));
  }
  return earliest;
}

/// What a motion may meet, of what stands still or of one mover.
template <Variant variant, class Scalar>
std::span<const PieceIndex> StepSolver<variant, Scalar>::pieces_along(const LocalMotion& motion,
                                                                      MoverIndex mover) noexcept {
  if constexpr (variant.movers) {
    const Surroundings<Scalar>& around = moving_.around;
    if (mover != no_mover) return around.phases.query(mover, space_.touched_from(motion.box()), around.memory.of_mover);
  }
  return neighbourhood_.around(motion.box(), motion.way);
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::push_corner(Scalar fraction) noexcept {
  if (!result_.path.empty() && result_.path.back().fraction == fraction && result_.path.back().position == position_)
    return;
  result_.path.push_back({position_, fraction}, neighbourhood_.memory().corners);
  if constexpr (variant.movers) memory().contacts_at[result_.path.size() - 1] = result_.contacts.size();
}

}  // namespace paperproof::octagon_sweep
