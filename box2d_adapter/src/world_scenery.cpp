#include <paperproof/box2d/world_scenery.hpp>

#include "float_geometry.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::box2d {
namespace {

/// Box2D puts new bodies and fixtures in front of its lists.
template <class Node>
std::vector<Node*> in_order_of_creation(Node* newest) {
  std::vector<Node*> nodes;
  for (Node* node = newest; node != nullptr; node = node->GetNext()) nodes.push_back(node);
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<Vec2d> in_world(std::span<const b2Vec2> points, const b2Transform& transform) {
  std::vector<Vec2d> result;
  for (const b2Vec2& point : points) result.push_back(widened(b2Mul(transform, point)));
  return result;
}

ColliderDef chain_of(std::span<const b2Vec2> points, const b2Transform& transform) {
  return {.shape = ColliderDef::Shape::chain, .points = in_world(points, transform)};
}

ColliderDef polygon_around(const b2CircleShape& circle, const b2Transform& transform, int corners) {
  const Vec2d centre = widened(b2Mul(transform, circle.m_p));
  const double half_angle = std::numbers::pi / corners;
  const double reach = static_cast<double>(circle.m_radius) / std::cos(half_angle);
  ColliderDef polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = half_angle * (2 * i + 1);
    polygon.points.push_back(centre + reach * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform, int circle_corners) {
  switch (shape.GetType()) {
    case b2Shape::e_circle:
      return polygon_around(static_cast<const b2CircleShape&>(shape), transform, circle_corners);
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

bool is_solid(const b2Fixture& fixture) { return !fixture.IsSensor(); }

}  // namespace

WorldScenery scenery_of(b2World& world, const WorldSceneryDef& def) {
  if (def.circle_corners < 3) throw InvalidDefinition("a polygon around a circle has at least 3 corners");
  const auto& wanted = def.filter ? def.filter : is_solid;
  WorldScenery result;
  for (b2Body* body : in_order_of_creation(world.GetBodyList())) {
    if (body->GetType() != b2_staticBody || !body->IsEnabled()) continue;
    for (b2Fixture* fixture : in_order_of_creation(body->GetFixtureList())) {
      if (!wanted(*fixture)) continue;
      result.scenery.colliders.push_back(collider_of(*fixture->GetShape(), body->GetTransform(), def.circle_corners));
      result.fixtures.push_back(fixture);
    }
  }
  return result;
}

}  // namespace paperproof::box2d
