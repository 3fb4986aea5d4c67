/// Counts what an executable allocates. Compile allocations.cpp into it.
#pragma once

#include <cstddef>

namespace paperproof::tests {

/// Calls of operator new so far, by all threads.
[[nodiscard]] std::size_t allocations() noexcept;

}  // namespace paperproof::tests
