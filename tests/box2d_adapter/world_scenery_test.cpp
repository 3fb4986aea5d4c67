/// The controller over a world that a game owns.
#include "float_geometry.hpp"
#include "worlds.hpp"

#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/paperproof.hpp>

#include <box2d/box2d.h>

#include <gtest/gtest.h>

namespace paperproof::box2d::test {
namespace {

b2Body* new_body(b2World& world, b2BodyType type, const b2Vec2& position = {0, 0}, float angle = 0) {
  b2BodyDef def;
  def.type = type;
  def.position = position;
  def.angle = angle;
  return world.CreateBody(&def);
}

b2Fixture* add_box(b2Body* body, float half_width, float half_height_of_box) {
  b2PolygonShape shape;
  shape.SetAsBox(half_width, half_height_of_box);
  return body->CreateFixture(&shape, 1);
}

TEST(WorldScenery, ten_lines_put_the_controller_into_a_box2d_game) {
  b2World world({0, -10});  // the game's
  b2Fixture* const floor = add_box(new_body(world, b2_staticBody, {0, -1}), 20, 1);
  b2Fixture* const wall = add_box(new_body(world, b2_staticBody, {6, 2}), 0.5F, 2);
  b2Body* const hero_body = new_body(world, b2_kinematicBody, {0, 2});
  std::vector<b2Fixture*> touched;
  const double dt = frame;

  const WorldScenery borrowed = scenery_of(world);  // once per level
  const Scenery<double> scenery(borrowed.scenery);
  const Controller<double> controller(scenery, CharacterDef{});
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> hero;
  hero.position = {0, 2};
  for (int i = 0; i < 240; ++i) {  // every frame, before world.Step
    controller.step(hero, {.move = 1.0, .jump = false}, {0, -10}, dt, scratch, report);
    const Vec2d way = hero.position - Vec2d(hero_body->GetPosition().x, hero_body->GetPosition().y);
    hero_body->SetLinearVelocity({static_cast<float>(way.x() / dt), static_cast<float>(way.y() / dt)});
    for (const Contact<double>& contact : report.move.contacts) touched.push_back(borrowed.fixtures[contact.collider]);
    world.Step(static_cast<float>(dt), 8, 3);
  }

  const double half_width = CharacterDef{}.shape.box().upper.x();
  EXPECT_TRUE(hero.grounded);
  EXPECT_NEAR(hero.position.y(), half_height(), 2e-6);
  EXPECT_NEAR(hero.position.x(), 6 - 0.5 - half_width, 2e-6);
  EXPECT_NEAR(static_cast<double>(hero_body->GetPosition().x), hero.position.x(), 1e-4);
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

TEST(WorldScenery, the_polygon_around_a_circle_encloses_it_within_half_a_percent) {
  b2World world({0, 0});
  b2CircleShape circle;
  circle.m_p = {1, 0};
  circle.m_radius = 2;
  new_body(world, b2_staticBody, {10, 20})->CreateFixture(&circle, 0);
  const std::vector<Vec2d> corners = scenery_of(world).scenery.colliders.at(0).points;
  const Vec2d centre(11, 20);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d corner = corners[i] - centre;
    const Vec2d middle = (corners[i] + corners[(i + 1) % corners.size()]) / 2 - centre;
    EXPECT_GE(std::sqrt(middle.squaredNorm()), 2 - 1e-12);
    EXPECT_LE(std::sqrt(corner.squaredNorm()), 2 * 1.005);
  }
  EXPECT_THROW((void)scenery_of(world, {.circle_corners = 2}), InvalidDefinition);
}

TEST(WorldMovers, are_the_bodies_asked_for_and_no_others) {
  b2World world({0, 0});
  add_box(new_body(world, b2_staticBody), 1, 1);
  add_box(new_body(world, b2_kinematicBody, {0, 9}), 1, 1);  // the hero
  new_body(world, b2_kinematicBody, {5, 5});                 // has no fixtures
  b2Body* const lift = new_body(world, b2_kinematicBody, {3, 4}, b2_pi / 2);
  b2Fixture* const deck = add_box(lift, 2, 1);
  b2Fixture* const zone = add_box(lift, 4, 4);
  zone->SetSensor(true);
  add_box(new_body(world, b2_dynamicBody, {8, 8}), 1, 1);
  EXPECT_TRUE(scenery_of(world).movers.empty());

  const WorldScenery read = scenery_of(world, {.filter = [](const b2Fixture&) { return true; },
                                               .movers = [](const b2Body& body) { return body.GetPosition().y < 6; }});
  EXPECT_EQ(read.movers, std::vector<b2Body*>{lift});
  ASSERT_EQ(read.fixtures.size(), 3U);
  EXPECT_EQ(read.fixtures[1], deck);
  const std::vector<ColliderDef>& colliders = read.scenery.colliders;
  EXPECT_EQ(colliders[0].mover, no_mover);
  EXPECT_EQ(colliders[1].mover, 0U);
  EXPECT_TRUE(!colliders[1].sensor && colliders[2].sensor && colliders[2].mover == 0);
  // Turned, around its own origin: 4 m wide became 4 m high.
  for (const Vec2d& point : colliders[1].points) EXPECT_NEAR(std::abs(point.y()), 2, 1e-6);
  EXPECT_EQ(Scenery<double>(read.scenery).mover_count(), 1U);
}

TEST(WorldMovers, go_as_box2d_moves_them_to_the_bit) {
  b2World world({0, -10});
  b2Body* const lift = new_body(world, b2_kinematicBody, {0.1F, 1000.3F});
  add_box(lift, 2, 1);
  const WorldScenery read = scenery_of(world, {.movers = [](const b2Body&) { return true; }});
  std::vector<MoverMotion<double>> motions(1);
  std::vector<MoverMotion<float>> rounded_motions(1);
  Random random(5);
  const float dt = 1 / 60.0F;
  for (int step = 0; step < 1000; ++step) {
    // Now and then more than the 2 m that Box2D moves at most.
    const double speed = random.between(0, step % 10 == 0 ? 300 : 50);
    const Vec2d velocity = speed * random.direction();
    lift->SetLinearVelocity({static_cast<float>(velocity.x()), static_cast<float>(velocity.y())});
    ASSERT_TRUE(motions_of<double>(read, dt, motions));
    ASSERT_TRUE(motions_of<float>(read, dt, rounded_motions));
    EXPECT_EQ(motions[0].from, widened(lift->GetPosition()));
    world.Step(dt, 8, 3);
    EXPECT_EQ(motions[0].to, widened(lift->GetPosition())) << step;
    EXPECT_EQ(rounded_motions[0].to.cast<double>(), motions[0].to);
  }
}

TEST(WorldMovers, carry_the_games_hero) {
  b2World world({0, -10});  // the game's
  add_box(new_body(world, b2_staticBody, {0, -3}), 20, 1);
  b2Body* const lift = new_body(world, b2_kinematicBody, {0, -0.5F});
  add_box(lift, 3, 0.5F);
  b2Body* const hero_body = new_body(world, b2_kinematicBody, {0, 1});
  add_box(hero_body, 0.3F, 0.6F);
  const auto dt = static_cast<float>(frame);

  const WorldScenery borrowed =
      scenery_of(world, {.movers = [hero_body](const b2Body& body) { return &body != hero_body; }});
  const Scenery<double> scenery(borrowed.scenery);
  const Controller<double> controller(scenery, CharacterDef{});
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> hero;
  hero.position = {0, half_height() + 0.1};
  std::vector<MoverMotion<double>> motions(borrowed.movers.size());
  for (int i = 0; i < 600; ++i) {
    const double angle = 0.02 * i;
    lift->SetLinearVelocity({2 * static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
    ASSERT_TRUE(motions_of<double>(borrowed, dt, motions));
    controller.step(hero, {.move = 0.0, .jump = false}, {0, -10}, static_cast<double>(dt), motions, scratch, report);
    world.Step(dt, 8, 3);
    const Vec2d place = hero.position - widened(lift->GetPosition());
    if (i < 60) continue;  // it falls, and is taken along
    EXPECT_TRUE(hero.grounded) << i;
    EXPECT_NEAR(place.y(), 0.5 + half_height(), 2e-6) << i;
    EXPECT_LT(std::abs(place.x()), 1) << i;
  }
}

TEST(WorldMovers, that_are_dynamic_carry_the_games_hero_after_the_world_has_stepped) {
  b2World world({0, -10});  // the game's
  add_box(new_body(world, b2_staticBody, {0, -3}), 20, 1);
  std::vector<b2Body*> crates;
  for (const float y : {-1.4F, -0.3F, 0.9F}) {
    crates.push_back(new_body(world, b2_dynamicBody, {0, y}));
    crates.back()->SetFixedRotation(true);
    add_box(crates.back(), 1, 0.5F);
  }
  const auto dt = static_cast<float>(frame);

  const WorldScenery borrowed =
      scenery_of(world, {.movers = [](const b2Body& body) { return body.IsFixedRotation(); }});
  ASSERT_EQ(borrowed.movers, crates);
  const Scenery<double> scenery(borrowed.scenery);
  const Controller<double> controller(scenery, CharacterDef{});
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> hero;
  hero.position = {0, 1.4 + half_height() + 0.1};
  std::vector<Vec2d> places(borrowed.movers.size());
  std::vector<MoverMotion<double>> motions(borrowed.movers.size());
  for (int i = 0; i < 600; ++i) {
    places_of(borrowed, places);
    world.Step(dt, 8, 3);
    ASSERT_TRUE(motions_since<double>(borrowed, places, motions));
    controller.step(hero, {.move = 0.0, .jump = false}, {0, -10}, static_cast<double>(dt), motions, scratch, report);
    if (i < 30) continue;                                                                  // all of them fall
    if (i == 200) crates[2]->ApplyLinearImpulseToCenter({crates[2]->GetMass(), 0}, true);  // 1 m/s, a kick
    EXPECT_TRUE(hero.grounded) << i;
    const Vec2d place = hero.position - widened(crates[2]->GetPosition());
    EXPECT_NEAR(place.y(), 0.5 + half_height(), 2e-6) << i;
    EXPECT_NEAR(place.x(), 0, 1e-6) << i;
  }
  EXPECT_GT(hero.position.x(), 0.1);
}

TEST(WorldMovers, that_are_dynamic_are_not_known_before_the_world_steps) {
  b2World world({0, -10});
  b2Body* const crate = new_body(world, b2_dynamicBody);
  crate->SetFixedRotation(true);
  add_box(crate, 1, 1);
  const WorldScenery read = scenery_of(world, {.movers = [](const b2Body&) { return true; }});
  std::vector<MoverMotion<double>> motions(1);
  EXPECT_FALSE(motions_of<double>(read, 0.01F, motions));
  const std::vector<Vec2d> places(1, Vec2d::Zero());
  EXPECT_TRUE(motions_since<double>(read, places, motions));
  crate->SetTransform({0, 0}, 0.1F);
  EXPECT_FALSE(motions_since<double>(read, places, motions));
}

TEST(WorldMovers, that_turn_are_no_longer_known) {
  b2World world({0, 0});
  b2Body* const door = new_body(world, b2_kinematicBody);
  add_box(door, 2, 1);
  const WorldScenery read = scenery_of(world, {.movers = [](const b2Body&) { return true; }});
  std::vector<MoverMotion<double>> motions(1);
  EXPECT_TRUE(motions_of<double>(read, 0.01F, motions));
  door->SetAngularVelocity(1);
  EXPECT_FALSE(motions_of<double>(read, 0.01F, motions));
  world.Step(0.01F, 8, 3);
  door->SetAngularVelocity(0);
  EXPECT_FALSE(motions_of<double>(read, 0.01F, motions));
  EXPECT_TRUE(motions_of<double>(scenery_of(world, {.movers = [](const b2Body&) { return true; }}), 0.01F, motions));
}

}  // namespace
}  // namespace paperproof::box2d::test
