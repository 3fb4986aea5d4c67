/// The controller with one of its techniques as a contender.
#pragma once

#include "runs/contender.hpp"

namespace paperproof::compare {

[[nodiscard]] std::unique_ptr<Contender> make_technique_contender(const TechniqueEntry& technique, ScalarKind scalar,
                                                                  const Scene& scene, const Scenery& scenery,
                                                                  const Planning& planning);

}  // namespace paperproof::compare
