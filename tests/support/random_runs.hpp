/// What random tests draw from: the campaign's own generators, which the command `replay` draws from as well.
#pragma once

#include "campaign/play_levels.hpp"
#include "campaign/random.hpp"
#include "campaign/terrain.hpp"
#include "campaign/wanderers.hpp"

namespace paperproof::test {

using compare::add_mover;
using compare::all_play_levels;
using compare::all_terrains;
using compare::name_of;
using compare::next_offset;
using compare::play_level;
using compare::PlayLevel;
using compare::Random;
using compare::random_terrain;
using compare::Terrain;
using compare::Wanderer;

}  // namespace paperproof::test
