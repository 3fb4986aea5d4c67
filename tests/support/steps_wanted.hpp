/// How long the random tests of a guarantee run.
#pragma once

#include <cstdlib>

namespace paperproof::test {

/// The number in an environment variable, or `otherwise` where there is none.
[[nodiscard]] inline int steps_wanted(const char* variable, int otherwise) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

/// Of each family, for octagon_sweep: the sum over families is above 100,000.
[[nodiscard]] inline int steps_per_family() { return steps_wanted("PAPERPROOF_GUARANTEE_STEPS", 9000); }

}  // namespace paperproof::test
