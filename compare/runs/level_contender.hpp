/// octagon_sweep in double where something turns.
#pragma once

#include "runs/contender.hpp"

namespace paperproof::compare {

/// All movers of such a scene stand in its trace with the ways of their vertices: in steps of several parts what does
/// not turn does not go evenly either.
/// @throws NotApplicable for several characters, for movers that are one-way, and for knobs of the technique: the
///   controller of a level has none.
[[nodiscard]] std::unique_ptr<Contender> make_level_contender(const TechniqueEntry& octagon_sweep, const Scene& scene,
                                                              const Scenery& scenery, const Planning& planning);

}  // namespace paperproof::compare
