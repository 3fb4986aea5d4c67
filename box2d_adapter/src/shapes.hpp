/// Box2D's shapes as colliders.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_math.h>
#include <box2d/b2_polygon_shape.h>

#include <optional>
#include <span>

class b2Shape;

namespace paperproof::box2d {

/// The character's fixture, made by Box2D's own `Set`.
/// @param hull counter-clockwise.
/// @throws InvalidDefinition where Box2D would weld or drop a corner, or abort: corners nearer than 2.5 mm, an area
/// below
///   1e-6 m², corners that are not finite, or not strictly convex in float.
[[nodiscard]] b2PolygonShape character_polygon(std::span<const Vec2d> hull);

/// A shape at a place, in world coordinates. An edge and a chain block from both sides.
[[nodiscard]] ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform);

/// The side from which Box2D lets a one-sided edge or chain block: the first of `up`, down, right and left that each of
/// its segments faces. Nothing for a shape that is not one-sided, and for one that faces none of them everywhere, as a
/// loop.
/// @param turn of its body.
[[nodiscard]] std::optional<Vec2d> front_of(const b2Shape& shape, const b2Rot& turn, const Vec2d& up);

/// Whether all points are in front of a chain, or on it. It faces `front` everywhere, and goes on straight at its ends.
/// @param points not empty.
[[nodiscard]] bool are_in_front(std::span<const Vec2d> points, std::span<const Vec2d> chain, const Vec2d& front);

/// The polygon of 32 corners that encloses a circle, and reaches beyond it by 0.5 % of its radius: circles cannot be
/// one-way.
[[nodiscard]] ColliderDef polygon_around(const ColliderDef& circle);

}  // namespace paperproof::box2d
