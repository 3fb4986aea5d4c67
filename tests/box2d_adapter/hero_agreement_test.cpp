/// A hero among random bodies, against the controller over the controller's own scenery, and against exact overlap.
#include "hero_world.hpp"

#include <paperproof/box2d/world_scenery.hpp>

#include "shapes.hpp"
#include "support/box2d_level.hpp"
#include "support/play_levels.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace paperproof::box2d::hero_test {
namespace {

using paperproof::test::all_play_levels;
using paperproof::test::name_of;
using paperproof::test::play_level;
using paperproof::test::PlayLevel;
using paperproof::test::Random;
using paperproof::test::steps_wanted;

Input random_input(Random& random) {
  return {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
}

class HeroInPlay : public ::testing::TestWithParam<PlayLevel> {};

TEST_P(HeroInPlay, steps_have_the_bits_of_the_controller_over_the_whole_scenery) {
  int steps = 0;
  int touching = 0;
  const int wanted = steps_wanted("PAPERPROOF_HERO_STEPS", 3000);
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    CharacterDef character;
    character.snap = random.chance(0.5) ? 0.2 : 0;
    b2World world({0, -30});
    paperproof::test::build_level(world, Scenery<double>(play_level(GetParam(), random)));
    const Vec2d start(random.between(-25, 25), 12);
    const WorldScenery borrowed = scenery_of(world);
    const Scenery<double> scenery(borrowed.scenery);
    const Controller<double> controller(scenery, character);
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    CharacterState<double> state;
    state.position = start;
    Hero hero(world, {.character = character, .position = start});
    Input input;
    for (int i = 0; i < 300; ++i, ++steps) {
      if (i % 20 == 0) input = random_input(random);
      world.Step(static_cast<float>(frame), 8, 3);
      hero.step(input, frame);
      controller.step(state, input, {{0, -30}, frame}, scratch, report);
      ASSERT_EQ(hero.position(), state.position) << "seed " << seed << ", step " << i;
      ASSERT_EQ(hero.velocity(), state.velocity) << "seed " << seed << ", step " << i;
      ASSERT_EQ(hero.grounded(), state.grounded) << "seed " << seed << ", step " << i;
      touching += !hero.contacts().empty();
    }
  }
  EXPECT_GE(touching, steps / 4);
}

/// Crates, balls, planks on a pin: whatever turns.
void add_body(b2World& world, Random& random) {
  b2BodyDef def;
  def.type = random.chance(0.7) ? b2_dynamicBody : b2_kinematicBody;
  def.position = {static_cast<float>(random.between(-20, 20)), static_cast<float>(random.between(-8, 14))};
  def.angle = static_cast<float>(random.angle());
  const bool is_kinematic = def.type == b2_kinematicBody;
  if (is_kinematic) def.linearVelocity = {static_cast<float>(random.between(-2, 2)), 0};
  def.angularVelocity = static_cast<float>(random.between(-3, 3));
  b2Body* body = world.CreateBody(&def);
  b2CircleShape circle;
  circle.m_radius = static_cast<float>(random.between(0.1, 1));
  b2PolygonShape box;
  const Vec2d half{random.between(0.1, 1.5), random.between(0.05, 0.6)};  // in this order with every compiler
  box.SetAsBox(static_cast<float>(half.x()), static_cast<float>(half.y()));
  const auto density = static_cast<float>(random.log_between(0.05, 50));
  body->CreateFixture(random.chance(0.3) ? static_cast<b2Shape*>(&circle) : &box, density);
}

/// How many fixtures of a world, but the hero's own, the hero overlaps where everything is now.
std::size_t overlaps_now(b2World& world, const Hero& hero) {
  SceneryDef now;
  std::vector<MoverMotion<double>> standing;
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body == &hero.body()) continue;
    b2Transform turned = body->GetTransform();
    const Vec2d at(static_cast<double>(turned.p.x), static_cast<double>(turned.p.y));
    turned.p.SetZero();
    for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
      now.colliders.push_back(collider_of(*fixture->GetShape(), turned));
      now.colliders.back().mover = static_cast<MoverIndex>(standing.size());
    }
    standing.push_back({at, at});
  }
  const Scenery<double> scenery(now);
  const Controller<double> controller(scenery, {});
  Scratch<double> scratch = controller.make_scratch();
  return controller.overlaps(hero.position(), {{0, 0}, frame, standing}, scratch).value();
}

TEST_P(HeroInPlay, never_gets_into_what_stands_among_bodies_that_turn) {
  int steps = 0;
  int hit = 0;
  int carried = 0;
  int crushed = 0;
  double fastest = 0;  // [m/s]
  const int wanted = steps_wanted("PAPERPROOF_HERO_STEPS", 3000);
  const auto play = [&](std::uint64_t seed) {
    Random random(seed);
    b2World world({0, -10});
    paperproof::test::build_level(world, Scenery<double>(play_level(GetParam(), random)));
    const WorldScenery borrowed = scenery_of(world);
    const Scenery<double> scenery(borrowed.scenery);
    const Controller<double> standing(scenery, {});
    Scratch<double> scratch = standing.make_scratch();
    for (int i = 0; i < 30; ++i) add_body(world, random);
    Hero hero(world, {.position = {random.between(-20, 20), 16}});
    Input input;
    for (int i = 0; i < 300; ++i, ++steps) {
      if (i % 20 == 0) input = random_input(random);
      world.Step(static_cast<float>(frame), 8, 3);
      const StepStatus status = hero.step(input, frame);
      ASSERT_TRUE(hero.position().allFinite());
      ASSERT_EQ(standing.overlaps(hero.position(), {{0, -10}, frame}, scratch), 0U)
          << "seed " << seed << ", step " << i << ", status " << static_cast<int>(status);
      const bool is_in_the_hall = std::abs(hero.position().x()) <= 30 && hero.position().y() >= -12;
      ASSERT_TRUE(is_in_the_hall) << "seed " << seed << ", step " << i;
      const bool has_room = status == StepStatus::moved || status == StepStatus::dropped;
      const bool is_checked = has_room && !hero.contacts().empty();
      ASSERT_EQ(is_checked ? overlaps_now(world, hero) : 0U, 0U) << "seed " << seed << ", step " << i;
      for (const HeroContact& contact : hero.contacts())
        hit += contact.change == HeroContact::Change::added && contact.fixture->GetBody()->GetType() != b2_staticBody;
      carried += hero.state().ride.ground != Ride<double>::none;
      crushed += status == StepStatus::crushed || status == StepStatus::stuck;
      fastest = std::max(fastest, hero.velocity().norm());
    }
  };
  for (std::uint64_t seed = 1; steps < wanted && !HasFatalFailure(); ++seed) play(seed);
  play(87);  // among the arches a hero that was squeezed forgot what it had touched on its way
  EXPECT_GE(hit, steps / 600);
  EXPECT_GE(carried, steps / 600);
  EXPECT_LE(crushed, steps / 10);
  EXPECT_LE(fastest, 40);
}

/// Tiles of a metre, which a game makes and destroys.
class Tiles {
 public:
  static constexpr int width = 40;
  static constexpr int height = 12;

  explicit Tiles(b2World& world) : body_(world.CreateBody(std::make_unique<b2BodyDef>().get())) {
    b2PolygonShape floor;
    floor.SetAsBox(width, 1, {width / 2.0F, -1}, 0);
    body_->CreateFixture(&floor, 0);
  }
  void toggle(std::size_t tile) {
    if (fixtures_[tile] != nullptr) {
      body_->DestroyFixture(std::exchange(fixtures_[tile], nullptr));
      return;
    }
    b2PolygonShape shape;
    shape.SetAsBox(0.5F, 0.5F, {static_cast<float>(tile % width) + 0.5F, static_cast<float>(tile / width) + 0.5F}, 0);
    fixtures_[tile] = body_->CreateFixture(&shape, 0);
  }
  [[nodiscard]] bool has(std::size_t tile) const { return fixtures_[tile] != nullptr; }

 private:
  b2Body* body_;
  std::array<b2Fixture*, static_cast<std::size_t>(width) * height> fixtures_{};
};

TEST(HeroAmongTiles, edited_100000_times_steps_as_in_a_level_that_was_built_at_once) {
  constexpr std::size_t count = static_cast<std::size_t>(Tiles::width) * Tiles::height;
  Random random(1);
  b2World edited_world({0, -10});
  Tiles edited(edited_world);
  Hero edited_hero(edited_world, {.position = {20, 13}});
  for (int i = 0; i < 100'000; ++i) {
    edited.toggle(static_cast<std::size_t>(random.integer(0, count - 1)));
    if (i % 100 == 0) {
      edited_world.Step(static_cast<float>(frame), 8, 3);
      edited_hero.step(random_input(random), frame);
    }
  }
  b2World world({0, -10});
  Tiles tiles(world);
  std::size_t solid = 0;
  for (std::size_t tile = 0; tile < count; ++tile) {
    if (!edited.has(tile)) continue;
    tiles.toggle(tile);
    ++solid;
  }
  ASSERT_GE(solid, count / 4);
  Hero hero(world, {.position = {20, 13}});
  edited_hero.place({20, 13});
  int touching = 0;
  Input input;
  for (int i = 0; i < 600; ++i) {
    if (i % 20 == 0) input = {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.2)};
    for (b2World* each : {&world, &edited_world}) each->Step(static_cast<float>(frame), 8, 3);
    hero.step(input, frame);
    edited_hero.step(input, frame);
    ASSERT_EQ(hero.position(), edited_hero.position()) << "step " << i;
    ASSERT_EQ(hero.velocity(), edited_hero.velocity()) << "step " << i;
    ASSERT_EQ(hero.grounded(), edited_hero.grounded()) << "step " << i;
    touching += !hero.contacts().empty();
  }
  EXPECT_GE(touching, 300);
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, HeroInPlay, ::testing::ValuesIn(all_play_levels),
                         [](const ::testing::TestParamInfo<PlayLevel>& level) { return name_of(level.param); });

}  // namespace
}  // namespace paperproof::box2d::hero_test
