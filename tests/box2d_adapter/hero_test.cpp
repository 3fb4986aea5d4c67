/// A hero in a game: what it meets there, and how the game's own contact listener sees it.
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_prismatic_joint.h>
#include <box2d/b2_revolute_joint.h>

#include <cmath>
#include <limits>
#include <memory>

namespace paperproof::box2d::hero_test {
namespace {

void pin(b2World& world, b2Body* a, b2Body* b, const b2Vec2& at) {
  b2RevoluteJointDef joint;
  joint.Initialize(a, b, at);
  world.CreateJoint(&joint);
}

double speed_of(const b2Fixture& fixture) {
  return static_cast<double>(fixture.GetBody()->GetLinearVelocity().Length());
}

TEST(Hero, stands_on_the_floor_and_the_listener_sees_it) {
  Game game({.position = {0, 0.7}});
  b2Fixture& floor = game.floor();
  game.run(30);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-6);
  EXPECT_EQ(game.hero.ground(), &floor);
  EXPECT_EQ(game.listener.touching.count(&floor), 1U);
  const Vec2d at = game.hero.position();
  game.run(600);
  EXPECT_EQ(game.hero.position(), at);
  EXPECT_EQ(game.listener.begun.size(), 1U) << "the contact flickered";
}

TEST(Hero, walks_at_its_speed_and_jumps) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  game.run(20, {.move = 1.0});
  EXPECT_DOUBLE_EQ(game.hero.velocity().x(), CharacterDef{}.walk_speed);
  game.go({.move = 1.0, .jump = true});
  EXPECT_FALSE(game.hero.grounded());
  EXPECT_NEAR(game.hero.velocity().y(), CharacterDef{}.jump_speed - 10 * frame, 1e-9);
}

TEST(Hero, survives_a_tumbling_crate) {
  Game game({.position = {0, 0.7}});
  game.floor();
  b2Fixture& crate = game.box(b2_dynamicBody, {0.6F, 4}, 0.5F, 0.5F, 1);
  crate.GetBody()->SetTransform({0.6F, 4}, 0.6F);
  for (int i = 0; i < 300; ++i) {
    game.go();
    ASSERT_GE(game.hero.position().y(), half_height - 1e-9);
    ASSERT_NE(game.hero.report().status, StepStatus::stuck);
  }
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_NEAR(speed_of(crate), 0, 0.01);
  EXPECT_NE(std::find(game.listener.begun.begin(), game.listener.begun.end(), &crate), game.listener.begun.end());
}

TEST(Hero, pushes_a_crate_no_faster_than_its_force_allows) {
  // Newton, with the friction of Box2D (0.2): force - 0.2 m g = (m + M) a.
  const double mass = 70;
  const double crate_mass = 100;
  const double force = 700;
  Game game({.position = {0, half_height}, .mass = mass, .push_force = force});
  game.floor();
  b2Fixture& crate = game.box(b2_dynamicBody, {1, 0.51F}, 0.5F, 0.5F, static_cast<float>(crate_mass));
  game.run(30);
  while (game.listener.touching.count(&crate) == 0) game.go({.move = 1.0});
  game.run(10, {.move = 1.0});
  const double before = speed_of(crate);
  game.run(30, {.move = 1.0});
  const double expected = (force - 0.2 * crate_mass * 10) / (mass + crate_mass);
  EXPECT_NEAR((speed_of(crate) - before) / (30 * frame), expected, 0.05 * expected);
  EXPECT_EQ(game.listener.touching.count(&crate), 1U);
}

TEST(Hero, tilts_a_see_saw_and_rides_it) {
  CharacterDef character;
  character.snap = 0.1;
  Game game({.character = character, .position = {1.5, 1.6}});
  b2Fixture& post = game.box(b2_staticBody, {0, 0.3F}, 0.1F, 0.1F);
  b2Fixture& plank = game.box(b2_dynamicBody, {0, 0.8F}, 3, 0.1F, 1);
  pin(game.world, post.GetBody(), plank.GetBody(), {0, 0.8F});
  plank.GetBody()->SetAngularDamping(2);
  int in_the_air = 0;
  for (int i = 0; i < 30; ++i) {
    game.go();
    in_the_air += i > 15 && !game.hero.grounded();
  }
  EXPECT_EQ(in_the_air, 0);
  EXPECT_LT(plank.GetBody()->GetAngle(), -0.05F) << "the hero does not weigh on it";
  EXPECT_EQ(game.hero.ground(), &plank);
  EXPECT_EQ(game.listener.touching.count(&plank), 1U);
}

TEST(Hero, crosses_a_bridge_of_20_links) {
  CharacterDef character;
  character.snap = 0.2;
  character.step_height = 0.2;  // links are kerbs for each other
  Game game({.character = character, .position = {-11, 1.7}});
  b2Fixture& left = game.box(b2_staticBody, {-12, 0}, 2, 1);
  b2Fixture& right = game.box(b2_staticBody, {12, 0}, 2, 1);
  std::set<b2Fixture*> links;
  b2Body* last = left.GetBody();
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<float>(i) - 9.5F;
    b2Fixture& link = game.box(b2_dynamicBody, {x, 0.9F}, 0.5F, 0.1F, 20);
    pin(game.world, last, link.GetBody(), {x - 0.5F, 0.9F});
    last = link.GetBody();
    links.insert(&link);
  }
  pin(game.world, last, right.GetBody(), {10, 0.9F});
  std::set<b2Fixture*> stood_on;
  int frames = 0;
  for (; game.hero.position().x() < 11 && frames < 900; ++frames) {
    game.go({.move = 0.6});
    if (game.hero.grounded()) stood_on.insert(game.hero.ground());
    ASSERT_GT(game.hero.position().y(), -2);
  }
  EXPECT_LT(frames, 900) << "stopped at " << game.hero.position().x();
  EXPECT_GE(stood_on.size(), 10U);
  std::size_t seen = 0;
  for (b2Fixture* link : links)
    seen += std::find(game.listener.begun.begin(), game.listener.begun.end(), link) != game.listener.begun.end();
  EXPECT_GE(seen, 10U);
}

/// By the ratio of the masses, crate to hero.
class ThrownCrate : public ::testing::TestWithParam<double> {};

TEST_P(ThrownCrate, knocks_the_hero_back_and_gives_it_no_energy_of_its_own) {
  const double ratio = GetParam();
  Game game({.position = {0, half_height + 1e-6}, .mass = 1});
  game.floor();
  b2Fixture& crate = game.box(b2_dynamicBody, {3, 0.9F}, 0.3F, 0.3F, static_cast<float>(ratio / 0.36));
  crate.GetBody()->SetLinearVelocity({-10, 1.5F});
  game.run(5, {});
  const double height = static_cast<double>(crate.GetBody()->GetPosition().y);
  double most = 0.5 * ratio * std::pow(speed_of(crate), 2) + ratio * 10 * height;
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({});
    fastest = std::max(fastest, -game.hero.velocity().x());
    const double kinetic = 0.5 * game.hero.velocity().squaredNorm() + 0.5 * ratio * std::pow(speed_of(crate), 2);
    const double energy = kinetic + ratio * 10 * static_cast<double>(crate.GetBody()->GetPosition().y);
    EXPECT_LE(energy, most * 1.02 + 0.05) << "frame " << i;
  }
  // Between an impact without and one with bounce.
  const double without_bounce = 10 * ratio / (1 + ratio);
  EXPECT_GE(fastest, 0.9 * without_bounce);
  EXPECT_LE(fastest, 2 * without_bounce + 0.02);
  EXPECT_NE(std::find(game.listener.begun.begin(), game.listener.begun.end(), &crate), game.listener.begun.end());
}

INSTANTIATE_TEST_SUITE_P(Ratios, ThrownCrate, ::testing::Values(0.01, 0.1, 1.0, 10.0, 100.0, 1e4));

TEST(Hero, falls_in_the_frame_in_which_its_lift_is_destroyed) {
  Game game({.position = {0, 1.7}});
  b2Fixture& lift = game.box(b2_kinematicBody, {0, 1}, 1, 0.05F);
  lift.GetBody()->SetLinearVelocity({0.5F, 0.25F});
  game.run(60);
  ASSERT_EQ(game.hero.ground(), &lift);
  ASSERT_EQ(game.listener.touching.count(&lift), 1U);
  EXPECT_NEAR(game.hero.velocity().x(), 0.5, 1e-6);
  const double y = game.hero.position().y();
  game.world.DestroyBody(lift.GetBody());
  EXPECT_EQ(game.listener.touching.size(), 0U);
  game.go();
  EXPECT_FALSE(game.hero.grounded());
  EXPECT_NEAR(game.hero.position().y() - y, (0.25 - 10 * frame) * frame, 1e-6);
  game.run(120);
  EXPECT_LT(game.hero.position().y(), y - 10);
}

TEST(Hero, falls_in_the_frame_in_which_its_tile_is_destroyed) {
  Game game({.position = {0.5, 1.7}});
  std::vector<b2Fixture*> tiles;
  for (int i = -5; i <= 5; ++i)
    tiles.push_back(&game.box(b2_staticBody, {static_cast<float>(i) + 0.5F, 0.5F}, 0.5F, 0.5F));
  game.run(60);
  ASSERT_EQ(game.hero.ground(), tiles[5]);
  ASSERT_EQ(game.listener.touching.count(tiles[5]), 1U);
  const double y = game.hero.position().y();
  game.world.DestroyBody(tiles[5]->GetBody());
  game.go();
  EXPECT_FALSE(game.hero.grounded());
  EXPECT_NEAR(y - game.hero.position().y(), 10 * frame * frame, 1e-9);
}

TEST(Hero, takes_a_coin_however_fast_it_is) {
  Game game({.position = {0, 30}});
  b2BodyDef def;
  def.position = {0, 10};
  b2CircleShape shape;
  shape.m_radius = 0.25F;
  b2FixtureDef coin_def;
  coin_def.shape = &shape;
  coin_def.isSensor = true;
  b2Fixture* coin = game.world.CreateBody(&def)->CreateFixture(&coin_def);
  game.hero.set_velocity({0, -200});
  int entered = 0;
  int left = 0;
  for (int i = 0; i < 12; ++i) {
    game.go({});
    for (const HeroSensorEvent& event : game.hero.sensors()) {
      EXPECT_EQ(event.sensor, coin);
      (event.change == SensorEvent<double>::Change::enter ? entered : left) += 1;
    }
  }
  EXPECT_EQ(entered, 1);
  EXPECT_EQ(left, 1);
}

TEST(Hero, is_seen_by_the_listener_at_a_coin) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& coin = game.box(b2_staticBody, {2, 0.5F}, 0.1F, 0.1F);
  coin.SetSensor(true);
  game.run(60, {.move = 1.0});
  EXPECT_EQ(std::count(game.listener.begun.begin(), game.listener.begun.end(), &coin), 1);
  EXPECT_GT(game.hero.position().x(), 3);
}

TEST(Hero, jumps_up_through_a_platform_of_pre_solve_and_lands_on_it) {
  b2Fixture* platform = nullptr;
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [&](b2Fixture& fixture) {
               return Surface{.blocks = &fixture == platform ? Blocking::from_above : Blocking::from_everywhere};
             }});
  game.floor();
  platform = &game.box(b2_staticBody, {0, 3}, 1, 0.1F);
  double highest = 0;
  for (int i = 0; i < 200; ++i) {
    game.go({.move = 0.0, .jump = i == 5});
    highest = std::max(highest, game.hero.position().y());
  }
  EXPECT_GT(highest, 5) << "the platform stopped the jump";
  EXPECT_EQ(game.hero.ground(), platform);
  EXPECT_NEAR(game.hero.position().y(), 3.1 + half_height, 1e-6);
  EXPECT_EQ(game.listener.touching.count(platform), 1U);
  game.go({.drop = true});
  game.run(90);
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-6);
}

TEST(Hero, goes_through_what_the_game_says_does_not_block) {
  bool is_open = false;
  b2Fixture* door = nullptr;
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [&](b2Fixture& fixture) {
               return Surface{.blocks = &fixture == door && is_open ? Blocking::not_at_all : Blocking::from_everywhere};
             }});
  game.floor();
  door = &game.box(b2_staticBody, {2, 1}, 0.1F, 1);
  game.run(60, {.move = 1.0});
  EXPECT_NEAR(game.hero.position().x(), 1.9 - 0.3125, 1e-6);
  is_open = true;
  game.run(60, {.move = 1.0});
  EXPECT_GT(game.hero.position().x(), 5);
}

TEST(Hero, is_hit_by_a_bullet_that_never_passes_it) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& bullet = game.box(b2_dynamicBody, {-9, 0.9F}, 0.02F, 0.02F, 1);
  bullet.GetBody()->SetBullet(true);
  bullet.GetBody()->SetGravityScale(0);
  bullet.GetBody()->SetLinearVelocity({100, 0});
  bool touched = false;
  for (int i = 0; i < 30; ++i) {
    game.go({});
    touched = touched || game.listener.touching.count(&bullet) > 0;
    ASSERT_LT(static_cast<double>(bullet.GetBody()->GetPosition().x), game.hero.position().x());
  }
  EXPECT_NE(std::find(game.listener.begun.begin(), game.listener.begun.end(), &bullet), game.listener.begun.end());
  EXPECT_LE(game.hero.velocity().norm(), 1) << "a bullet of a five hundredth of its mass";
}

TEST(Hero, respawns_without_dragging_anything_along) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& crate = game.box(b2_dynamicBody, {1, 0.51F}, 0.5F, 0.5F, 1);
  game.box(b2_staticBody, {50, 10}, 2, 0.5F);
  game.run(60, {.move = 1.0});
  ASSERT_GT(game.listener.touching.count(&crate), 0U);
  const float x = crate.GetBody()->GetPosition().x;
  game.hero.place({50, 12});
  EXPECT_EQ(game.hero.position(), Vec2d(50, 12));
  EXPECT_EQ(game.hero.velocity(), Vec2d(0, 0));
  game.run(120);
  EXPECT_NEAR(game.hero.position().x(), 50, 1e-9);
  EXPECT_NEAR(game.hero.position().y(), 10.5 + half_height, 1e-6);
  const double slides = 6.0 * 6.0 / (2 * 0.2 * 10);  // by its own speed, with the friction of Box2D
  EXPECT_LT(static_cast<double>(crate.GetBody()->GetPosition().x - x), slides);
  EXPECT_EQ(game.listener.touching.count(&crate), 0U);
}

TEST(Hero, stands_on_a_second_hero_and_is_stopped_by_it) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  Hero other(game.world, {.position = {3, half_height + 1e-6}});
  Hero above(game.world, {.position = {3, 2.5}});
  for (int i = 0; i < 90; ++i) {
    game.go({.move = 1.0});
    other.step({.move = 0.0}, frame);
    above.step({.move = 0.0}, frame);
    ASSERT_LE(game.hero.position().x(), other.position().x() - 0.625 + 1e-6);
    ASSERT_GE(above.position().y(), other.position().y() + 2 * half_height - 1e-5);
  }
  EXPECT_TRUE(above.grounded());
  EXPECT_EQ(above.ground()->GetBody(), &other.body());
  const auto& contacts = game.hero.contacts();
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [&](const HeroContact& contact) {
    return contact.fixture->GetBody() == &other.body();
  })) << "Box2D's listener does not see it: heroes have no skin for each other";
}

TEST(Hero, is_carried_by_what_turns_and_moves_without_a_toggle) {
  struct Ground {
    const char* name;
    float spin;
    bool wheel;
    b2Vec2 velocity;
  };
  for (const Ground& ground : {Ground{"plank", 0.2F, false, {0, 0}}, Ground{"plank back", -0.2F, false, {0, 0}},
                               Ground{"wheel", 0.2F, true, {0, 0}}, Ground{"lift", 0, false, {0.3F, -0.5F}},
                               Ground{"turning lift", 0.1F, false, {0.3F, 0.5F}}}) {
    Game game({.position = {0.5, ground.wheel ? 2.75 : 0.75}});
    b2BodyDef def;
    def.type = b2_kinematicBody;
    b2CircleShape circle;
    circle.m_radius = 2;
    b2PolygonShape box;
    box.SetAsBox(4, 0.1F);
    b2Body* body = game.world.CreateBody(&def);
    body->CreateFixture(ground.wheel ? static_cast<b2Shape*>(&circle) : &box, 1);
    game.run(30);
    ASSERT_TRUE(game.hero.grounded()) << ground.name;
    body->SetAngularVelocity(ground.spin);
    body->SetLinearVelocity(ground.velocity);
    for (int i = 0; i < 150; ++i) {
      const b2Vec2 foot = body->GetLocalPoint(
          {static_cast<float>(game.hero.position().x()), static_cast<float>(game.hero.position().y() - half_height)});
      game.go();
      ASSERT_TRUE(game.hero.grounded()) << ground.name << ", frame " << i;
      ASSERT_EQ(game.hero.ground(), body->GetFixtureList()) << ground.name << ", frame " << i;
      // The ground under the foot takes the hero along in the same frame.
      const b2Vec2 there = body->GetWorldPoint(foot);
      EXPECT_NEAR(game.hero.position().x(), static_cast<double>(there.x), 0.004) << ground.name << ", frame " << i;
    }
  }
}

TEST(Hero, skips_an_edge_of_zero_length) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2BodyDef def;
  b2EdgeShape edge;
  edge.SetTwoSided({0.5F, 0.5F}, {0.5F, 0.5F});
  b2Fixture* nothing = game.world.CreateBody(&def)->CreateFixture(&edge, 0);
  game.run(60, {.move = 1.0});
  EXPECT_GT(game.hero.position().x(), 5);
  game.hero.place({0, half_height + 1e-6});
  game.go();
  ASSERT_EQ(game.hero.skipped().size(), 1U);
  EXPECT_EQ(game.hero.skipped()[0], nothing);
}

TEST(Hero, crouches_and_stands_up_where_there_is_room) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  game.box(b2_staticBody, {3, 1.7F}, 2, 0.5F);  // leaves 1.2 m
  CharacterDef low;
  low.shape = CharacterShape(std::array{Vec2d(-0.3, -0.3), Vec2d(0.3, -0.3), Vec2d(0.3, 0.3), Vec2d(-0.3, 0.3)});
  ASSERT_TRUE(game.hero.change(low));
  EXPECT_NEAR(game.hero.position().y(), 0.3 + 1e-6, 1e-9) << "the feet stay where they are";
  game.run(30, {.move = 1.0});
  ASSERT_GT(game.hero.position().x(), 1.5);
  const Vec2d at = game.hero.position();
  EXPECT_FALSE(game.hero.change(CharacterDef{}));
  EXPECT_EQ(game.hero.position(), at);
  game.run(60, {.move = 1.0});
  EXPECT_TRUE(game.hero.change(CharacterDef{}));
  game.run(10);
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-6);
  EXPECT_TRUE(game.hero.grounded());
}

TEST(Hero, is_the_same_after_a_roll_back) {
  Game game({.position = {0, 1.8}});
  game.floor();
  b2Fixture& lift = game.box(b2_kinematicBody, {0, 1}, 2, 0.1F);
  const auto go = [&](int frames) {
    for (int i = 0; i < frames; ++i) game.go({.move = i % 40 < 20 ? 1.0 : -1.0, .jump = i % 30 == 9});
  };
  lift.GetBody()->SetLinearVelocity({0.2F, 0});
  lift.GetBody()->SetAngularVelocity(0.05F);
  go(60);
  const HeroSave save = game.hero.save();
  const b2Transform lift_then = lift.GetBody()->GetTransform();
  const float angle_then = lift.GetBody()->GetAngle();
  go(100);
  const CharacterState<double> first = game.hero.state();
  lift.GetBody()->SetTransform(lift_then.p, angle_then);
  game.hero.restore(save);
  go(100);
  EXPECT_EQ(game.hero.state(), first);
}

TEST(Hero, follows_a_shifted_origin) {
  Game game({.position = {1000, half_height + 1e-6}});
  game.box(b2_staticBody, {1000, -1}, 10, 1);
  game.run(30, {.move = 0.5});
  const Vec2d at = game.hero.position();
  game.world.ShiftOrigin({1000, 0});
  game.hero.shift_origin({1000, 0});
  EXPECT_EQ(game.hero.position(), Vec2d(at - Vec2d(1000, 0)));
  game.run(30);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_NEAR(game.hero.position().x(), at.x() - 1000, 0.5);
}

TEST(Hero, follows_its_world_through_every_change) {
  Game game({.position = {0, half_height + 1e-6}});
  b2Fixture& floor = game.floor();
  b2Fixture& wall = game.box(b2_staticBody, {2, 1}, 0.1F, 1);
  const auto is_stopped = [&] {
    game.hero.place({0, half_height + 1e-6});
    game.run(60, {.move = 1.0});
    return game.hero.position().x() < 2;
  };
  EXPECT_TRUE(is_stopped());
  wall.GetBody()->SetEnabled(false);
  EXPECT_FALSE(is_stopped());
  wall.GetBody()->SetEnabled(true);
  EXPECT_TRUE(is_stopped());
  wall.GetBody()->SetTransform({2, 10}, 0);
  EXPECT_FALSE(is_stopped());
  wall.GetBody()->SetTransform({2, 1}, 0);
  b2Filter filter;
  filter.maskBits = 2;
  wall.SetFilterData(filter);
  EXPECT_FALSE(is_stopped());
  wall.SetFilterData({});
  wall.SetSensor(true);
  EXPECT_FALSE(is_stopped());
  wall.SetSensor(false);
  EXPECT_TRUE(is_stopped());
  wall.GetBody()->DestroyFixture(&wall);
  EXPECT_FALSE(is_stopped());
  EXPECT_TRUE(game.hero.grounded());
  floor.GetBody()->SetEnabled(false);
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

TEST(Hero, reads_a_chain_of_many_segments_only_near_it) {
  Game game({.position = {0, 3}});
  std::vector<b2Vec2> points;
  for (int i = 0; i <= 4000; ++i) {
    const float x = 500 - static_cast<float>(i) * 0.25F;
    points.emplace_back(x, std::sin(x));
  }
  b2ChainShape chain;
  chain.CreateChain(points.data(), static_cast<int>(points.size()), points.front(), points.back());
  b2BodyDef def;
  game.world.CreateBody(&def)->CreateFixture(&chain, 0);
  for (int i = 0; i < 600; ++i) {
    game.go({.move = 1.0});
    const double x = game.hero.position().x();
    ASSERT_GT(game.hero.position().y(), std::sin(x) + half_height - 0.3) << "at " << x;
  }
  EXPECT_GT(game.hero.position().x(), 40);
}

TEST(Hero, walks_and_jumps_where_gravity_turns) {
  Game game({.position = {0, 0}});
  game.box(b2_staticBody, {0, -5}, 6, 1);
  game.box(b2_staticBody, {0, 5}, 6, 1);
  game.box(b2_staticBody, {-5, 0}, 1, 6);
  game.box(b2_staticBody, {5, 0}, 1, 6);
  for (const b2Vec2& down : {b2Vec2(0, -10), b2Vec2(10, 0), b2Vec2(0, 10), b2Vec2(-10, 0), b2Vec2(6, -8)}) {
    game.world.SetGravity(down);
    game.run(150);
    const Vec2d up(-static_cast<double>(down.x) / 10, -static_cast<double>(down.y) / 10);
    ASSERT_TRUE(game.hero.grounded()) << "down " << down.x << " " << down.y;
    EXPECT_GT(game.hero.report().move.ground.normal.dot(up), 0.6);
    const Vec2d across(up.y(), -up.x());
    const double before = game.hero.position().dot(across);
    game.run(10, {.move = 0.5});
    EXPECT_GT(game.hero.position().dot(across), before) << "move 0.5 goes to the right of the hero";
    game.run(60);
    game.go({.move = 0.0, .jump = true});
    EXPECT_GT(game.hero.velocity().dot(up), 11);
  }
}

/// Box2D lets a heavy crate sink into a light hero. That is a crush, and no leap to the side.
TEST(Hero, stands_still_under_a_crate_that_falls_flat_on_its_head) {
  for (const float density : {0.1F, 1.0F, 20.0F}) {
    for (const float y : {1.9F, 3.0F, 6.0F}) {
      SCOPED_TRACE(testing::Message() << "density " << density << ", from " << y);
      Game game({.position = {0, half_height + 1e-6}});
      game.floor();
      game.box(b2_dynamicBody, {0.1F, y}, 0.5F, 0.5F, density);
      int crushed = 0;
      for (int i = 0; i < 240; ++i) {
        const Vec2d before = game.hero.position();
        game.go();
        crushed += game.hero.report().status != StepStatus::moved;
        ASSERT_LE((game.hero.position() - before).norm(), 0.3) << "frame " << i;
      }
      EXPECT_LE(crushed, density > 1 ? 180 : 0);
      game.run(120, {.move = -1.0});
      EXPECT_LT(game.hero.position().x(), -3) << "it cannot walk away";
    }
  }
}

TEST(Hero, carries_a_second_hero_on_its_head_in_either_order) {
  for (const bool upper_first : {true, false}) {
    for (const double aside : {0.0, 0.1, 0.3}) {
      Game game({.position = {0, half_height + 1e-6}});
      game.floor();
      Hero other(game.world, {.position = {aside, 2.5}});
      for (int i = 0; i < 300; ++i) {
        game.world.Step(static_cast<float>(frame), 8, 3);
        if (upper_first) other.step({.move = 0.0}, frame);
        const StepStatus status = game.hero.step({.move = i > 200 ? 1.0 : 0.0}, frame);
        if (!upper_first) other.step({.move = 0.0}, frame);
        ASSERT_EQ(status, StepStatus::moved) << "aside " << aside << ", frame " << i;
        ASSERT_EQ(other.report().status, StepStatus::moved) << "aside " << aside << ", frame " << i;
      }
      EXPECT_GT(game.hero.position().x(), 5) << "the lower one cannot walk";
    }
  }
}

TEST(Hero, does_not_press_its_crate_into_the_crate_below) {
  Game game({.position = {0, 2.7}, .mass = 70});
  game.floor();
  game.box(b2_dynamicBody, {0, 0.5F}, 0.5F, 0.5F, 20);
  b2Fixture& upper = game.box(b2_dynamicBody, {0, 1.51F}, 0.5F, 0.5F, 20);
  game.run(60);
  ASSERT_EQ(game.hero.ground(), &upper);
  const float height = upper.GetBody()->GetPosition().y;
  EXPECT_GE(height, 1.49F) << "Box2D lets each sink by its slop of 5 mm";
  game.run(600);
  EXPECT_EQ(game.hero.ground(), &upper);
  EXPECT_NEAR(upper.GetBody()->GetPosition().y, height, 0.001);
}

TEST(Hero, does_not_press_a_plank_off_its_hinge) {
  Game game({.position = {1, 1.6}, .mass = 70});
  b2Fixture& post = game.box(b2_staticBody, {0, 0.3F}, 0.1F, 0.1F);
  b2Fixture& plank = game.box(b2_dynamicBody, {0, 0.8F}, 3, 0.1F, 1);
  b2RevoluteJointDef joint;
  joint.Initialize(post.GetBody(), plank.GetBody(), {0, 0.8F});
  joint.enableLimit = true;
  game.world.CreateJoint(&joint);
  game.run(600);
  EXPECT_EQ(game.hero.ground(), &plank);
  EXPECT_NEAR(plank.GetBody()->GetPosition().y, 0.8F, 0.005);
}

TEST(Hero, does_not_press_a_lift_on_a_motor_down) {
  Game game({.position = {0, 0.8}, .mass = 70});
  b2Fixture& post = game.box(b2_staticBody, {0, -30}, 1, 1);
  b2Fixture& lift = game.box(b2_dynamicBody, {0, 0}, 2, 0.1F, 20);
  b2PrismaticJointDef joint;
  joint.Initialize(post.GetBody(), lift.GetBody(), {0, 0}, {0, 1});
  joint.enableMotor = true;
  joint.maxMotorForce = 1e6F;
  joint.motorSpeed = 0.5F;
  game.world.CreateJoint(&joint);
  game.run(60);
  const float before = lift.GetBody()->GetPosition().y;
  game.run(600);
  EXPECT_EQ(game.hero.ground(), &lift);
  EXPECT_NEAR(lift.GetBody()->GetPosition().y - before, 0.5 * 10, 0.001);
}

TEST(Hero, moves_no_crate_without_force) {
  Game game({.position = {0.6, half_height + 1e-6}, .mass = 70, .push_force = 0});
  game.floor();
  b2Fixture& crate = game.box(b2_dynamicBody, {1.5F, 0.51F}, 0.5F, 0.5F, 20);
  game.run(300, {.move = 0.1});  // both have come to rest
  const float before = crate.GetBody()->GetPosition().x;
  game.run(600, {.move = 1.0});
  EXPECT_EQ(game.listener.touching.count(&crate), 1U);
  EXPECT_NEAR(crate.GetBody()->GetPosition().x - before, 0, 0.001);
}

TEST(Hero, pushes_a_ball_up_to_its_walking_speed) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = {2, 0.51F};
  b2CircleShape circle;
  circle.m_radius = 0.5F;
  b2Fixture* ball = game.world.CreateBody(&def)->CreateFixture(&circle, 1);
  game.run(120, {.move = 1.0});
  EXPECT_NEAR(game.hero.velocity().x(), CharacterDef{}.walk_speed, 0.1);
  EXPECT_NEAR(speed_of(*ball), CharacterDef{}.walk_speed, 0.1);
  EXPECT_EQ(game.listener.touching.count(ball), 1U);
}

TEST(Hero, is_not_shot_away_by_a_bar_that_turns) {
  Game game({.position = {-1.5, half_height + 1e-6}});
  game.floor();
  b2Body* bar = game.box(b2_kinematicBody, {0, 1.2F}, 3, 0.05F).GetBody();
  bar->SetAngularVelocity(3);
  for (int i = 0; i < 6000; ++i) {
    const Vec2d before = game.hero.position();
    game.go({.move = i / 120 % 2 == 0 ? 1.0 : -1.0});
    ASSERT_LE((game.hero.position() - before).norm(), 8) << "frame " << i;
    ASSERT_LE(game.hero.velocity().norm(), 30) << "frame " << i;
    if (std::abs(game.hero.position().x()) > 20) game.hero.place({-1.5, half_height + 1e-6});
  }
}

TEST(Hero, is_not_swept_along_by_a_body_that_took_the_address_of_another) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Body* old_body = game.box(b2_kinematicBody, {-1, 0.6F}, 0.3F, 0.3F).GetBody();
  game.run(5);
  const Vec2d at = game.hero.position();
  game.world.DestroyBody(old_body);
  b2Body* new_body = game.box(b2_kinematicBody, {0.9F, 0.6F}, 0.3F, 0.3F).GetBody();
  if (new_body != old_body) GTEST_SKIP() << "Box2D gave another address";
  game.run(5);
  EXPECT_EQ(game.hero.position(), at);
}

TEST(Hero, sees_a_chain_that_was_dug_in_place) {
  Game game({.position = {0, half_height + 1e-6}});
  std::vector<b2Vec2> points{{9, 0}, {2, 0}, {1, 0}, {-1, 0}, {-2, 0}, {-9, 0}};
  b2ChainShape chain;
  chain.CreateChain(points.data(), static_cast<int>(points.size()), {10, 0}, {-10, 0});
  b2BodyDef def;
  b2Body* ground = game.world.CreateBody(&def);
  b2Fixture* fixture = ground->CreateFixture(&chain, 0);
  game.run(5);
  chain.m_vertices[2].y = chain.m_vertices[3].y = -1;
  ground->DestroyFixture(fixture);
  ground->CreateFixture(&chain, 0);
  game.run(60);
  EXPECT_NEAR(game.hero.position().y(), half_height - 1, 1e-5);
}

TEST(Hero, stands_on_a_lift_beside_a_moving_edge_of_zero_length) {
  Game game({.position = {0, 1}});
  game.box(b2_kinematicBody, {0, 0.1F}, 1, 0.1F);
  b2BodyDef def;
  def.type = b2_kinematicBody;
  def.position = {-3, 0};
  b2EdgeShape edge;
  edge.SetTwoSided({0.5F, 0.5F}, {0.5F, 0.5F});
  game.world.CreateBody(&def)->CreateFixture(&edge, 0);
  game.run(120);
  EXPECT_TRUE(game.hero.grounded());
}

TEST(Hero, has_the_shape_of_the_save_after_a_restore) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  CharacterDef low;
  low.shape = CharacterShape(std::array{Vec2d(-0.3, -0.3), Vec2d(0.3, -0.3), Vec2d(0.3, 0.3), Vec2d(-0.3, 0.3)});
  ASSERT_TRUE(game.hero.change(low));
  game.go();
  const HeroSave save = game.hero.save();
  ASSERT_TRUE(game.hero.change(CharacterDef{}));
  game.run(20, {.move = 1.0});
  game.hero.restore(save);
  game.run(20);
  EXPECT_NEAR(game.hero.position().y(), 0.3, 1e-5);
  EXPECT_TRUE(game.hero.grounded());
}

TEST(Hero, enters_and_leaves_sensors_without_moving_there) {
  using Change = SensorEvent<double>::Change;
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& zone = game.box(b2_staticBody, {10, 1}, 1, 1);
  zone.SetSensor(true);
  game.run(3);
  game.hero.place({10, half_height + 1e-6});
  game.go();
  ASSERT_EQ(game.hero.sensors().size(), 1U);
  EXPECT_EQ(game.hero.sensors()[0].change, Change::enter);
  EXPECT_EQ(game.hero.inside().size(), 1U);
  game.run(5);
  EXPECT_TRUE(game.hero.sensors().empty());
  zone.GetBody()->SetTransform({13, 1}, 0);
  game.go();
  ASSERT_EQ(game.hero.sensors().size(), 1U);
  EXPECT_EQ(game.hero.sensors()[0].change, Change::exit);
  EXPECT_TRUE(game.hero.inside().empty());
}

TEST(Hero, is_stopped_by_a_lift_that_became_static) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& lift = game.box(b2_kinematicBody, {2, 1}, 0.5F, 1);
  game.run(5);
  lift.GetBody()->SetType(b2_staticBody);
  game.run(60, {.move = 1.0});
  EXPECT_NEAR(game.hero.position().x(), 1.5 - CharacterDef{}.shape.box().upper.x(), 1e-5);
}

TEST(Hero, is_carried_by_a_chain_that_is_a_conveyor) {
  Game game({.position = {0, half_height + 1e-6}, .surface_of = [](b2Fixture&) { return Surface{.speed = 1.5}; }});
  const std::vector<b2Vec2> points{{9, 0}, {2, 0}, {-2, 0}, {-9, 0}};
  b2ChainShape chain;
  chain.CreateChain(points.data(), static_cast<int>(points.size()), {10, 0}, {-10, 0});
  b2BodyDef def;
  game.world.CreateBody(&def)->CreateFixture(&chain, 0);
  game.run(10);
  const double from = game.hero.position().x();
  game.run(60);
  EXPECT_NEAR(game.hero.position().x() - from, 1.5, 1e-6);
}

TEST(Hero, leaves_a_sensor_that_it_is_placed_far_away_from) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& zone = game.box(b2_staticBody, {0, 1}, 1, 1);
  zone.SetSensor(true);
  game.run(3);
  ASSERT_EQ(game.hero.inside().size(), 1U);
  game.hero.place({80, half_height + 1e-6});
  game.go();
  ASSERT_EQ(game.hero.sensors().size(), 1U);
  EXPECT_EQ(game.hero.sensors()[0].sensor, &zone);
  EXPECT_EQ(game.hero.sensors()[0].change, SensorEvent<double>::Change::exit);
}

TEST(Hero, sends_no_event_of_a_sensor_that_was_destroyed) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& zone = game.box(b2_staticBody, {0, 1}, 1, 1);
  zone.SetSensor(true);
  game.run(3);
  game.world.DestroyBody(zone.GetBody());
  game.go();
  EXPECT_TRUE(game.hero.sensors().empty());
  EXPECT_TRUE(game.hero.inside().empty());
}

TEST(Hero, crouches_on_a_rising_lift_before_and_after_its_step) {
  Game game({.position = {0, 0.2 + half_height + 1e-6}});
  b2Fixture& lift = game.box(b2_kinematicBody, {0, 0.1F}, 2, 0.1F);
  lift.GetBody()->SetLinearVelocity({0, 3});
  CharacterDef low;
  low.shape = CharacterShape(std::array{Vec2d(-0.3, -0.3), Vec2d(0.3, -0.3), Vec2d(0.3, 0.3), Vec2d(-0.3, 0.3)});
  game.run(10);
  ASSERT_TRUE(game.hero.grounded());
  game.world.Step(static_cast<float>(frame), 8, 3);
  EXPECT_TRUE(game.hero.change(low));
  game.hero.step({}, frame);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_TRUE(game.hero.change(CharacterDef{}));
  game.go();
  EXPECT_TRUE(game.hero.grounded());
}

TEST(Hero, knows_its_ground_after_a_place_and_a_restore) {
  Game game({.position = {0, half_height + 1e-6}});
  b2Fixture& floor = game.floor();
  game.run(3);
  const HeroSave save = game.hero.save();
  game.hero.place({0, 5});
  EXPECT_EQ(game.hero.ground(), nullptr);
  game.run(10);
  game.hero.restore(save);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_EQ(game.hero.ground(), &floor);
  game.hero.knock_back({0, 1});
  EXPECT_EQ(game.hero.ground(), nullptr);
}

TEST(Hero, has_the_body_of_the_save_after_a_restore) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Body* crate = game.box(b2_dynamicBody, {0.7F, 0.5F}, 0.5F, 0.5F).GetBody();
  game.run(30, {.move = 1.0});
  const HeroSave save = game.hero.save();
  const b2Vec2 place = game.hero.body().GetPosition();
  const b2Vec2 velocity = game.hero.body().GetLinearVelocity();
  ASSERT_GT(crate->GetPosition().x, 0.8F) << "it is pushed";
  game.run(30, {.move = -1.0});
  game.hero.restore(save);
  EXPECT_EQ(game.hero.body().GetPosition(), place);
  EXPECT_EQ(game.hero.body().GetLinearVelocity(), velocity);
  EXPECT_FALSE(game.hero.body().IsBullet());
}

TEST(Hero, stands_on_a_lift_beside_nothing_but_a_moving_edge_of_zero_length) {
  for (const bool lift_first : {true, false}) {
    Game game({.position = {0, 1}});
    const auto add_edge = [&] {
      b2BodyDef def;
      def.type = b2_kinematicBody;
      def.position = {-0.2F, 0.3F};
      def.angularVelocity = 0.1F;
      b2EdgeShape edge;
      edge.SetTwoSided({0.5F, 0.5F}, {0.5F, 0.5F});
      game.world.CreateBody(&def)->CreateFixture(&edge, 0);
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
  }
}

TEST(Hero, has_no_ground_in_the_air_and_keeps_its_answers_after_a_refusal) {
  Game game({.position = {0, half_height + 1e-6}});
  b2Fixture& floor = game.floor();
  game.run(3);
  EXPECT_EQ(game.hero.step({.move = std::numeric_limits<double>::quiet_NaN()}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.ground(), &floor);
  game.go({.move = 0.0, .jump = true});
  game.run(5);
  EXPECT_EQ(game.hero.ground(), nullptr);
}

TEST(Hero, refuses_what_it_cannot_do) {
  Game game;
  game.floor();
  const CharacterState<double> before = game.hero.state();
  EXPECT_EQ(game.hero.step({}, 0), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.step({}, std::numeric_limits<double>::quiet_NaN()), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.step({.move = std::numeric_limits<double>::infinity()}, frame), StepStatus::invalid_input);
  EXPECT_EQ(game.hero.state(), before);
  EXPECT_THROW(game.hero.place({std::numeric_limits<double>::quiet_NaN(), 0}), InvalidDefinition);
  EXPECT_THROW(game.hero.knock_back({0, std::numeric_limits<double>::infinity()}), InvalidDefinition);
  EXPECT_THROW(Hero(game.world, {.mass = 0}), InvalidDefinition);
  CharacterDef impossible;
  impossible.walk_speed = -1;
  EXPECT_THROW(Hero(game.world, {.character = impossible}), InvalidCharacter);
  EXPECT_EQ(game.world.GetBodyCount(), 2) << "a hero that was refused left a body";
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
