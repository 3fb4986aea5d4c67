/// Random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace paperproof::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Every order of magnitude is as likely as the next.
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double p) { return unit() < p; }
  double angle() { return between(0, 2 * std::numbers::pi); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace paperproof::test
