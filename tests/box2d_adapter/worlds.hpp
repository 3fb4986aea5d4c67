/// What the tests of the adapter and of the Box2D twin share.
#pragma once

#include <paperproof/character.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace paperproof::box2d::test {

inline constexpr double frame = 1.0 / 60;

/// Half the height of the article's character [m].
inline double half_height() { return CharacterDef{}.shape.box().upper.y(); }

/// Uniform in [low, high); the same on every machine (`std::uniform_real_distribution` is not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  std::size_t below(std::size_t count) { return engine_() % count; }
  Vec2d direction() {
    const double angle = between(0, 2 * std::numbers::pi);
    return {std::cos(angle), std::sin(angle)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace paperproof::box2d::test
