/// A stepper whose steps compute in `float`.
#pragma once

#include "controller/stepping.hpp"

#include <paperproof/in_float.hpp>

namespace paperproof::stepping {

/// @param colliders are rounded to `float`.
[[nodiscard]] inline Stepper in_float(std::vector<ColliderDef> colliders, const CharacterDef& character = {}) {
  for (ColliderDef& collider : colliders) {
    for (Vec2d& point : collider.points) point = point.cast<float>().cast<double>();
    collider.radius = static_cast<double>(static_cast<float>(collider.radius));
  }
  return Stepper(std::make_unique<const Scenery>(SceneryDef{std::move(colliders)}),
                 [&](const Scenery& level) { return TechniqueController(make_controller_in_float(level, character)); });
}

}  // namespace paperproof::stepping
