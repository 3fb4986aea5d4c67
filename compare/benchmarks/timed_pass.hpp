/// One pass of a subject over its workload, timed.
#pragma once

#include "subject.hpp"

#include <chrono>

namespace paperproof::benchmarks {

/// Timed passes of each side, after one that is not. The design asks for 9 at least; the more, the nearer the minimum
/// comes to an undisturbed machine.
inline constexpr int passes = 25;

/// Nanoseconds of a pass.
inline double timed_pass(Subject& subject) {
  subject.restart();
  const auto begin = std::chrono::steady_clock::now();
  subject.run();
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  return took.count();
}

}  // namespace paperproof::benchmarks
