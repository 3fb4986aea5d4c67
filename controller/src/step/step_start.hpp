/// Depenetration. A start that overlaps something, or is nearer than `hit` to it, is made free.
#pragma once

#include "inlining.hpp"
#include "step/certificate.hpp"
#include "step/step.hpp"
#include "step/step_push.hpp"
#include "step/step_sweep.hpp"

#include <utility>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Pushes that restore the gaps of a start in a corner. If that many are not enough, there is no room.
inline constexpr int restore_rounds = 16;

/// @param now its displacement is that at the end of the step.
inline void remember(Step& step, const Crusher& now) {
  auto& all = step.memory.crushers;
  const auto known = std::ranges::find(all, now.collider, &Crusher::collider);
  if (known != all.end())
    *known = now;
  else
    all.push_back(now);
}

[[nodiscard]] inline bool overlaps(const Step& step, PieceIndex piece, const Vec2& position) {
  return !step.space.info(piece).is_one_way() &&
         overlaps_exactly(step.space, piece, step.movers.moving.motions, position, step.time);
}

[[nodiscard]] inline bool overlaps(Step& step, const Vec2& position) {
  return any_near(step, {position, position}, [&](PieceIndex piece) { return overlaps(step, piece, position); });
}

/// Ignores the movers that overlap the character, and finds each of them in the list of the state. The list may come
/// from another scenery: unknown entries are skipped. A mover that is not in the list came at the last free position;
/// if the list is full, its side is not known. True if there is a mover that was not ignored yet.
inline bool ignore_overlapping_movers(Step& step) {
  bool any = false;
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (mover_of(step, piece) == no_mover || ignored(step, piece) || !overlaps(step, piece, step.position)) return;
    step.memory.mark(collider_of(step, piece), overlaps_since_start);
    any = true;
  });
  const CharacterState& before = step.request.state;
  const bool full = before.crushers.size() == Crushers::capacity();
  step.moving.overlapping = 0;
  for (const ColliderIndex collider : step.memory.marked) {
    if (!step.memory.is(collider, overlaps_since_start)) continue;
    ++step.moving.overlapping;
    Crusher now{collider, before.last_free, displacement_of(step, collider), !full};
    const auto known = std::ranges::find(before.crushers, collider, &Crusher::collider);
    if (known != before.crushers.end())
      now = {collider, known->last_free, known->displacement + now.displacement, known->has_side};
    else if (!before.has_last_free && !full)
      continue;
    remember(step, now);
    step.moving.side_lost = step.moving.side_lost || !now.has_side;
  }
  return any;
}

/// Notes the colliders that the step begins inside of.
inline void note_colliders_left(Step& step) {
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (overlaps(step, piece, step.position)) step.memory.mark(collider_of(step, piece), leaving);
  });
}

/// An upper bound for the way out of the colliders that are overlapped: their extent and that of the octagon [m].
[[nodiscard]] inline Real reach_of_solids_inside(Step& step) {
  const Vec2 middle = step.position + step.space.hull_box().middle();
  Box2 whole{middle, middle};
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    if (!overlaps(step, piece, step.position)) return;
    const Vec2 shift = offset(step, piece);
    const PieceRange solid = step.space.scenery().pieces_of(collider_of(step, piece));
    const double angle = step.space.info(piece).angle;
    for (PieceIndex part = solid.first; part < solid.end; ++part) {
      Box2 box = step.space.scenery().box(part);
      if (angle != 0) box = geometry::Turn(angle)(box);
      whole = whole.merged(box + shift);
    }
  });
  const Vec2 extent = step.space.hull_box().size();
  return length_of(Vec2((middle - Vec2(whole.lower)).cwiseMax(Vec2(whole.upper) - middle) + extent));
}

/// What a search for a free position has in common that starts now.
[[nodiscard]] inline FreePositionQuery query_here(const Step& step) {
  return {.from = step.position,
          .near = step.position,
          .crushers = step.memory.crushers,
          .movers = step.movers.moving.motions,
          .drops = step.request.drop};
}

/// Every piece that may be hit on a straight motion to a position that is wanted. First come the pieces that may be
/// passed: all of those colliders that have a piece for which `may_pass` holds. `query.passable` counts them.
template <class MayPass>
[[nodiscard]] inline std::span<const PieceIndex> pieces_for(Step& step, FreePositionQuery& query,
                                                            const MayPass& may_pass) {
  Box2 box = Box2{query.near, query.near}.inflated(query.reach).with(query.from);
  for (const std::optional<Vec2>& before : {query.last_free, query.entered_from})
    if (before) box = box.with(*before);
  for (const Crusher& crusher : query.crushers) box = box.with(crusher.last_free + crusher.displacement);
  const std::span<PieceIndex> around = step.near.take(box);  // those of one collider are in a row
  const Box2 touched = step.space.touched_from(box);
  const auto is_out_of_way = [&](PieceIndex piece) {
    if (mover_of(step, piece) == no_mover) return false;
    const MoverMotion way{offset(step, piece, query.begin), offset(step, piece, query.end)};
    return ignored(step, piece) || !PieceFinder::seen_by(touched, way).overlaps(step.space.info(piece).box);
  };
  const std::span<PieceIndex> pieces{around.begin(), std::remove_if(around.begin(), around.end(), is_out_of_way)};
  query.passable = 0;
  for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
    bool passable = false;
    for (end = first; end < pieces.size() && collider_of(step, pieces[end]) == collider_of(step, pieces[first]); ++end)
      passable = passable || may_pass(pieces[end]);
    for (std::size_t k = first; passable && k < end; ++k) std::swap(pieces[query.passable++], pieces[k]);
  }
  return pieces;
}

/// Searches near first, then twice as far, and so on, until the solids that are overlapped are searched as a whole: 52
/// times at most from 1 nm on, as solids are less than 4e6 m wide.
[[nodiscard]] inline std::optional<Vec2> find_way_out(Step& step, FreePositionQuery query, Real whole) {
  const Vec2 extent = step.space.hull_box().size();
  for (query.reach = std::min(whole, extent.maxCoeff());; query.reach = std::min(whole, 2 * query.reach)) {
    const std::span<const PieceIndex> pieces =
        pieces_for(step, query, [&](PieceIndex piece) { return overlaps(step, piece, step.position); });
    if (const std::optional<Vec2> out = nearest_free(step.space, pieces, query)) return out;
    if (!(query.reach < whole)) return std::nullopt;
  }
}

/// The nearest free position on the side of the last free position; where there is none, on any side. First with the
/// gap that is kept everywhere else, then with that of an opening that counts as closed.
/// @param farthest it is no farther away [m].
[[nodiscard]] inline std::optional<Vec2> find_way_out(Step& step, Real farthest) {
  const Real whole = std::min(reach_of_solids_inside(step), farthest);
  FreePositionQuery query = query_here(step);
  const CharacterState& before = step.request.state;
  // What crushed it may have done so after it had moved on from there: of each the side is known.
  if (before.has_last_free) (step.memory.crushers.empty() ? query.last_free : query.entered_from) = before.last_free;
  do {
    for (const Real gap : {tolerances.stop, least_gap(step.position)}) {
      query.gap = gap;
      if (const std::optional<Vec2> out = find_way_out(step, query, whole)) return out;
    }
  } while (std::exchange(query.last_free, std::nullopt));
  return std::nullopt;
}

/// Leaves what overlaps the character. False if there is no way out.
/// @param farthest the way out is no longer [m].
[[nodiscard]] inline bool leave(Step& step, Real farthest) {
  const std::optional<Vec2> out = find_way_out(step, farthest);
  if (!out) return false;
  if (step.movers.active) note_colliders_left(step);
  step.start = step.position = *out;
  // Movers that were ignored and do not overlap here are as solid as others again.
  for (const ColliderIndex collider : step.memory.marked) step.memory.unmark(collider, overlaps_since_start);
  if (step.moving.overlapping > 0) ignore_overlapping_movers(step);
  push_corner(step, 0);
  return true;
}

/// Whether a piece blocks a character that is at `p` at a fraction of the step. A one-way segment blocks only from
/// above its surface.
[[nodiscard]] PAPERPROOF_INLINE bool may_block(const Step& step, PieceIndex piece, const Vec2& p, Real time) {
  if (!step.space.info(piece).is_one_way()) return true;
  const Vec2 shift = offset(step, piece, time);
  return !step.request.drop && is_above(step.space, piece, Vec2(p - shift), lost_by(p, shift));
}

/// The surface of a piece that the character touches now, if it may block.
[[nodiscard]] PAPERPROOF_INLINE std::optional<TouchedSurface> touched_here(const Step& step, PieceIndex piece) {
  const BestAxis best = best_axis(step.space, piece, local(step, piece, step.position));
  const bool touches = std::abs(best.separation) <= tolerances.touch;
  if (!touches || !may_block(step, piece, step.position, step.time)) return std::nullopt;
  return surface_at(step, piece, best.axis);
}

/// Pushes the character off the nearest piece, again and again, until every gap is at least `hit`. Without success the
/// position does not change.
inline void restore_gap(Step& step) {
  Vec2 q = step.position;
  for (int round = 0; round < restore_rounds; ++round) {
    Real least = std::numeric_limits<Real>::infinity();
    Vec2 push = Vec2::Zero();
    for_each_near(step, Box2::between(q, step.position), [&](PieceIndex piece) {
      const BestAxis best = best_axis(step.space, piece, local(step, piece, q));
      if (best.separation >= least || !may_block(step, piece, step.position, step.time)) return;
      least = best.separation;
      push = step.space.normal(piece, best.axis) * (tolerances.stop - best.separation);
    });
    if (least < tolerances.hit) {
      q += push;
      continue;
    }
    if (exactly_clear(step, step.position, q)) step.position = q;
    return push_corner(step, 0);
  }
}

/// Where not all gaps can be restored, restores those to moving pieces one by one. Each push must make no gap smaller
/// that is below `hit`. Otherwise rounding could let a mover that carries the character overlap it.
inline void restore_gaps_to_movers(Step& step) {
  std::vector<HalfPlane>& pushes = step.memory.planes;
  pushes.clear();
  for_each_near(step, {step.position, step.position}, [&](PieceIndex piece) {
    const MoverIndex mover = mover_of(step, piece);
    if (step.movers.displacement(mover) == Vec2::Zero() || !may_block(step, piece, step.position, step.time)) return;
    const BestAxis best = best_axis(step.space, piece, local(step, piece, step.position));
    if (best.separation < tolerances.hit)
      add_plane({step.space.normal(piece, best.axis), tolerances.stop - best.separation}, pushes);
  });
  const Vec2 before = step.position;
  for (const HalfPlane& push : pushes) {
    const Vec2 q = step.position + push.normal * push.least;
    const bool narrows = any_near(step, Box2::between(q, step.position), [&](PieceIndex piece) {
      if (!may_block(step, piece, step.position, step.time)) return false;
      const Real now = best_axis(step.space, piece, local(step, piece, step.position)).separation;
      const Real then = best_axis(step.space, piece, local(step, piece, q)).separation;
      return then < std::min(now, tolerances.hit) - tolerances.certain;
    });
    if (!narrows && exactly_clear(step, step.position, q)) step.position = q;
  }
  if (step.position != before) push_corner(step, 0);
}

/// Makes a start free that overlaps something, or is nearer than `hit` to it. False: the character is stuck.
[[nodiscard]] PAPERPROOF_COLD inline bool prepare_start(Step& step) {
  const CharacterState& state = step.request.state;
  const auto any_way = static_cast<Real>(step.request.around.limits.out);
  if (state.has_last_free) step.moving.last_free = state.last_free;
  if (state.crushed && ignore_overlapping_movers(step) && !step.moving.side_lost) {
    // They are left as any solid, to the side from which the character came, but no farther than they may push.
    step.moving.ignored &= static_cast<std::uint8_t>(~overlaps_since_start);
    const std::vector<Crusher>& crushers = step.memory.crushers;
    const bool is_out = leave(step, crushers.empty() ? any_way : push_left(step, crushers, step.position));
    step.moving.ignored = passes_through;
    if (is_out) return true;
  }
  while (overlaps(step, step.position)) {  // each round ignores one more collider that moves
    // Movers overlap the character, too: it must not leave to another side of them than it came from.
    if (!step.memory.crushers.empty()) return false;
    if (leave(step, any_way)) return true;
    // There is no free position beside the movers. Without those that overlap there may be one.
    if (!ignore_overlapping_movers(step)) return false;
  }
  if (!is_passed_through(step)) {
    restore_gap(step);
    restore_gaps_to_movers(step);
  }
  sweep_along(step, Vec2::Zero());
  step.certify = step.found.least_separation < tolerances.certain;
  return true;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
