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

/// Whether a mover moves a solid: pieces of moving solids lie between the standing ones and the sensors.
[[nodiscard]] inline bool has_moving_solids(const Scenery& scenery) noexcept {
  return scenery.sensor_pieces().first > scenery.static_pieces().end;
}

/// Some surface is a conveyor.
[[nodiscard]] inline bool has_conveyors(const Scenery& scenery) noexcept {
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [](const ColliderInfo& c) { return !c.sensor && c.surface_speed != 0; });
}

/// Some collider is not there for every character.
[[nodiscard]] inline bool has_filters(const Scenery& scenery) noexcept {
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [](const ColliderInfo& c) { return c.filter != Filter{}; });
}

/// Number of colliders that movers move, sensors included.
[[nodiscard]] inline std::size_t count_moving_colliders(const Scenery& scenery) noexcept {
  std::size_t count = 0;
  for (ColliderIndex i = 0; i < scenery.collider_count(); ++i)
    if (scenery.collider(i).mover != no_mover) ++count;
  return count;
}

/// Some collider is round, sensors included.
[[nodiscard]] inline bool has_circles(const Scenery& scenery) noexcept {
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [](const ColliderInfo& c) { return c.shape == ColliderDef::Shape::circle; });
}

/// Some segment blocks from one side only.
[[nodiscard]] inline bool has_one_way_chains(const Scenery& scenery) noexcept {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  return std::any_of(pieces.begin(), pieces.end(), [](const PieceInfo& piece) { return piece.one_way; });
}

}  // namespace paperproof
