/// Several characters that take turns, by `octagon_sweep`.
#pragma once

#include "runs/contender.hpp"

#include <paperproof/techniques.hpp>

namespace paperproof::compare {

/// @throws NotApplicable with the reason.
[[nodiscard]] std::unique_ptr<Contender> make_together_contender(const TechniqueEntry& octagon_sweep,
                                                                 const Scene& scene, const Scenery& scenery,
                                                                 const Planning& planning);

}  // namespace paperproof::compare
