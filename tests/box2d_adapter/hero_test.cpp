/// A hero in a game: what it meets there, and how the game's own contact listener sees it.
#include "hero_world.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::hero_test {
namespace {

using compare::degree;
using Change = SensorEvent::Change;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double speed_of(const b2Fixture& fixture) {
  return static_cast<double>(fixture.GetBody()->GetLinearVelocity().Length());
}

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
  Game game({.character = {.snap = 0.1}, .position = {1.5, 1.6}});
  b2Fixture& post = game.box(b2_staticBody, {0, 0.3F}, 0.1F, 0.1F);
  b2Fixture& plank = game.box(b2_dynamicBody, {0, 0.8F}, 3, 0.1F, 1);
  b2RevoluteJointDef joint;
  joint.Initialize(post.GetBody(), plank.GetBody(), {0, 0.8F});
  game.world.CreateJoint(&joint);
  plank.GetBody()->SetAngularDamping(2);
  game.run(30);
  EXPECT_TRUE(game.hero.grounded());
  EXPECT_LT(plank.GetBody()->GetAngle(), -0.05F) << "the hero does not weigh on it";
  EXPECT_EQ(game.hero.ground(), &plank);
  EXPECT_TRUE(game.touches(plank));
}

TEST(Hero, crosses_a_bridge_of_20_links) {
  // Links are kerbs for each other.
  Game game({.character = {.snap = 0.2, .step_height = 0.2}, .position = {-11, 1.7}});
  b2Body* last = game.box(b2_staticBody, {-12, 0}, 2, 1).GetBody();
  b2Body* other_end = game.box(b2_staticBody, {12, 0}, 2, 1).GetBody();
  for (int i = 0; i <= 20; ++i) {
    const float x = static_cast<float>(i) - 10;
    b2Body* link = i < 20 ? game.box(b2_dynamicBody, {x + 0.5F, 0.9F}, 0.5F, 0.1F, 20).GetBody() : other_end;
    b2RevoluteJointDef joint;
    joint.Initialize(last, link, {x, 0.9F});
    game.world.CreateJoint(&joint);
    last = link;
  }
  for (int i = 0; i < 900 && game.x() < 11; ++i) game.go({.move = 0.6});
  EXPECT_GE(game.x(), 11);
}

class ThrownCrate : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Ratios, ThrownCrate, ::testing::Values(0.01, 0.1, 1.0, 10.0, 100.0, 1e4));

TEST_P(ThrownCrate, knocks_the_hero_back_and_gives_it_no_energy_of_its_own) {
  const double ratio = GetParam();  // of the masses, crate to hero
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

TEST(Hero, is_hit_by_a_bullet_that_never_passes_it) {
  OnFloor game;
  b2Fixture& fixture = game.box(b2_dynamicBody, {-9, 0.9F}, 0.02F, 0.02F, 1);
  b2Body& bullet = *fixture.GetBody();
  bullet.SetBullet(true);
  bullet.SetGravityScale(0);
  bullet.SetLinearVelocity({100, 0});
  game.run(30, {});
  EXPECT_LT(static_cast<double>(bullet.GetPosition().x), game.x());
  EXPECT_GT(game.times_begun(fixture), 0);
  EXPECT_LE(game.hero.velocity().norm(), 1) << "a bullet of a five hundredth of its mass";
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

// What readers of a `Hero` found to go wrong, each once.

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

/// The crate creeps by a micrometre in each step: the hero never stood, and could not jump.
TEST(Hero, stands_and_jumps_between_a_slope_and_a_crate_that_rests) {
  for (const float degrees : {55.0F, 63.0F, 75.0F}) {
    for (const float density : {1.0F, 5.0F, 100.0F, 1000.0F}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, density " << density);
      Game game({.position = {0.05, 2.4}});
      const float foot = 6 / std::tan(degrees * static_cast<float>(degree));
      b2PolygonShape slope;
      slope.Set(std::vector<b2Vec2>{{-foot, 6}, {-foot, 0}, {0, 0}}.data(), 3);
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
