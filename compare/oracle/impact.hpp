/// The time of impact of a translation, exactly.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/world.hpp"

#include <span>

namespace paperproof::compare::detail {

/// The first touch with `collider` on the way from `from` by `displacement`.
/// @param edges those of the collider that the octagon enters on that way, which it does not overlap at the start; at
///   least one.
[[nodiscard]] ExactImpact find_impact(const World& world, const Vec2d& from, const Vec2d& displacement,
                                      ColliderIndex collider, std::span<const std::uint32_t> edges);

}  // namespace paperproof::compare::detail
