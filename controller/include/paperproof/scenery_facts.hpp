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
  const std::vector<ColliderDef>& colliders = scenery.as_run().colliders;
  return std::any_of(colliders.begin(), colliders.end(),
                     [](const ColliderDef& c) { return !c.sensor && c.surface_speed != 0; });
}

/// A segment blocks from one side.
template <class Scalar>
[[nodiscard]] bool has_one_way_chains(const Scenery<Scalar>& scenery) noexcept {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  return std::any_of(pieces.begin(), pieces.end(), [](const PieceInfo& piece) { return piece.one_way; });
}

}  // namespace paperproof
