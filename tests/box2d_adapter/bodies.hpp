/// Bodies of a world that a game owns.
#pragma once

#include <box2d/box2d.h>

namespace paperproof::box2d::test {

inline b2Body* new_body(b2World& world, b2BodyType type, const b2Vec2& position = {0, 0}, float angle = 0) {
  b2BodyDef def;
  def.type = type;
  def.position = position;
  def.angle = angle;
  return world.CreateBody(&def);
}

inline b2Fixture* add_box(b2Body* body, float half_width, float half_height_of_box) {
  b2PolygonShape shape;
  shape.SetAsBox(half_width, half_height_of_box);
  return body->CreateFixture(&shape, 1);
}

}  // namespace paperproof::box2d::test
