/// Box2D's shapes as colliders.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_math.h>

class b2Shape;

namespace paperproof::box2d {

/// A shape at a place, in world coordinates. An edge and a chain block from both sides; a circle becomes the polygon of
/// `circle_corners` corners around it.
[[nodiscard]] ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform, int circle_corners);

}  // namespace paperproof::box2d
