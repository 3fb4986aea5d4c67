/// What a scenery has at all, which decides before the first step what has to be looked at.
#pragma once

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <span>

namespace paperproof {

/// A surface moves what stands on it.
template <class Scalar>
[[nodiscard]] bool has_conveyors(const Scenery<Scalar>& scenery) noexcept {
  const std::vector<ColliderDef>& colliders = scenery.as_run().colliders;
  return std::any_of(colliders.begin(), colliders.end(), [](const ColliderDef& c) { return c.surface_speed != 0; });
}

/// A segment blocks from one side.
template <class Scalar>
[[nodiscard]] bool has_one_way_chains(const Scenery<Scalar>& scenery) noexcept {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  return std::any_of(pieces.begin(), pieces.end(), [](const PieceInfo& piece) { return piece.one_way; });
}

}  // namespace paperproof
