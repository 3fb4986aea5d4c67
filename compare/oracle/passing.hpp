/// How a solid was passed: for the sentence that tells it, so rounded numbers do.
#pragma once

#include "oracle/judge.hpp"

namespace paperproof::compare::detail {

/// The passing of `collider` on the straight way between two places free of it; its speed is left open.
[[nodiscard]] Passing describe_passing(const ExactScenery& scenery, const Place& from, const Place& to,
                                       ColliderIndex collider);

/// The smallest distance of two parallel lines that hold the convex ring between them [m].
[[nodiscard]] double narrowest_width(const std::vector<Vec2d>& ring);

/// The largest depth of a passing that counts as clipped [m]; 0 where each passing is a tunnel.
[[nodiscard]] double rim_of(const TraceHeader& header);

}  // namespace paperproof::compare::detail
