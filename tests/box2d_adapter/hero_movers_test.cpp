/// A hero among what the game moves: lifts, presses, and bodies that it puts elsewhere at once.
#include "hero_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::box2d::hero_test {
namespace {

using compare::degree;

TEST(Hero, crouches_on_a_rising_lift_before_and_after_its_step) {
  Game game({.position = {0, 0.2 + half_height + 1e-6}});
  game.box(b2_kinematicBody, {0, 0.1F}, 2, 0.1F).GetBody()->SetLinearVelocity({0, 3});
  game.run(10);
  ASSERT_TRUE(game.hero.grounded());
  game.world.Step(static_cast<float>(frame), 8, 3);
  EXPECT_TRUE(game.hero.change(low()));
  game.hero.step({}, frame);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_TRUE(game.hero.change(CharacterDef{}));
  game.go();
  EXPECT_TRUE(game.hero.grounded());
}

/// The order of addresses must not matter: there is one before the lift, and one behind it.
TEST(Hero, stands_on_a_lift_between_edges_of_zero_length_and_names_them) {
  for (const b2BodyType type : {b2_staticBody, b2_kinematicBody}) {
    Game game({.position = {0, 1}});
    b2EdgeShape shape;
    shape.SetTwoSided({0.5F, 0.5F}, {0.5F, 0.5F});
    std::set<b2Fixture*> edges{&game.add(type, {-0.2F, 0.3F}, shape)};
    b2Body* lift = game.box(b2_kinematicBody, {0, 0.1F}, 1, 0.1F).GetBody();
    edges.insert(&game.add(type, {-0.3F, 0.3F}, shape));
    for (b2Fixture* edge : edges) edge->GetBody()->SetAngularVelocity(0.1F);
    game.run(60);
    lift->SetAngularVelocity(0.3F);
    for (int i = 0; i < 30; ++i) ASSERT_EQ(game.go(), StepStatus::moved) << i;
    EXPECT_TRUE(game.hero.grounded());
    EXPECT_EQ(std::set(game.hero.skipped().begin(), game.hero.skipped().end()), edges);
  }
}

/// A press that is turned by nearly nothing makes a wedge with the floor that leads out at any speed: the hero was
/// moved by 120 km in a frame. A wide one moved it to its edge. A press whose way was a whole number of steps
/// overlapped the hero by rounding alone, and in the next step the hero came out from under it to its edge.
TEST(Hero, is_squeezed_out_at_most_twice_as_fast_as_a_press_moves_or_crushed) {
  int crushed = 0;
  int squeezed = 0;
  const auto press_down = [&](b2BodyType type, float spin, float half_of_width, float speed, float from) {
    SCOPED_TRACE(testing::Message() << "type " << type << ", spin " << spin << ", half width " << half_of_width
                                    << ", speed " << speed << ", from " << from);
    OnFloor game;
    b2Body& press = *game.box(type, {0.3F, from + 1}, half_of_width, 1, 1000).GetBody();
    press.SetGravityScale(0);
    const bool is_door = type == b2_kinematicBody && spin == 0;
    const double fastest = -speed + 4 * std::abs(spin);
    bool was_crushed = false;
    for (int i = 0; i < 600 && press.GetPosition().y > 1.2F; ++i) {
      press.SetAngularVelocity(spin);
      press.SetLinearVelocity({0, speed});
      const Vec2d before = game.hero.position();
      const StepStatus status = game.go();
      ASSERT_LE((game.hero.position() - before).norm(), fastest * frame + 0.25) << "frame " << i;
      ASSERT_LE(game.hero.velocity().norm(), 2 * fastest + 0.1) << "frame " << i;
      ASSERT_TRUE(status != StepStatus::crushed || game.hero.crushed_by()[0] == press.GetFixtureList());
      was_crushed = was_crushed || status == StepStatus::crushed;
      ASSERT_TRUE(!is_door || !was_crushed || status == StepStatus::crushed || status == StepStatus::stuck);
    }
    (game.hero.report().status == StepStatus::moved ? squeezed : crushed) += 1;
    if (!is_door) return;
    EXPECT_TRUE(was_crushed);
    press.SetLinearVelocity({0, 3});
    game.run(60, {.move = 1.0});
    EXPECT_GT(game.x(), 1) << "it cannot walk away";
  };
  for (const b2BodyType type : {b2_kinematicBody, b2_dynamicBody})
    for (const float spin : {0.0F, 1e-7F, 1e-5F, 1e-3F, 0.05F, 0.5F, 2.0F, -1e-4F})
      for (const float half_of_width : {1.0F, 3.0F})
        for (const float speed : {-0.5F, -3.0F}) press_down(type, spin, half_of_width, speed, 1.5F);
  for (const float speed : {-0.5F, -1.0F, -2.0F, -3.0F, -6.0F})
    for (const float from : {1.5F, 1.75F, 2.0F, 2.25F, 2.5F, 3.0F}) press_down(b2_kinematicBody, 0, 2, speed, from);
  EXPECT_GT(crushed, 0);
  EXPECT_GT(squeezed, 0);
}

/// It was thrown out at 230 m/s. Only presses onto standing ground were looked at.
TEST(Hero, is_not_thrown_out_between_a_lift_and_a_ceiling) {
  for (const double degrees : {0.0, 0.1, 0.5, 1.0, 3.0, 5.0, 10.0, -2.0}) {
    for (const float speed : {0.5F, 2.0F}) {
      Game game({.position = {0.2, 5}});
      b2Body& ceiling = *game.box(b2_staticBody, {0, 9}, 20, 1).GetBody();
      ceiling.SetTransform({0, 9}, static_cast<float>(degrees * degree));
      b2Body& lift = *game.box(b2_kinematicBody, {0, 4}, 2, 0.3F).GetBody();
      game.run(60);
      for (int i = 0; i < 400 && game.hero.position().y() > lift.GetPosition().y; ++i) {
        lift.SetLinearVelocity({0, lift.GetPosition().y > 7.6F ? 0 : speed});
        const Vec2d before = game.hero.position();
        game.go();
        ASSERT_LE((game.hero.position() - before).norm(), 2 * speed * frame + 0.25)
            << degrees << " degrees, frame " << i;
        ASSERT_LE(std::abs(game.hero.velocity().x()), 2 * speed + 0.1) << degrees << " degrees, frame " << i;
      }
    }
  }
}

/// A body that the game turned was taken to have swept from its old angle to the new one, and threw the hero 60 m. One
/// that the game put elsewhere, or that took the address of another, swept it along.
TEST(Hero, is_not_thrown_by_a_body_that_the_game_turns_or_moves_at_once) {
  for (const bool is_turned : {false, true}) {
    for (const bool is_moving : {false, true}) {
      OnFloor game;
      const b2Vec2 from = is_turned ? b2Vec2(0, 3) : b2Vec2(3.2F, 0.7F);
      b2Body& plank = *game.box(b2_kinematicBody, from, 2.5F, 0.1F).GetBody();
      game.run(30);
      if (is_moving) plank.SetAngularVelocity(4);  // more than it is turned, were that the way of a step
      if (is_moving) plank.SetLinearVelocity({6.5F, 0});
      game.go();
      plank.SetAngularVelocity(0);
      plank.SetLinearVelocity({0, 0});
      plank.SetTransform(is_turned ? from : b2Vec2(-3.2F, 0.7F), is_turned ? 3.14F : 0);
      game.run(60);
      EXPECT_LT((game.hero.position() - Vec2d(0, half_height)).norm(), 1) << is_turned << ", " << is_moving;
    }
  }
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
