/// What surfaces do to a motion, in the limit of short steps: the law of octagon_sweep, and that of a Box2D body.
///
/// The law of design §4 is one of steps: in each, steering adds s to the horizontal speed (at most acceleration * dt,
/// towards move * walk_speed), gravity adds g * dt, and a surface with unit normal n answers where the sum w enters it
/// (w·n < 0). As dt goes to zero two things are left of it.
///
/// **An impact.** Where a velocity v of finite size enters a surface, s and g * dt are as nothing beside it: the answer
/// is that to v alone.
///  - Walkable: the horizontal part goes on along the surface, (x, -x n.x / n.y).
///  - Steep or wall: a horizontal part that presses in dies; what still enters slides, v - (v·n) n, or ends where it
///    goes into walkable ground. A rise that only came from following walkable ground dies with the walk.
///  - Ceiling: a rise slides (that of a walk dies); a fall goes on, x follows the surface: (-y n.y / n.x, y).
///  - Two surfaces that both enter: the fall that there was before, (0, y), goes to the nearest motion that both allow,
///    if that still falls and neither is walkable; else the motion ends.
///
/// **An acceleration.** A surface that is touched and not entered (v·n = 0) is held while the acceleration f = (s', -g)
/// enters it, where s' is the acceleration, with the sign of what is missing to the wanted speed. A step's w is then
/// v + f dt, and its answer is v + A dt:
///  - Walkable, f·n < 0: A = (s', -s' n.x / n.y). The horizontal speed goes to the wanted one as on level ground, up
///    and down hills alike. Where f·n >= 0 (it speeds up downhill faster than gravity follows) it leaves the ground. Of
///    a walk that brakes uphill f is (s', s' v.y / v.x - g): the climb slows with the walk.
///  - Steep or wall, s' pressing in (s' n.x < 0): steering has no effect, A is that of gravity alone, slid: on a wall
///    (0, -g), on a slope g n.y (n.x, n.y) + (0, -g). Speed gained so is never braked.
///  - Steep, s' pointing outward: A = f - (f·n) n where f·n < 0, else it leaves the slope.
///  - A rise beside a steep surface has v·n > 0 and leaves it; steering may bring it back: impacts follow each other,
///    each with less time in between, and end in a slide.
///  - Ceiling: held only where s' presses in more than gravity leads away. A rise slides, A = f - (f·n) n; a fall goes
///    on, A = (g n.y / n.x, -g).
///  - Two surfaces, each of which keeps A from following the other: rest, unless neither is walkable and gravity alone
///    finds a way down between them.
/// At the wanted speed s' = 0. Where what else acts leads away from it, and s' would lead back, the motion stays at the
/// wanted speed: it slides along the switch (A. F. Filippov, "Differential equations with discontinuous righthand
/// sides", 1988).
///
/// **Box2D's law** for a body without friction and restitution: after an impact the velocity is the nearest one that
/// all surfaces allow, and A is the nearest to f that all touched ones allow. Uphill it loses speed, downhill it gains
/// speed; s' acts on it as on any body.
///
/// Standing (the acceleration of the ground applies, a jump is allowed): walkable ground is held, or a fall ended
/// between two surfaces.
///
/// **The law of steps itself.** s and g * dt are of finite size there: a step of it is an impact of v + s + g * dt with
/// all surfaces that its way meets, those that are touched as it begins included. What differs from the answer above is
/// how steering that presses onto a slope or a wall is answered: momentum alone is, and goes on falling so; steering
/// then moves it across at that speed of falling, as far as the surface allows. Steering that leads away, or goes along
/// walkable ground, is answered as momentum is.
#pragma once

#include "continuous/number.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare::continuous {

enum class Law : std::uint8_t {
  octagon_sweep,  ///< Design §4.
  frictionless,   ///< A Box2D body without friction.
};

/// A surface that is touched.
struct Touch {
  std::size_t facet = 0;
  Point normal;  ///< Unit vector to the free side.
  bool walkable = false;
  /// Where it is touched at a convex corner of the outline: the normal on the corner's other side. Only what enters
  /// both sides enters the corner.
  std::optional<Point> corner{};
};

/// The velocity after the impact of one that enters some of the surfaces touched.
/// @param stood it stood on walkable ground up to this moment.
[[nodiscard]] Point after_impact(Law law, Point velocity, std::span<const Touch> touched, bool stood);

/// The velocity without a climb: by octagon_sweep's law nothing rises along a steep surface that gravity presses onto.
[[nodiscard]] Point without_climb(Law law, Point velocity, std::span<const Touch> touched);

/// The motion of a step.
struct StepMotion {
  Point velocity;
  Point momentum;   ///< Velocity without what this step's steering adds,
  Real steered{0};  ///< and what that adds across, unless a surface answered it as momentum.
};

/// The law of steps: the motion after the impact of one that enters some of the surfaces touched.
/// @param stood it stands on walkable ground up to this moment.
[[nodiscard]] StepMotion after_impact(Law law, const StepMotion& step, std::span<const Touch> touched, bool stood);

/// What acts on a body that enters nothing.
struct Forces {
  Point velocity;     ///< Relative to what carries it [m/s].
  Real fall{0};       ///< Acceleration downwards: gravity, or 0 at the greatest speed of falling [m/s²].
  Real missing{0};    ///< The wanted horizontal speed minus the present one [m/s].
  Real on_ground{0};  ///< Acceleration of steering [m/s²], 0 where nothing steers,
  Real in_air{0};     ///< and that in the air.
};

/// How it goes on.
struct Hold {
  Point acceleration;
  std::vector<std::size_t> facets{};  ///< That hold it.
  bool stands = false;
  bool chatters = false;  ///< The ground holds it with the acceleration of the ground, and not with that of the air.
};

[[nodiscard]] Hold acceleration_of(Law law, const Forces& forces, std::span<const Touch> touched);

}  // namespace paperproof::compare::continuous
