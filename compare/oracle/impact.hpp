/// The time of impact of a translation, exactly.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/seam.hpp"
#include "oracle/world.hpp"

#include <span>

namespace paperproof::compare::detail {

/// The first touch with `collider` on a way, as a fraction of it.
/// @param way_in the way in the frame of any group: neighbours that move otherwise may abut at that moment.
/// @param edges those of the collider that the octagon enters on that way, which it does not overlap at the start; at
///   least one.
[[nodiscard]] ExactImpact find_impact(const World& world, const WayIn& way_in, ColliderIndex collider,
                                      std::span<const std::uint32_t> edges);

}  // namespace paperproof::compare::detail
