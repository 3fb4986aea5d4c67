/// What is done before the first step, and how long that takes.
#pragma once

#include "runs/contender.hpp"
#include "scenes/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

struct Preparation {
  double seconds = 0;  ///< Until the first step.
  double pairs = 0;    ///< Of pieces that the character can touch both of: what the time grows with.
};

/// Measured on every k-th collider and extrapolated. None where the scene is so small that measuring would take longer.
/// @param contenders, scalars that are to run.
[[nodiscard]] std::optional<Preparation> expected_preparation(const Scene& scene,
                                                              const std::vector<std::string>& contenders,
                                                              const std::vector<ScalarKind>& scalars);

}  // namespace paperproof::compare
