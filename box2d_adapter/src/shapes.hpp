/// Box2D's shapes as colliders.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_math.h>
#include <box2d/b2_polygon_shape.h>

#include <array>
#include <optional>
#include <span>

class b2Shape;

namespace paperproof::box2d {

/// The character's fixture, made by Box2D's own `Set`.
/// @param hull counter-clockwise.
/// @throws InvalidDefinition where Box2D would weld or drop a corner, or abort: corners nearer than 2.5 mm, an area
///   below 1e-6 m², corners that are not finite, or not strictly convex in float.
[[nodiscard]] b2PolygonShape character_polygon(std::span<const Vec2d> hull);

/// The vertices of a shape, or the middle of a circle.
/// @param room for those that the shape does not have in a row.
[[nodiscard]] std::span<const b2Vec2> points_of(const b2Shape& shape, std::array<b2Vec2, 2>& room);

/// A shape at a place. An edge and a chain block from both sides.
[[nodiscard]] ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform);

/// Whether Box2D lets a shape block from one side alone: the right of the way along its vertices.
[[nodiscard]] bool is_one_sided(const b2Shape& shape);

/// The unit vector that all segments of a one-sided chain face, and with it the straight way from its first vertex to
/// its last. Nothing if a segment faces away from it: a loop, an overhang.
[[nodiscard]] std::optional<Vec2d> front_of(std::span<const Vec2d> chain);

/// Whether a convex polygon is in front of a chain, or touches it from there, where the two are above each other;
/// beside the chain: whether the polygon's middle is in front of the chain's nearest segment, as if that went on.
/// @param polygon one corner or more. @param front that the chain faces.
[[nodiscard]] bool is_in_front(std::span<const Vec2d> polygon, std::span<const Vec2d> chain, const Vec2d& front);

/// The polygon of 32 corners that encloses a circle, and reaches beyond it by 0.5 % of its radius: circles cannot be
/// one-way.
[[nodiscard]] ColliderDef polygon_around(const ColliderDef& circle);

}  // namespace paperproof::box2d
