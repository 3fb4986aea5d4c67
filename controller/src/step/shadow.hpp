/// What a piece hides from a place: what no straight motion from there reaches without meeting the piece.
///
/// In configuration space a piece is convex, and so is its shadow: what lies behind those of its facets that face the
/// place, between the two tangents from there.
#pragma once

#include "step/narrow_phase.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::octagon_sweep {

/// Unit normals of the two tangents, away from the piece; zero where the piece is no further than `width` away in all
/// its corners.
template <class Scalar>
struct Tangents {
  Vec2<Scalar> left;
  Vec2<Scalar> right;
};

/// Grows with the angle by which a vector is left of another, up to a quarter of a turn to either side: from -1 to 1.
template <class Scalar>
[[nodiscard]] inline Scalar leftward(const Vec2<Scalar>& ahead, const Vec2<Scalar>& v) noexcept {
  const Scalar aside = ahead.x() * v.y() - ahead.y() * v.x();
  const Scalar far = std::abs(aside) + std::max(Scalar(0), ahead.x() * v.x() + ahead.y() * v.y());
  return far > 0 ? aside / far : Scalar(0);
}

/// @param from the place, as the piece sees it; not deeper in the piece than rounding.
/// @param facing normal of the axis that separates the two best there. No corner of the piece is behind it, so that
///   its corners are seen within half a turn.
/// @param width that the tangents keep from the piece [m].
template <class Scalar>
[[nodiscard]] Tangents<Scalar> tangents_from(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                             const Vec2<Scalar>& from, const Vec2<Scalar>& facing,
                                             Scalar width) noexcept {
  const Vec2<Scalar> ahead = -facing;
  Vec2<Scalar> left = Vec2<Scalar>::Zero();
  Vec2<Scalar> right = Vec2<Scalar>::Zero();
  Scalar leftmost = -2;
  Scalar rightmost = 2;
  const bool is_circle = space.is_circle(piece);
  if (is_circle) width += space.scenery().circle(piece).radius;
  for (const Vec2<Scalar>& v : space.scenery().vertices_of(piece)) {
    for (const Vec2<Scalar>& o : space.hull()) {
      const Vec2<Scalar> to = v - from - o;
      const Scalar length = length_of(to);
      if (!(length > width) && !is_circle) continue;
      const Scalar sine = std::min(width / length, Scalar(1));
      // Of a small width the cosine is 1.
      const Vec2<Scalar> past = is_circle ? Vec2<Scalar>(to * std::sqrt((1 - sine) * (1 + sine))) : to;
      const Vec2<Scalar> aside = Vec2<Scalar>{-to.y(), to.x()} * sine;
      const Vec2<Scalar> passing_left = past + aside;
      const Vec2<Scalar> passing_right = past - aside;
      if (const Scalar place = leftward(ahead, passing_left); place > leftmost) {
        leftmost = place;
        left = passing_left;
      }
      if (const Scalar place = leftward(ahead, passing_right); place < rightmost) {
        rightmost = place;
        right = passing_right;
      }
    }
  }
  const auto unit = [](const Vec2<Scalar>& v) {
    const Scalar length = length_of(v);
    return length > 0 ? Vec2<Scalar>(v / length) : v;
  };
  return {unit({-left.y(), left.x()}), unit({right.y(), -right.x()})};
}

}  // namespace paperproof::octagon_sweep
