/// What small games with Box2D need of a hero, where no other test shows it. `controller/coming_from.md` lists all of
/// it.
#include "hero_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::box2d::hero_test {
namespace {

TEST(HeroSituation, a_press_crushes_and_is_named_until_it_goes_back) {
  Game game({.position = {0, half_height + 1e-6}});
  b2Fixture& floor = game.floor();
  b2Fixture& press = game.box(b2_kinematicBody, {0, 2.003F}, 1, 0.5F);
  press.GetBody()->SetLinearVelocity({0, -1});  // 0.253 m above the head
  int frames = 0;
  while (game.go() == StepStatus::moved && frames < 60) ++frames;
  EXPECT_NEAR(frames * frame, 0.253, frame);
  EXPECT_EQ(game.hero.report().status, StepStatus::crushed);
  ASSERT_EQ(game.hero.crushed_by().size(), 1U);
  EXPECT_EQ(game.hero.crushed_by()[0], &press);
  game.run(5);
  EXPECT_EQ(game.hero.report().status, StepStatus::stuck);
  press.GetBody()->SetLinearVelocity({0, 2});
  game.run(30);
  EXPECT_EQ(game.hero.report().status, StepStatus::moved);
  EXPECT_EQ(game.hero.ground(), &floor);
}

TEST(HeroSituation, stairs_are_walked_up_and_down_on_the_ground) {
  CharacterDef character;
  character.step_height = character.snap = 0.25;
  Game game({.character = character, .position = {-1, half_height + 1e-6}});
  game.floor();
  for (int i = 0; i < 10; ++i) {
    const float height = 0.1F * static_cast<float>(std::min(i, 9 - i) + 1);
    game.box(b2_staticBody, {static_cast<float>(i) * 0.4F + 1.2F, height}, 0.2F, height);
  }
  game.run(10, {.move = 0.5});
  double highest = 0;
  for (int i = 0; i < 150; ++i) {
    const double before = game.hero.position().x();
    game.go({.move = 0.5});
    ASSERT_TRUE(game.hero.grounded()) << "at " << before;
    ASSERT_NEAR(game.hero.position().x() - before, 3 * frame, 1e-3) << "at " << before;
    highest = std::max(highest, game.hero.position().y());
  }
  EXPECT_NEAR(highest, 1 + half_height, 1e-5);
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-5);
}

TEST(HeroSituation, nobody_hangs_at_a_corner_with_the_key_held) {
  for (const double below_the_edge : {-0.6, -0.3, 0.0, 0.1, 0.3, 0.6}) {
    Game game({.position = {0, 3 + below_the_edge}});
    game.floor();
    game.box(b2_staticBody, {2.3125F, 2.5F}, 2, 0.5F);  // its corner is at (0.3125, 3), where the hero's side is
    game.run(90, {.move = 1.0});
    const bool is_on_top = game.hero.position().y() > 3;
    EXPECT_NEAR(game.hero.position().y(), (is_on_top ? 3 : 0) + half_height, 1e-5) << below_the_edge;
    EXPECT_TRUE(game.hero.grounded());
  }
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
