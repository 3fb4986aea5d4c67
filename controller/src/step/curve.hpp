/// A line or an arc on which a position is searched, and a spot on it.
#pragma once

#include "step/real.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// A line, or an arc of at most half a turn.
struct Curve {
  Vec2 middle;             ///< The foot of a line, from which places are counted [m]; the centre of an arc.
  Vec2 along;              ///< Unit vector towards growing places; of an arc where the place is 0.
  Vec2 out{Vec2::Zero()};  ///< Unit vector from the centre of an arc to its place 0.
  Real radius = 0;         ///< Of an arc [m]. Its places are the tangents of half the angles.

  [[nodiscard]] bool is_arc() const { return radius > 0; }
  [[nodiscard]] Vec2 at(Real place) const {
    if (!is_arc()) return middle + along * place;
    const Real square = place * place;
    return middle + (out * (1 - square) + along * (2 * place)) * (radius / (1 + square));
  }
  /// The place on an arc in a direction from its centre, less than half a turn from `out`.
  [[nodiscard]] Real place_towards(const Vec2& direction) const {
    return dot(direction, along) / (1 + dot(direction, out));
  }
  /// One unit of place is at most so long [m].
  [[nodiscard]] Real pace() const { return is_arc() ? 2 * radius : Real(1); }
};

/// A place on a curve, and which way one goes along it.
struct Spot {
  /// A line that an edge of a region leaves by less per metre does not leave it there.
  static constexpr Real parallel = std::numeric_limits<Real>::epsilon() * 64;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  Spot(const Curve& on, Real begin, Real last, Real forth)
      : curve(on), place(begin), end(last), direction(forth), position(on.at(begin)) {}

  const Curve& curve;
  Real place;
  Real end;        ///< Where the search ends.
  Real direction;  ///< 1 or -1.
  Vec2 position;

  [[nodiscard]] bool is_beyond_end() const { return place * direction > end * direction; }
  [[nodiscard]] Vec2 after(Real reach) const { return curve.at(place + direction * reach); }
  void go(Real reach) {
    place += direction * reach;
    position = curve.at(place);
  }
  /// How far it goes until it is by `depth` > 0 further along a unit vector; infinity if it never is.
  [[nodiscard]] Real until(const Vec2& normal, Real depth) const {
    const Real turned = dot(normal, curve.along);
    if (!curve.is_arc()) return turned * direction > parallel ? depth / (turned * direction) : infinity;
    // The height over the centre is reached at the roots of a t^2 - 2 b t + c, and is less where that is positive.
    const Real height = dot(normal, Vec2(position - curve.middle)) + depth;
    if (!(height < curve.radius)) return infinity;
    const Real out = curve.radius * dot(normal, curve.out);
    const Real b = curve.radius * turned;
    const Real larger = b + std::copysign(std::sqrt((curve.radius - height) * (curve.radius + height)), b);
    Real least = infinity;
    for (const Real root : {larger / (height + out), (height - out) / larger})
      if (const Real reach = (root - place) * direction; reach > 0) least = std::min(least, reach);
    return least;
  }
};

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
