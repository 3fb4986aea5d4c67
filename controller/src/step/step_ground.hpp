/// Ground that the character touches: does it stand on it, or leave it?
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"
#include "step/step_ride.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

#include <initializer_list>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

PAPERPROOF_COLD inline void note_ground_velocity(Step& step, PieceIndex piece) {
  step.result.ground.velocity = ground_velocity(step, piece, step.result.ground.normal);
}

PAPERPROOF_INLINE void note_ground(Step& step, GroundState state, PieceIndex piece, const Vec2& normal) {
  step.result.grounded = state != GroundState::steep;
  step.result.ground.state = state;
  step.result.ground.collider = collider_of(step, piece);
  step.result.ground.normal = normal;
  step.result.ground.velocity = Vec2::Zero();
  if (step.movers.active) [[unlikely]]
    note_ground_velocity(step, piece);
}

/// How fast round ground falls away below a motion that went along a tangent of it at most a step ago [m/s].
/// @param motion relative to it [m/s].
[[nodiscard]] PAPERPROOF_COLD inline Real falls_away_from_tangent(const Step& step, PieceIndex piece, Vec2 motion) {
  const Real speed = length_of(motion);
  return speed * speed * step.movers.dt / step.space.circle(piece).radius;
}

/// Whether the motion at the end of the step leaves ground that it touches: one more step of it would part them by more
/// than `touch`. Vertices that are rounded make seams of straight ground bend by 1e-12 or 1e-6: they are no crests. A
/// jump leaves at any speed. Round ground falls away below a walk, which does not leave it.
[[nodiscard]] PAPERPROOF_INLINE bool leaves(const Step& step, PieceIndex piece, const Vec2& normal) {
  const Vec2 ground = step.movers.velocity(mover_of(step, piece));
  const Real leaving = dot(Vec2(step.velocity - ground), normal);
  if (leaving <= step.leaves_ground_above) return false;
  if (step.leaves_ground_above == 0) return leaving > along_plane * (length_of(step.velocity) + length_of(ground));
  return !step.space.is_circle(piece) || leaving > falls_away_from_tangent(step, piece, Vec2(step.velocity - ground));
}

/// The surface of a piece that the character touches now, if it is walkable ground.
[[nodiscard]] PAPERPROOF_INLINE std::optional<TouchedSurface> touched_ground(const Step& step, PieceIndex piece) {
  const std::optional<TouchedSurface> surface = touched_here(step, piece);
  return surface && walkable(step, surface->normal) ? surface : std::nullopt;
}

/// The same, if the motion does not leave it: the character stands on it.
[[nodiscard]] PAPERPROOF_INLINE std::optional<TouchedSurface> stood_on(const Step& step, PieceIndex piece) {
  const std::optional<TouchedSurface> ground = touched_ground(step, piece);
  return ground && !leaves(step, piece, ground->normal) ? ground : std::nullopt;
}

[[nodiscard]] PAPERPROOF_COLD inline bool touches_ground(Step& step) {
  return any_near(step, {step.position, step.position},
                  [&](PieceIndex piece) { return touched_ground(step, piece).has_value(); });
}

[[nodiscard]] inline Vec2 upward(const Step& step) { return step.up.in_world({0, 1}); }

/// Whether ways that take no time, one after another, are free, and the last one ends at walkable ground: where a mover
/// takes the character as the step ends, as a climb comes then.
/// @param ways across and up [m].
[[nodiscard]] PAPERPROOF_COLD inline bool lead_to_ground(Step& step, MoverIndex mover,
                                                         std::initializer_list<Vec2> ways) {
  const Vec2 from = step.position;
  const Real time = step.time;
  step.position -= step.movers.relative(Vec2::Zero(), mover, time);
  step.time = 1;
  bool is_free = true;
  bool is_hit = false;
  for (const Vec2& way : ways) {
    is_free = is_free && !is_hit;
    set_motion(step.motion, step.space, step.position, Vec2(step.up.in_world(way)));
    sweep_again(step);  // one more call of `sweep_along` costs a walk 1 % (g++ 12)
    order_stops(step);
    is_hit = step.found.hit;
    step.position += step.motion.displacement;
  }
  step.position = from;
  step.time = time;
  return is_free && is_hit &&
         walkable(step, step.space.normal(step.found.stops[0].piece, step.found.stops[0].axes.normal));
}

/// Of some points the one that is furthest along a direction.
template <class Points>
[[nodiscard]] Vec2 furthest(const Points& points, const Vec2& direction) {
  Vec2 best = Vec2::Constant(std::numeric_limits<Real>::quiet_NaN());
  for (const Vec2d& each : points) {
    const Vec2 point = each.cast<Real>();
    if (!(dot(point, direction) <= dot(best, direction))) best = point;
  }
  return best;
}

/// Whether a walker rests on a stair: on a corner or a side that is too steep to walk on, and
/// - no higher than `step_height`, and just beyond its foot would stand, so much higher at most than the step began;
/// - or no higher than `snap`, and past it there is ground, so much lower at most. No climb ends so.
/// It stands there as on level ground. So a hull that is narrower at the foot rests with its slanted side on the corner
/// of a stair, and so does a foot on the side of a kerb that leans back.
[[nodiscard]] PAPERPROOF_COLD inline bool rests_on_stair(Step& step, const TouchedSurface& steep) {
  constexpr Real little = 2 * tolerances.touch;
  constexpr Real same_face = 1e-6;  // of directions: its ends are furthest along those beside its normal
  const Vec2& n = steep.normal;
  if (!step.climbs || walkable(step, n) || !(step.up.up_of(n) > 0)) return false;
  const Vec2 at = local(step, steep.piece, step.position);
  const Real side = std::copysign(Real(1), -step.up.across_of(n));  // of the stair
  const auto points = step.space.vertices_of(steep.piece);
  const Vec2 bottom = furthest(points, Vec2(n - same_face * upward(step)));
  const Real height = step.up.up_of(Vec2(furthest(points, Vec2(n + same_face * upward(step))) - bottom));
  const Real radius = step.space.is_circle(steep.piece) ? step.space.circle(steep.piece).radius : Real(0);
  const Vec2 began = Vec2(step.request.state.position) + step.moving.ride.velocity * step.movers.dt * step.time;
  const Real risen = step.up.up_of(Vec2(step.position - began));

  const Real cosine = step.settings.walkable_cosine;
  const Vec2 steepest = step.up.in_world({-side * step.settings.walkable_tangent * cosine, cosine});
  const Vec2 stood_on = furthest(points, steepest) + steepest * radius;
  const Vec2 foothold = step.up.seen(Vec2(stood_on - furthest(step.space.hull(), Vec2(-steepest)) - at));
  const Real highest = std::max({height, foothold.y(), foothold.y() + risen, tolerances.touch});
  if (highest <= step.settings.step_height &&
      lead_to_ground(step, steep.mover,
                     {{0, foothold.y() + 2 * little}, {foothold.x() + side * little, 0}, {0, -4 * little}}))
    return true;

  const Vec2 flank = furthest(step.space.hull(), step.up.in_world({side, 0}));
  const Real past = step.up.across_of(Vec2(bottom + n * radius - flank - at)) - side * little;
  const Real down = step.settings.snap + std::min(risen, Real(0));
  return risen <= tolerances.touch && std::max(height, tolerances.touch) <= step.settings.snap && down > 0 &&
         lead_to_ground(step, steep.mover, {{past, 0}, {0, -down}});
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
