/// What a map lacks that comes without a scene, and where its character can begin.
#pragma once

#include "scenes/scene.hpp"

#include <optional>

namespace paperproof::compare {

/// Steps, input and what its character can do. @param scene has its scale.
void set_map_defaults(Scene& scene);

/// Above the first ground: columns of `column` metres from the left of `box`, in each from top to bottom, the first
/// place where the character stands free within the box, one sixteenth of a metre above a collider.
[[nodiscard]] std::optional<Vec2d> first_ground(const Scene& scene, const Box2& box, double column);

/// The free place nearest to `wanted` on a grid of 1/32 m: straight up to 5 m, else in the columns beside it (1 m
/// apart, up to 8), else straight up to the top of `box`. `wanted` itself where that is free.
[[nodiscard]] std::optional<Vec2d> free_place_near(const Scene& scene, const Box2& box, const Vec2d& wanted);

}  // namespace paperproof::compare
