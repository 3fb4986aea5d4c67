/// A convex body in one frame, and how two of them meet when only the frame's start and its end are looked at.
#pragma once

#include <paperproof/scenery.hpp>

#include <optional>
#include <span>

namespace paperproof::discrete {

/// What moves and what is in the way. A body of inverse mass 0 moves as it was told, whatever it meets.
template <class Scalar>
struct Body {
  /// Convex, counter-clockwise, relative to the position [m]; two points are a segment, without an inside. Must outlive
  /// the body.
  PieceVertices<Scalar> outline{std::span<const Vec2<Scalar>>{}};
  Box2<Scalar> box;  ///< Around the outline, relative to the position [m].
  /// How what the body goes along with moves during the frame: `position` and `movement` are seen from there. What
  /// stands on it does not move, so no rounding can add up.
  MoverMotion<Scalar> base;
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};  ///< Where the frame begins [m].
  Vec2<Scalar> movement{Vec2<Scalar>::Zero()};  ///< To where the frame is expected to end [m].
  Vec2<Scalar> velocity{Vec2<Scalar>::Zero()};  ///< In the world [m/s].
  Scalar inverse_mass = 1;                      ///< [1/kg]
  bool one_way = false;  ///< A segment that only stops what begins on its left and moves to its right.
  bool drops = false;    ///< One-way segments do not stop it.

  [[nodiscard]] Vec2<Scalar> expected() const noexcept { return position + movement; }
  [[nodiscard]] bool can_be_moved() const noexcept { return inverse_mass > 0; }
  /// Around the body at both ends of the frame, in the world [m].
  [[nodiscard]] Box2<Scalar> total_box() const noexcept {
    const Vec2<Scalar> start = base.from + position;
    const Vec2<Scalar> end = base.to + expected();
    return {start.cwiseMin(end) + box.lower, start.cwiseMax(end) + box.upper};
  }
};

/// One body is expected to end in another.
template <class Scalar>
struct Impact {
  Scalar time = 0;                            ///< Of the frame, in [0, 1], along the straight relative motion.
  Vec2<Scalar> normal{Vec2<Scalar>::Zero()};  ///< Unit, from the second body towards the first.
  Scalar depth = 0;                           ///< How far they overlap along the normal at the end of the frame [m].
  Vec2<Scalar> point{Vec2<Scalar>::Zero()};   ///< On the second body at the end of the frame, seen from the first's
                                              ///< base [m].
};

/// The impact of two bodies that overlap where the frame is expected to end; nothing for all others, whatever they pass
/// on the way.
///
/// The time of impact is found backwards: along each normal of either outline (separating axes) the overlap and the
/// speed of approach give the time at which that overlap began, and the last of these times is when the bodies met.
/// With bodies that overlapped from the start it is 0, and the normal that of the least overlap.
/// @param touch up to this overlap at the start two bodies only touched [m].
template <class Scalar>
[[nodiscard]] std::optional<Impact<Scalar>> find_impact(const Body<Scalar>& first, const Body<Scalar>& second,
                                                        Scalar touch) noexcept;

/// Bodies overlap by more than `touch` where the frame began [m].
template <class Scalar>
[[nodiscard]] bool began_overlapping(const Body<Scalar>& first, const Body<Scalar>& second, Scalar touch) noexcept;

}  // namespace paperproof::discrete
