/// Stability: stiff and extreme cases, each a region over two parameters.
#pragma once

#include "studies/sweep.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One picture: a sweep over the parameters `x` and `y`.
struct StabilityRegion {
  std::string name;
  std::string question;
  Sweep sweep;
};

/// octagon_sweep in double and in float, and Box2D; others where they are asked for.
[[nodiscard]] std::vector<StabilityRegion> stability_regions(const std::vector<std::string>& contenders);

}  // namespace paperproof::compare
