/// What a piece hides from a place: what no straight motion from there reaches without meeting the piece.
///
/// In configuration space a piece is convex, and so is its shadow: what lies behind those of its facets that face the
/// place, between the two tangents from there.
#pragma once

#include "step/narrow_phase.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

[[nodiscard]] inline Vec2 unit(const Vec2& v) {
  const Real length = length_of(v);
  return length > 0 ? Vec2(v / length) : v;
}

/// Unit normals of the two tangents, away from the piece; zero where the piece is no further than `width` away in all
/// its corners.
struct Tangents {
  Vec2 left;
  Vec2 right;
};

/// Grows with the angle by which a vector is left of another, up to a quarter of a turn to either side: from -1 to 1.
[[nodiscard]] inline Real leftward(const Vec2& ahead, const Vec2& v) {
  const Real aside = ahead.x() * v.y() - ahead.y() * v.x();
  const Real far = std::abs(aside) + std::max(Real(0), ahead.x() * v.x() + ahead.y() * v.y());
  return far > 0 ? aside / far : Real(0);
}

/// @param from the place, as the piece sees it; not deeper in the piece than rounding.
/// @param facing normal of the axis that separates the two best there. No corner of the piece is behind it, so that
///   its corners are seen within half a turn.
/// @param width that the tangents keep from the piece [m].
[[nodiscard]] inline Tangents tangents_from(const ConfigurationSpace& space, PieceIndex piece, const Vec2& from,
                                            const Vec2& facing, Real width) {
  const Vec2 ahead = -facing;
  Vec2 left = Vec2::Zero();
  Vec2 right = Vec2::Zero();
  Real leftmost = -2;
  Real rightmost = 2;
  const bool is_circle = space.is_circle(piece);
  if (is_circle) width += space.circle(piece).radius;
  for (const Vec2d& v : space.vertices_of(piece)) {
    for (const Vec2d& o : space.hull()) {
      const Vec2 to = Vec2(v) - from - Vec2(o);
      const Real length = length_of(to);
      if (!(length > width) && !is_circle) continue;
      const Real sine = std::min(width / length, Real(1));
      // Of a small width the cosine is 1.
      const Vec2 past = is_circle ? Vec2(to * std::sqrt((1 - sine) * (1 + sine))) : to;
      const Vec2 aside = Vec2{-to.y(), to.x()} * sine;
      const Vec2 passing_left = past + aside;
      const Vec2 passing_right = past - aside;
      if (const Real place = leftward(ahead, passing_left); place > leftmost) {
        leftmost = place;
        left = passing_left;
      }
      if (const Real place = leftward(ahead, passing_right); place < rightmost) {
        rightmost = place;
        right = passing_right;
      }
    }
  }
  return {unit({-left.y(), left.x()}), unit({right.y(), -right.x()})};
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
