/// Facts about a scenery. They decide before the first step which stages it needs.
#pragma once

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace paperproof {

/// The colliders that block and stand still, in order. A level that is drawn once, as squares or as a picture, consists
/// of these. Sensors block nothing, whatever their shape.
[[nodiscard]] inline std::vector<ColliderIndex> standing_solids(const SceneryDef& scenery) {
  std::vector<ColliderIndex> solids;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i)
    if (!scenery.colliders[i].sensor && scenery.colliders[i].mover == no_mover) solids.push_back(i);
  return solids;
}

/// Whether a mover moves a solid.
[[nodiscard]] inline bool has_moving_solids(const Scenery& scenery) noexcept {
  return scenery.counts().moving_pieces > 0;
}

/// Some surface is a conveyor.
[[nodiscard]] inline bool has_conveyors(const Scenery& scenery) noexcept { return scenery.counts().conveyors > 0; }

/// Some collider is not there for every character.
[[nodiscard]] inline bool has_filters(const Scenery& scenery) noexcept { return scenery.counts().filtered > 0; }

/// Some collider is round, sensors included.
[[nodiscard]] inline bool has_circles(const Scenery& scenery) noexcept { return scenery.counts().circles > 0; }

/// Some segment blocks from one side only.
[[nodiscard]] inline bool has_one_way_chains(const Scenery& scenery) noexcept { return scenery.counts().one_way > 0; }

}  // namespace paperproof
