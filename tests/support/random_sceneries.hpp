/// Families of random scenery around the origin: each breaks a different naive sweep.
#pragma once

#include "support/random.hpp"

#include <paperproof/scenery.hpp>

#include <array>
#include <string>

namespace paperproof::test {

enum class Family {
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

inline constexpr std::array all_families{Family::tiles,   Family::slopes,         Family::spikes,  Family::papers,
                                         Family::chains,  Family::wedges,         Family::stairs,  Family::ceilings,
                                         Family::shafts,  Family::needles,        Family::concave, Family::one_way,
                                         Family::lattice, Family::one_way_solids, Family::circles};

std::string name_of(Family family);

/// Solids within about 6 m of `origin`, with free room among them.
SceneryDef random_scenery(Family family, Random& random, const Vec2d& origin);

}  // namespace paperproof::test
