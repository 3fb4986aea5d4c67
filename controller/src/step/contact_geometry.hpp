/// Where and when exactly a contact happens: computed once per contact, from differences of coordinates, so that it
/// stays accurate far from the origin.
#pragma once

#include "inlining.hpp"
#include "step/narrow_phase.hpp"

#include <paperproof/report.hpp>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// What of a piece faces the octagon along an axis with normal n: its highest points along n.
struct PieceFace {
  Real high;  ///< max n·(v - p) [m]
  Real from;  ///< Where they begin along (-n.y, n.x), relative to p [m],
  Real to;    ///< and where they end [m]; equal to `from` for a corner.
};

/// Along a box direction, of a rectangle: three of four contacts.
[[nodiscard]] PAPERPROOF_INLINE PieceFace rectangle_face(const Box2& box, const Vec2& n, const Vec2& p) {
  const Vec2& corner = n.x() + n.y() > 0 ? box.upper : box.lower;
  const bool upright = n.x() == 0;
  const Real high = upright ? n.y() * (corner.y() - p.y()) : n.x() * (corner.x() - p.x());
  const Real a = upright ? -n.y() * (box.lower.x() - p.x()) : n.x() * (box.lower.y() - p.y());
  const Real b = upright ? -n.y() * (box.upper.x() - p.x()) : n.x() * (box.upper.y() - p.y());
  return {high, std::min(a, b), std::max(a, b)};
}

/// From differences of coordinates: relative accuracy of a few ulp, also where the offset of the axis has lost its last
/// digits far from the origin. @param n normal of the axis.
[[nodiscard]] PAPERPROOF_INLINE PieceFace piece_face(const ConfigurationSpace& space, PieceIndex piece,
                                                     std::size_t axis, const Vec2& n, const Vec2& p) {
  constexpr Real flat = tolerances.hit;  // points this close to the highest belong to the face
  if (axis < 4 && space.info(piece).source.is_rectangle()) return rectangle_face(space.info(piece).box, n, p);
  PieceFace face{-std::numeric_limits<Real>::infinity(), 0, 0};
  for (const Vec2d& v : space.vertices_of(piece)) {
    const Real x = v.x() - p.x();
    const Real y = v.y() - p.y();
    const Real height = n.x() * x + n.y() * y;
    const Real place = n.x() * y - n.y() * x;
    if (height > face.high + flat) face = {height, place, place};
    if (height < face.high - flat) continue;
    face = {std::max(face.high, height), std::min(face.from, place), std::max(face.to, place)};
  }
  return face;
}

/// Separation from a piece along any direction, from differences of coordinates [m].
[[nodiscard]] PAPERPROOF_NOT_INLINE inline Real separation_along(const ConfigurationSpace& space, PieceIndex piece,
                                                                 Vec2 n, Vec2 p) {
  const Real low = space.face_along(n).low;
  if (space.is_circle(piece)) {
    const Circle circle = space.circle(piece);
    const Vec2 centre = circle.centre - p;
    return low - (n.x() * centre.x() + n.y() * centre.y()) - circle.radius;
  }
  // `piece_face` has the highest point as well. One more call of it costs a walk 1 % (g++ 12 inlines otherwise then).
  Real least = std::numeric_limits<Real>::infinity();
  for (const Vec2d& v : space.vertices_of(piece))
    least =
        std::min(least, low - (n.x() * static_cast<Real>(v.x() - p.x()) + n.y() * static_cast<Real>(v.y() - p.y())));
  return least;
}

/// Time of impact of a motion with a piece it hits, as a fraction of the motion, in [0, 1]: when the separation along
/// the axis that is entered last becomes zero; or, where the piece itself is missed, when it comes within `hit`.
[[nodiscard]] PAPERPROOF_INLINE Real time_of_impact(const ConfigurationSpace& space, const Vec2& from,
                                                    const Vec2& displacement, PieceIndex piece, const EntryAxes& axes) {
  if (axes.impact == ConfigurationSpace::no_axis) return 0;  // inside from the start
  const Real level = axes.missed ? tolerances.hit : Real(0);
  const Vec2 n = space.normal(piece, axes.impact);
  const Real approach = -(n.x() * displacement.x() + n.y() * displacement.y());
  Real separation = 0;
  if (is_direction(axes.impact)) [[unlikely]]
    separation = separation_along(space, piece, n, from);
  else
    separation = space.octagon_face(piece, axes.impact).low - piece_face(space, piece, axes.impact, n, from).high;
  return std::clamp((separation - level) / approach, Real(0), Real(1));
}

/// Where a contact is, and the gap there.
struct ContactPlace {
  Vec2 point;       ///< The middle of what octagon and piece have face to face, on the piece [m].
  Real separation;  ///< [m]
};

/// The point of a circle's arc that faces the octagon.
[[nodiscard]] PAPERPROOF_COLD inline ContactPlace place_on_arc(const ConfigurationSpace& space, PieceIndex piece,
                                                               Vec2 n, Vec2 p) {
  const Circle circle = space.circle(piece);
  return {circle.centre + n * circle.radius, separation_along(space, piece, n, p)};
}

/// @param n normal of the axis.
[[nodiscard]] PAPERPROOF_INLINE ContactPlace contact_place(const ConfigurationSpace& space, PieceIndex piece,
                                                           std::size_t axis, const Vec2& n, const Vec2& p) {
  if (is_direction(axis)) [[unlikely]]
    return place_on_arc(space, piece, n, p);
  const PieceFace there = piece_face(space, piece, axis, n, p);
  const OctagonFace& face = space.octagon_face(piece, axis);
  // Corner to corner they have nothing face to face, by less than a contact's gap.
  const Real middle =
      std::clamp((std::max(there.from, face.from) + std::min(there.to, face.to)) / 2, there.from, there.to);
  return {{p.x() + n.x() * there.high - n.y() * middle, p.y() + n.y() * there.high + n.x() * middle},
          face.low - there.high};
}

/// @param at as the piece sees it. @param offset of the mover of the piece.
[[nodiscard]] PAPERPROOF_INLINE Contact contact_with(const ConfigurationSpace& space, const UpFrame& up,
                                                     PieceIndex piece, std::size_t axis, const Vec2& at,
                                                     const Vec2& offset, Real fraction) {
  const Vec2 normal = space.normal(piece, axis);
  const ContactPlace place = contact_place(space, piece, axis, normal, at);
  return {.collider = space.info(piece).source.collider,
          .point = place.point + offset,
          .normal = normal,
          .fraction = fraction,
          .separation = place.separation,
          .side = up.side_of(normal)};
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
