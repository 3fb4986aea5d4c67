/// A convex body in one frame, and how two of them meet when only the frame's start and its end are looked at.
#pragma once

#include <paperproof/scenery.hpp>

#include <optional>
#include <span>

namespace paperproof::discrete {

/// What moves and what is in the way. A body of inverse mass 0 moves as it was told, whatever it meets.
struct Body {
  /// Convex, counter-clockwise, relative to the position [m]; two points are a segment, without an inside. Must outlive
  /// the body.
  PieceVertices outline{std::span<const Vec2d>{}};
  Box2 box;  ///< Around the outline, relative to the position [m].
  /// How what the body goes along with moves during the frame: `position` and `movement` are seen from there. What
  /// stands on it does not move, so no rounding can add up.
  MoverMotion base;
  Vec2d position{Vec2d::Zero()};  ///< Where the frame begins [m].
  Vec2d movement{Vec2d::Zero()};  ///< To where the frame is expected to end [m].
  Vec2d velocity{Vec2d::Zero()};  ///< In the world [m/s].
  double inverse_mass = 1;        ///< [1/kg]
  bool one_way = false;           ///< A segment that only stops what begins on its left and moves to its right.
  bool drops = false;             ///< One-way segments do not stop it.

  [[nodiscard]] Vec2d expected() const noexcept { return position + movement; }
  [[nodiscard]] bool can_be_moved() const noexcept { return inverse_mass > 0; }
  /// Around the body at both ends of the frame, in the world [m].
  [[nodiscard]] Box2 total_box() const noexcept {
    const Vec2d start = base.from + position;
    const Vec2d end = base.to + expected();
    return Box2::between(start, end) + box;
  }
};

/// One body is expected to end in another.
struct Impact {
  double time = 0;              ///< Of the frame, in [0, 1], along the straight relative motion.
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the second body towards the first.
  double depth = 0;             ///< How far they overlap along the normal at the end of the frame [m].
  Vec2d point{Vec2d::Zero()};   ///< On the second body at the end of the frame, seen from the first's
                                ///< base [m].
};

/// The impact of two bodies that overlap where the frame is expected to end; nothing for all others, whatever they pass
/// on the way.
///
/// The time of impact is found backwards: along each normal of either outline (separating axes) the overlap and the
/// speed of approach give the time at which that overlap began, and the last of these times is when the bodies met.
/// With bodies that overlapped from the start it is 0, and the normal that of the least overlap.
/// @param touch up to this overlap at the start two bodies only touched [m].
[[nodiscard]] std::optional<Impact> find_impact(const Body& first, const Body& second, double touch) noexcept;

/// Bodies overlap by more than `touch` where the frame began [m].
[[nodiscard]] bool began_overlapping(const Body& first, const Body& second, double touch) noexcept;

}  // namespace paperproof::discrete
