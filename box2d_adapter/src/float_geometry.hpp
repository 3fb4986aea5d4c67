/// From the controller's numbers to those of Box2D, and back.
#pragma once

#include <paperproof/types.hpp>

#include <box2d/b2_math.h>

namespace paperproof::box2d {

/// In a source of its own, not inlined: where the conversions to float and back to double of two coordinates come
/// together, g++ 12 vectorises them at -O2 and loses both, so that nothing is rounded at all. The project's options
/// forbid it these vectors as well (controller/compiler_options.cmake).
[[nodiscard]] b2Vec2 rounded(const Vec2d& value) noexcept;
[[nodiscard]] inline Vec2d widened(const b2Vec2& value) noexcept {
  return {static_cast<double>(value.x), static_cast<double>(value.y)};
}

}  // namespace paperproof::box2d
