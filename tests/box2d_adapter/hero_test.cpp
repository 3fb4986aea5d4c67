/// A hero in a game: what it meets there, and how the game's own contact listener sees it.
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::hero_test {
namespace {

using Change = SensorEvent::Change;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Hero, stands_on_the_floor_and_the_listener_sees_it_until_it_jumps) {
  Game game({.position = {0, 0.7}});
  b2Fixture& floor = game.floor();
  std::vector<HeroContact::Change> changes;
  for (int i = 0; i < 640; ++i) {
    const Vec2d at = game.hero.position();
    game.go({.move = 0.0, .jump = i == 630});
    EXPECT_TRUE(i < 30 || i >= 630 || game.hero.position() == at) << "frame " << i;
    for (const HeroContact& contact : game.hero.contacts()) {
      EXPECT_EQ(contact.fixture, &floor);
      if (changes.empty() || changes.back() != contact.change) changes.push_back(contact.change);
    }
    if (i != 629) continue;
    EXPECT_EQ(game.hero.ground(), &floor);
    EXPECT_NEAR(game.feet(), 0, 1e-6);
    EXPECT_TRUE(game.touches(floor));
    EXPECT_EQ(game.listener.begun.size(), 1U) << "the contact flickered";
  }
  using enum ContactChange;
  EXPECT_EQ(changes, (std::vector{added, persisted, removed}));
}

/// Box2D takes a body in eight sub-steps to what is within 5 mm before it, but not to what it overlaps.
TEST(Hero, is_solved_once_a_frame_for_each_standing_thing_that_it_touches) {
  OnFloor game;
  b2Fixture& wall = game.box(b2_staticBody, {3, 1}, 1, 1);
  const double roof = 2 * half_height + 2e-6;
  game.box(b2_staticBody, {0, static_cast<float>(roof) + 1}, 10, 1);
  game.run(120, {.move = 1.0});
  ASSERT_TRUE(game.touches(wall) && game.listener.touching.size() == 3);
  for (const std::optional<double> key : {std::optional(1.0), std::optional(0.0), std::optional<double>()}) {
    game.listener.solved = 0;
    game.run(100, {.move = key});
    EXPECT_EQ(game.listener.solved, 100 * game.listener.touching.size());
  }
}

TEST(Hero, falls_in_the_frame_in_which_its_tile_is_destroyed) {
  for (const bool is_lift : {false, true}) {
    Game game({.position = {0.5, 1.7}});
    b2Fixture& tile = game.box(is_lift ? b2_kinematicBody : b2_staticBody, {0.5F, 0.5F}, 0.5F, 0.5F);
    const b2Vec2 velocity = is_lift ? b2Vec2(0.5F, 0.25F) : b2Vec2_zero;
    tile.GetBody()->SetLinearVelocity(velocity);
    game.run(60);
    ASSERT_EQ(game.hero.ground(), &tile);
    ASSERT_TRUE(game.touches(tile));
    EXPECT_NEAR(game.hero.velocity().x(), static_cast<double>(velocity.x), 1e-6);
    const double before = game.feet();
    game.world.DestroyBody(tile.GetBody());
    EXPECT_TRUE(game.listener.touching.empty());
    game.go();
    EXPECT_FALSE(game.hero.grounded());
    EXPECT_NEAR(game.feet() - before, (static_cast<double>(velocity.y) - 10 * frame) * frame, is_lift ? 1e-6 : 1e-9);
  }
}

/// A ledge has its top where the world's is, however its body is turned.
TEST(Hero, jumps_up_through_a_ledge_at_any_angle_and_lands_on_it) {
  constexpr float right_angle = b2_pi / 2;
  for (const float angle : {0.0F, right_angle, 2 * right_angle, -right_angle, 0.2F}) {
    for (const bool turns : {false, true}) {
      const b2Fixture* ledge = nullptr;
      HeroDef def{.position = {0, 0.6}};
      def.character.jump_speed = 8;
      def.surface_of = [&](const b2Fixture& fixture) -> Surface {
        return {.blocks = &fixture == ledge ? Blocking::from_above : Blocking::from_everywhere};
      };
      Game game(def);
      game.floor();
      const bool upright = std::abs(std::cos(angle)) < 0.5F;
      b2Fixture& fixture = game.box(b2_kinematicBody, {0, 2}, upright ? 0.1F : 3, upright ? 3 : 0.1F);
      ledge = &fixture;
      fixture.GetBody()->SetTransform({0, 2}, angle);
      if (turns) fixture.GetBody()->SetAngularVelocity(0.01F);
      game.run(30);
      ASSERT_TRUE(game.hero.grounded());
      double highest = 0;
      for (int i = 0; i < 200; ++i) {
        game.go({.move = 0.0, .jump = i < 40});
        highest = std::max(highest, game.feet());
      }
      EXPECT_GT(highest, 2.5) << angle;
      EXPECT_EQ(game.hero.ground(), ledge) << angle;
      EXPECT_NEAR(game.feet(), 2.1, 0.1) << angle;
    }
  }
}

TEST(Hero, takes_a_coin_however_fast_it_is) {
  Game game({.position = {0, 30}});
  b2Fixture& coin = game.circle(b2_staticBody, {0, 10}, 0.25F);
  coin.SetSensor(true);
  game.hero.set_velocity({0, -200});
  std::vector<Change> changes;
  for (int i = 0; i < 12; ++i) {
    game.go({});
    for (const HeroSensorEvent& event : game.hero.sensors()) {
      EXPECT_EQ(event.sensor, &coin);
      changes.push_back(event.change);
    }
  }
  EXPECT_EQ(changes, (std::vector{Change::enter, Change::exit}));
}

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

TEST(Hero, knows_its_ground_after_a_place_a_restore_and_a_refusal) {
  OnFloor game;
  game.run(3);
  const HeroSave save = game.hero.save();
  game.hero.place({0, 5});
  EXPECT_EQ(game.hero.ground(), nullptr);
  game.run(10);
  EXPECT_EQ(game.hero.ground(), nullptr) << "it falls";
  game.hero.restore(save);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_EQ(game.hero.ground(), &game.ground);
  EXPECT_EQ(game.hero.step({.move = nan}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.ground(), &game.ground);
  game.hero.knock_back({0, 1});
  EXPECT_EQ(game.hero.ground(), nullptr);
}

/// Box2D's circles have no skin, so a hero that rests on one never touched it for the game's listener.
TEST(HeroListener, hears_of_circles_of_every_type_of_body) {
  for (const b2BodyType type : {b2_staticBody, b2_kinematicBody, b2_dynamicBody}) {
    Game game({.position = {0, 1 + half_height + 0.01}});
    b2Fixture& circle = game.circle(type, {0, 0}, 1, 1000);
    circle.GetBody()->SetGravityScale(0);
    game.run(30);
    EXPECT_TRUE(game.touches(circle)) << "type " << type;
    EXPECT_EQ(game.hero.ground(), &circle) << "type " << type;
  }
}

TEST(HeroListener, hears_once_of_a_saw_blade_that_comes_and_of_a_coin_that_is_passed) {
  OnFloor game;
  b2Fixture& coin = game.sensor({-1, 0.5F}, 0.1F);
  game.run(30, {.move = -1.0});
  b2Fixture& saw = game.circle(b2_kinematicBody, {static_cast<float>(game.x()) + 3, 0.5F}, 0.4F);
  saw.GetBody()->SetLinearVelocity({-2, 0});
  game.run(90);
  EXPECT_EQ(game.times_begun(coin), 1);
  EXPECT_EQ(game.times_begun(saw), 1);
}

TEST(Hero, that_is_launched_out_of_a_jump_is_not_slowed_by_the_button) {
  OnFloor game({.character = {.jump_cut = 0.2}});
  game.run(5);
  game.run(3, {.jump = true});
  ASSERT_FALSE(game.hero.grounded());
  game.hero.place({0, 3}, {0, 10});
  game.go({.jump = false});
  EXPECT_NEAR(game.hero.velocity().y(), 10 - 10 * frame, 1e-9);
}

/// The hero rides the second part of a chain that was cut to what is near.
TEST(Hero, is_carried_by_a_chain_that_is_a_conveyor_and_rides_on_after_it_was_restored) {
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [](b2Fixture&) { return Surface{.speed = 1.5}; }});
  game.chain({{9, 0}, {6, 0}, {6, -20}, {-6, -20}, {-6, 0}, {-9, 0}, {-9, 40}, {0.5F, 40}, {0.5F, 0}, {-0.5F, 0}});
  game.run(5);
  const HeroSave saved = game.hero.save();
  const double from = game.x();
  game.run(2);
  EXPECT_NEAR(game.x() - from, 1.5 * 2 * frame, 1e-6);
  game.run(8);
  const double there = game.x();
  game.hero.restore(saved);
  game.run(10);
  EXPECT_EQ(game.x(), there);
}

TEST(Hero, refuses_what_it_cannot_do) {
  OnFloor game;
  const CharacterState before = game.hero.state();
  for (const double bad : {0.0, nan}) EXPECT_EQ(game.hero.step({}, bad), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.step({.move = infinity}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.state(), before);
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
