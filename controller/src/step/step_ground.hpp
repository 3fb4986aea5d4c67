/// Ground that the character touches: does it stand on it, or leave it?
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"
#include "step/step_ride.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

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

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
