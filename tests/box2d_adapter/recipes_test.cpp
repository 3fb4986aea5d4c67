/// The recipes of box2d_adapter/recipes.md, as printed: recipes.inc holds its blocks of code.
#include <array>
#include <cmath>
#include <cstdint>

#include "recipes.inc"

#include "hero_world.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

TEST(Recipe, marks_the_body) {
  Game game;
  Player player;
  mark(game.hero, player);
  EXPECT_EQ(player_of(*game.hero.body().GetFixtureList()), &player);
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

TEST(Recipe, dashes) {
  OnFloor game;
  dash(game.hero, 1);
  game.run(6, Input{});
  EXPECT_NEAR(game.x(), 25 * 6 * frame, 1e-9);
}

TEST(Recipe, knocks_back) {
  OnFloor game;
  game.run(5);
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
  EXPECT_TRUE(game.hero.grounded());
  const double slides = 6.0 * 6.0 / (2 * 0.2 * 10);  // by its own speed, with the friction of Box2D
  EXPECT_LT(static_cast<double>(crate.GetBody()->GetPosition().x - x), slides) << "it is not dragged along";
  EXPECT_GE(crate.GetBody()->GetPosition().x, x) << "it is not dragged along";
  EXPECT_FALSE(game.touches(crate));
}

TEST(Recipe, crouches_under_a_ceiling) {
  OnFloor game;
  game.box(b2_staticBody, {3, 1.7F}, 2, 0.5F);
  bool is_low = crouch(game.hero, true, false);
  ASSERT_TRUE(is_low);
  game.run(60, {.move = 1.0});
  ASSERT_NEAR(game.x(), 2, 0.4);
  is_low = crouch(game.hero, false, is_low);
  EXPECT_TRUE(is_low) << "it stood up in a ceiling";
  game.run(180, {.move = 1.0});
  is_low = crouch(game.hero, false, is_low);
  EXPECT_FALSE(is_low);
}

TEST(Recipe, crouches_on_every_slope) {
  for (const float degrees : {-45.0F, -15.0F, 1.0F, 30.0F, 45.0F}) {
    Game game({.position = {0, 1.5}});
    b2PolygonShape slope;
    slope.SetAsBox(30, 1, {0, -1}, degrees * static_cast<float>(compare::degree));
    game.add(b2_staticBody, {0, 0}, slope);
    game.run(60);
    ASSERT_TRUE(game.hero.grounded());
    EXPECT_TRUE(crouch(game.hero, true, false)) << degrees;
    EXPECT_FALSE(crouch(game.hero, false, true)) << degrees;
  }
}

TEST(Recipe, bounces_on_a_trampoline) {
  Game game({.position = {0, 3}});
  game.floor().GetUserData().pointer = 7;
  double highest = 0;
  for (int i = 0; i < 240; ++i) {
    game.go();
    bounce(game.hero, 7);
    if (i > 60) highest = std::max(highest, game.feet());
  }
  EXPECT_NEAR(highest, 15.0 * 15 / 20, 0.2);
}

TEST(Recipe, slides_on_ice) {
  OnFloor game;
  game.ground.GetUserData().pointer = 7;
  bool is_on_ice = false;
  game.run(2);
  const auto braked_in_half_a_second = [&] {
    walk_on(game.hero, 7, is_on_ice);
    game.hero.set_velocity({6, 0});
    game.run(30);
    return 6 - game.hero.velocity().x();
  };
  EXPECT_NEAR(braked_in_half_a_second(), 4 * 0.5, 1e-9);
  EXPECT_TRUE(is_on_ice);
  game.ground.GetUserData().pointer = 0;
  EXPECT_NEAR(braked_in_half_a_second(), 6, 1e-9);
  EXPECT_FALSE(is_on_ice);
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
  const CharacterState<double> first = game.hero.state();
  restore(game.hero, *lift, saved);
  game.run(40, {.move = -1.0, .jump = true});
  EXPECT_EQ(game.hero.state(), first);
}

TEST(Recipe, knows_its_ground) {
  OnFloor game;
  b2Fixture& other = game.box(b2_staticBody, {9, 9}, 1, 1);
  game.run(3);
  EXPECT_TRUE(is_on(game.hero, *game.ground.GetBody()));
  EXPECT_FALSE(is_on(game.hero, *other.GetBody()));
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
