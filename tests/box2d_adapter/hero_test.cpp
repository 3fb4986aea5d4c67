/// A hero in a game: what no story of tests/situations/heroes can tell.
#include "controller/states.hpp"
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::hero_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Hero, carries_a_second_hero_on_its_head_in_either_order) {
  for (const bool upper_first : {true, false}) {
    for (const double aside : {0.0, 0.1, 0.3}) {
      OnFloor game;
      Hero other(game.world, {.position = {aside, 2.5}});
      for (int i = 0; i < 300; ++i) {
        game.world.Step(static_cast<float>(frame), 8, 3);
        if (upper_first) other.step({.move = 0.0}, frame);
        game.hero.step({.move = i > 200 ? 1.0 : 0.0}, frame);
        if (!upper_first) other.step({.move = 0.0}, frame);
        for (const Hero* each : {&game.hero, &other})
          ASSERT_EQ(each->report().status, StepStatus::moved) << "aside " << aside << ", frame " << i;
      }
      EXPECT_GE(other.position().y(), game.feet() + 3 * half_height - 1e-5);
      EXPECT_GT(game.x(), 5) << "the lower one cannot walk";
    }
  }
}

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

/// A press that is turned by nearly nothing makes a wedge with the floor. It once pushed the hero 120 km in a frame; a
/// wide press pushed the hero to the edge of the press. Where the way of a press was a whole number of steps, rounding
/// alone made it overlap the hero, and in the next step the hero left it at its edge.
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

/// Bodies of one team do not collide.
class Teams : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
    return a->GetBody()->GetUserData().pointer != b->GetBody()->GetUserData().pointer;
  }
};

TEST(ContactFilterOfTheGame, decides_for_the_hero_too) {
  OnFloor game;
  Teams teams;
  game.world.SetContactFilter(&teams);
  game.hero.body().GetUserData().pointer = 1;
  game.ground.GetBody()->GetUserData().pointer = 3;
  b2Body& own = *game.box(b2_staticBody, {2, 1}, 0.1F, 1).GetBody();
  b2Body& other = *game.box(b2_staticBody, {4, 1}, 0.1F, 1).GetBody();
  own.GetUserData().pointer = 1;
  other.GetUserData().pointer = 2;
  game.run(90, {.move = 1.0});
  EXPECT_NEAR(game.x(), 3.9 - half_width, 1e-5);
  own.GetUserData().pointer = 2;
  game.run(90, {.move = -1.0});
  EXPECT_NEAR(game.x(), 2.1 + half_width, 1e-5) << "it is asked in every step";
}

TEST(HeroAlone, steps_together_as_by_itself) {
  OnFloor one;
  OnFloor other;
  Hero* const party = &other.hero;
  for (OnFloor* game : {&one, &other}) {
    game->box(b2_dynamicBody, {2, 0.5F}, 0.5F, 0.5F);
    game->box(b2_kinematicBody, {-3, 0.5F}, 0.5F, 0.5F).GetBody()->SetLinearVelocity({0.5F, 0.1F});
  }
  for (int i = 0; i < 400; ++i) {
    const Input input{.move = i / 50 % 3 - 1, .jump = i % 40 < 3};
    one.go(input);
    other.world.Step(static_cast<float>(frame), 8, 3);
    step_together({&party, 1}, {&input, 1}, frame);
    ASSERT_TRUE(stepping::same_step(one.hero.state(), one.hero.report(), other.hero.state(), other.hero.report())) << i;
  }
}

TEST(HeroAlone, and_others_are_refused_without_time) {
  OnFloor game;
  Hero second(game.world, {.position = {3, 1}});
  const std::array<Hero*, 2> party{&game.hero, &second};
  const std::array<Input, 2> inputs{};
  const CharacterState before = second.state();
  step_together(party, inputs, 0);
  for (const Hero* hero : party) EXPECT_EQ(hero->report().status, StepStatus::invalid_input);
  EXPECT_EQ(second.state(), before);
}

TEST(Hero, refuses_what_it_cannot_do) {
  OnFloor game;
  game.run(3);
  const CharacterState before = game.hero.state();
  const b2Fixture* const ground = &game.ground;
  ASSERT_EQ(game.hero.ground(), ground);
  for (const double bad : {0.0, nan}) EXPECT_EQ(game.hero.step({}, bad), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.step({.move = infinity}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.state(), before);
  EXPECT_EQ(game.hero.ground(), ground);
  EXPECT_THROW(game.hero.place({nan, 0}), InvalidDefinition);
  EXPECT_THROW(game.hero.knock_back({0, infinity}), InvalidDefinition);
  EXPECT_THROW(Hero(game.world, {.mass = 0}), InvalidDefinition);
  // Box2D asserts on these, or makes another shape of them.
  const CharacterDef tiny{.shape = CharacterShape(compare::box(0, 0, 0.001, 0.001).points)};
  EXPECT_THROW(Hero(game.world, {.character = tiny}), InvalidDefinition);
  EXPECT_THROW((void)game.hero.change(tiny), InvalidDefinition);
  EXPECT_THROW(Hero(game.world, {.character = {.walk_speed = -1}}), InvalidCharacter);
  EXPECT_EQ(game.world.GetBodyCount(), 2) << "a hero that was refused left a body";
  const HeroSave saved = game.hero.save();
  game.listener.on_begin = [&] {
    EXPECT_THROW(game.hero.restore(saved), InvalidDefinition);
    EXPECT_THROW(game.hero.shift_origin({1, 0}), InvalidDefinition);
  };
  game.run(5);
  EXPECT_EQ(game.times_begun(game.ground), 1) << "it was called during a step of the world";
  EXPECT_EQ(game.x(), 0);
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
