/// What impulses of an engine without friction make of a velocity that met surfaces, in closed form.
#pragma once

#include "oracle/met_surface.hpp"

#include <span>
#include <vector>

namespace paperproof::compare {

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

}  // namespace paperproof::compare
