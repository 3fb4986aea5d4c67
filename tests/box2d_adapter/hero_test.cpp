/// A hero in a game: what it meets there, and how the game's own contact listener sees it.
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::hero_test {
namespace {

using Change = SensorEvent<double>::Change;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double speed_of(const b2Fixture& fixture) {
  return static_cast<double>(fixture.GetBody()->GetLinearVelocity().Length());
}

TEST(Hero, stands_on_the_floor_and_the_listener_sees_it) {
  Game game({.position = {0, 0.7}});
  b2Fixture& floor = game.floor();
  game.run(30);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_NEAR(game.feet(), 0, 1e-6);
  EXPECT_EQ(game.hero.ground(), &floor);
  EXPECT_TRUE(game.touches(floor));
  const Vec2d at = game.hero.position();
  game.run(600);
  EXPECT_EQ(game.hero.position(), at);
  EXPECT_EQ(game.listener.begun.size(), 1U) << "the contact flickered";
}

TEST(Hero, pushes_a_crate_no_faster_than_its_force_allows) {
  // Newton, with the friction of Box2D (0.2): force - 0.2 m g = (m + M) a.
  const double mass = 70;
  const double crate_mass = 100;
  const double force = 700;
  OnFloor game({.mass = mass, .push_force = force});
  b2Fixture& crate = game.box(b2_dynamicBody, {1, 0.51F}, 0.5F, 0.5F, static_cast<float>(crate_mass));
  game.run(30);
  while (!game.touches(crate)) game.go({.move = 1.0});
  game.run(10, {.move = 1.0});
  const double before = speed_of(crate);
  game.run(30, {.move = 1.0});
  const double expected = (force - 0.2 * crate_mass * 10) / (mass + crate_mass);
  EXPECT_NEAR((speed_of(crate) - before) / (30 * frame), expected, 0.05 * expected);
  EXPECT_TRUE(game.touches(crate));
}

TEST(Hero, moves_no_crate_without_force) {
  OnFloor game({.position = {0.6, 0}, .mass = 70, .push_force = 0});
  b2Fixture& crate = game.box(b2_dynamicBody, {1.5F, 0.51F}, 0.5F, 0.5F, 20);
  game.run(300, {.move = 0.1});  // both have come to rest
  const float before = crate.GetBody()->GetPosition().x;
  game.run(600, {.move = 1.0});
  EXPECT_TRUE(game.touches(crate));
  EXPECT_NEAR(crate.GetBody()->GetPosition().x - before, 0, 0.001);
}

TEST(Hero, pushes_a_ball_up_to_its_walking_speed) {
  OnFloor game;
  b2Fixture& ball = game.circle(b2_dynamicBody, {2, 0.51F}, 0.5F);
  game.run(120, {.move = 1.0});
  EXPECT_NEAR(game.hero.velocity().x(), CharacterDef{}.walk_speed, 0.1);
  EXPECT_NEAR(speed_of(ball), CharacterDef{}.walk_speed, 0.1);
  EXPECT_TRUE(game.touches(ball));
}

TEST(Hero, tilts_a_see_saw_and_rides_it) {
  CharacterDef character;
  character.snap = 0.1;
  Game game({.character = character, .position = {1.5, 1.6}});
  b2Fixture& plank = game.see_saw(false);
  plank.GetBody()->SetAngularDamping(2);
  game.run(16);
  for (int i = 16; i < 30; ++i) {
    game.go();
    EXPECT_TRUE(game.hero.grounded()) << "frame " << i;
  }
  EXPECT_LT(plank.GetBody()->GetAngle(), -0.05F) << "the hero does not weigh on it";
  EXPECT_EQ(game.hero.ground(), &plank);
  EXPECT_TRUE(game.touches(plank));
}

TEST(Hero, crosses_a_bridge_of_20_links) {
  CharacterDef character;
  character.snap = 0.2;
  character.step_height = 0.2;  // links are kerbs for each other
  Game game({.character = character, .position = {-11, 1.7}});
  std::vector<b2Fixture*> links{&game.box(b2_staticBody, {-12, 0}, 2, 1)};
  for (int i = 0; i < 20; ++i)
    links.push_back(&game.box(b2_dynamicBody, {static_cast<float>(i) - 9.5F, 0.9F}, 0.5F, 0.1F, 20));
  links.push_back(&game.box(b2_staticBody, {12, 0}, 2, 1));
  for (int i = 0; i <= 20; ++i) {
    const auto link = links.begin() + i;
    b2RevoluteJointDef joint;
    joint.Initialize(link[0]->GetBody(), link[1]->GetBody(), {static_cast<float>(i) - 10, 0.9F});
    game.world.CreateJoint(&joint);
  }
  std::set<b2Fixture*> stood_on;
  int frames = 0;
  for (; game.x() < 11 && frames < 900; ++frames) {
    game.go({.move = 0.6});
    if (game.hero.grounded()) stood_on.insert(game.hero.ground());
    ASSERT_GT(game.hero.position().y(), -2);
  }
  EXPECT_LT(frames, 900) << "stopped at " << game.x();
  EXPECT_GE(stood_on.size(), 12U) << "ten links and both ends";
  EXPECT_GE(std::count_if(links.begin(), links.end(), [&](auto* link) { return game.times_begun(*link) > 0; }), 12);
}

/// By the ratio of the masses, crate to hero.
class ThrownCrate : public ::testing::TestWithParam<double> {};

TEST_P(ThrownCrate, knocks_the_hero_back_and_gives_it_no_energy_of_its_own) {
  const double ratio = GetParam();
  OnFloor game({.mass = 1});
  b2Fixture& crate = game.box(b2_dynamicBody, {3, 0.9F}, 0.3F, 0.3F, static_cast<float>(ratio / 0.36));
  crate.GetBody()->SetLinearVelocity({-10, 1.5F});
  game.run(5, {});
  const auto energy = [&] {
    const double height = static_cast<double>(crate.GetBody()->GetPosition().y);
    return 0.5 * game.hero.velocity().squaredNorm() + ratio * (0.5 * std::pow(speed_of(crate), 2) + 10 * height);
  };
  const double most = energy() - 0.5 * game.hero.velocity().squaredNorm();
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({});
    fastest = std::max(fastest, -game.hero.velocity().x());
    EXPECT_LE(energy(), most * 1.02 + 0.05) << "frame " << i;
  }
  // Between an impact without and one with bounce.
  const double without_bounce = 10 * ratio / (1 + ratio);
  EXPECT_GE(fastest, 0.9 * without_bounce);
  EXPECT_LE(fastest, 2 * without_bounce + 0.02);
  EXPECT_GT(game.times_begun(crate), 0);
}

INSTANTIATE_TEST_SUITE_P(Ratios, ThrownCrate, ::testing::Values(0.01, 0.1, 1.0, 10.0, 100.0, 1e4));

TEST(Hero, falls_in_the_frame_in_which_its_tile_is_destroyed) {
  for (const bool is_lift : {false, true}) {
    Game game({.position = {0.5, 1.7}});
    for (int i = 0; i < 5; ++i) game.box(b2_staticBody, {static_cast<float>(i) - 4.5F, 0.5F}, 0.5F, 0.5F);
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

TEST(Hero, is_hit_by_a_bullet_that_never_passes_it) {
  OnFloor game;
  b2Fixture& bullet = game.box(b2_dynamicBody, {-9, 0.9F}, 0.02F, 0.02F, 1);
  bullet.GetBody()->SetBullet(true);
  bullet.GetBody()->SetGravityScale(0);
  bullet.GetBody()->SetLinearVelocity({100, 0});
  for (int i = 0; i < 30; ++i) {
    game.go({});
    ASSERT_LT(static_cast<double>(bullet.GetBody()->GetPosition().x), game.x());
  }
  EXPECT_GT(game.times_begun(bullet), 0);
  EXPECT_LE(game.hero.velocity().norm(), 1) << "a bullet of a five hundredth of its mass";
}

TEST(Hero, carries_a_second_hero_on_its_head_in_either_order) {
  for (const bool upper_first : {true, false}) {
    for (const double aside : {0.0, 0.1, 0.3}) {
      OnFloor game;
      Hero other(game.world, {.position = {aside, 2.5}});
      for (int i = 0; i < 300; ++i) {
        game.world.Step(static_cast<float>(frame), 8, 3);
        if (upper_first) other.step({.move = 0.0}, frame);
        const StepStatus status = game.hero.step({.move = i > 200 ? 1.0 : 0.0}, frame);
        if (!upper_first) other.step({.move = 0.0}, frame);
        ASSERT_EQ(status, StepStatus::moved) << "aside " << aside << ", frame " << i;
        ASSERT_EQ(other.report().status, StepStatus::moved) << "aside " << aside << ", frame " << i;
      }
      EXPECT_GE(other.position().y(), game.feet() + 3 * half_height - 1e-5);
      EXPECT_GT(game.x(), 5) << "the lower one cannot walk";
    }
  }
}

TEST(Hero, follows_its_world_through_every_change) {
  OnFloor game;
  b2Fixture& wall = game.box(b2_staticBody, {2, 1}, 0.1F, 1);
  b2Body& body = *wall.GetBody();
  const auto is_stopped = [&] {
    game.hero.place({0, half_height + 1e-6});
    game.run(60, {.move = 1.0});
    return std::abs(game.x() - (1.9 - half_width)) < 1e-5;
  };
  EXPECT_TRUE(is_stopped());
  body.SetEnabled(false);
  EXPECT_FALSE(is_stopped());
  body.SetEnabled(true);
  EXPECT_TRUE(is_stopped());
  body.SetTransform({2, 10}, 0);
  EXPECT_FALSE(is_stopped());
  body.SetTransform({2, 1}, 0);
  for (const b2BodyType type : {b2_kinematicBody, b2_staticBody}) {
    body.SetType(type);
    EXPECT_TRUE(is_stopped()) << "type " << type;
  }
  b2Filter filter;
  filter.maskBits = 2;
  wall.SetFilterData(filter);
  EXPECT_FALSE(is_stopped());
  wall.SetFilterData({});
  wall.SetSensor(true);
  EXPECT_FALSE(is_stopped());
  wall.SetSensor(false);
  EXPECT_TRUE(is_stopped());
  body.DestroyFixture(&wall);
  EXPECT_FALSE(is_stopped());
  EXPECT_TRUE(game.hero.grounded());
  game.ground.GetBody()->SetEnabled(false);
  game.run(2);
  EXPECT_FALSE(game.hero.grounded());
}

TEST(Hero, tells_each_contact_as_added_persisted_and_removed) {
  Game game({.position = {0, half_height + 0.1}});
  b2Fixture& floor = game.floor();
  std::vector<HeroContact::Change> changes;
  for (int i = 0; i < 40; ++i) {
    game.go({.move = 0.0, .jump = i == 30});
    for (const HeroContact& contact : game.hero.contacts()) {
      EXPECT_EQ(contact.fixture, &floor);
      if (changes.empty() || changes.back() != contact.change) changes.push_back(contact.change);
    }
  }
  using enum ContactChange;
  EXPECT_EQ(changes, (std::vector{added, persisted, removed}));
}

/// Box2D lets a heavy crate sink into a light hero. That is a crush, and no leap to the side.
TEST(Hero, stands_still_under_a_crate_that_falls_flat_on_its_head) {
  for (const float density : {0.1F, 1.0F, 20.0F}) {
    for (const float y : {1.9F, 3.0F, 6.0F}) {
      SCOPED_TRACE(testing::Message() << "density " << density << ", from " << y);
      OnFloor game;
      game.box(b2_dynamicBody, {0.1F, y}, 0.5F, 0.5F, density);
      int crushed = 0;
      for (int i = 0; i < 240; ++i) {
        const Vec2d before = game.hero.position();
        crushed += game.go() != StepStatus::moved;
        ASSERT_LE((game.hero.position() - before).norm(), 0.3) << "frame " << i;
      }
      EXPECT_LE(crushed, density > 1 ? 180 : 0);
      game.run(120, {.move = -1.0});
      EXPECT_LT(game.x(), -3) << "it cannot walk away";
    }
  }
}

TEST(Hero, does_not_press_its_crate_into_the_crate_below) {
  Game game({.position = {0, 2.7}, .mass = 70});
  game.floor();
  game.box(b2_dynamicBody, {0, 0.5F}, 0.5F, 0.5F, 20);
  b2Fixture& upper = game.box(b2_dynamicBody, {0, 1.51F}, 0.5F, 0.5F, 20);
  game.run(60);
  const float height = upper.GetBody()->GetPosition().y;
  EXPECT_GE(height, 1.49F) << "Box2D lets each sink by its slop of 5 mm";
  game.run(600);
  EXPECT_EQ(game.hero.ground(), &upper);
  EXPECT_NEAR(upper.GetBody()->GetPosition().y, height, 0.001);
}

TEST(Hero, does_not_press_a_plank_off_its_hinge) {
  Game game({.position = {1, 1.6}, .mass = 70});
  b2Fixture& plank = game.see_saw(true);
  game.run(600);
  EXPECT_EQ(game.hero.ground(), &plank);
  EXPECT_NEAR(plank.GetBody()->GetPosition().y, 0.8F, 0.005);
}

TEST(Hero, is_not_swept_along_by_a_body_that_took_the_address_of_another) {
  OnFloor game;
  b2Body* old_body = game.box(b2_kinematicBody, {-1, 0.6F}, 0.3F, 0.3F).GetBody();
  game.run(5);
  const Vec2d at = game.hero.position();
  game.world.DestroyBody(old_body);
  b2Body* new_body = game.box(b2_kinematicBody, {0.9F, 0.6F}, 0.3F, 0.3F).GetBody();
  if (new_body != old_body) GTEST_SKIP() << "Box2D gave another address";
  game.run(5);
  EXPECT_EQ(game.hero.position(), at);
}

TEST(Hero, has_the_shape_and_the_body_of_the_save_after_a_restore) {
  OnFloor game;
  b2Body* crate = game.box(b2_dynamicBody, {0.85F, 0.5F}, 0.5F, 0.5F, 0.5F).GetBody();
  ASSERT_TRUE(game.hero.change(low()));
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

/// The second fixture is the lift's: the order of addresses must not matter.
TEST(Hero, stands_on_a_lift_beside_a_moving_edge_of_zero_length_and_names_it) {
  for (const bool lift_first : {true, false}) {
    for (const b2BodyType type : {b2_staticBody, b2_kinematicBody}) {
      Game game({.position = {0, 1}});
      b2Fixture* edge = nullptr;
      const auto add_edge = [&] {
        b2EdgeShape shape;
        shape.SetTwoSided({0.5F, 0.5F}, {0.5F, 0.5F});
        edge = &game.add(type, {-0.2F, 0.3F}, shape);
        edge->GetBody()->SetAngularVelocity(0.1F);
      };
      if (!lift_first) add_edge();
      b2Body* lift = game.box(b2_kinematicBody, {0, 0.1F}, 1, 0.1F).GetBody();
      if (lift_first) add_edge();
      game.run(60);
      ASSERT_TRUE(game.hero.grounded());
      lift->SetAngularVelocity(0.3F);
      for (int i = 0; i < 30; ++i) ASSERT_EQ(game.go(), StepStatus::moved) << i;
      EXPECT_TRUE(game.hero.grounded());
      ASSERT_EQ(game.hero.skipped().size(), 1U);
      EXPECT_EQ(game.hero.skipped()[0], edge);
    }
  }
}

TEST(HeroSituation, a_press_crushes_and_is_named_until_it_goes_back) {
  OnFloor game;
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
  EXPECT_EQ(game.hero.ground(), &game.ground);
}

TEST(Hero, refuses_what_it_cannot_do) {
  OnFloor game;
  const CharacterState<double> before = game.hero.state();
  for (const double bad : {0.0, nan}) EXPECT_EQ(game.hero.step({}, bad), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.step({.move = infinity}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.state(), before);
  EXPECT_THROW(game.hero.place({nan, 0}), InvalidDefinition);
  EXPECT_THROW(game.hero.knock_back({0, infinity}), InvalidDefinition);
  EXPECT_THROW(Hero(game.world, {.mass = 0}), InvalidDefinition);
  CharacterDef impossible;
  impossible.walk_speed = -1;
  EXPECT_THROW(Hero(game.world, {.character = impossible}), InvalidCharacter);
  EXPECT_EQ(game.world.GetBodyCount(), 2) << "a hero that was refused left a body";
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
