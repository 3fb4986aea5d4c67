/// Where and when exactly a contact happens: computed once per contact, from differences of coordinates, so that it
/// stays accurate far from the origin.
#pragma once

#include "step/narrow_phase.hpp"

namespace paperproof::octagon_sweep {

/// Separation along an axis [m], from differences: relative accuracy of a few ulp also where the offset of the axis has
/// lost its last digits.
template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar accurate_separation(const ConfigurationSpace<Scalar>& space,
                                                                    PieceIndex piece, std::size_t axis,
                                                                    const Vec2<Scalar>& p) noexcept {
  const Vec2<Scalar> n = space.normal(piece, axis);
  Scalar nearest = std::numeric_limits<Scalar>::infinity();
  for (const Vec2<Scalar>& v : space.scenery().vertices_of(piece))
    nearest = std::min(nearest, n.x() * (p.x() - v.x()) + n.y() * (p.y() - v.y()));
  return nearest + space.octagon_face(piece, axis).low;
}

/// Time of impact of a motion with a piece it hits, as a fraction of the motion, in [0, 1]: when the separation along
/// the axis that is entered last becomes zero; or, where the piece itself is missed, when it comes within `hit`.
template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar time_of_impact(const ConfigurationSpace<Scalar>& space,
                                                               const Vec2<Scalar>& from,
                                                               const Vec2<Scalar>& displacement, PieceIndex piece,
                                                               const EntryAxes& axes) noexcept {
  if (axes.impact == space.axis_count(piece)) return 0;  // inside from the start
  const Scalar level = axes.missed ? Tolerances<Scalar>{}.hit : Scalar(0);
  const Vec2<Scalar> n = space.normal(piece, axes.impact);
  const Scalar approach = -(n.x() * displacement.x() + n.y() * displacement.y());
  return std::clamp((accurate_separation(space, piece, axes.impact, from) - level) / approach, Scalar(0), Scalar(1));
}

/// Where a contact is, and the gap there.
template <class Scalar>
struct ContactPlace {
  Vec2<Scalar> point;  ///< The middle of what octagon and piece have face to face, on the piece [m].
  Scalar separation;   ///< [m]
};

template <class Scalar>
[[nodiscard, gnu::always_inline]] inline ContactPlace<Scalar> contact_place(const ConfigurationSpace<Scalar>& space,
                                                                            PieceIndex piece, std::size_t axis,
                                                                            const Vec2<Scalar>& p) noexcept {
  constexpr Scalar flat = Tolerances<Scalar>{}.hit;  // points this close to the highest belong to the face
  const Vec2<Scalar> n = space.normal(piece, axis);
  // Relative to the octagon, so that nothing cancels far from the origin.
  Scalar high = -std::numeric_limits<Scalar>::infinity();
  Scalar from = 0;
  Scalar to = 0;
  for (const Vec2<Scalar>& v : space.scenery().vertices_of(piece)) {
    const Scalar x = v.x() - p.x();
    const Scalar y = v.y() - p.y();
    const Scalar height = n.x() * x + n.y() * y;
    const Scalar place = n.x() * y - n.y() * x;
    if (height > high + flat) {
      high = height;
      from = to = place;
    }
    if (height < high - flat) continue;
    high = std::max(high, height);
    from = std::min(from, place);
    to = std::max(to, place);
  }
  const OctagonFace<Scalar>& face = space.octagon_face(piece, axis);
  // Corner to corner they have nothing face to face, by less than a contact's gap.
  const Scalar middle = std::clamp((std::max(from, face.from) + std::min(to, face.to)) / 2, from, to);
  return {{p.x() + n.x() * high - n.y() * middle, p.y() + n.y() * high + n.x() * middle}, face.low - high};
}

}  // namespace paperproof::octagon_sweep
