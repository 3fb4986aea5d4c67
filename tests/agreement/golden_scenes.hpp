/// The scenery of `same_bits`: random, but made without anything that a compiler or a standard library may decide.
#pragma once

#include <paperproof/paperproof.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace paperproof::golden {

constexpr double arena_width = 40;
constexpr double arena_height = 20;

/// No distribution of the standard library: those differ.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  std::uint64_t below(std::uint64_t count) { return bits_() % count; }
  Vec2d point(const Vec2d& low, const Vec2d& high) {
    const double x = uniform(low.x(), high.x());
    const double y = uniform(low.y(), high.y());
    return {x, y};
  }

 private:
  std::mt19937_64 bits_;
};

/// Back and forth along a line, at the same speed everywhere.
struct Shuttle {
  Vec2d reach{Vec2d::Zero()};  ///< From the one end to the other [m].
  double period = 1;           ///< There and back [s].
  double phase = 0;            ///< Share of the period at time 0, in [0, 1).

  [[nodiscard]] Vec2d offset_at(double time) const;
};

/// An arena of `arena_width` times `arena_height` with something in it.
struct Scene {
  std::string name;
  Vec2d origin;
  SceneryDef scenery;
  std::vector<Shuttle> shuttles;  ///< One for each mover.
};

[[nodiscard]] std::vector<Scene> make_scenes();

}  // namespace paperproof::golden
