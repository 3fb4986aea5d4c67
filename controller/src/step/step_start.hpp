/// StepSolver: depenetration. A start that overlaps something, or is nearer than `hit` to it, is made free.
#pragma once

#include "step/certificate.hpp"
#include "step/step_solver.hpp"

#include <utility>

namespace paperproof::octagon_sweep {

/// Pushes that restore the gaps of a start in a corner. If that many are not enough, there is no room.
inline constexpr int restore_rounds = 16;

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::prepare_start(Part part, const StepRequest<Scalar>& request) noexcept {
  if (request.has_last_free) moving_.last_free = request.last_free;
  if (request.crushed && ignore_overlapping_movers(request) && part == Part::whole &&
      leaves_overlapping_movers(request))
    return true;
  while (overlaps(position_)) {  // each round ignores one more collider that moves
    // Movers overlap the character, too: it must not leave to another side of them than it came from.
    if (!memory_.crushers.empty()) return false;
    const std::optional<V> out = find_way_out(request);
    if (out) {
      if (movers_.active) note_colliders_left();
      start_ = position_ = *out;
      // Movers that were ignored and do not overlap here are as solid as others again.
      for (const ColliderIndex collider : memory_.marked) memory_.unmark(collider, overlaps_since_start);
      if (moving_.overlapping > 0) ignore_overlapping_movers(request);
      push_corner(0);
      return true;
    }
    // There is no free position beside the movers. Without those that overlap there may be one.
    if (!ignore_overlapping_movers(request)) return false;
  }
  if (!is_passed_through()) {
    restore_gap();
    if (movers_.count > 0) restore_gaps_to_movers();
  }
  sweep_along(V::Zero());
  certify_ = found_.least_separation < Tolerances<Scalar>{}.certain;
  return true;
}

/// The nearest free position on the side of the last free position; where there is none, on any side. First with the
/// gap that is kept everywhere else, then with a little more than the gap of an opening that counts as closed.
template <std::size_t Lanes, class Scalar, class Up>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar, Up>::find_way_out(const StepRequest<Scalar>& request) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const Scalar whole = reach_of_solids_inside();
  FreePositionQuery<Scalar> query{.from = position_,
                                  .near = position_,
                                  .last_free = {},
                                  .crushers = memory_.crushers,
                                  .entered_from = {},
                                  .movers = request.movers,
                                  .drops = request.drop,
                                  .gap = {},
                                  .reach = {}};
  if (request.has_last_free) query.last_free = request.last_free;
  do {
    for (const Scalar gap : {tolerances.stop, tolerances.hit * Scalar(least_gap)}) {
      query.gap = gap;
      if (const std::optional<V> out = find_way_out(query, whole)) return out;
    }
  } while (std::exchange(query.last_free, std::nullopt));
  return std::nullopt;
}

/// Searches near first, then twice as far, and so on, until the solids that are overlapped are searched as a whole: 52
/// times at most from 1 nm on, as solids are less than 4e6 m wide.
template <std::size_t Lanes, class Scalar, class Up>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar, Up>::find_way_out(FreePositionQuery<Scalar> query,
                                                                        Scalar whole) noexcept {
  const V extent = space_.hull_box().upper - space_.hull_box().lower;
  for (query.reach = std::min(whole, extent.maxCoeff());; query.reach = std::min(whole, 2 * query.reach)) {
    const std::span<PieceIndex> pieces = pieces_for(query, query.reach);
    query.passable = put_first(pieces, [this](PieceIndex piece) { return overlaps(piece, position_); });
    if (const std::optional<V> out = nearest_free<Lanes>(space_, pieces, query)) return out;
    if (!(query.reach < whole)) return std::nullopt;
  }
}

/// Every piece that may be hit on a straight motion to a position less than `radius` away from `query.near`. The pieces
/// of one collider are in a row. The span may be reordered.
template <std::size_t Lanes, class Scalar, class Up>
std::span<PieceIndex> StepSolver<Lanes, Scalar, Up>::pieces_for(const FreePositionQuery<Scalar>& query,
                                                                Scalar radius) noexcept {
  Box2<Scalar> box = Box2<Scalar>{query.near, query.near}.inflated(radius).merged({query.from, query.from});
  const auto add = [&box](const V& p) { box = box.merged({p, p}); };
  if (query.last_free) add(*query.last_free);
  if (query.entered_from) add(*query.entered_from);
  for (const Crusher<Scalar>& crusher : query.crushers) add(crusher.last_free + crusher.displacement);
  auto [storage, count] = neighbourhood_.take(box);
  const Box2<Scalar> touched = space_.touched_from(box);
  for (MoverIndex mover = 0; mover < movers_.count; ++mover) {
    const V begin = movers_.offset(mover, query.begin);
    const V end = movers_.offset(mover, query.end);
    const Box2<Scalar> seen{touched.lower - begin.cwiseMax(end), touched.upper - begin.cwiseMin(end)};
    if (!seen.overlaps(movers_.phases.whole(mover))) continue;
    for (const PieceIndex piece : movers_.phases.query(mover, seen, memory_.of_mover))
      if (!ignored(piece)) storage[count++] = piece;
  }
  return storage.first(count);
}

/// Puts all pieces of those colliders first that have a piece for which the condition holds.
/// @return how many they are.
template <std::size_t Lanes, class Scalar, class Up>
template <class Condition>
std::size_t StepSolver<Lanes, Scalar, Up>::put_first(std::span<PieceIndex> pieces,
                                                     const Condition& condition) const noexcept {
  std::size_t count = 0;
  for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
    bool fulfilled = false;
    for (end = first; end < pieces.size() && collider_of(pieces[end]) == collider_of(pieces[first]); ++end)
      fulfilled = fulfilled || condition(pieces[end]);
    for (std::size_t k = first; fulfilled && k < end; ++k) std::swap(pieces[count++], pieces[k]);
  }
  return count;
}

/// An upper bound for the way out of the colliders that are overlapped: their extent and that of the octagon [m].
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::reach_of_solids_inside() noexcept {
  const V middle = position_ + space_.hull_box().middle();
  Box2<Scalar> whole{middle, middle};
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (!overlaps(piece, position_)) return;
    const V shift = offset(piece);
    const PieceRange solid = space_.scenery().pieces_of(collider_of(piece));
    for (PieceIndex part = solid.first; part < solid.end; ++part) {
      const Box2<Scalar>& box = space_.scenery().box(part);
      whole = whole.merged({box.lower + shift, box.upper + shift});
    }
  });
  const V extent = space_.hull_box().upper - space_.hull_box().lower;
  return length_of(V((middle - whole.lower).cwiseMax(whole.upper - middle) + extent));
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::overlaps(const V& position) noexcept {
  return any_near({position, position}, [&](PieceIndex piece) { return overlaps(piece, position); });
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::overlaps(PieceIndex piece, const V& position) const noexcept {
  const V at = local(piece, position);
  if (space_.info(piece).one_way_axis != ObstacleInfo::not_one_way ||
      best_axis<Lanes>(space_, piece, at).separation >= Tolerances<Scalar>{}.certain)
    return false;
  const MoverIndex mover = mover_of(piece);
  if (mover != no_mover) return overlaps_exactly(space_, piece, ExactPosition(position, movers_.motions[mover], time_));
  return overlaps_exactly(space_, piece, at);
}

/// Whether a piece blocks a character at `position`. A one-way segment blocks only from above its surface.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::may_block(PieceIndex piece, const V& position) const noexcept {
  if (space_.info(piece).one_way_axis == ObstacleInfo::not_one_way) return true;
  if (drops_) return false;
  return is_above(space_, piece, local(piece, position), lost_by(position, offset(piece)));
}

/// Pushes the character off the nearest piece, again and again, until every gap is at least `hit`. Without success the
/// position does not change.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::restore_gap() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  V q = position_;
  for (int round = 0; round < restore_rounds; ++round) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    V push = V::Zero();
    for_each_near({q.cwiseMin(position_), q.cwiseMax(position_)}, [&](PieceIndex piece) {
      const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, q));
      if (best.separation >= least || !may_block(piece, position_)) return;
      least = best.separation;
      push = space_.normal(piece, best.axis) * (tolerances.stop - best.separation);
    });
    if (least >= tolerances.hit) {
      if (!exactly_clear(position_, q)) return;
      position_ = q;
      push_corner(0);
      return;
    }
    q += push;
  }
}

/// Whether a straight motion that takes no time is clear of every piece, exactly.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::exactly_clear(const V& from, const V& to) noexcept {
  return !any_near({from.cwiseMin(to), from.cwiseMax(to)},
                   [&](PieceIndex piece) { return !exactly_clear(piece, from, to, time_); });
}

/// The same for one piece, and a motion from now to a fraction of the step.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::exactly_clear(PieceIndex piece, const V& begin, const V& target,
                                                  Scalar end) const noexcept {
  const V from = local(piece, begin);
  const V to = target - offset(piece, end);
  if (one_axis_separates(space_, piece, from, to)) return true;
  LocalMotion motion = make_motion<Lanes>(space_, from, V(to - from));
  motion.lost = lost_by(begin, offset(piece));
  if (!in_way(motion, piece)) return true;
  return clear_of_exactly(space_, piece, movers_.motions, begin, time_, target, end);
}

/// Where not all gaps can be restored, restores those to moving pieces one by one. Each push must make no gap smaller
/// that is below `hit`. Otherwise rounding could let a mover that carries the character overlap it.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::restore_gaps_to_movers() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  std::vector<HalfPlane<Scalar>>& pushes = memory_.displacement_planes;
  pushes.clear();
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const MoverIndex mover = mover_of(piece);
    if (mover == no_mover || movers_.displacement(mover) == V::Zero() || !may_block(piece, position_)) return;
    const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
    if (best.separation < tolerances.hit)
      add_plane({space_.normal(piece, best.axis), tolerances.stop - best.separation}, pushes);
  });
  const V before = position_;
  for (const HalfPlane<Scalar>& push : pushes) {
    const V q = position_ + push.normal * push.least;
    const bool narrows = any_near({q.cwiseMin(position_), q.cwiseMax(position_)}, [&](PieceIndex piece) {
      if (!may_block(piece, position_)) return false;
      const Scalar now = best_axis<Lanes>(space_, piece, local(piece, position_)).separation;
      const Scalar then = best_axis<Lanes>(space_, piece, local(piece, q)).separation;
      return then < std::min(now, tolerances.hit) - tolerances.certain;
    });
    if (!narrows && exactly_clear(position_, q)) position_ = q;
  }
  if (position_ != before) push_corner(0);
}

}  // namespace paperproof::octagon_sweep
