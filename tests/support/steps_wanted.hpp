/// How long the random tests of a guarantee run.
#pragma once

#include <cstdlib>

namespace paperproof::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

/// So many random cases, or a quarter where sanitizers look on: each case takes ten times as long there, and the other
/// builds run all of them.
[[nodiscard]] constexpr int sampled(int cases) { return sanitized ? cases / 4 : cases; }

/// The number in an environment variable, or `otherwise` where there is none.
[[nodiscard]] inline int steps_wanted(const char* variable, int otherwise) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

/// Of each family, for octagon_sweep: the sum over families is above 100,000.
[[nodiscard]] inline int steps_per_family() { return steps_wanted("PAPERPROOF_GUARANTEE_STEPS", 9000); }

}  // namespace paperproof::test
