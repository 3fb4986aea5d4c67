/// Whether two characters of one shape hit each other on straight motions.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/tolerances.hpp>
#include <paperproof/up_frame.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/exact.hpp"

namespace paperproof::crowd {

/// A straight motion from one position to another [m].
struct Leg {
  Vec2d from{Vec2d::Zero()};
  Vec2d to{Vec2d::Zero()};
  bool rounded = false;  ///< An end lies between two corners of a path: its exact position is no double.
};

/// What two legs that are made at the same time do to a pair.
struct PairSweep {
  bool hits = false;  ///< The rest is valid only where it is true.
  double stop = 0;    ///< Where to stop both, as a fraction of the legs.
  double impact = 0;  ///< Time of impact as a fraction of the legs; beyond 1 where they stop just before an impact.
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the second towards the first.
};

/// a - b, where that is exactly a double that the exact predicates accept.
[[nodiscard]] inline std::optional<double> exact_difference(double a, double b) noexcept {
  const double difference = a - b;
  const double b_virtual = difference - a;
  const double a_virtual = difference - b_virtual;
  if ((a - a_virtual) + (-b - b_virtual) != 0) return std::nullopt;
  if (difference != 0 && geometry::without_traces(difference) == 0) return std::nullopt;
  return difference;
}

[[nodiscard]] inline std::optional<Vec2d> exact_difference(const Vec2d& a, const Vec2d& b) noexcept {
  const std::optional<double> x = exact_difference(double{a.x()}, double{b.x()});
  const std::optional<double> y = exact_difference(double{a.y()}, double{b.y()});
  if (!x || !y) return std::nullopt;
  return Vec2d{*x, *y};
}

/// Whether the whole ring, moved by `shift`, lies outside of the line through one edge of the ring. Exact.
template <class Ring>
[[nodiscard]] bool edge_separates(const Ring& ring, std::size_t edge, const Vec2d& shift) noexcept {
  const Vec2d& from = ring[edge];
  const Vec2d& to = ring[(edge + 1) % ring.size()];
  for (const Vec2d& point : ring)
    if (geometry::orientation_sign_of_sum(from, to, std::array{shift, point}) > 0) return false;
  return true;
}

[[nodiscard]] inline double largest(const Vec2d& v) noexcept { return std::max(std::abs(v.x()), std::abs(v.y())); }

/// The narrow phase of two characters of the same shape.
///
/// The first at p and the second at q overlap exactly when p - q is inside the Minkowski sum of the shape and its
/// mirror image. The facets of that sum have the normals of the hull's edges and their negatives, and along each
///
///     f(p, q) = n·(p - q) - width along n
///
/// is the separation. A motion is tested as in the narrow phase of `octagon_sweep`, which explains the lengths in
/// `Tolerances`. Immutable after construction; may be used from any thread.
class PairSpace {
 public:
  explicit PairSpace(const CharacterShape& shape) {
    for (const Vec2d& point : shape.hull()) hull_.push_back(point);
    box_ = {shape.box().lower, shape.box().upper};
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Vec2d edge = hull_[(i + 1) % hull_.size()] - hull_[i];
      const Vec2d outward = Vec2d{edge.y(), -edge.x()} / std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
      add_axis(outward);
      add_axis(-outward);
    }
  }

  /// Whether the pair comes nearer than `hit_distance` [m] on these legs. A pair that begins nearer hits if it comes
  /// nearer still.
  [[nodiscard]] PairSweep sweep(const Leg& first, const Leg& second, double hit_distance,
                                const UpFrame& up) const noexcept {
    // A rounded leg may be so short that its ends are equal: it moves all the same.
    if (first.from == first.to && second.from == second.to && !first.rounded && !second.rounded) return {};
    const Separations s = separations(first, second);
    if (s.start[s.best] >= Tolerances{}.certain) return sweep_apart(s, hit_distance, up);
    if (comes_no_nearer(s) || passes_exactly(first, second)) return {};
    return {.hits = true, .normal = axes_[s.best].normal};
  }
  /// Separation along the best axis [m]; negative: they overlap.
  [[nodiscard]] double separation(const Vec2d& first, const Vec2d& second) const noexcept {
    const Separations s = separations({.from = first, .to = first}, {.from = second, .to = second});
    return s.start[s.best];
  }
  /// Around the shape, relative to its position [m].
  [[nodiscard]] const Box2& box() const noexcept { return box_; }

 private:
  struct Axis {
    Vec2d normal;
    double width;
  };
  static constexpr std::size_t max_axes = 2 * CharacterShape::max_points;
  /// Separations along all axes, before and after two legs [m].
  struct Separations {
    std::array<double, max_axes> start;
    std::array<double, max_axes> end;
    std::size_t best = 0;  ///< Axis of the largest separation before the legs.
    double noise = 0;      ///< Bound of the rounding of a separation [m].
  };

  void add_axis(const Vec2d& normal) noexcept {
    const Vec2d rounded = normal;
    for (const Axis& known : axes_)
      if (known.normal == rounded) return;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec2d& point : hull_) {
      const double along = normal.x() * point.x() + normal.y() * point.y();
      low = std::min(low, along);
      high = std::max(high, along);
    }
    axes_.push_back({rounded, high - low});
  }

  [[nodiscard]] Separations separations(const Leg& first, const Leg& second) const noexcept {
    const Vec2d start = first.from - second.from;
    const Vec2d end = first.to - second.to;
    Separations s;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Axis& axis = axes_[k];
      s.start[k] = (axis.normal.x() * start.x() + axis.normal.y() * start.y()) - axis.width;
      s.end[k] = (axis.normal.x() * end.x() + axis.normal.y() * end.y()) - axis.width;
      if (s.start[k] > s.start[s.best]) s.best = k;
    }
    const double extent = largest(box_.upper - box_.lower);
    const double reach = std::max({largest(first.from), largest(first.to), largest(second.from), largest(second.to)});
    s.noise = 16 * std::numeric_limits<double>::epsilon() * (reach + extent);
    return s;
  }

  /// For a pair that overlaps, or is so near that rounding hides whether it does: true where the separation shrinks
  /// along no axis on which the two may be apart.
  [[nodiscard]] bool comes_no_nearer(const Separations& s) const noexcept {
    constexpr double certain = Tolerances{}.certain;
    const double best = s.start[s.best];
    const bool overlaps = best < -certain;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      if (s.start[k] < std::min(best, -certain)) continue;
      // A pair that may still be apart must not come nearer by rounding either.
      if (!(s.end[k] - s.start[k] >= (overlaps ? -s.noise : s.noise))) return false;
    }
    return true;
  }

  /// Whether one line separates the two at both ends of the legs, by exact arithmetic. False also where an end, or the
  /// distance between the two, is no double.
  [[nodiscard]] bool passes_exactly(const Leg& first, const Leg& second) const noexcept {
    if (first.rounded || second.rounded) return false;
    const std::optional<Vec2d> start = exact_difference(first.from, second.from);
    const std::optional<Vec2d> end = exact_difference(first.to, second.to);
    if (!start || !end) return false;
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      if (edge_separates(hull_, k, *start) && edge_separates(hull_, k, *end)) return true;
      if (edge_separates(hull_, k, -*start) && edge_separates(hull_, k, -*end)) return true;
    }
    return false;
  }

  /// The pair hits when, at some time, all separations are below tau: the latest entry below it comes before the
  /// earliest exit above it. It is then stopped where it enters the larger region below `Tolerances::stop`.
  [[nodiscard]] PairSweep sweep_apart(const Separations& s, double hit_distance, const UpFrame& up) const noexcept {
    constexpr Tolerances tolerances{};
    const double tau = std::min(hit_distance, s.start[s.best] - s.noise);
    const bool touching = s.start[s.best] <= tolerances.touch;
    PairSweep result;
    double entry = -1;
    double exit = 1;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const double start = s.start[k];
      const double end = s.end[k];
      const double approach = start - end;
      if (start >= tau) {
        if (end >= tau) return {};
        const double time = (start - tau) / approach;
        const bool more_upright = std::abs(up.up_of(axes_[k].normal)) > std::abs(up.up_of(result.normal));
        if (time > entry || (time == entry && more_upright)) result.normal = axes_[k].normal;
        entry = std::max(entry, time);
      } else if (end > tau) {
        exit = std::min(exit, (tau - start) / (end - start));
      }
      if (start >= 0 && approach > 0) result.impact = std::max(result.impact, start / approach);
      if (!touching && start > tolerances.stop && approach > 0)
        result.stop = std::max(result.stop, (start - tolerances.stop) / approach);
    }
    result.stop = std::min(result.stop, 1.0);
    result.hits = entry < exit;
    return result;
  }

  FixedVector<Vec2d, CharacterShape::max_points> hull_;
  FixedVector<Axis, max_axes> axes_;
  Box2 box_;
};

}  // namespace paperproof::crowd
