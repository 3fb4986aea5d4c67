/// A scenery as a level of Box2D.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_chain_shape.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>

#include <memory>
#include <vector>

namespace paperproof::test {

/// The pieces of a level as static fixtures: convex polygons, and chains of one segment each.
inline void build_level(b2World& world, const Scenery& scenery) {
  b2Body* body = world.CreateBody(std::make_unique<b2BodyDef>().get());
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    std::vector<b2Vec2> points;
    for (const Vec2d& point : scenery.vertices_of(piece))
      points.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
    if (points.size() > b2_maxPolygonVertices) points.resize(b2_maxPolygonVertices);
    b2PolygonShape polygon;
    b2ChainShape chain;
    if (points.size() >= 3)
      polygon.Set(points.data(), static_cast<int>(points.size()));
    else
      chain.CreateChain(points.data(), 2, points[0], points[1]);
    body->CreateFixture(points.size() >= 3 ? static_cast<b2Shape*>(&polygon) : &chain, 0);
  }
}

}  // namespace paperproof::test
