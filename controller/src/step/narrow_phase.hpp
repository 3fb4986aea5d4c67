/// One piece against one straight motion.
///
/// The functions are always inlined: a step is short, and vectors handed over in memory cost as much as the arithmetic
/// (a pair that is written as two numbers and read as one waits for the memory).
#pragma once

#include "geometry/vectors.hpp"
#include "step/configuration_space.hpp"

#include <paperproof/tolerances.hpp>
#include <paperproof/up_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace paperproof::octagon_sweep {

using geometry::length_of;

/// A straight motion of the reference point, with all that is the same for every piece.
template <std::size_t Lanes, class Scalar>
struct Motion {
  Vec2<Scalar> from;
  Vec2<Scalar> displacement;     ///< What is to be travelled [m].
  Scalar length;                 ///< Of `displacement` [m].
  Scalar reach;                  ///< The sweep covers `displacement` times this: it looks a little beyond the end.
  Vec2<Scalar> extended;         ///< That product [m].
  PerAxis<Lanes, Scalar> at;     ///< n·from
  PerAxis<Lanes, Scalar> along;  ///< n·extended
  Vec2<Scalar> lost;             ///< What `from` lost when the offset of the piece's mover was taken from it [m].
  /// The bent one-way surface that was asked for last, and the answer: its pieces come one after the other.
  mutable typename OneWaySurfaces<Scalar>::Index known_surface;
  mutable bool above_known_surface = false;

  [[nodiscard]] Box2<Scalar> box() const noexcept {
    const Vec2<Scalar> to = from + extended;
    return {from.cwiseMin(to), from.cwiseMax(to)};
  }
};

/// @param look how far beyond the end of the motion the sweep looks [m].
template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::always_inline]] inline Motion<Lanes, Scalar> make_motion(
    const ConfigurationSpace<Scalar>& space, const Vec2<Scalar>& from, const Vec2<Scalar>& displacement,
    Scalar look = Tolerances<Scalar>{}.look) noexcept {
  // A shorter motion would make the reach infinite.
  constexpr Scalar shortest = std::numeric_limits<Scalar>::min() * Scalar(1e8);
  const PerAxis<Lanes, Scalar> x = PerAxis<Lanes, Scalar>::Map(space.shared_x().data());
  const PerAxis<Lanes, Scalar> y = PerAxis<Lanes, Scalar>::Map(space.shared_y().data());
  Motion<Lanes, Scalar> motion;
  motion.from = from;
  motion.displacement = displacement;
  motion.length = length_of(displacement);
  // By the larger component: a look up to 1.42 times as far is as good, and nothing waits for a square root.
  const Scalar larger = std::max(std::abs(displacement.x()), std::abs(displacement.y()));
  motion.reach = 1 + look / std::max(larger, shortest);
  motion.extended = displacement * motion.reach;
  motion.at = x * from.x() + y * from.y();
  motion.along = x * motion.extended.x() + y * motion.extended.y();
  motion.lost = Vec2<Scalar>::Zero();
  motion.known_surface = OneWaySurfaces<Scalar>::none;
  return motion;
}

/// What the axes of a piece say together about a motion.
template <class Scalar>
struct Clearance {
  Scalar start;  ///< Largest separation before the motion [m]; below zero: inside.
  Scalar kept;   ///< Largest separation that one axis keeps over the whole motion [m].
  /// Separation before the motion along each shared axis [m].
  std::array<Scalar, ConfigurationSpace<Scalar>::max_shared> shared_starts;

  /// What counts as a hit [m]: coming nearer than `hit`, or than at the start where that is nearer.
  [[nodiscard]] Scalar tau() const noexcept { return std::min(Tolerances<Scalar>{}.hit, start); }
  /// One axis keeps the motion clear.
  [[nodiscard]] bool clear() const noexcept { return kept >= tau(); }
};

/// Separations of a piece at the start and at the end of the extended motion [m], shared axes first.
template <class Scalar>
struct AxisRanges {
  std::size_t count;
  std::array<Scalar, ConfigurationSpace<Scalar>::max_axes> start;
  std::array<Scalar, ConfigurationSpace<Scalar>::max_axes> end;
};

template <std::size_t Lanes, class Scalar>
[[gnu::always_inline]] inline void find_ranges(const ConfigurationSpace<Scalar>& space,
                                               const Motion<Lanes, Scalar>& motion, PieceIndex piece,
                                               const Clearance<Scalar>& clear, AxisRanges<Scalar>& f) noexcept {
  using Shared = PerAxis<Lanes, Scalar>;
  const Shared start = Shared::Map(clear.shared_starts.data());
  Shared::Map(f.start.data()) = start;
  Shared::Map(f.end.data()) = start + motion.along;
  f.count = Lanes;
  for (const OwnAxis<Scalar>& own : space.own_axes(piece)) {
    const Scalar at = own.normal.x() * motion.from.x() + own.normal.y() * motion.from.y() - own.offset;
    f.start[f.count] = at;
    f.end[f.count++] = at + (own.normal.x() * motion.extended.x() + own.normal.y() * motion.extended.y());
  }
}

/// How far away one of the box directions alone, which are the first shared axes, keeps a piece during the whole motion
/// [m]. With most pieces that is further than `hit`: looking at these axes first saves half of a sweep.
template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar kept_by_box(const ConfigurationSpace<Scalar>& space,
                                                            const Motion<Lanes, Scalar>& motion,
                                                            PieceIndex piece) noexcept {
  using BoxAxes = PerAxis<ConfigurationSpace<Scalar>::box_axes, Scalar>;
  const BoxAxes start = BoxAxes::Map(motion.at.data()) - space.box_offsets(piece);
  const BoxAxes least = start.min(start + BoxAxes::Map(motion.along.data()));
  return least.maxCoeff();
}

/// Separation of a circle before the motion, and the one that the axis of this separation keeps over the whole motion.
template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::cold, gnu::noinline]] std::pair<Scalar, Scalar> clearance_of_circle(
    const ConfigurationSpace<Scalar>& space, const Motion<Lanes, Scalar>& motion, PieceIndex piece) noexcept {
  const geometry::NearCircle<Scalar> near = space.near_circle(piece, motion.from);
  const Scalar along = near.normal.x() * motion.extended.x() + near.normal.y() * motion.extended.y();
  return {near.separation, near.separation + std::min(along, Scalar(0))};
}

template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::always_inline]] inline Clearance<Scalar> clearance(const ConfigurationSpace<Scalar>& space,
                                                                     const Motion<Lanes, Scalar>& motion,
                                                                     PieceIndex piece) noexcept {
  using Shared = PerAxis<Lanes, Scalar>;
  const Shared start = motion.at - space.template shared_offsets<Lanes>(piece);
  const Shared least = start.min(start + motion.along);
  Clearance<Scalar> result;
  result.start = start.maxCoeff();
  result.kept = least.maxCoeff();
  Shared::Map(result.shared_starts.data()) = start;
  if (space.info(piece).own_count == 0) return result;
  if (space.is_circle(piece)) [[unlikely]] {
    const auto [start_of_circle, kept] = clearance_of_circle(space, motion, piece);
    result.start = start_of_circle;
    result.kept = std::max(result.kept, kept);
    return result;
  }
  for (const OwnAxis<Scalar>& own : space.own_axes(piece)) {
    const Scalar at = own.normal.x() * motion.from.x() + own.normal.y() * motion.from.y() - own.offset;
    const Scalar end = at + (own.normal.x() * motion.extended.x() + own.normal.y() * motion.extended.y());
    result.start = std::max(result.start, at);
    result.kept = std::max(result.kept, std::min(at, end));
  }
  return result;
}

/// The axes along which a piece is entered last.
struct EntryAxes {
  std::size_t normal;  ///< Its normal is the contact's: below the hit distance.
  std::size_t impact;  ///< Its time is the time of impact: below zero. The number of axes where none is.
  /// The piece itself is missed, by less than the hit distance: `impact` is then the axis along which it comes that
  /// near, covered or not.
  bool missed;
  bool covered;  ///< `normal` is that of a covered facet.
};

/// What a motion does to a piece that it comes near to.
template <class Scalar>
struct PieceHit {
  bool hit;
  Scalar stop;     ///< Where to stop, as a fraction of `displacement`.
  EntryAxes axes;  ///< Valid for a hit.
};

/// Finds the axis that is entered last; of times that are equal but for rounding the normal that points up most wins.
template <class Scalar, class Up>
class LastEntry {
 public:
  LastEntry(const ConfigurationSpace<Scalar>& space, PieceIndex piece, const Up& frame) noexcept
      : space_(space), frame_(frame), piece_(piece), open_{space.axis_count(piece)}, covered_(open_) {}

  void add(std::size_t axis, Scalar time) noexcept {
    Entry& last = space_.covered(piece_, axis) ? covered_ : open_;
    if (!(time > last.time + same) && !(time >= last.time - same && up(axis) > up(last.axis))) return;
    last = {axis, time};
  }

  /// A facet that other obstacles cover gives no contact normal unless there is no other, or no other that is faced
  /// where the motion is stopped: what covers it may be let through, or leave less of it open than counts.
  /// @param faced whether the piece is still apart there along an axis.
  template <class Faced>
  [[nodiscard]] bool is_covered(const Faced& faced) const noexcept {
    return open_.time < 0 || (covered_.time >= 0 && !faced(open_.axis));
  }
  [[nodiscard]] std::size_t axis(bool is_covered) const noexcept { return is_covered ? covered_.axis : open_.axis; }

 private:
  struct Entry {
    std::size_t axis;
    Scalar time = -1;  ///< Below zero: there is none, and the axis is their number.
  };
  /// Times closer than this are one corner, met with both facets at once.
  static constexpr Scalar same = std::numeric_limits<Scalar>::epsilon() * 64;
  [[nodiscard]] Scalar up(std::size_t axis) const noexcept { return frame_.up_of(space_.normal(piece_, axis)); }

  const ConfigurationSpace<Scalar>& space_;
  const Up& frame_;
  PieceIndex piece_;
  Entry open_;
  Entry covered_;
};

/// Of the distances at which an uncovered facet is hit, and stops: see `sweep_covered`.
template <class Scalar>
inline constexpr Scalar covered_share = Scalar(0.5);

/// When all separations are below a level for the first time; nothing where they never are together.
template <class Scalar>
[[nodiscard]] std::optional<Scalar> entry_below(const AxisRanges<Scalar>& f, Scalar level) noexcept {
  Scalar entry = 0;
  Scalar exit = 1;
  for (std::size_t axis = 0; axis < f.count; ++axis) {
    const Scalar start = f.start[axis];
    const Scalar end = f.end[axis];
    if (start >= level && end >= level) return std::nullopt;
    if (start >= level)
      entry = std::max(entry, (start - level) / (start - end));
    else if (end > level)
      exit = std::min(exit, (level - start) / (end - start));
  }
  return entry < exit ? std::optional(entry) : std::nullopt;
}

/// Where a motion is stopped that enters by a hidden facet alone; nothing where it passes.
///
/// Such a facet lies inside of what covers it. Near it what covers it is nearer than its distance to the facet, which
/// is up to 1.42 times the separation: where two facets that stand at right angles meet. Were both to stop at the same
/// separation, then a motion that just misses the one might still be stopped by the other, and by a normal that the
/// surface has nowhere: who flies up a slope and over its crest would lose its speed to the side of the next tile. So
/// the hidden facet stops later, and only where nothing stops the motion that covers it.
/// @param tau see `Clearance`.
template <class Scalar>
[[nodiscard, gnu::cold, gnu::noinline]] std::optional<Scalar> sweep_covered(const AxisRanges<Scalar>& f,
                                                                            Scalar tau) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (!entry_below(f, std::min(tau, tolerances.hit * covered_share<Scalar>))) return std::nullopt;
  const Scalar start = *std::max_element(f.start.begin(), f.start.begin() + f.count);
  if (start <= tolerances.touch * covered_share<Scalar>) return Scalar(0);
  return entry_below(f, tolerances.stop * covered_share<Scalar>);
}

/// A circle is entered along the tangent that it has where the motion is stopped. From each slide along a tangent it is
/// a little further away: where that counted as touching up to the whole gap of a touch, a walk over a circle of 100 km
/// would be in the air in one step of four.
template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::cold, gnu::noinline]] PieceHit<Scalar> sweep_circle(const ConfigurationSpace<Scalar>& space,
                                                                      const Motion<Lanes, Scalar>& motion,
                                                                      PieceIndex piece, Scalar start) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const auto approach = [&](Scalar level) {
    return geometry::approach<Scalar>(space.hull(), motion.from, motion.extended, space.scenery().circle(piece), level);
  };
  const auto near = approach(std::min(tolerances.hit, start));
  if (!near) return {false, 0, {}};
  geometry::Approach<Scalar> stop{0, space.near_circle(piece, motion.from)};
  const Scalar touching = tolerances.stop + (tolerances.touch - tolerances.stop) / 4;
  if (start > touching) stop = approach(tolerances.stop).value_or(*near);
  stop.time *= motion.reach;
  const auto impact = start >= 0 ? approach(Scalar(0)) : std::nullopt;
  const bool missed = start >= 0 && !impact;
  const std::size_t no_axis = space.axis_count(piece);
  return {stop.time <= 1,
          stop.time,
          {space.axis_of(stop.there),
           impact   ? space.axis_of(impact->there)
           : missed ? space.axis_of(near->there)
                    : no_axis,
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
template <Covered covered = Covered::yields, std::size_t Lanes, class Scalar, class Up = Upright<Scalar>>
[[nodiscard, gnu::always_inline]] inline PieceHit<Scalar> sweep_piece(const ConfigurationSpace<Scalar>& space,
                                                                      const Motion<Lanes, Scalar>& motion,
                                                                      PieceIndex piece, const Clearance<Scalar>& clear,
                                                                      const Up& up = {}) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  AxisRanges<Scalar> f;
  find_ranges(space, motion, piece, clear, f);
  if (f.count > Lanes && space.is_circle(piece)) [[unlikely]]
    return sweep_circle(space, motion, piece, clear.start);
  const Scalar tau = clear.tau();
  const Scalar inside = std::min(tau, Scalar(0));
  const bool touching = clear.start <= tolerances.touch;
  LastEntry<Scalar, Up> last(space, piece, up);
  Scalar entry = 0;
  Scalar exit = 1;
  Scalar stop = 0;
  Scalar impact_time = -1;
  Scalar leaves = 1;  // when some separation is above zero again
  std::size_t impact = f.count;
  std::size_t near = f.count;
  const auto look_at = [&](std::size_t axis) {
    const Scalar start = f.start[axis];
    const Scalar end = f.end[axis];
    if (start < inside && end < inside) return;  // most axes of a piece that is met: they say nothing
    const Scalar approach = start - end;
    if (start >= 0 && approach > 0 && start > impact_time * approach) {
      impact_time = start / approach;
      impact = axis;
    }
    if (start >= 0 && approach <= 0)
      leaves = -1;  // this axis keeps the piece itself clear
    else if (start < 0 && end > 0)
      leaves = std::min(leaves, start / approach);
    if (start >= tau) {  // end < tau then, or the axis would keep it clear
      const Scalar time = (start - tau) / approach;
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
  for (std::size_t axis = 0; axis < Lanes; ++axis) look_at(axis);
  for (std::size_t axis = Lanes; axis < f.count; ++axis) look_at(axis);
  const auto faced = [&](std::size_t axis) {
    return f.start[axis] + (f.end[axis] - f.start[axis]) * stop >= std::min(tau, tolerances.certain);
  };
  const bool is_covered = last.is_covered(faced);
  bool hit = entry < exit;
  if constexpr (covered == Covered::yields) {
    if (hit && is_covered && space.hidden(piece, last.axis(true))) {
      const std::optional<Scalar> later = sweep_covered(f, tau);
      hit = later.has_value();
      stop = later.value_or(stop);
    }
  }
  stop *= motion.reach;
  const bool missed = impact_time > leaves;
  return {hit && stop <= 1, stop, {last.axis(is_covered), missed ? near : impact, missed, is_covered}};
}

/// Whether one axis, by more than rounding, separates a piece from both ends of a straight motion: proof that the
/// motion is clear of it.
template <class Scalar>
[[nodiscard]] bool one_axis_separates(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                      const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept {
  constexpr Scalar certain = Tolerances<Scalar>{}.certain;
  const auto separates = [&](std::size_t axis) {
    return space.separation(piece, axis, from) >= certain && space.separation(piece, axis, to) >= certain;
  };
  for (std::size_t axis = 0; axis < space.axis_count(piece); ++axis)
    if (separates(axis)) return true;
  return space.is_circle(piece) && (separates(space.axis_of(space.near_circle(piece, from))) ||
                                    separates(space.axis_of(space.near_circle(piece, to))));
}

/// The axis of largest separation at a position, and that separation.
template <class Scalar>
struct BestAxis {
  std::size_t axis = 0;
  Scalar separation = 0;
};

template <class Scalar>
[[nodiscard, gnu::cold, gnu::noinline]] BestAxis<Scalar> best_axis_of_circle(const ConfigurationSpace<Scalar>& space,
                                                                             PieceIndex piece,
                                                                             const Vec2<Scalar>& p) noexcept {
  const geometry::NearCircle<Scalar> near = space.near_circle(piece, p);
  return {space.axis_of(near), near.separation};
}

template <std::size_t Lanes, class Scalar>
[[nodiscard, gnu::always_inline]] inline BestAxis<Scalar> best_axis(const ConfigurationSpace<Scalar>& space,
                                                                    PieceIndex piece, const Vec2<Scalar>& p) noexcept {
  using Shared = PerAxis<Lanes, Scalar>;
  const Shared f = Shared::Map(space.shared_x().data()) * p.x() + Shared::Map(space.shared_y().data()) * p.y() -
                   space.template shared_offsets<Lanes>(piece);
  BestAxis<Scalar> best{0, f.maxCoeff()};
  while (f[static_cast<Eigen::Index>(best.axis)] != best.separation) ++best.axis;
  for (std::size_t axis = Lanes; axis < space.axis_count(piece); ++axis) {
    if (space.is_circle(piece)) [[unlikely]]
      return best_axis_of_circle(space, piece, p);
    const Scalar separation = space.separation(piece, axis, p);
    if (separation > best.separation) best = {axis, separation};
  }
  return best;
}

}  // namespace paperproof::octagon_sweep
