/// Bodies of a world that a game owns, which carry and push the controller.
#include "bodies.hpp"
#include "float_geometry.hpp"
#include "worlds.hpp"

#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/paperproof.hpp>

#include <gtest/gtest.h>

#include <optional>

namespace paperproof::box2d::test {
namespace {

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
    controller.step(hero, {.move = 0.0, .jump = false}, {{0, -10}, static_cast<double>(dt), motions}, scratch, report);
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
    controller.step(hero, {.move = 0.0, .jump = false}, {{0, -10}, static_cast<double>(dt), motions}, scratch, report);
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

TEST(WorldMovers, that_are_disabled_or_asleep_stay_as_in_box2d) {
  b2World world({0, -10});
  b2Body* const lift = new_body(world, b2_kinematicBody, {1, 2});
  add_box(lift, 2, 1);
  b2Body* const crate = new_body(world, b2_dynamicBody, {9, 9});
  add_box(crate, 1, 1);
  const WorldScenery read = scenery_of(world, {.movers = [](const b2Body&) { return true; }});
  ASSERT_EQ(read.movers.size(), 2U);
  std::vector<MoverMotion<double>> motions(2);
  crate->SetEnabled(false);
  const auto expect_rest = [&](const char* who) {
    EXPECT_TRUE(motions_of<double>(read, 0.01F, motions)) << who;
    world.Step(0.01F, 8, 3);
    EXPECT_EQ(lift->GetPosition(), b2Vec2(1, 2)) << who;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(motions[i].from, widened(read.movers[i]->GetPosition())) << who;
      EXPECT_EQ(motions[i].to, motions[i].from) << who;
    }
  };
  lift->SetLinearVelocity({0, 1});
  lift->SetAngularVelocity(1);
  lift->SetEnabled(false);
  expect_rest("disabled, with velocities");
  lift->SetEnabled(true);
  lift->SetAwake(false);
  expect_rest("asleep");
  lift->SetLinearVelocity({0, 1});
  EXPECT_TRUE(motions_of<double>(read, 0.01F, motions));
  EXPECT_GT(motions[0].to.y(), 2) << "that woke it";
  lift->SetEnabled(false);
  EXPECT_EQ(scenery_of(world, {.movers = [](const b2Body&) { return true; }}).movers.size(), 0U);
}

bool is_steady_lift(const b2Body& body) {
  return body.GetType() == b2_kinematicBody && body.GetFixtureList() != nullptr && body.GetAngularVelocity() == 0;
}

/// What comes of reading the world.
struct Level {
  explicit Level(b2World& world) : borrowed(scenery_of(world, {.movers = is_steady_lift})) {}
  WorldScenery borrowed;
  Scenery<double> scenery{borrowed.scenery};
  Controller<double> controller{scenery, CharacterDef{}};
  Scratch<double> scratch = controller.make_scratch();
  std::vector<MoverMotion<double>> motions = std::vector<MoverMotion<double>>(borrowed.movers.size());
};

TEST(WorldMovers, that_turn_are_named_and_the_hero_goes_on_without_them) {
  b2World world({0, -10});  // the game's
  b2Body* const far_away = new_body(world, b2_kinematicBody, {30, 0});
  add_box(far_away, 3, 0.5F);
  b2Body* const lift = new_body(world, b2_kinematicBody, {0, -0.5F});
  add_box(lift, 3, 0.5F);
  lift->SetLinearVelocity({1, 0.5F});
  const auto dt = static_cast<float>(frame);
  StepReport<double> report;
  CharacterState<double> hero;
  hero.position = {0, half_height() + 0.01};

  std::optional<Level> level(world);
  int times_read = 1;
  for (int i = 0; i < 180; ++i) {
    if (i == 60) far_away->SetAngularVelocity(1);
    if (i == 120) {  // the game knows when what it turned stands again
      far_away->SetAngularVelocity(0);
      level.emplace(world);
      ++times_read;
    }
    EXPECT_EQ(first_turned(level->borrowed), i == 60 ? far_away : nullptr) << i;
    if (!motions_of<double>(level->borrowed, dt, level->motions)) {
      level.emplace(world);
      ++times_read;
      ASSERT_TRUE(motions_of<double>(level->borrowed, dt, level->motions)) << i;
    }
    EXPECT_EQ(level->borrowed.movers.size(), i >= 60 && i < 120 ? 1U : 2U) << i;
    const StepStatus status = level->controller.step(
        hero, {.move = 0.0}, {{0, -10}, static_cast<double>(dt), level->motions}, level->scratch, report);
    EXPECT_EQ(status, StepStatus::moved) << i;
    world.Step(dt, 8, 3);
    if (i < 30) continue;  // it falls, and is taken along
    EXPECT_TRUE(hero.grounded) << i;
    EXPECT_NEAR(hero.position.y() - widened(lift->GetPosition()).y(), 0.5 + half_height(), 2e-6) << i;
    EXPECT_NEAR(hero.velocity.x(), 1, 1e-5) << i;
  }
  EXPECT_EQ(times_read, 3);
  EXPECT_GT(far_away->GetAngle(), 0.9F);
}

TEST(WorldMovers, that_are_put_elsewhere_take_nobody_along_before_places_of_and_do_after) {
  for (const bool before : {true, false}) {
    b2World world({0, -10});
    b2Body* const lift = new_body(world, b2_kinematicBody, {0, -0.5F});
    add_box(lift, 3, 0.5F);
    Level level(world);
    StepReport<double> report;
    CharacterState<double> hero;
    hero.position = {0, half_height() + 5e-7};
    std::vector<Vec2d> places(1);
    for (int i = 0; i < 10; ++i) {
      if (i == 9 && before) lift->SetTransform({20, -0.5F}, 0);
      places_of(level.borrowed, places);
      world.Step(static_cast<float>(frame), 8, 3);
      if (i == 9 && !before) lift->SetTransform({20, -0.5F}, 0);
      ASSERT_TRUE(motions_since<double>(level.borrowed, places, level.motions));
      level.controller.step(hero, {.move = 0.0}, {{0, -10}, frame, level.motions}, level.scratch, report);
    }
    EXPECT_NEAR(hero.position.x(), before ? 0 : 20, 1e-9);
    EXPECT_NEAR(hero.velocity.x(), before ? 0 : 20 / frame, 1e-6);
    EXPECT_EQ(hero.grounded, !before);
  }
}

/// A hero among crates, with a kinematic body of its own that follows it.
struct CrateGame {
  /// @param sensor whether Box2D leaves the hero to the controller.
  CrateGame(bool sensor, const b2Vec2& crate_at) {
    add_box(new_body(world, b2_staticBody, {0, -1}), 50, 1);
    hero.position = {0, half_height() + 5e-7};
    hero_body = new_body(world, b2_kinematicBody, {0, static_cast<float>(half_height())});
    b2PolygonShape shape;
    shape.SetAsBox(0.3125F, static_cast<float>(half_height()));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.isSensor = sensor;  // what the controller handles Box2D does not handle once more
    hero_body->CreateFixture(&fixture);
    crate = new_body(world, b2_dynamicBody, crate_at);
    crate->SetFixedRotation(true);
    add_box(crate, 0.5F, 0.5F);
  }

  /// @returns how many steps the hero was crushed.
  int run(int steps, double move) {
    const WorldScenery borrowed = scenery_of(world, {.movers = [this](const b2Body& body) { return &body == crate; }});
    const Scenery<double> scenery(borrowed.scenery);
    const Controller<double> controller(scenery, CharacterDef{});
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    std::vector<Vec2d> places(1);
    std::vector<MoverMotion<double>> motions(1);
    int crushes = 0;
    for (int i = 0; i < steps; ++i) {
      places_of(borrowed, places);
      world.Step(static_cast<float>(frame), 8, 3);
      EXPECT_TRUE(motions_since<double>(borrowed, places, motions));
      controller.step(hero, {.move = move}, {{0, -10}, frame, motions}, scratch, report);
      crushes += report.move.crushed.empty() ? 0 : 1;
      const Vec2d way = hero.position - widened(hero_body->GetPosition());
      hero_body->SetLinearVelocity({static_cast<float>(way.x() / frame), static_cast<float>(way.y() / frame)});
    }
    return crushes;
  }

  b2World world{{0, -10}};
  b2Body* hero_body = nullptr;
  b2Body* crate = nullptr;
  CharacterState<double> hero;
};

TEST(WorldMovers, that_are_crates_are_pushed_by_the_heros_body_unless_that_is_a_sensor) {
  const double stop = 3 - 0.5 - CharacterDef{}.shape.box().upper.x();  // at the crate's left side
  CrateGame box2d_pushes(false, {3, 0.51F});
  box2d_pushes.run(240, 1);
  EXPECT_GT(box2d_pushes.crate->GetPosition().x, 4);
  EXPECT_LT(box2d_pushes.hero.position.x(), 0.5 * CharacterDef{}.walk_speed * 240 * frame) << "it creeps behind";
  CrateGame game_pushes(true, {3, 0.51F});
  game_pushes.run(240, 1);
  EXPECT_EQ(game_pushes.crate->GetPosition().x, 3);
  EXPECT_NEAR(game_pushes.hero.position.x(), stop, 2e-6);
}

TEST(WorldMovers, that_are_crates_crush_the_hero_unless_they_rest_on_its_body) {
  CrateGame rests_on_body(false, {0, 4});
  EXPECT_EQ(rests_on_body.run(120, 0), 0);
  EXPECT_NEAR(rests_on_body.crate->GetPosition().y, 2 * half_height() + 0.5, 0.03) << "on its head";
  CrateGame falls(true, {0, 4});
  EXPECT_GT(falls.run(120, 0), 0);
  EXPECT_NEAR(falls.crate->GetPosition().y, 0.5, 0.03) << "on the floor";
}

}  // namespace
}  // namespace paperproof::box2d::test
