/// What a scenery has at all, which decides before the first step what has to be looked at.
#pragma once

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace paperproof {

/// What blocks and stands still, in order: a level that is drawn once, as squares or as a picture, is made of these.
/// Sensors block nothing, whatever their shape.
[[nodiscard]] inline std::vector<ColliderIndex> standing_solids(const SceneryDef& scenery) {
  std::vector<ColliderIndex> solids;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i)
    if (!scenery.colliders[i].sensor && scenery.colliders[i].mover == no_mover) solids.push_back(i);
  return solids;
}

/// Something that blocks moves; a sensor that does is in nobody's way.
template <class Scalar>
[[nodiscard]] bool has_moving_solids(const Scenery<Scalar>& scenery) noexcept {
  return scenery.sensor_pieces().first > scenery.static_pieces().end;
}

/// A surface moves what stands on it.
template <class Scalar>
[[nodiscard]] bool has_conveyors(const Scenery<Scalar>& scenery) noexcept {
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [](const ColliderInfo& c) { return !c.sensor && c.surface_speed != 0; });
}

/// How many colliders go along with movers, sensors among them.
template <class Scalar>
[[nodiscard]] std::size_t count_moving_colliders(const Scenery<Scalar>& scenery) noexcept {
  std::size_t count = 0;
  for (ColliderIndex i = 0; i < scenery.collider_count(); ++i)
    if (scenery.collider(i).mover != no_mover) ++count;
  return count;
}

/// A segment blocks from one side.
template <class Scalar>
[[nodiscard]] bool has_one_way_chains(const Scenery<Scalar>& scenery) noexcept {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  return std::any_of(pieces.begin(), pieces.end(), [](const PieceInfo& piece) { return piece.one_way; });
}

}  // namespace paperproof
