/// The time of impact of a translation, exactly.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/world.hpp"

#include <span>

namespace paperproof::compare::detail {

/// The first touch with `collider` on a way in its frame, as a fraction of that way.
/// @param edges those of the collider that the octagon enters on that way, which it does not overlap at the start; at
///   least one.
[[nodiscard]] ExactImpact find_impact(const World& world, const Way& way, ColliderIndex collider,
                                      std::span<const std::uint32_t> edges);

}  // namespace paperproof::compare::detail
