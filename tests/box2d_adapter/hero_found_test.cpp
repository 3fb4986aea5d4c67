/// What readers of a `Hero` found to go wrong, each once.
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::box2d::hero_test {
namespace {

using compare::degree;

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

struct Press {
  b2BodyType type = b2_kinematicBody;
  float spin = 0;
  float half_width = 0;
  float speed = 0;
  float from = 0;  ///< Where it begins [m].
};

std::vector<Press> all_presses() {
  std::vector<Press> all;
  for (const b2BodyType type : {b2_kinematicBody, b2_dynamicBody})
    for (const float spin : {0.0F, 1e-7F, 1e-5F, 1e-3F, 0.05F, 0.5F, 2.0F, -1e-4F})
      for (const float half_width : {1.0F, 3.0F})
        for (const float speed : {-0.5F, -3.0F}) all.push_back({type, spin, half_width, speed, 1.5F});
  for (const float speed : {-0.5F, -1.0F, -2.0F, -3.0F, -6.0F})
    for (const float from : {1.5F, 1.75F, 2.0F, 2.25F, 2.5F, 3.0F})
      all.push_back({b2_kinematicBody, 0, 2, speed, from});
  return all;
}

/// A press that is turned by nearly nothing makes a wedge with the floor that leads out at any speed: the hero was
/// moved by 120 km in a frame. A wide one moved it to its edge. A press whose way was a whole number of steps
/// overlapped the hero by rounding alone, and in the next step the hero came out from under it to its edge.
TEST(Hero, is_squeezed_out_hardly_faster_than_a_press_moves_or_crushed) {
  int crushed = 0;
  int squeezed = 0;
  for (const Press& one : all_presses()) {
    SCOPED_TRACE(testing::Message() << "type " << one.type << ", spin " << one.spin << ", half width " << one.half_width
                                    << ", speed " << one.speed << ", from " << one.from);
    OnFloor game;
    b2Body& press = *game.box(one.type, {0.3F, one.from + 1}, one.half_width, 1, 1000).GetBody();
    press.SetGravityScale(0);
    const bool is_door = one.type == b2_kinematicBody && one.spin == 0;
    const double fastest = -one.speed + 4 * std::abs(one.spin);
    bool was_crushed = false;
    for (int i = 0; i < 600 && press.GetPosition().y > 1.2F; ++i) {
      press.SetAngularVelocity(one.spin);
      press.SetLinearVelocity({0, one.speed});
      const Vec2d before = game.hero.position();
      const StepStatus status = game.go();
      ASSERT_LE((game.hero.position() - before).norm(), fastest * frame + 0.25) << "frame " << i;
      ASSERT_LE(game.hero.velocity().norm(), fastest + 0.1) << "frame " << i;
      was_crushed = was_crushed || status == StepStatus::crushed;
      ASSERT_TRUE(!is_door || !was_crushed || status == StepStatus::crushed || status == StepStatus::stuck);
    }
    (game.hero.report().status == StepStatus::moved ? squeezed : crushed) += 1;
    if (!is_door) continue;
    EXPECT_TRUE(was_crushed);
    press.SetLinearVelocity({0, 3});
    game.run(60, {.move = 1.0});
    EXPECT_GT(game.x(), 1) << "it cannot walk away";
  }
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
        ASSERT_LE((game.hero.position() - before).norm(), 0.3) << degrees << " degrees, frame " << i;
        ASSERT_LE(std::abs(game.hero.velocity().x()), 3) << degrees << " degrees, frame " << i;
      }
    }
  }
}

/// The crate creeps by a micrometre in each step: the hero never stood, and could not jump.
TEST(Hero, stands_and_jumps_between_a_slope_and_a_crate_that_rests) {
  for (const float degrees : {55.0F, 63.0F, 75.0F}) {
    for (const float density : {1.0F, 5.0F, 100.0F, 1000.0F}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, density " << density);
      Game game({.position = {0.05, 2.4}});
      const float foot = 6 / std::tan(degrees * static_cast<float>(degree));
      const std::array<b2Vec2, 3> corners{b2Vec2(-foot, 6), b2Vec2(-foot, 0), b2Vec2(0, 0)};
      b2PolygonShape slope;
      slope.Set(corners.data(), 3);
      game.add(b2_staticBody, {0, 0}, slope);
      game.floor();
      game.box(b2_dynamicBody, {1.45F, 1.5F}, 1, 1.5F, density);
      game.run(200);
      int stands = 0;
      for (int i = 0; i < 100; ++i) {
        game.go();
        stands += game.hero.grounded();
      }
      EXPECT_GE(stands, 95);
      game.run(3, {.move = 0.0, .jump = true});
      EXPECT_GT(game.hero.velocity().y(), 10);
    }
  }
}

/// A jump against a beam that hardly leaves a gap was lost: Box2D did not see the hero come.
TEST(Hero, throws_up_a_beam_that_lies_on_its_head) {
  for (const double mass : {0.68, 70.0}) {
    for (const float gap : {0.0F, 0.015F, 0.1F, 0.5F}) {
      SCOPED_TRACE(testing::Message() << "mass " << mass << ", gap " << gap);
      OnFloor game({.mass = mass});
      for (const float side : {-2.0F, 2.0F})
        game.box(b2_staticBody, {side, (1.25F + gap) / 2}, 0.2F, (1.25F + gap) / 2);
      const b2Body& beam = *game.box(b2_dynamicBody, {0, 1.35F + gap}, 2.2F, 0.1F, 0.5F).GetBody();
      game.run(60);
      game.go({.move = 0.0, .jump = true});
      const double highest = game.highest(120);
      // Both go on with the momentum of the hero.
      const double speed = 12 * mass / (mass + static_cast<double>(beam.GetMass()));
      const double rise = speed * speed / 20;
      EXPECT_GT(highest, 0.7 * rise);
      EXPECT_LT(highest, 1.1 * rise + static_cast<double>(gap));
    }
  }
}

/// A body that the game turned was taken to have swept from its old angle to the new one, and threw the hero 60 m.
TEST(Hero, is_not_thrown_by_a_body_that_the_game_turns_at_once) {
  for (const float angle : {1.57F, 2.5F, 3.14F}) {
    OnFloor game;
    b2Fixture& plank = game.box(b2_kinematicBody, {2.5F, 0.7F}, 1.5F, 0.1F);
    game.run(30);
    plank.GetBody()->SetTransform({2.5F, 0.7F}, angle);
    game.run(60);
    EXPECT_LT((game.hero.position() - Vec2d(0, half_height)).norm(), 1) << "turned by " << angle;
  }
}

/// Box2D asserts on these, or makes another shape of them.
TEST(Hero, refuses_a_character_that_box2d_would_weld) {
  Game game;
  const CharacterDef tiny{.shape = CharacterShape(std::array{Vec2d(0, 0), Vec2d(0.001, 0), Vec2d(0, 0.001)})};
  EXPECT_THROW(Hero(game.world, {.character = tiny}), InvalidDefinition);
  EXPECT_EQ(game.world.GetBodyCount(), 1);
  EXPECT_THROW((void)game.hero.change(tiny), InvalidDefinition);
  EXPECT_EQ(game.go(), StepStatus::moved);
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

TEST(Hero, leaves_the_user_data_of_its_fixture_to_the_game) {
  OnFloor game;
  b2Fixture* fixture = game.hero.body().GetFixtureList();
  EXPECT_EQ(fixture->GetUserData().pointer, 0U);
  fixture->GetUserData().pointer = 42;
  ASSERT_TRUE(game.hero.change(low()));
  EXPECT_EQ(game.hero.body().GetFixtureList()->GetUserData().pointer, 42U);
}

TEST(Hero, reports_the_velocity_that_it_has) {
  OnFloor game;
  game.box(b2_dynamicBody, {2, 0.5F}, 0.5F, 0.5F).GetBody()->SetLinearVelocity({-12, 0});
  bool was_hit = false;
  for (int i = 0; i < 60; ++i) {
    game.go();
    was_hit = was_hit || game.hero.velocity().x() < -0.1;
    ASSERT_EQ(game.hero.report().move.velocity, game.hero.velocity()) << "frame " << i;
  }
  EXPECT_TRUE(was_hit);
}

TEST(Hero, refuses_calls_during_a_step_of_the_world) {
  class Caller : public b2ContactListener {
   public:
    explicit Caller(Hero& hero) : hero_(hero), saved_(hero.save()) {}
    void BeginContact(b2Contact* /*contact*/) override {
      EXPECT_THROW(hero_.restore(saved_), InvalidDefinition);
      EXPECT_THROW(hero_.shift_origin({1, 0}), InvalidDefinition);
      ++calls;
    }
    int calls = 0;

   private:
    Hero& hero_;
    HeroSave saved_;
  };
  OnFloor game;
  Caller caller(game.hero);
  game.world.SetContactListener(&caller);
  game.run(5);
  EXPECT_GT(caller.calls, 0);
  EXPECT_EQ(game.x(), 0);
}

TEST(Hero, is_carried_by_a_chain_that_is_a_conveyor) {
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [](b2Fixture&) { return Surface{.speed = 1.5}; }});
  game.chain({{9, 0}, {2, 0}, {-2, 0}, {-9, 0}});
  game.run(10);
  const double from = game.x();
  game.run(60);
  EXPECT_NEAR(game.x() - from, 1.5, 1e-6);
}

/// The hero rides the second part of a chain that was cut to what is near.
TEST(Hero, rides_on_after_it_was_restored) {
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [](b2Fixture&) { return Surface{.speed = 1.5}; }});
  game.chain({{9, 0}, {6, 0}, {6, -20}, {-6, -20}, {-6, 0}, {-9, 0}, {-9, 40}, {0.5F, 40}, {0.5F, 0}, {-0.5F, 0}});
  game.run(5);
  const HeroSave saved = game.hero.save();
  std::vector<double> first;
  for (int i = 0; i < 10; ++i) {
    game.go();
    first.push_back(game.x());
  }
  game.hero.restore(saved);
  for (const double there : first) {
    game.go();
    EXPECT_EQ(game.x(), there);
  }
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
