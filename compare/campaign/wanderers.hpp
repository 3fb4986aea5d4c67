/// Things of every shape that wander about in an arena of 12 m.
#pragma once

#include "campaign/random.hpp"

#include <paperproof/scenery.hpp>

#include <vector>

namespace paperproof::compare {

struct Wanderer {
  Vec2d velocity{0, 0};   ///< [m per step]
  double until_turn = 0;  ///< [steps]
};

/// Adds the colliders of one mover: a box, a triangle, a paper, a chain, a one-way chain or a row of tiles.
void add_mover(std::vector<ColliderDef>& colliders, MoverIndex mover, Random& random, const Vec2d& origin);

/// Makes circles of most polygons that move.
void round_movers(std::vector<ColliderDef>& colliders, Random& random);

/// Where it is a step later. Now and then it turns; it stays in the arena, but for what is thrown out of it.
/// @return the offset of its mover [m], within 1e6.
[[nodiscard]] Vec2d next_offset(Wanderer& wanderer, const Vec2d& offset, Random& random);

}  // namespace paperproof::compare
