/// What becomes of a velocity that met surfaces by the law of octagon_sweep, in closed form.
#pragma once

#include "oracle/met_surface.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What a step of octagon_sweep begins with.
struct ControlledStep {
  Vec2d wanted{Vec2d::Zero()};      ///< Velocity [m/s].
  Vec2d unsteered{Vec2d::Zero()};   ///< The part of it that is there without this step's steering [m/s].
  Vec2d up{Vec2d::UnitY()};         ///< Unit vector.
  bool side_hit_ends_rise = false;  ///< See `CharacterDef::side_hit_ends_rise`.
  /// Along the sides of the character, and of its box; none where up is along an axis: unit vectors. A fall between
  /// rims may go along one of them.
  std::vector<Vec2d> sides{};
};

/// The velocities that the law of octagon_sweep (§4 of the design) can make in a step at the surfaces, in the order in
/// which they are met; each time all that are touched are answered together.
///
/// - Momentum across up that presses into what nobody walks on ends; steering against it is spent on it.
/// - Walkable ground keeps the part across up. Else the nearest velocity to what is left of the momentum is taken.
/// - Steering moves it across, as far as the surfaces allow at that height, or on ground.
/// - Surfaces on both sides that leave hardly anything of a fall hold it; rims that are left behind do not, nor does
///   ground that the character is beside. Then the fall goes on, where up is slanted along a side of the character.
/// - Those of which one pushes give a limited speed.
///
/// There are several only where a trace does not say, of a surface that is touched where the step ends, whether it was
/// met by rounding, was ground that is followed, also to where it was left, or takes nothing; of ground that moves,
/// whether a landing without speed across up is carried at once; and of several that are met at one place, whether one
/// came after another.
[[nodiscard]] std::vector<Vec2d> controlled_outcomes(const ControlledStep& step, std::span<const MetSurface> surfaces);

/// What a step may begin with where its parts are not told apart, as an upright character sees it: x across up, y along
/// it [m/s].
struct ControlledRange {
  Box2 unsteered{};           ///< As in `ControlledStep`.
  double least_steering = 0;  ///< Steering adds across up no less than this, which is not positive,
  double most_steering = 0;   ///< and no more than this.
  double squeezed = 0;        ///< Two surfaces press a character out by at most their own speeds and this.
};

/// A box that holds the wanted velocities, and all that the same law can make of them. It does not ask when the
/// surfaces are met, or whether at all, nor in which order: it goes over them twice. It knows their velocities as far
/// as `MetSurface::spread` says. Where walls leave no motion it is a crush, and the box need not hold its end.
/// @param surfaces as an upright character sees them.
[[nodiscard]] Box2 controlled_bounds(const ControlledRange& range, std::span<const MetSurface> surfaces);

/// Whether some surfaces that are touched together push a character, and allow it no velocity of at most `most` [m/s].
/// Then it goes to a free place, or is crushed.
[[nodiscard]] bool leave_no_motion(std::span<const MetSurface> surfaces, double most);

/// What is wrong with the velocity at the end of a step: it is none of `controlled_outcomes`, as far as rounding and
/// `MetSurface::spread` go. Nothing where it is one. The law knows the surfaces alone. It is not that of a step that
/// began inside something, was crushed, stuck or dropped motion, met another character, climbed a stair, or consisted
/// of shorter steps.
[[nodiscard]] std::optional<std::string> velocity_fault(const ControlledStep& step,
                                                        std::span<const MetSurface> surfaces, const Vec2d& velocity);

/// The smallest distance of a velocity from any of the outcomes [m/s].
[[nodiscard]] double distance_from(std::span<const Vec2d> outcomes, const Vec2d& velocity);

}  // namespace paperproof::compare
