/// A scenery, a character and one of the article's techniques, ready to move; and the shapes that its tests use.
#pragma once

#include <paperproof/techniques.hpp>

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace paperproof::article_tests {

/// One pixel [m]. A power of two: whole pixels are exact in both scalars.
inline constexpr double px = 1.0 / 32;

inline constexpr std::array<std::string_view, 4> article_kinds{"wind_back", "penetration_resolution",
                                                               "speculative_march", "speculative"};
inline constexpr std::array<std::string_view, 2> speculative_kinds{"speculative_march", "speculative"};

inline ColliderDef rectangle(double left, double bottom, double right, double top) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}

/// A square of one pixel: the article's single-pixel character.
inline CharacterShape single_pixel() {
  const std::array points{Vec2d{-px / 2, -px / 2}, Vec2d{px / 2, -px / 2}, Vec2d{px / 2, px / 2},
                          Vec2d{-px / 2, px / 2}};
  return CharacterShape(points);
}

inline CharacterDef of_shape(const CharacterShape& shape) {
  CharacterDef character;
  character.shape = shape;
  return character;
}

template <class Scalar>
struct Rig {
  Scenery<Scalar> scenery;
  CharacterDef character;
  std::unique_ptr<Technique<Scalar>> technique;
  Scratch<Scalar> scratch;
  MoveResult<Scalar> result;

  Rig(std::string_view kind, std::vector<ColliderDef> colliders, const ArticleKnobs& knobs = {},
      const CharacterShape& shape = CharacterShape::article())
      : scenery(SceneryDef{std::move(colliders)}),
        character(of_shape(shape)),
        technique(make_technique<Scalar>({.name = kind, .article = knobs}, scenery, character)),
        scratch(technique->make_scratch()) {}

  /// One step of a second: velocity and displacement are the same numbers.
  const MoveResult<Scalar>& move(const Vec2d& position, const Vec2d& displacement) {
    MoveRequest<Scalar> request;
    request.position = position.template cast<Scalar>();
    request.displacement = displacement.template cast<Scalar>();
    request.velocity = request.displacement;
    technique->move(request, scratch, result);
    return result;
  }
};

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [low, high).
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }

 private:
  std::mt19937_64 engine_;
};

/// Walks on, as a game does: gravity and a walking speed that is set anew in every frame.
struct Walker {
  double dt = 1.0 / 64;
  double gravity = 32;
  Vec2d position{Vec2d::Zero()};
  Vec2d velocity{Vec2d::Zero()};

  const MoveResult<double>& step(Rig<double>& rig) {
    velocity.y() -= gravity * dt;
    MoveRequest<double> request;
    request.position = position;
    request.displacement = velocity * dt;
    request.velocity = velocity;
    rig.technique->move(request, rig.scratch, rig.result);
    position = rig.result.position;
    velocity = rig.result.velocity;
    return rig.result;
  }
};

}  // namespace paperproof::article_tests
