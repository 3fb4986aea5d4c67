/// What becomes of a velocity that met surfaces, in closed form: by the law of each side.
#pragma once

#include <paperproof/types.hpp>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace paperproof::compare {

/// A surface that a motion met.
struct MetSurface {
  Vec2d normal{Vec2d::Zero()};    ///< Unit, towards the character.
  Vec2d velocity{Vec2d::Zero()};  ///< Of what it goes along with, a conveyor's surface included [m/s].
  ColliderIndex collider = no_collider;
  bool walkable = false;       ///< Within the climb limit of the character.
  bool is_overlapped = false;  ///< For bounds alone: the character is inside of it, and may go along.
  bool is_side = false;        ///< Touches the left or right side of the character.
  bool ridden = false;         ///< The step begins on it, and goes along: nobody lands on it.
  bool climbs = false;         ///< A rise that comes to it is the climb of a walk, whose ground is still touched.
  double met = 0;              ///< When it was met, as a fraction of the step; 1: only touched where that ends.
  double left = std::numeric_limits<double>::infinity();  ///< From then on it is touched no more.
  bool is_beside = false;                                 ///< It is touched corner to corner: it bears nobody.
  bool past_rim = false;  ///< It is touched still where it is left: the way goes on past its rim.
  bool returned = false;  ///< It was left, and is touched again.
  /// Its velocity is known to within this, where it turns [m/s]: for bounds along its normal, else in any direction.
  double spread = 0;
  double spread_along = 0;  ///< The same along the face; for bounds alone.
  /// The mover that turns it. A face of that mover stands so at one fraction of the step only: it presses nobody
  /// against a face of the same mover at another fraction.
  std::optional<MoverIndex> turning{};
  double stands_at = 0;

  /// The smallest box that holds its velocities.
  [[nodiscard]] Box2 velocities() const {
    constexpr double any = std::numeric_limits<double>::infinity();
    if (spread + spread_along == any) return {Vec2d::Constant(-any), Vec2d::Constant(any)};
    const Vec2d along(-normal.y(), normal.x());
    const Vec2d unknown = spread * normal.cwiseAbs() + spread_along * along.cwiseAbs();
    return {velocity - unknown, velocity + unknown};
  }
};

/// The velocities that impulses without friction and restitution can make of `wanted` at one or two of the surfaces,
/// met together or one after another: each time the nearest velocity that enters neither. `wanted` itself is the first.
/// Source: Moreau, "Unilateral contact and dry friction in finite freedom dynamics" (1988): the impulses project the
/// velocity onto the cone of velocities that are allowed.
[[nodiscard]] std::vector<Vec2d> frictionless_outcomes(const Vec2d& wanted, std::span<const MetSurface> surfaces);

/// Whether `velocity` is what some rounds of impulses at two of the surfaces in turn leave of `wanted`, short of the
/// limit that they go to: the impulses only push, and no more is left than the rounds can leave. A round multiplies
/// what is left by the square of the cosine between the normals, as alternating projections onto two lines do. Source:
/// von Neumann, "Functional operators II" (1950); b2ContactSolver is such an iteration (Catto 2005).
/// @param kept the change of velocity [m/s] that the impulses of the step before made: the solver begins with them.
/// @param rounds of the solver: 8 by default in Box2D.
[[nodiscard]] bool is_short_of_limit(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces,
                                     const Vec2d& kept, int rounds);

/// Whether an impulse along the normal of one surface, tilted by no more than `tilt` (its sine), makes `velocity` of
/// `wanted`, and leaves nothing of what enters.
[[nodiscard]] bool is_turned_by_tilt(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces,
                                     double tilt);

/// What a step of octagon_sweep begins with.
struct ControlledStep {
  Vec2d wanted{Vec2d::Zero()};      ///< Velocity [m/s].
  Vec2d unsteered{Vec2d::Zero()};   ///< The part of it that is there without this step's steering [m/s].
  Vec2d up{Vec2d::UnitY()};         ///< Unit vector.
  bool side_hit_ends_rise = false;  ///< See `CharacterDef::side_hit_ends_rise`.
  /// A character that two surfaces press out faster may go to a free place instead, and rest there [m/s].
  double most_pressed_out = std::numeric_limits<double>::infinity();
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

/// What is wrong with the velocity at the end of a step: it is none of `controlled_outcomes`, as far as rounding and
/// `MetSurface::spread` go. Nothing where it is one. The law knows the surfaces alone. It is not that of a step that
/// began inside something, was crushed, stuck or dropped motion, met another character, climbed a stair, or consisted
/// of shorter steps.
[[nodiscard]] std::optional<std::string> velocity_fault(const ControlledStep& step,
                                                        std::span<const MetSurface> surfaces, const Vec2d& velocity);

/// The smallest distance of a velocity from any of the outcomes [m/s].
[[nodiscard]] double distance_from(std::span<const Vec2d> outcomes, const Vec2d& velocity);

}  // namespace paperproof::compare
