/// Several characters that move as a `Crowd` as a contender.
#pragma once

#include "runs/contender.hpp"

namespace paperproof::compare {

/// @throws NotApplicable in words where a crowd does not move by this technique, or cannot go through the scenery.
[[nodiscard]] std::unique_ptr<Contender> make_crowd_contender(const TechniqueEntry& technique, const Scene& scene,
                                                              const Scenery& scenery, const Planning& planning);

}  // namespace paperproof::compare
