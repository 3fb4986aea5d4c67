/// What becomes of a velocity that met surfaces, in closed form: by the law of each side.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// A surface that a motion met.
struct MetSurface {
  Vec2d normal{Vec2d::Zero()};    ///< Unit, towards the character.
  Vec2d velocity{Vec2d::Zero()};  ///< Of what it goes along with, a conveyor's surface included [m/s].
  bool walkable = false;          ///< Within the climb limit of the character.
  bool at_end = false;            ///< Only touched where the step ends: it takes nothing, but ground is followed.
  double spread = 0;              ///< Where it turns: by so much its velocities differ over the character [m/s].
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

/// A velocity that is wanted, and the part of it that is there without this step's steering [m/s].
struct SteeredVelocity {
  Vec2d wanted{Vec2d::Zero()};
  Vec2d unsteered{Vec2d::Zero()};
};

/// The velocities that the law of octagon_sweep can make of `velocity` at the surfaces, met in their order. Walkable
/// ground keeps the horizontal part, steering holds no fall, a ceiling ends a rise; two surfaces that both hold the
/// motion end it, unless the fall of the unsteered velocity goes on between them. There are several because a
/// trace does not say whether a climb came from a walk, whether a surface had been left when the next one was met,
/// whether what is touched where the step ends was met or is only followed, and whether a landing without sideways
/// speed is carried at once.
[[nodiscard]] std::vector<Vec2d> controlled_outcomes(const SteeredVelocity& velocity,
                                                     std::span<const MetSurface> surfaces);

/// The smallest distance of a velocity from any of the outcomes [m/s].
[[nodiscard]] double distance_from(std::span<const Vec2d> outcomes, const Vec2d& velocity);

}  // namespace paperproof::compare
