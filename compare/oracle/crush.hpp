/// Whether the octagon had room where a contender says that it was crushed.
#pragma once

#include "oracle/exact.hpp"

#include <map>

namespace paperproof::compare::detail {

/// A position at the end of the step that would have been free: see `Judge` for what counts as room. Or none.
/// @param path the way of the step, corner by corner, up to its end.
/// @param crushed the colliders of movers that are said to crush.
/// @param free_of for what the octagon overlaps on its way the last place free of it, as far as there is one.
[[nodiscard]] std::optional<Vec2d> find_room(const ExactScenery& scenery, std::span<const Place> path,
                                             std::span<const ColliderIndex> crushed,
                                             const std::map<ColliderIndex, Place>& free_of);

}  // namespace paperproof::compare::detail
