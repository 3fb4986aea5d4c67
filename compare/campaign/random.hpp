/// Random numbers that are the same with every standard library and every compiler.
///
/// The compiler chooses the order in which the arguments of a call and the operands of most operators are evaluated:
/// `Vec2d(r.unit(), r.unit())` and `r.unit() * r.unit()` give other samples with GCC than with Clang. So at most one of
/// them draws; several draws stand within braces, `Vec2d{r.unit(), r.unit()}`, or one after the other.
#pragma once

#include <paperproof/types.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace paperproof::compare {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Every order of magnitude is as likely as the next.
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  /// As log_between, with either sign.
  double either_sign_log_between(double low, double high) {
    const double sign = chance(0.5) ? 1 : -1;
    return sign * log_between(low, high);
  }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// In [0, n).
  int below(int n) { return integer(0, n - 1); }
  bool chance(double p) { return unit() < p; }
  double angle() { return between(0, 2 * std::numbers::pi); }
  Vec2d point(double reach) { return {between(-reach, reach), between(-reach, reach)}; }
  /// On a coarse grid, so that touching is frequent.
  Vec2d grid_point(int reach) {
    return {(below(2 * reach + 1) - reach) * 0.15625, (below(2 * reach + 1) - reach) * 0.15625};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace paperproof::compare
