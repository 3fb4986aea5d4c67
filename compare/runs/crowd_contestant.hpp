/// Several characters that move by octagon_sweep as a contestant.
#pragma once

#include "runs/contestant.hpp"

namespace paperproof::compare {

/// @throws NotApplicable in words where a crowd cannot go through the scenery.
[[nodiscard]] std::unique_ptr<Contestant> make_crowd_contestant(ScalarKind scalar, const Scene& scene,
                                                                const Scenery<double>& scenery,
                                                                const Planning& planning);

}  // namespace paperproof::compare
