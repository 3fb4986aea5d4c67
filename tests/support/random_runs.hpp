/// What random tests draw from: the campaign's own generators, which the command `replay` draws from as well.
#pragma once

#include "campaign/play_levels.hpp"
#include "campaign/random.hpp"
#include "campaign/terrain.hpp"
#include "campaign/wanderers.hpp"

#include <array>
#include <string>

namespace paperproof::test {

using compare::add_mover;
using compare::next_offset;
using compare::play_level;
using compare::PlayLevel;
using compare::Random;
using compare::random_terrain;
using compare::Terrain;
using compare::Wanderer;

/// All values of an enumeration that has a name for each, in order.
template <class Enum, std::size_t count>
[[nodiscard]] constexpr std::array<Enum, count> all_of(const std::array<std::string_view, count>& /*names*/) {
  std::array<Enum, count> all{};
  for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<Enum>(i);
  return all;
}

inline constexpr std::array all_play_levels = all_of<PlayLevel>(compare::play_level_names);
inline constexpr std::array all_terrains = all_of<Terrain>(compare::terrain_names);
[[nodiscard]] inline std::string name_of(PlayLevel level) {
  return std::string(compare::play_level_names[static_cast<std::size_t>(level)]);
}
[[nodiscard]] inline std::string name_of(Terrain terrain) {
  return std::string(compare::terrain_names[static_cast<std::size_t>(terrain)]);
}

}  // namespace paperproof::test
