/// One piece against one straight motion.
///
/// The functions are always inlined: a step is short, and vectors handed over in memory cost as much as the arithmetic
/// (a pair that is written as two numbers and read as one waits for the memory).
#pragma once

#include "geometry/time_below.hpp"
#include "inlining.hpp"
#include "step/configuration_space.hpp"

#include <paperproof/up_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// A straight motion of the reference point, with all that is the same for every piece.
struct Motion {
  Vec2 from;
  Vec2 displacement;  ///< The whole motion [m].
  Real length;        ///< Of `displacement` [m].
  Real reach;         ///< The sweep covers `displacement` times this: it looks a little beyond the end.
  Vec2 extended;      ///< That product [m].
  PerAxis at;         ///< n·from
  PerAxis along;      ///< n·extended
  Vec2 lost;          ///< What `from` lost when the offset of the piece's mover was taken from it [m].

  [[nodiscard]] Box2 box() const {
    const Vec2 to = from + extended;
    return Box2::between(from, to);
  }
};

/// In place: a motion is large.
/// @param lost see `Motion`.
PAPERPROOF_INLINE void set_motion(Motion& motion, const ConfigurationSpace& space, const Vec2& from,
                                  const Vec2& displacement, const Vec2& lost = Vec2::Zero()) {
  // A shorter motion would make the reach infinite.
  constexpr Real shortest = std::numeric_limits<Real>::min() * Real(1e8);
  motion.from = from;
  motion.displacement = displacement;
  motion.length = length_of(displacement);
  // By the larger component: a look up to 1.42 times as far is as good, and nothing waits for a square root.
  const Real larger = std::max(std::abs(displacement.x()), std::abs(displacement.y()));
  motion.reach = 1 + tolerances.look / std::max(larger, shortest);
  motion.extended = displacement * motion.reach;
  space.for_each_group([&](std::size_t k) PAPERPROOF_INLINE_LAMBDA {
    motion.at.group(k) = space.shared_x(k) * from.x() + space.shared_y(k) * from.y();
    motion.along.group(k) = space.shared_x(k) * motion.extended.x() + space.shared_y(k) * motion.extended.y();
  });
  motion.lost = lost;
}

[[nodiscard]] PAPERPROOF_INLINE Motion make_motion(const ConfigurationSpace& space, const Vec2& from,
                                                   const Vec2& displacement, const Vec2& lost = Vec2::Zero()) {
  Motion motion;
  set_motion(motion, space, from, displacement, lost);
  return motion;
}

/// Separations of a piece at the start and at the end of the extended motion [m], shared axes first.
struct AxisRanges {
  std::size_t count;
  std::array<Real, ConfigurationSpace::max_axes> start;
  std::array<Real, ConfigurationSpace::max_axes> end;
};

/// What the axes of a piece say together about a motion.
struct Clearance {
  Real start;         ///< Largest separation before the motion [m]; below zero: inside.
  Real kept;          ///< Largest separation that one axis keeps over the whole motion [m].
  AxisRanges ranges;  ///< Of what is no circle.

  /// What counts as a hit [m]: coming nearer than `hit`, or than at the start where that is nearer.
  [[nodiscard]] Real tau() const { return std::min(tolerances.hit, start); }
  /// One axis keeps the motion clear.
  [[nodiscard]] bool clear() const { return kept >= tau(); }
};

/// How far away one of the box directions alone, which are the first shared axes, keeps a piece during the whole motion
/// [m]. With most pieces that is further than `hit`: looking at these axes first saves half of a sweep.
[[nodiscard]] PAPERPROOF_INLINE Real kept_by_box(const ConfigurationSpace& space, const Motion& motion,
                                                 PieceIndex piece) {
  const Four start = motion.at.group(0) - space.offsets(piece, 0);
  const Four least = start.min(start + motion.along.group(0));
  return least.maxCoeff();
}

/// Separation of a circle before the motion, and the one that the axis of this separation keeps over the whole motion.
[[nodiscard]] PAPERPROOF_COLD inline std::pair<Real, Real> clearance_of_circle(const ConfigurationSpace& space,
                                                                               const Motion& motion, PieceIndex piece) {
  const geometry::NearCircle near = space.near_circle(piece, motion.from);
  const Real along = near.normal.x() * motion.extended.x() + near.normal.y() * motion.extended.y();
  return {near.separation, near.separation + std::min(along, Real(0))};
}

[[nodiscard]] PAPERPROOF_INLINE Clearance clearance(const ConfigurationSpace& space, const Motion& motion,
                                                    PieceIndex piece) {
  Clearance result;
  AxisRanges& f = result.ranges;
  Four start;
  Four kept;
  space.for_each_group([&](std::size_t k) PAPERPROOF_INLINE_LAMBDA {
    const Four here = motion.at.group(k) - space.offsets(piece, k);
    const Four there = here + motion.along.group(k);
    const Four least = here.min(there);
    start = k == 0 ? here : Four(start.max(here));
    kept = k == 0 ? least : Four(kept.max(least));
    Four::Map(f.start.data() + 4 * k) = here;
    Four::Map(f.end.data() + 4 * k) = there;
  });
  result.start = start.maxCoeff();
  result.kept = kept.maxCoeff();
  f.count = space.lanes();
  if (space.own_axes(piece).empty()) return result;
  if (space.is_circle(piece)) [[unlikely]] {
    const auto [start_of_circle, kept_by_circle] = clearance_of_circle(space, motion, piece);
    result.start = start_of_circle;
    result.kept = std::max(result.kept, kept_by_circle);
    return result;
  }
  for (const OwnAxis& own : space.own_axes(piece)) {
    const Real at = own.normal.x() * motion.from.x() + own.normal.y() * motion.from.y() - own.offset;
    const Real end = at + (own.normal.x() * motion.extended.x() + own.normal.y() * motion.extended.y());
    result.start = std::max(result.start, at);
    result.kept = std::max(result.kept, std::min(at, end));
    f.start[f.count] = at;
    f.end[f.count++] = end;
  }
  return result;
}

/// The axes along which a piece is entered last.
struct EntryAxes {
  std::size_t normal;  ///< Its normal is the contact's: below the hit distance.
  std::size_t impact;  ///< Its time is the time of impact: below zero. `no_axis` where none is.
  /// The piece itself is missed, by less than the hit distance: `impact` is then the axis along which it comes that
  /// near, covered or not.
  bool missed;
  bool covered;  ///< `normal` is that of a covered facet.
};

/// What a motion does to a piece that it comes near to.
struct PieceHit {
  bool hit;
  Real stop;       ///< Where to stop, as a fraction of `displacement`.
  EntryAxes axes;  ///< Valid for a hit.
};

/// Finds the axis that is entered last; of times that are equal but for rounding the normal that points up most wins.
class LastEntry {
 public:
  LastEntry(const ConfigurationSpace& space, PieceIndex piece, const UpFrame& frame)
      : space_(space), frame_(frame), piece_(piece) {}

  void add(std::size_t axis, Real time) {
    Entry& last = space_.covered(piece_, axis) ? covered_ : open_;
    if (!(time > last.time + same) && !(time >= last.time - same && up(axis) > up(last.axis))) return;
    last = {axis, time};
  }

  /// A facet that other obstacles cover gives no contact normal unless there is no other, or no other that is faced
  /// where the motion is stopped: what covers it may be let through, or leave less of it open than counts.
  /// @param faced whether the piece is still apart there along an axis.
  template <class Faced>
  [[nodiscard]] bool is_covered(const Faced& faced) const {
    return open_.time < 0 || (covered_.time >= 0 && !faced(open_.axis));
  }
  [[nodiscard]] std::size_t axis(bool is_covered) const { return is_covered ? covered_.axis : open_.axis; }

 private:
  struct Entry {
    std::size_t axis = ConfigurationSpace::no_axis;
    Real time = -1;  ///< Below zero: there is none.
  };
  /// Times closer than this are one corner, met with both facets at once.
  static constexpr Real same = std::numeric_limits<Real>::epsilon() * 64;
  [[nodiscard]] Real up(std::size_t axis) const { return frame_.up_of(space_.normal(piece_, axis)); }

  const ConfigurationSpace& space_;
  const UpFrame& frame_;
  PieceIndex piece_;
  Entry open_;
  Entry covered_;
};

/// Of the distances at which an uncovered facet is hit, and stops: see `sweep_covered`.
inline constexpr Real covered_share = Real(0.5);

/// When all separations are below a level for the first time; nothing where they never are together.
[[nodiscard]] inline std::optional<Real> entry_below(const AxisRanges& f, Real level) {
  geometry::TimeBelow<Real> time{0, 1};
  for (std::size_t axis = 0; axis < f.count; ++axis) time.narrow(f.start[axis], f.end[axis], level);
  return time.any() ? std::optional(time.begin) : std::nullopt;
}

/// Where a motion is stopped that enters by a hidden facet alone; nothing where it passes.
///
/// Such a facet lies inside of what covers it. Near it what covers it is nearer than its distance to the facet, which
/// is up to 1.42 times the separation: where two facets that stand at right angles meet. Were both to stop at the same
/// separation, then a motion that just misses the one might still be stopped by the other, and by a normal that the
/// surface has nowhere: who flies up a slope and over its crest would lose its speed to the side of the next tile. So
/// the hidden facet stops later, and only where nothing stops the motion that covers it.
/// @param tau see `Clearance`.
[[nodiscard]] PAPERPROOF_COLD inline std::optional<Real> sweep_covered(const AxisRanges& f, Real tau) {
  if (!entry_below(f, std::min(tau, tolerances.hit * covered_share))) return std::nullopt;
  const Real start = *std::max_element(f.start.begin(), f.start.begin() + f.count);
  if (start <= tolerances.touch * covered_share) return Real(0);
  return entry_below(f, tolerances.stop * covered_share);
}

/// A circle is entered along the tangent that it has where the motion is stopped. From each slide along a tangent it is
/// a little further away: where that counted as touching up to the whole gap of a touch, a walk over a circle of 100 km
/// would be in the air in one step of four.
[[nodiscard]] PAPERPROOF_COLD inline PieceHit sweep_circle(const ConfigurationSpace& space, const Motion& motion,
                                                           PieceIndex piece, Real start) {
  const auto approach = [&](Real level) {
    return geometry::approach(space.hull(), motion.from, motion.extended, space.circle(piece), level);
  };
  const auto near = approach(std::min(tolerances.hit, start));
  if (!near) return {false, 0, {}};
  geometry::Approach stop{0, space.near_circle(piece, motion.from)};
  const Real touching = tolerances.stop + (tolerances.touch - tolerances.stop) / 4;
  if (start > touching) stop = approach(tolerances.stop).value_or(*near);
  stop.time *= motion.reach;
  const auto impact = start >= 0 ? approach(Real(0)) : std::nullopt;
  const bool missed = start >= 0 && !impact;
  return {stop.time <= 1,
          Real(stop.time),
          {axis_along(stop.there.normal),
           impact   ? axis_along(impact->there.normal)
           : missed ? axis_along(near->there.normal)
                    : ConfigurationSpace::no_axis,
           missed, false}};
}

/// Whether hidden facets yield to what covers them. A sweep over many pieces asks that in a second round only, where
/// one of them came first: behind the surface of a wall of tiles every facet is covered.
enum class Covered : std::uint8_t { as_any, yields };

/// Sweeps the reference point against one obstacle that may block it: no axis keeps it clear.
///
/// Every separation is linear in time. The motion hits when, at some time, all of them are below tau: the latest entry
/// below tau comes before the earliest exit above it. It is then stopped where it enters the larger region below
/// `stop`. The obstacle is inflated instead of backing off along the motion: where the motion grazes, its time of
/// impact is ill-conditioned, but the separations are not.
/// @param up decides which of two facets counts that are entered at once.
template <Covered covered = Covered::yields>
[[nodiscard]] PAPERPROOF_INLINE PieceHit sweep_piece(const ConfigurationSpace& space, const Motion& motion,
                                                     PieceIndex piece, const Clearance& clear, const UpFrame& up = {}) {
  const AxisRanges& f = clear.ranges;
  if (space.is_circle(piece)) [[unlikely]]
    return sweep_circle(space, motion, piece, clear.start);
  const Real tau = clear.tau();
  const Real inside = std::min(tau, Real(0));
  const bool touching = clear.start <= tolerances.touch;
  LastEntry last(space, piece, up);
  Real entry = 0;
  Real exit = 1;
  Real stop = 0;
  Real impact_time = -1;
  Real leaves = 1;  // when some separation is above zero again
  std::size_t impact = ConfigurationSpace::no_axis;
  std::size_t near = ConfigurationSpace::no_axis;
  const auto look_at = [&](std::size_t axis) {
    const Real start = f.start[axis];
    const Real end = f.end[axis];
    if (start < inside && end < inside) return;  // most axes of a piece that is met: they say nothing
    const Real approach = start - end;
    if (start >= 0 && approach > 0 && start > impact_time * approach) {
      impact_time = start / approach;
      impact = axis;
    }
    if (start >= 0 && approach <= 0)
      leaves = -1;  // this axis keeps the piece itself clear
    else if (start < 0 && end > 0)
      leaves = std::min(leaves, start / approach);
    if (start >= tau) {  // end < tau then, or the axis would keep it clear
      const Real time = (start - tau) / approach;
      if (time >= entry) {
        entry = time;
        near = axis;
      }
      last.add(axis, time);
    } else if (end > tau) {
      exit = std::min(exit, (tau - start) / (end - start));
    }
    if (!touching && start > tolerances.stop) stop = std::max(stop, (start - tolerances.stop) / approach);
  };
  for (std::size_t axis = 0; axis < f.count; ++axis) look_at(axis);
  const auto faced = [&](std::size_t axis) {
    return f.start[axis] + (f.end[axis] - f.start[axis]) * stop >= std::min(tau, tolerances.certain);
  };
  const bool is_covered = last.is_covered(faced);
  bool hit = entry < exit;
  if constexpr (covered == Covered::yields) {
    if (hit && is_covered && space.hidden(piece, last.axis(true))) {
      const std::optional<Real> later = sweep_covered(f, tau);
      hit = later.has_value();
      stop = later.value_or(stop);
    }
  }
  stop *= motion.reach;
  const bool missed = impact_time > leaves;
  return {hit && stop <= 1, stop, {last.axis(is_covered), missed ? near : impact, missed, is_covered}};
}

/// What a motion does to an obstacle that may be far away.
[[nodiscard]] inline PieceHit find_hit(const ConfigurationSpace& space, const Motion& motion, PieceIndex piece,
                                       const UpFrame& up = {}) {
  const Clearance clear = clearance(space, motion, piece);
  return clear.clear() ? PieceHit{} : sweep_piece(space, motion, piece, clear, up);
}

/// Whether one axis, by more than rounding, separates a piece from both ends of a straight motion: proof that the
/// motion is clear of it. @param at_begin so much is enough where it begins [m].
[[nodiscard]] inline bool one_axis_separates(const ConfigurationSpace& space, PieceIndex piece, const Vec2& from,
                                             const Vec2& to, Real at_begin = tolerances.certain) {
  const auto separates = [&](std::size_t axis) {
    return space.separation(piece, axis, from) >= at_begin && space.separation(piece, axis, to) >= tolerances.certain;
  };
  for (std::size_t axis = 0; axis < space.axis_count(piece); ++axis)
    if (separates(axis)) return true;
  return space.is_circle(piece) && (separates(axis_along(space.near_circle(piece, from).normal)) ||
                                    separates(axis_along(space.near_circle(piece, to).normal)));
}

/// The axis of largest separation at a position, and that separation.
struct BestAxis {
  std::size_t axis = 0;
  Real separation = 0;
};

[[nodiscard]] PAPERPROOF_COLD inline BestAxis best_axis_of_circle(const ConfigurationSpace& space, PieceIndex piece,
                                                                  const Vec2& p) {
  const geometry::NearCircle near = space.near_circle(piece, p);
  return {axis_along(near.normal), Real(near.separation)};
}

[[nodiscard]] PAPERPROOF_INLINE BestAxis best_axis(const ConfigurationSpace& space, PieceIndex piece, const Vec2& p) {
  PerAxis f;
  Four largest;
  space.for_each_group([&](std::size_t k) PAPERPROOF_INLINE_LAMBDA {
    const Four here = space.shared_x(k) * p.x() + space.shared_y(k) * p.y() - space.offsets(piece, k);
    largest = k == 0 ? here : Four(largest.max(here));
    f.group(k) = here;
  });
  BestAxis best{0, largest.maxCoeff()};
  while (f[best.axis] != best.separation) ++best.axis;
  for (std::size_t axis = space.lanes(); axis < space.axis_count(piece); ++axis) {
    if (space.is_circle(piece)) [[unlikely]]
      return best_axis_of_circle(space, piece, p);
    const Real separation = space.separation(piece, axis, p);
    if (separation > best.separation) best = {axis, separation};
  }
  return best;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
