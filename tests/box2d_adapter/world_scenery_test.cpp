/// What `scenery_of` reads of a world that a game owns. `HeroInPlay` walks over it.
#include "hero_world.hpp"

#include "campaign/random.hpp"

#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/scenery.hpp>

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

TEST(WorldScenery, fixtures_come_in_order_of_creation_and_only_the_static_solid_ones) {
  Game game;
  b2Fixture* const a = &game.box(b2_staticBody, {0, 0}, 1, 1);
  b2Fixture* const b = a->GetBody()->CreateFixture(a->GetShape(), 1);
  game.box(b2_dynamicBody, {9, 9}, 1, 1);
  b2Fixture* const c = &game.box(b2_staticBody, {5, 0}, 1, 1);
  game.sensor({5, 0}, 3);
  game.box(b2_staticBody, {50, 0}, 1, 1).GetBody()->SetEnabled(false);
  EXPECT_EQ(scenery_of(game.world).fixtures, (std::vector<b2Fixture*>{a, b, c}));
  const auto only_b = [b](const b2Fixture& fixture) { return &fixture == b; };
  EXPECT_EQ(scenery_of(game.world, {.filter = only_b}).fixtures, std::vector<b2Fixture*>{b});
}

TEST(WorldScenery, filters_let_collide_what_box2d_lets_collide) {
  Game game;
  b2Fixture* const a = &game.box(b2_staticBody, {0, 0}, 1, 1);
  b2Fixture* const b = &game.box(b2_dynamicBody, {0, 0}, 1, 1);
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
    ASSERT_EQ(scenery_of(game.world).scenery.colliders[0].filter, filter_of(*a));
    collisions += expected;
  }
  EXPECT_GT(collisions, 2000);
  EXPECT_LT(collisions, 8000);
  a->SetFilterData({});
  EXPECT_EQ(filter_of(*a), Filter{}) << "steps without filters stay fast";
}

TEST(WorldScenery, shapes_arrive_in_world_coordinates_and_a_loop_closed) {
  Game game;
  b2Body* turned_body = game.box(b2_staticBody, {3, 4}, 2, 1).GetBody();
  turned_body->SetTransform({3, 4}, b2_pi / 2);
  b2EdgeShape edge;
  edge.SetTwoSided({0, 0}, {1, 0});
  turned_body->CreateFixture(&edge, 0);
  b2CircleShape circle;
  circle.m_p = {1, 0};
  circle.m_radius = 0.1F;
  game.add(b2_staticBody, {10, 20}, circle);
  b2ChainShape loop;
  loop.CreateLoop(std::vector<b2Vec2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}}.data(), 4);
  game.add(b2_staticBody, {0, 0}, loop);
  const std::vector<ColliderDef> read = scenery_of(game.world).scenery.colliders;
  const Box2 turned = Box2::around(read[0].points);
  EXPECT_LT((turned.lower - Vec2d(3 - 1, 4 - 2)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((turned.upper - Vec2d(3 + 1, 4 + 2)).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(read[1].shape, ColliderDef::Shape::chain);
  EXPECT_LT((read[1].points[1] - Vec2d(3, 5)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(read[2].shape, ColliderDef::Shape::circle);
  EXPECT_EQ(read[2].points, (std::vector<Vec2d>{{11, 20}}));
  EXPECT_EQ(read[2].radius, static_cast<double>(0.1F));
  ASSERT_EQ(read[3].points.size(), 5U);
  EXPECT_EQ(read[3].points.front(), read[3].points.back());
  EXPECT_EQ(Scenery({{read[3]}}).pieces().size(), 4U);
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
