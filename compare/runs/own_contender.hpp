/// Our controller as a contender: with one of its techniques, in a level where something turns, as a crowd, and taking
/// turns.
#pragma once

#include "runs/contender.hpp"

namespace paperproof::compare {

/// All movers of a scene where something turns stand in its trace with the ways of their vertices: in steps of several
/// parts what does not turn does not go evenly either.
/// @param scenery shared by all contenders of a scene, and must outlive them; one in float brings its own, rounded.
/// @throws NotApplicable where the technique, in these numbers and with these knobs, is not made for the scene.
[[nodiscard]] std::unique_ptr<Contender> make_own_contender(const TechniqueEntry& technique, ScalarKind scalar,
                                                            const Scene& scene, const Scenery& scenery,
                                                            const Planning& planning);

}  // namespace paperproof::compare
