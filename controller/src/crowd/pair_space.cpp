#include "crowd/pair_space.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/exact.hpp"

namespace paperproof::crowd {
namespace {

/// a - b where that is a double, as the exact predicates need it.
std::optional<double> exact_difference(double a, double b) noexcept {
  const double difference = a - b;
  const double b_virtual = difference - a;
  const double a_virtual = difference - b_virtual;
  if ((a - a_virtual) + (-b - b_virtual) != 0) return std::nullopt;
  if (difference != 0 && geometry::without_traces(difference) == 0) return std::nullopt;
  return difference;
}

template <class Scalar>
std::optional<Vec2d> exact_difference(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  const std::optional<double> x = exact_difference(double{a.x()}, double{b.x()});
  const std::optional<double> y = exact_difference(double{a.y()}, double{b.y()});
  if (!x || !y) return std::nullopt;
  return Vec2d{*x, *y};
}

/// Whether the line of an edge of the ring at the origin has the whole ring at `shift` on its outside, exactly.
template <class Ring>
bool edge_separates(const Ring& ring, std::size_t edge, const Vec2d& shift) noexcept {
  const Vec2d& from = ring[edge];
  const Vec2d& to = ring[(edge + 1) % ring.size()];
  for (const Vec2d& point : ring)
    if (geometry::orientation_sign_of_offset(from, to, shift, point) > 0) return false;
  return true;
}

template <class Scalar>
Scalar largest(const Vec2<Scalar>& v) noexcept {
  return std::max(std::abs(v.x()), std::abs(v.y()));
}

}  // namespace

template <class Scalar>
PairSpace<Scalar>::PairSpace(const CharacterShape& shape) {
  for (const Vec2d& point : shape.hull()) {
    // As it runs: in `Scalar`.
    hull_.push_back(point.template cast<Scalar>().template cast<double>());
  }
  box_ = {hull_[0].template cast<Scalar>(), hull_[0].template cast<Scalar>()};
  for (const Vec2d& point : hull_) box_ = box_.merged({point.template cast<Scalar>(), point.template cast<Scalar>()});
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Vec2d edge = hull_[(i + 1) % hull_.size()] - hull_[i];
    const Vec2d outward = Vec2d{edge.y(), -edge.x()} / std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
    add_axis(outward);
    add_axis(-outward);
  }
}

template <class Scalar>
void PairSpace<Scalar>::add_axis(const Vec2d& normal) noexcept {
  const Vec2<Scalar> rounded = normal.template cast<Scalar>();
  for (const Axis& known : axes_)
    if (known.normal == rounded) return;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2d& point : hull_) {
    const double along = normal.x() * point.x() + normal.y() * point.y();
    low = std::min(low, along);
    high = std::max(high, along);
  }
  axes_.push_back({rounded, static_cast<Scalar>(high - low)});
}

template <class Scalar>
typename PairSpace<Scalar>::Ranges PairSpace<Scalar>::ranges(const Leg<Scalar>& first,
                                                             const Leg<Scalar>& second) const noexcept {
  const Vec2<Scalar> start = first.from - second.from;
  const Vec2<Scalar> end = first.to - second.to;
  Ranges f;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const Axis& axis = axes_[k];
    f.start[k] = (axis.normal.x() * start.x() + axis.normal.y() * start.y()) - axis.width;
    f.end[k] = (axis.normal.x() * end.x() + axis.normal.y() * end.y()) - axis.width;
    if (f.start[k] > f.start[f.best]) f.best = k;
  }
  const Scalar extent = largest<Scalar>(box_.upper - box_.lower);
  const Scalar reach = std::max({largest(first.from), largest(first.to), largest(second.from), largest(second.to)});
  f.noise = 16 * std::numeric_limits<Scalar>::epsilon() * (reach + extent);
  return f;
}

template <class Scalar>
Scalar PairSpace<Scalar>::separation(const Vec2<Scalar>& first, const Vec2<Scalar>& second) const noexcept {
  const Ranges f = ranges({.from = first, .to = first}, {.from = second, .to = second});
  return f.start[f.best];
}

/// Of a pair that overlaps, or is nearer than rounding can tell: no axis along which it may be apart loses anything.
template <class Scalar>
bool PairSpace<Scalar>::gets_no_nearer(const Ranges& f) const noexcept {
  constexpr Scalar certain = Tolerances<Scalar>{}.certain;
  const Scalar best = f.start[f.best];
  const bool overlaps = best < -certain;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (f.start[k] < std::min(best, -certain)) continue;
    // What overlaps already loses nothing by rounding; what may still be apart could.
    if (!(f.end[k] - f.start[k] >= (overlaps ? -f.noise : f.noise))) return false;
  }
  return true;
}

/// Whether one line separates the two at both ends of a motion, exactly. False also where an end or their distance is
/// no double.
template <class Scalar>
bool PairSpace<Scalar>::certified(const Leg<Scalar>& first, const Leg<Scalar>& second) const noexcept {
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

template <class Scalar>
PairSweep<Scalar> PairSpace<Scalar>::sweep(const Leg<Scalar>& first, const Leg<Scalar>& second,
                                           Scalar least) const noexcept {
  if (first.from == first.to && second.from == second.to) return {};
  const Ranges f = ranges(first, second);
  if (f.start[f.best] >= Tolerances<Scalar>{}.certain) return sweep_apart(f, least);
  if (gets_no_nearer(f) || certified(first, second)) return {};
  return {.meets = true, .normal = axes_[f.best].normal};
}

/// The pair meets when, at some time, all separations are below tau: the latest entry below it comes before the
/// earliest exit above it. It is then stopped where it enters the larger region below `stop`.
template <class Scalar>
PairSweep<Scalar> PairSpace<Scalar>::sweep_apart(const Ranges& f, Scalar least) const noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const Scalar tau = std::min(least, f.start[f.best] - f.noise);
  const bool touching = f.start[f.best] <= tolerances.touch;
  PairSweep<Scalar> result;
  Scalar entry = -1;
  Scalar exit = 1;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const Scalar start = f.start[k];
    const Scalar end = f.end[k];
    const Scalar approach = start - end;
    if (start >= tau) {
      if (end >= tau) return {};
      const Scalar time = (start - tau) / approach;
      const bool more_upright = std::abs(axes_[k].normal.y()) > std::abs(result.normal.y());
      if (time > entry || (time == entry && more_upright)) result.normal = axes_[k].normal;
      entry = std::max(entry, time);
    } else if (end > tau) {
      exit = std::min(exit, (tau - start) / (end - start));
    }
    if (start >= 0 && approach > 0) result.impact = std::max(result.impact, start / approach);
    if (!touching && start > tolerances.stop && approach > 0)
      result.stop = std::max(result.stop, (start - tolerances.stop) / approach);
  }
  result.stop = std::min(result.stop, Scalar(1));
  result.meets = entry < exit;
  return result;
}

template class PairSpace<float>;
template class PairSpace<double>;

}  // namespace paperproof::crowd
