#include "shapes.hpp"

#include "float_geometry.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace paperproof::box2d {
namespace {

std::vector<Vec2d> in_world(std::span<const b2Vec2> points, const b2Transform& transform) {
  std::vector<Vec2d> result;
  for (const b2Vec2& point : points) result.push_back(widened(b2Mul(transform, point)));
  return result;
}

ColliderDef chain_of(std::span<const b2Vec2> points, const b2Transform& transform) {
  return {.shape = ColliderDef::Shape::chain, .points = in_world(points, transform)};
}

ColliderDef circle_of(const b2CircleShape& circle, const b2Transform& transform) {
  ColliderDef def{.shape = ColliderDef::Shape::circle, .points = {widened(b2Mul(transform, circle.m_p))}};
  def.radius = static_cast<double>(circle.m_radius);
  return def;
}

}  // namespace

ColliderDef polygon_around(const ColliderDef& circle) {
  constexpr int corners = 32;
  constexpr double half_angle = std::numbers::pi / corners;
  const double reach = circle.radius / std::cos(half_angle);
  ColliderDef polygon = circle;
  polygon.shape = ColliderDef::Shape::polygon;
  polygon.radius = 0;
  polygon.points.clear();
  for (int i = 0; i < corners; ++i) {
    const double angle = half_angle * (2 * i + 1);
    polygon.points.emplace_back(circle.points.front() + reach * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform) {
  switch (shape.GetType()) {
    case b2Shape::e_circle:
      return circle_of(static_cast<const b2CircleShape&>(shape), transform);
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      return chain_of(std::array{edge.m_vertex1, edge.m_vertex2}, transform);
    }
    case b2Shape::e_polygon: {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      return {.points = in_world({polygon.m_vertices, static_cast<std::size_t>(polygon.m_count)}, transform)};
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      return chain_of({chain.m_vertices, static_cast<std::size_t>(chain.m_count)}, transform);
    }
    case b2Shape::e_typeCount:
      break;
  }
  throw InvalidDefinition("a fixture has a shape that Box2D 2.4 does not have");
}

}  // namespace paperproof::box2d
