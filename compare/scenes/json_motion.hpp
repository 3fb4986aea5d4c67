/// Places and velocities in JSON scenes, within what a sweep can hold.
#pragma once

#include "scenes/json_text.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof::compare {

/// A point within 2e6 m of the origin, the range of a sweep: see Tolerances::range.
[[nodiscard]] Vec2d read_place(const JsonCursor& at);

/// [m/s]. @param dt of the longest step [s]. @throws InputError for more than 1e6 m in such a step.
[[nodiscard]] Vec2d read_velocity(const JsonCursor& at, double dt);

/// Refuses what leaves in one step what a sweep can hold; later steps are watched by the run.
/// @param per_step how far it moves the character in a step [m].
void check_travel(const JsonCursor& at, double per_step, double dt);

}  // namespace paperproof::compare
