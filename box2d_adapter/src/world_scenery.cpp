#include <paperproof/box2d/world_scenery.hpp>

#include "float_geometry.hpp"

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
bool is_no_mover(const b2Body&) { return false; }

/// Still turned as it was when it was read, and does not turn: what is disabled stays as it is, whatever its velocity.
bool keeps_its_angle(const b2Body& body, float read_at) {
  return (body.GetAngularVelocity() == 0 || !body.IsEnabled()) && body.GetAngle() == read_at;
}

/// Whether it is known before a step what it does to a body.
bool is_predictable(const b2Body& body) { return body.GetType() != b2_dynamicBody || !body.IsEnabled(); }

/// Where `b2Island::Solve` takes a kinematic body, in the same operations and so to the same bits. It leaves out who is
/// disabled, whatever velocity it has; who sleeps has none.
b2Vec2 position_after_step(const b2Body& body, float dt) {
  if (!body.IsEnabled()) return body.GetPosition();
  b2Vec2 velocity = body.GetLinearVelocity();
  const b2Vec2 way = dt * velocity;
  if (way.LengthSquared() > b2_maxTranslationSquared) velocity *= b2_maxTranslation / way.Length();
  return body.GetPosition() + dt * velocity;
}

}  // namespace

Filter filter_of(const b2Fixture& fixture) noexcept {
  const b2Filter& bits = fixture.GetFilterData();
  Filter filter{.category = bits.categoryBits, .mask = bits.maskBits, .group = bits.groupIndex};
  if (bits.maskBits == b2Filter().maskBits) filter.mask = Filter{}.mask;  // all kinds
  return filter;
}

WorldScenery scenery_of(b2World& world, const WorldSceneryDef& def) {
  if (def.circle_corners < 3) throw InvalidDefinition("a polygon around a circle has at least 3 corners");
  const auto& wanted = def.filter ? def.filter : is_solid;
  const auto& moves = def.movers ? def.movers : is_no_mover;
  WorldScenery result;
  for (b2Body* body : in_order_of_creation(world.GetBodyList())) {
    const bool is_mover = body->GetType() != b2_staticBody && moves(*body);
    if (!body->IsEnabled() || (body->GetType() != b2_staticBody && !is_mover)) continue;
    b2Transform transform = body->GetTransform();
    if (is_mover) transform.p.SetZero();
    const std::size_t before = result.fixtures.size();
    for (b2Fixture* fixture : in_order_of_creation(body->GetFixtureList())) {
      if (!wanted(*fixture)) continue;
      ColliderDef collider = collider_of(*fixture->GetShape(), transform, def.circle_corners);
      collider.sensor = fixture->IsSensor();
      collider.filter = filter_of(*fixture);
      if (is_mover) collider.mover = static_cast<MoverIndex>(result.movers.size());
      result.scenery.colliders.push_back(std::move(collider));
      result.fixtures.push_back(fixture);
    }
    if (!is_mover || result.fixtures.size() == before) continue;
    result.movers.push_back(body);
    result.angles.push_back(body->GetAngle());
  }
  return result;
}

template <class Scalar>
bool motions_of(const WorldScenery& scenery, float dt, std::span<MoverMotion<Scalar>> motions) noexcept {
  bool known = true;
  for (std::size_t i = 0; i < scenery.movers.size(); ++i) {
    const b2Body& body = *scenery.movers[i];
    const Vec2d from = widened(body.GetPosition());
    const Vec2d to = widened(position_after_step(body, dt));
    motions[i] = {from.cast<Scalar>(), to.cast<Scalar>()};
    known = known && is_predictable(body);
  }
  return known && first_turned(scenery) == nullptr;
}

b2Body* first_turned(const WorldScenery& scenery) noexcept {
  for (std::size_t i = 0; i < scenery.movers.size(); ++i)
    if (!keeps_its_angle(*scenery.movers[i], scenery.angles[i])) return scenery.movers[i];
  return nullptr;
}

void places_of(const WorldScenery& scenery, std::span<Vec2d> places) noexcept {
  for (std::size_t i = 0; i < scenery.movers.size(); ++i) places[i] = widened(scenery.movers[i]->GetPosition());
}

template <class Scalar>
bool motions_since(const WorldScenery& scenery, std::span<const Vec2d> places,
                   std::span<MoverMotion<Scalar>> motions) noexcept {
  for (std::size_t i = 0; i < scenery.movers.size(); ++i) {
    const Vec2d to = widened(scenery.movers[i]->GetPosition());
    motions[i] = {places[i].cast<Scalar>(), to.cast<Scalar>()};
  }
  return first_turned(scenery) == nullptr;
}

template bool motions_of(const WorldScenery&, float, std::span<MoverMotion<float>>) noexcept;
template bool motions_of(const WorldScenery&, float, std::span<MoverMotion<double>>) noexcept;
template bool motions_since(const WorldScenery&, std::span<const Vec2d>, std::span<MoverMotion<float>>) noexcept;
template bool motions_since(const WorldScenery&, std::span<const Vec2d>, std::span<MoverMotion<double>>) noexcept;

}  // namespace paperproof::box2d
