/// A scenery, a character and one of the article's techniques, ready to move; and the shapes that its tests use.
#pragma once

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "support/refusal.hpp"

#include <paperproof/techniques.hpp>

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace paperproof::article_tests {

using compare::half_height;
using compare::half_width;
using compare::Random;
using test::refusal_by;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double frame = 1.0 / 60;

/// One pixel [m]. A power of two: whole pixels are exact in both scalars.
inline constexpr double px = 1.0 / 32;

inline ColliderDef rectangle(double left, double bottom, double right, double top) {
  return compare::box(left, bottom, right, top);
}

inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}

/// Corners of a convex outline, in order of angle.
inline std::vector<Vec2d> on_an_ellipse(Random& random, const Vec2d& centre, const Vec2d& radii) {
  const int corners = 3 + random.below(6);
  const double turn = random.angle();
  std::vector<Vec2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 6.283185 * (i + random.between(0, 0.7)) / corners;
    outline.push_back(centre + radii.cwiseProduct(compare::towards(angle)));
  }
  return outline;
}

inline CharacterDef of_shape(const CharacterShape& shape) {
  CharacterDef character;
  character.shape = shape;
  return character;
}

struct Rig {
  Scenery scenery;
  CharacterDef character;
  std::unique_ptr<Technique> technique;
  Scratch scratch;
  MoveRequest request;  ///< Of the next step; what is not of its motion stays.
  MoveResult result;

  Rig(const TechniqueDef& def, std::vector<ColliderDef> colliders,
      const CharacterShape& shape = CharacterShape::article())
      : scenery(SceneryDef{std::move(colliders)}),
        character(of_shape(shape)),
        technique(make_technique(def, scenery, character)),
        scratch(technique->make_scratch()) {}
  Rig(std::string_view kind, std::vector<ColliderDef> colliders, const ArticleKnobs& knobs = {},
      const CharacterShape& shape = CharacterShape::article())
      : Rig(TechniqueDef{.name = kind, .article = knobs}, std::move(colliders), shape) {}

  /// One step of a second: velocity and displacement are the same numbers.
  const MoveResult& move(const Vec2d& position, const Vec2d& displacement) {
    request.position = position;
    request.displacement = displacement;
    request.velocity = request.displacement;
    technique->move(request, scratch, result);
    return result;
  }
};

}  // namespace paperproof::article_tests
