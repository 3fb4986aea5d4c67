/// The law of pushing.
///
/// In one step, what moves pushes a character no farther than it goes itself and `Tolerances::push` beyond that, on top
/// of what the character wants to go; and it leaves the character no faster than twice the mover's speed, or than
/// the character was. What would push farther crushes (step_crush.hpp). A crushed character leaves what overlaps it by
/// as much in each step.
///
/// All that pushes asks here: surfaces that squeeze a character out, the search for a free position, and the ways out
/// of what crushed it. A step in shorter parts spends one push in all of them (`Around::limits`).
#pragma once

#include "inlining.hpp"
#include "step/step.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

[[nodiscard]] inline Vec2 way_of(const Step& step, ColliderIndex collider) { return displacement_of(step, collider); }
[[nodiscard]] inline Vec2 way_of(const Step& step, const Crusher& crusher) { return way_of(step, crusher.collider); }
[[nodiscard]] inline Vec2 way_of(const Step& step, const TouchedSurface& surface) {
  return step.movers.displacement(surface.mover);
}

/// How much farther some of these may push a character that is at `p`; negative where it is too far already [m].
/// @param pushing surfaces, colliders or crushers.
template <class Pushing>
[[nodiscard]] Real push_left(const Step& step, const Pushing& pushing, const Vec2& p) {
  Real way = 0;
  for (const auto& each : pushing) way = std::max(way, length_of(way_of(step, each)));
  const Real pushed = length_of(Vec2(p - step.start)) - length_of(step.wanted);
  return way + static_cast<Real>(step.request.around.limits.push) - std::max(Real(0), pushed);
}

/// How fast a surface goes [m/s]: ground that may carry as a whole, with its belt; any other along its normal.
[[nodiscard]] inline Real speed_of(const Step& step, const TouchedSurface& surface) {
  const Vec2 velocity = step.movers.velocity(surface.mover);
  if (!walkable(step, surface.normal)) return std::abs(dot(velocity, surface.normal));
  return length_of(velocity) + std::abs(surface_speed(step, surface.piece));
}

/// Whether one of the touched surfaces comes against the character, and they are not all of one direction.
[[nodiscard]] inline bool squeeze(const Step& step) {
  const std::vector<TouchedSurface>& all = step.memory.surfaces;
  const auto is_another = [&](const TouchedSurface& one) {
    return length_of(Vec2(one.normal - all[0].normal)) > same_plane;
  };
  const auto comes = [&](const TouchedSurface& one) { return dot(way_of(step, one), one.normal) > tolerances.certain; };
  return std::ranges::any_of(all, is_another) && std::ranges::any_of(all, comes);
}

/// Holds a velocity to the law where the touched surfaces squeeze the character out: as a wedge does, the blunter the
/// faster. So fast as the law allows a wall pushes up a slope of 60 degrees.
/// @param had the velocity before the response, which it may keep; of a walk that is its speed along the ground. With
/// or without this step's steering: a brake slows no fall.
/// @param made by the response.
inline void limit_speed(const Step& step, const Desired& had, Desired& made) {
  Real most = 0;
  for (const Vec2& velocity : {had.wanted, had.unsteered}) {
    most = std::max(most, length_of(velocity));
    for (const TouchedSurface& surface : step.memory.surfaces)
      if (walkable(step, surface.normal))
        most = std::max<Real>(most, std::abs(step.up.across_of(velocity)) / step.up.up_of(surface.normal));
  }
  for (const TouchedSurface& surface : step.memory.surfaces) most = std::max(most, 2 * speed_of(step, surface));
  const Real share = std::min(Real(1), most / length_of(made.wanted));
  made = {made.wanted * share, made.unsteered * share};
}

/// Holds the response at the last corner of the path to the law. @param allowed by the surfaces.
/// @return false if they would push the character too far: then it goes to a free position, or is crushed.
[[nodiscard]] PAPERPROOF_NOT_INLINE inline bool limit_push(const Step& step, DesiredMotion& allowed) {
  if (!squeeze(step)) return true;
  if (push_left(step, step.memory.surfaces, step.position + allowed.displacement.wanted) < 0) return false;
  limit_speed(step, step.memory.reported_at[step.result.path.size() - 1].velocity, allowed.velocity);
  return true;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
