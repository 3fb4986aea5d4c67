/// A hero when the game changes its shape, restores a save, or edits fixtures in place.
#include "hero_world.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

TEST(Hero, has_the_shape_and_the_body_of_the_save_after_a_restore) {
  OnFloor game;
  b2Body* crate = game.box(b2_dynamicBody, {0.85F, 0.5F}, 0.5F, 0.5F, 0.5F).GetBody();
  game.hero.body().GetFixtureList()->GetUserData().pointer = 42;
  ASSERT_TRUE(game.hero.change(low()));
  EXPECT_EQ(game.hero.body().GetFixtureList()->GetUserData().pointer, 42U) << "it is the game's";
  EXPECT_NEAR(game.hero.position().y(), 0.3 + 1e-6, 1e-9) << "the feet stay where they are";
  game.run(30, {.move = 1.0});
  ASSERT_GT(crate->GetPosition().x, 0.9F) << "it is pushed";
  const HeroSave save = game.hero.save();
  const b2Vec2 place = game.hero.body().GetPosition();
  const b2Vec2 velocity = game.hero.body().GetLinearVelocity();
  game.run(30, {.move = -1.0});
  ASSERT_TRUE(game.hero.change(CharacterDef{}));
  game.hero.restore(save);
  EXPECT_EQ(game.hero.body().GetPosition(), place);
  EXPECT_EQ(game.hero.body().GetLinearVelocity(), velocity);
  EXPECT_FALSE(game.hero.body().IsBullet());
  game.run(20);
  EXPECT_NEAR(game.hero.position().y(), 0.3, 1e-5);
  EXPECT_TRUE(game.hero.grounded());
}

/// Where it was free last goes along with its shape: else it would come out on the side of where it stood, on top.
TEST(Hero, comes_out_beside_a_low_box_that_the_game_moves_into_it_when_it_has_crouched) {
  OnFloor game;
  b2Body& low_box = *game.box(b2_staticBody, {-3, 0.15F}, 0.5F, 0.15F).GetBody();
  game.run(5);
  ASSERT_TRUE(game.hero.change(low()));
  low_box.SetTransform({-0.55F, 0.15F}, 0);
  game.go();
  EXPECT_NEAR(game.x(), -0.05 + 0.3, 1e-5);
}

/// Of a long chain every second vertex was compared.
TEST(Hero, sees_a_long_chain_that_was_dug_in_place_at_any_vertex) {
  for (const int dug : {750, 751, 752, 753}) {
    std::vector<b2Vec2> points;
    for (int i = 0; i < 1500; ++i) points.emplace_back(static_cast<float>(750 - i), 0.0F);
    Game game({.position = {static_cast<double>(750 - dug), half_height + 1e-6}});
    b2ChainShape chain;
    chain.CreateChain(points.data(), 1500, {751, 0}, {-750, 0});
    b2Fixture& fixture = game.add(b2_staticBody, {0, 0}, chain);
    game.run(5);
    chain.m_vertices[dug].y = -1;
    b2Body* ground = fixture.GetBody();
    ground->DestroyFixture(&fixture);
    ground->CreateFixture(&chain, 0);
    game.run(5);
    EXPECT_LT(game.feet(), -0.01) << "vertex " << dug;
  }
}

/// A game makes a fixture anew on its body, with the shape that it has changed.
TEST(Hero, sees_a_circle_that_was_made_smaller_or_larger_in_place) {
  for (const auto& [before, after] : {std::pair{0.5F, 0.25F}, {0.25F, 0.5F}}) {
    Game game({.position = {0, half_height + static_cast<double>(before) + 1e-6}});
    b2CircleShape circle;
    circle.m_radius = before;
    b2Fixture& fixture = game.add(b2_staticBody, {0, 0}, circle);
    game.run(5);
    ASSERT_TRUE(game.hero.grounded());
    circle.m_radius = after;
    b2Body* ground = fixture.GetBody();
    ground->DestroyFixture(&fixture);
    ground->CreateFixture(&circle, 0);
    game.run(30);
    EXPECT_NEAR(game.feet(), after, 1e-4) << before;
  }
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
