/// The controller with one of its techniques as a contestant.
#pragma once

#include "runs/contestant.hpp"

namespace paperproof::compare {

[[nodiscard]] std::unique_ptr<Contestant> make_technique_contestant(const TechniqueEntry& technique, ScalarKind scalar,
                                                                    const Scene& scene, const Scenery<double>& scenery,
                                                                    const Planning& planning);

}  // namespace paperproof::compare
