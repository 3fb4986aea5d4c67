/// The recipes of box2d_adapter/recipes.md, as printed: recipes.inc holds its blocks of code.
#include <array>
#include <cmath>
#include <cstdint>

#include "recipes.inc"

#include "hero_world.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

TEST(Recipe, marks_the_body_and_knows_its_ground) {
  OnFloor game;
  Player player;
  mark(game.hero, player);
  EXPECT_EQ(player_of(*game.hero.body().GetFixtureList()), &player);
  b2Fixture& other = game.box(b2_staticBody, {9, 9}, 1, 1);
  game.run(3);
  EXPECT_TRUE(is_on(game.hero, *game.ground.GetBody()));
  EXPECT_FALSE(is_on(game.hero, *other.GetBody()));
}

TEST(Recipe, takes_coins) {
  OnFloor game;
  for (const float x : {1.0F, 2.0F, 3.0F}) game.sensor({x, 0.5F}, 0.1F).GetUserData().pointer = coin;
  int taken = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({.move = 1.0});
    taken += take_coins(game.world, game.hero);
  }
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(game.world.GetBodyCount(), 2);
}

TEST(Recipe, decides_what_a_fixture_is) {
  OnFloor game;
  game.hero = make_hero(game.world);
  b2Fixture& door = game.box(b2_staticBody, {3, 2}, 0.1F, 2);
  game.run(90, {.move = 1.0});
  EXPECT_NEAR(game.x(), 2.9 - half_width, 1e-5);
  door.GetUserData().pointer = open_door;
  game.run(60, {.move = 1.0});
  EXPECT_GT(game.x(), 3);
  game.ground.GetUserData().pointer = conveyor;
  game.run(30);
  EXPECT_NEAR(game.hero.velocity().x(), 1.5, 1e-9);
  game.ground.GetUserData().pointer = ledge;
  game.go({.drop = true});
  game.run(60, {});
  EXPECT_LT(game.feet(), -2);
}

TEST(Recipe, dashes_and_knocks_back) {
  OnFloor game;
  dash(game.hero, 1);
  game.run(6, Input{});
  EXPECT_NEAR(game.x(), 25 * 6 * frame, 1e-9);
  respawn(game.hero, {0, half_height + 1e-6});
  hurt(game.hero, {1, 0});
  game.run(12, Input{});
  EXPECT_FALSE(game.hero.grounded());
  EXPECT_NEAR(game.x(), -6 * 12 * frame, 1e-6);
}

TEST(Recipe, respawns) {
  OnFloor game;
  b2Fixture& crate = game.box(b2_dynamicBody, {1, 0.51F}, 0.5F, 0.5F, 1);
  game.run(60, {.move = 1.0});
  ASSERT_TRUE(game.touches(crate));
  const float x = crate.GetBody()->GetPosition().x;
  respawn(game.hero, {-20, half_height + 1e-6});
  EXPECT_EQ(game.hero.velocity(), Vec2d(0, 0));
  game.run(120);
  EXPECT_NEAR(game.x(), -20, 1e-9);
  const double slides = 6.0 * 6.0 / (2 * 0.2 * 10);  // by its own speed, with the friction of Box2D
  EXPECT_NEAR(crate.GetBody()->GetPosition().x - x, slides / 2, slides / 2) << "it is not dragged along";
}

TEST(Recipe, crouches_under_a_ceiling) {
  OnFloor game;
  game.box(b2_staticBody, {3, 1.7F}, 2, 0.5F);
  EXPECT_TRUE(crouch(game.hero, true, false));
  game.run(60, {.move = 1.0});
  ASSERT_NEAR(game.x(), 2, 0.4);
  EXPECT_TRUE(crouch(game.hero, false, true)) << "it stood up in a ceiling";
  game.run(180, {.move = 1.0});
  EXPECT_FALSE(crouch(game.hero, false, true));
}

TEST(Recipe, crouches_on_every_slope) {
  for (const float degrees : {-45.0F, -15.0F, 1.0F, 30.0F, 45.0F}) {
    Game game({.position = {0, 1.5}});
    b2Body* slope = game.box(b2_staticBody, {0, -1}, 30, 1).GetBody();
    slope->SetTransform({0, -1}, degrees * static_cast<float>(compare::degree));
    game.run(60);
    EXPECT_TRUE(game.hero.grounded() && crouch(game.hero, true, false)) << degrees;
    EXPECT_FALSE(crouch(game.hero, false, true)) << degrees;
  }
}

TEST(Recipe, bounces_on_a_trampoline) {
  Game game({.position = {0, half_height + 0.01}});
  game.floor().GetUserData().pointer = 7;
  double highest = 0;
  for (int i = 0; i < 180; ++i) {
    game.go();
    highest = std::max(highest, game.feet());
    bounce(game.hero, 7);
  }
  EXPECT_NEAR(highest, 15.0 * 15 / 20, 0.2);
}

TEST(Recipe, slides_on_ice) {
  OnFloor game;
  game.run(2);
  bool is_on_ice = false;
  for (const bool is_ice : {true, false}) {
    game.ground.GetUserData().pointer = is_ice ? 7 : 0;
    walk_on(game.hero, 7, is_on_ice);
    EXPECT_EQ(is_on_ice, is_ice);
    game.hero.set_velocity({6, 0});
    game.run(30);
    EXPECT_NEAR(6 - game.hero.velocity().x(), is_ice ? 4 * 0.5 : 6, 1e-9) << "braked in half a second";
  }
}

TEST(Recipe, climbs_a_ladder) {
  OnFloor game;
  game.box(b2_staticBody, {0, 6}, 1, 0.5F);
  for (int i = 0; i < 120; ++i) {
    game.world.Step(static_cast<float>(frame), 8, 3);
    climb(game.hero, 0, 1, frame);
  }
  EXPECT_NEAR(game.hero.position().y(), 5.5 - half_height, 1e-6);
}

TEST(Recipe, steps_two_heroes) {
  OnFloor game;
  Hero second(game.world, {.position = {3, half_height + 1e-6}});
  for (int i = 0; i < 120; ++i) frame_of_two(game.world, game.hero, {.move = 1.0}, second, {.move = -1.0}, 1.0F / 60);
  EXPECT_NEAR(second.position().x() - game.x(), 2 * half_width, 1e-4);
  const auto is_second = [&](const HeroContact& contact) { return contact.fixture->GetBody() == &second.body(); };
  EXPECT_TRUE(std::ranges::any_of(game.hero.contacts(), is_second)) << "Box2D's listener does not hear of it";
}

TEST(Recipe, rolls_back) {
  Game game({.position = {0, 1.8}});
  b2Body* lift = game.box(b2_kinematicBody, {0, 1}, 5, 0.1F).GetBody();
  lift->SetLinearVelocity({0.3F, 0.2F});
  game.run(40, {.move = 1.0});
  const Saved saved = save(game.hero, *lift);
  game.run(40, {.move = -1.0, .jump = true});
  const CharacterState first = game.hero.state();
  restore(game.hero, *lift, saved);
  game.run(40, {.move = -1.0, .jump = true});
  EXPECT_EQ(game.hero.state(), first);
}

TEST(Recipe, shifts_the_origin) {
  OnFloor game({.position = {60, 0}});
  game.run(5);
  recentre(game.world, game.hero);
  game.run(5);
  EXPECT_NEAR(game.x(), 0, 0.5);
  EXPECT_TRUE(game.hero.grounded());
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
