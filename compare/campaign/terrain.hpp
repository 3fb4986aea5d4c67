/// Families of random scenery around the origin: each breaks a different naive sweep.
#pragma once

#include "campaign/random.hpp"

#include <paperproof/scenery.hpp>

#include <array>
#include <string_view>

namespace paperproof::compare {

enum class Terrain {
  tiles,
  slopes,
  spikes,
  papers,
  chains,
  wedges,
  stairs,
  ceilings,
  shafts,
  needles,
  concave,
  one_way,
  lattice,
  one_way_solids,
  circles,
};

/// In the order of `Terrain`.
inline constexpr std::array<std::string_view, 15> terrain_names{
    "tiles",  "slopes",  "spikes",  "papers",  "chains",  "wedges",         "stairs", "ceilings",
    "shafts", "needles", "concave", "one_way", "lattice", "one_way_solids", "circles"};

/// Solids within about 6 m of `origin`, with free room among them.
SceneryDef random_terrain(Terrain terrain, Random& random, const Vec2d& origin);

}  // namespace paperproof::compare
