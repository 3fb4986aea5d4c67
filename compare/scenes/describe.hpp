/// Says what is in a scene.
#pragma once

#include "scenes/scene.hpp"

#include <string>

namespace paperproof::compare {

/// Several lines for `paperproof check`: colliders by kind, convex pieces, bounds, start, movers, input, notes. The
/// scene is one that a loader gave out, hence valid.
[[nodiscard]] std::string describe(const Scene& scene);

}  // namespace paperproof::compare
