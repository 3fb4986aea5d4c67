/// The controller over a world that a game owns.
#include "bodies.hpp"
#include "worlds.hpp"

#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/paperproof.hpp>

#include <gtest/gtest.h>

#include <random>

namespace paperproof::box2d::test {
namespace {

TEST(WorldScenery, a_character_walks_over_a_borrowed_level) {
  b2World world({0, -10});  // the game's
  b2Fixture* const floor = add_box(new_body(world, b2_staticBody, {0, -1}), 20, 1);
  b2Fixture* const wall = add_box(new_body(world, b2_staticBody, {6, 2}), 0.5F, 2);
  const WorldScenery borrowed = scenery_of(world);
  const Scenery<double> scenery(borrowed.scenery);
  const Controller<double> controller(scenery, CharacterDef{});
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
  state.position = {0, 2};
  std::vector<b2Fixture*> touched;
  for (int i = 0; i < 240; ++i) {
    controller.step(state, {.move = 1.0}, {{0, -10}, frame}, scratch, report);
    for (const Contact<double>& contact : report.move.contacts) touched.push_back(borrowed.fixtures[contact.collider]);
  }
  EXPECT_TRUE(state.grounded);
  EXPECT_NEAR(state.position.y(), half_height(), 2e-6);
  EXPECT_NEAR(state.position.x(), 6 - 0.5 - CharacterDef{}.shape.box().upper.x(), 2e-6);
  EXPECT_NE(std::find(touched.begin(), touched.end(), floor), touched.end());
  EXPECT_NE(std::find(touched.begin(), touched.end(), wall), touched.end());
}

TEST(WorldScenery, fixtures_come_in_order_of_creation_and_only_the_static_solid_ones) {
  b2World world({0, 0});
  b2Body* const first = new_body(world, b2_staticBody);
  b2Fixture* const a = add_box(first, 1, 1);
  b2Fixture* const b = add_box(first, 2, 1);
  add_box(new_body(world, b2_dynamicBody, {9, 9}), 1, 1);
  b2Body* const second = new_body(world, b2_staticBody, {5, 0});
  b2Fixture* const c = add_box(second, 1, 1);
  add_box(second, 3, 3)->SetSensor(true);
  new_body(world, b2_staticBody, {50, 0})->SetEnabled(false);
  EXPECT_EQ(scenery_of(world).fixtures, (std::vector<b2Fixture*>{a, b, c}));
  const auto only_b = [b](const b2Fixture& fixture) { return &fixture == b; };
  EXPECT_EQ(scenery_of(world, {.filter = only_b}).fixtures, std::vector<b2Fixture*>{b});
}

TEST(WorldScenery, filters_let_collide_what_box2d_lets_collide) {
  b2World world({0, 0});
  b2Fixture* const a = add_box(new_body(world, b2_staticBody), 1, 1);
  b2Fixture* const b = add_box(new_body(world, b2_dynamicBody), 1, 1);
  std::mt19937 random(1);  // seed 1
  const auto bits = [&]() -> std::uint16_t {
    const auto few = static_cast<std::uint16_t>(random() & random());
    return random() % 3 == 0 ? 0xFFFF : few;
  };
  b2ContactFilter rule;
  int collisions = 0;
  for (int round = 0; round < 10000; ++round) {
    for (b2Fixture* fixture : {a, b}) {
      b2Filter filter;
      filter.categoryBits = bits();
      filter.maskBits = bits();
      filter.groupIndex = static_cast<std::int16_t>(static_cast<int>(random() % 5) - 2);
      fixture->SetFilterData(filter);
    }
    const bool expected = rule.ShouldCollide(a, b);
    ASSERT_EQ(collide(filter_of(*a), filter_of(*b)), expected) << "round " << round;
    collisions += expected;
  }
  EXPECT_GT(collisions, 2000);
  EXPECT_LT(collisions, 8000);
  a->SetFilterData({});
  EXPECT_EQ(filter_of(*a), Filter{}) << "steps without filters stay fast";
}

TEST(WorldScenery, a_hero_goes_through_what_its_fixture_does_not_collide_with) {
  b2World world({0, -10});
  add_box(new_body(world, b2_staticBody, {0, -1}), 20, 1);
  b2Fixture* const wall = add_box(new_body(world, b2_staticBody, {4, 2}), 0.5F, 2);
  b2Filter of_wall;
  of_wall.categoryBits = 8;
  wall->SetFilterData(of_wall);
  b2Fixture* const hero_fixture = add_box(new_body(world, b2_kinematicBody, {0, 2}), 0.3F, 0.6F);
  const WorldScenery borrowed = scenery_of(world);
  const Scenery scenery(borrowed.scenery);
  const Controller controller(scenery, CharacterDef{});
  Scratch<> scratch = controller.make_scratch();
  StepReport<> report;
  for (const bool is_ghost : {false, true}) {
    b2Filter of_hero;
    if (is_ghost) of_hero.maskBits = static_cast<std::uint16_t>(~8);
    hero_fixture->SetFilterData(of_hero);
    const ColliderFilter filter{filter_of(*hero_fixture)};
    CharacterState<> hero;
    hero.position = {0, 2};
    for (int step = 0; step < 120; ++step)
      controller.step(hero, {.move = 1.0}, {{0, -10}, frame, {}, &filter}, scratch, report);
    EXPECT_EQ(hero.position.x() > 5, is_ghost);
    EXPECT_TRUE(hero.grounded);
  }
}

TEST(WorldScenery, shapes_arrive_in_world_coordinates) {
  b2World world({0, 0});
  b2Body* const turned = new_body(world, b2_staticBody, {3, 4}, b2_pi / 2);
  add_box(turned, 2, 1);
  b2EdgeShape edge;
  edge.SetTwoSided({0, 0}, {1, 0});
  turned->CreateFixture(&edge, 0);
  const WorldScenery read = scenery_of(world);
  Box2<double> box{read.scenery.colliders[0].points[0], read.scenery.colliders[0].points[0]};
  for (const Vec2d& point : read.scenery.colliders[0].points) box = box.merged({point, point});
  EXPECT_LT((box.lower - Vec2d(3 - 1, 4 - 2)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((box.upper - Vec2d(3 + 1, 4 + 2)).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(read.scenery.colliders[1].shape, ColliderDef::Shape::chain);
  EXPECT_LT((read.scenery.colliders[1].points[1] - Vec2d(3, 5)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(WorldScenery, a_loop_arrives_closed_and_the_controller_accepts_it) {
  b2World world({0, 0});
  const std::array<b2Vec2, 4> corners{b2Vec2(0, 0), b2Vec2(4, 0), b2Vec2(4, 3), b2Vec2(0, 3)};
  b2ChainShape loop;
  loop.CreateLoop(corners.data(), 4);
  new_body(world, b2_staticBody)->CreateFixture(&loop, 0);
  const WorldScenery read = scenery_of(world);
  ASSERT_EQ(read.scenery.colliders[0].points.size(), 5U);
  EXPECT_EQ(read.scenery.colliders[0].points.front(), read.scenery.colliders[0].points.back());
  EXPECT_EQ(Scenery<double>(read.scenery).pieces().size(), 4U);
}

TEST(WorldScenery, a_circle_is_exactly_that_circle) {
  b2World world({0, 0});
  b2CircleShape circle;
  circle.m_p = {1, 0};
  circle.m_radius = 0.1F;
  new_body(world, b2_staticBody, {10, 20})->CreateFixture(&circle, 0);
  const ColliderDef read = scenery_of(world).scenery.colliders.at(0);
  EXPECT_EQ(read.shape, ColliderDef::Shape::circle);
  EXPECT_EQ(read.points, (std::vector<Vec2d>{{11, 20}}));
  EXPECT_EQ(read.radius, static_cast<double>(0.1F));
}

}  // namespace
}  // namespace paperproof::box2d::test
