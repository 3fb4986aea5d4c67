/// Small levels, and what the tests of the Box2D twin ask of them.
#pragma once

#include <paperproof/box2d/reference_world.hpp>

#include <numbers>
#include <random>

namespace paperproof::box2d::test {

inline constexpr double frame = 1.0 / 60;

inline ColliderDef polygon(std::vector<Vec2d> points, std::vector<std::vector<Vec2d>> holes = {}) {
  return {.shape = ColliderDef::Shape::polygon, .points = std::move(points), .holes = std::move(holes)};
}
inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}
inline std::vector<Vec2d> rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}
inline ColliderDef box(double left, double bottom, double right, double top) {
  return polygon(rectangle(left, bottom, right, top));
}
inline Scenery<double> level(std::vector<ColliderDef> colliders) {
  return Scenery<double>(SceneryDef{std::move(colliders)});
}

/// Half the height of the article's character [m].
inline double half_height() { return CharacterDef{}.shape.box().upper.y(); }

/// Steps `world` under gravity, the horizontal velocity kept, until `steps` are done; the velocity that was left
/// carries over as in a run.
template <class EachStep>
void run(ReferenceWorld& world, Vec2d velocity, const Vec2d& gravity, int steps, const EachStep& each_step) {
  for (int i = 0; i < steps; ++i) {
    velocity += gravity * frame;
    const TwinStep& step = world.step(velocity, frame);
    velocity = step.velocity;
    each_step(step);
  }
}
inline void run(ReferenceWorld& world, const Vec2d& velocity, const Vec2d& gravity, int steps) {
  run(world, velocity, gravity, steps, [](const TwinStep&) {});
}

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
