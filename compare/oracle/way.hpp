/// Places and ways of the octagon as a mover sees them. Every number is a sum of doubles and of products of two
/// doubles, so the relative motion is exact.
#pragma once

#include "oracle/number.hpp"

#include <paperproof/types.hpp>

#include <algorithm>

namespace paperproof::compare::detail {

/// A place in the frame of a mover: position - (from + fraction (to - from)), unrounded. For what stands still the
/// motion is zero.
struct FramePlace {
  Vec2d position{Vec2d::Zero()};
  MoverMotion mover{};
  double fraction = 0;

  template <class Number>
  [[nodiscard]] Point<Number> in(const Convert<Number>& number) const {
    const Point<Number> at = convert(number, position);
    if (!moved()) return at;
    if (fraction == 1) return at - convert(number, mover.to);
    const Point<Number> from = at - convert(number, mover.from);
    if (fraction == 0 || mover.from == mover.to) return from;
    const auto share = [&](const Vec2d& v) {
      return Point<Number>{number.product(fraction, v.x()), number.product(fraction, v.y())};
    };
    return from - (share(mover.to) - share(mover.from));
  }
  [[nodiscard]] bool moved() const noexcept { return mover.from != Vec2d::Zero() || mover.to != Vec2d::Zero(); }
  /// No larger than the lowest bit of the place.
  [[nodiscard]] int unit() const noexcept {
    if (!moved()) return lowest_bit(position);
    int unit = std::min({lowest_bit(position), lowest_bit(mover.from), lowest_bit(mover.to)});
    for (const double x : {mover.from.x(), mover.from.y(), mover.to.x(), mover.to.y()}) {
      unit = std::min(unit, lowest_bit_of_product(fraction, x));
    }
    return unit;
  }
  [[nodiscard]] Vec2d offset() const noexcept {
    return fraction == 1 ? mover.to : Vec2d(mover.from + fraction * (mover.to - mover.from));
  }
  [[nodiscard]] Vec2d rounded() const noexcept { return position - offset(); }
  /// No number on the way to the rounded place is larger.
  [[nodiscard]] double size() const noexcept {
    return position.cwiseAbs().maxCoeff() + 2 * (mover.from.cwiseAbs().maxCoeff() + mover.to.cwiseAbs().maxCoeff());
  }
};

/// A straight way in the frame of a mover; both ends exact.
struct Way {
  FramePlace from;
  FramePlace end;
  Vec2d by_displacement{Vec2d::Zero()};
  bool to_end = false;

  [[nodiscard]] static Way stay(const FramePlace& at) { return to(at, at); }
  /// By a displacement in the world while the mover makes the motion of a whole step.
  [[nodiscard]] static Way by(const FramePlace& from, const Vec2d& displacement) {
    return {from, {}, displacement, false};
  }
  [[nodiscard]] static Way to(const FramePlace& from, const FramePlace& end) {
    return {from, end, Vec2d::Zero(), true};
  }

  template <class Number>
  [[nodiscard]] Point<Number> displacement(const Convert<Number>& number) const {
    if (to_end) return end.in(number)-from.in(number);
    return convert(number, by_displacement) - (convert(number, from.mover.to) - convert(number, from.mover.from));
  }
  [[nodiscard]] Vec2d rounded_displacement() const noexcept {
    if (to_end) return end.rounded() - from.rounded();
    return by_displacement - (from.mover.to - from.mover.from);
  }
  [[nodiscard]] Vec2d rounded_end() const noexcept {
    return to_end ? end.rounded() : Vec2d(from.rounded() + rounded_displacement());
  }
  /// Where the mover is, rounded, after a fraction of the way.
  [[nodiscard]] Vec2d offset_after(double fraction) const noexcept {
    const Vec2d change = to_end ? Vec2d(end.offset() - from.offset()) : Vec2d(from.mover.to - from.mover.from);
    return from.offset() + fraction * change;
  }
  [[nodiscard]] int unit() const noexcept {
    return std::min(from.unit(), to_end ? end.unit() : lowest_bit(by_displacement));
  }
  /// No number on the way to the rounded ends is larger.
  [[nodiscard]] double size() const noexcept {
    return from.size() + (to_end ? end.size() : by_displacement.cwiseAbs().maxCoeff());
  }
};

}  // namespace paperproof::compare::detail
