/// What `scenery_of` reads of a world that a game owns. `HeroInMaps` walks over it.
#include "campaign/random.hpp"

#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/scenery.hpp>

#include <box2d/box2d.h>

#include <gtest/gtest.h>

#include <array>

namespace paperproof::box2d {
namespace {

b2Fixture* add(b2World& world, b2BodyType type, const b2Vec2& position, const b2Shape& shape, float angle = 0) {
  b2BodyDef def;
  def.type = type;
  def.position = position;
  def.angle = angle;
  return world.CreateBody(&def)->CreateFixture(&shape, 1);
}

b2PolygonShape box(float half_width, float half_height) {
  b2PolygonShape shape;
  shape.SetAsBox(half_width, half_height);
  return shape;
}

TEST(WorldScenery, fixtures_come_in_order_of_creation_and_only_the_static_solid_ones) {
  b2World world({0, 0});
  b2Fixture* const a = add(world, b2_staticBody, {0, 0}, box(1, 1));
  const b2PolygonShape wide = box(2, 1);
  b2Fixture* const b = a->GetBody()->CreateFixture(&wide, 1);
  add(world, b2_dynamicBody, {9, 9}, box(1, 1));
  b2Fixture* const c = add(world, b2_staticBody, {5, 0}, box(1, 1));
  add(world, b2_staticBody, {5, 0}, box(3, 3))->SetSensor(true);
  add(world, b2_staticBody, {50, 0}, box(1, 1))->GetBody()->SetEnabled(false);
  EXPECT_EQ(scenery_of(world).fixtures, (std::vector<b2Fixture*>{a, b, c}));
  const auto only_b = [b](const b2Fixture& fixture) { return &fixture == b; };
  EXPECT_EQ(scenery_of(world, {.filter = only_b}).fixtures, std::vector<b2Fixture*>{b});
}

TEST(WorldScenery, filters_let_collide_what_box2d_lets_collide) {
  b2World world({0, 0});
  b2Fixture* const a = add(world, b2_staticBody, {0, 0}, box(1, 1));
  b2Fixture* const b = add(world, b2_dynamicBody, {0, 0}, box(1, 1));
  compare::Random random(1);
  const auto bits = [&] {
    const int few = random.below(0x10000);
    return static_cast<std::uint16_t>(random.below(3) == 0 ? 0xFFFF : few & random.below(0x10000));
  };
  b2ContactFilter rule;
  int collisions = 0;
  for (int round = 0; round < 10000; ++round) {
    for (b2Fixture* fixture : {a, b}) {
      b2Filter filter;
      filter.categoryBits = bits();
      filter.maskBits = bits();
      filter.groupIndex = static_cast<std::int16_t>(random.integer(-2, 2));
      fixture->SetFilterData(filter);
    }
    const bool expected = rule.ShouldCollide(a, b);
    ASSERT_EQ(collide(filter_of(*a), filter_of(*b)), expected) << "seed 1, round " << round;
    ASSERT_EQ(scenery_of(world).scenery.colliders[0].filter, filter_of(*a));
    collisions += expected;
  }
  EXPECT_GT(collisions, 2000);
  EXPECT_LT(collisions, 8000);
  a->SetFilterData({});
  EXPECT_EQ(filter_of(*a), Filter{}) << "steps without filters stay fast";
}

TEST(WorldScenery, shapes_arrive_in_world_coordinates_and_a_loop_closed) {
  b2World world({0, 0});
  add(world, b2_staticBody, {3, 4}, box(2, 1), b2_pi / 2);
  b2EdgeShape edge;
  edge.SetTwoSided({0, 0}, {1, 0});
  add(world, b2_staticBody, {3, 4}, edge, b2_pi / 2);
  b2CircleShape circle;
  circle.m_p = {1, 0};
  circle.m_radius = 0.1F;
  add(world, b2_staticBody, {10, 20}, circle);
  const std::array<b2Vec2, 4> corners{b2Vec2(0, 0), b2Vec2(4, 0), b2Vec2(4, 3), b2Vec2(0, 3)};
  b2ChainShape loop;
  loop.CreateLoop(corners.data(), 4);
  add(world, b2_staticBody, {0, 0}, loop);
  const std::vector<ColliderDef> read = scenery_of(world).scenery.colliders;
  const Box2<double> turned = Box2<double>::around(read[0].points);
  EXPECT_LT((turned.lower - Vec2d(3 - 1, 4 - 2)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((turned.upper - Vec2d(3 + 1, 4 + 2)).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(read[1].shape, ColliderDef::Shape::chain);
  EXPECT_LT((read[1].points[1] - Vec2d(3, 5)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(read[2].shape, ColliderDef::Shape::circle);
  EXPECT_EQ(read[2].points, (std::vector<Vec2d>{{11, 20}}));
  EXPECT_EQ(read[2].radius, static_cast<double>(0.1F));
  ASSERT_EQ(read[3].points.size(), 5U);
  EXPECT_EQ(read[3].points.front(), read[3].points.back());
  EXPECT_EQ(Scenery<double>({{read[3]}}).pieces().size(), 4U);
}

}  // namespace
}  // namespace paperproof::box2d
