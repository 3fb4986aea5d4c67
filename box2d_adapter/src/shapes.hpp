/// Box2D's shapes as colliders.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_math.h>

class b2Shape;

namespace paperproof::box2d {

/// A shape at a place, in world coordinates. An edge and a chain block from both sides.
[[nodiscard]] ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform);

/// The polygon of 32 corners that encloses a circle, and reaches beyond it by 0.5 % of its radius: circles cannot be
/// one-way.
[[nodiscard]] ColliderDef polygon_around(const ColliderDef& circle);

}  // namespace paperproof::box2d
