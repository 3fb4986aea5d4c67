/// A hero among random bodies, against the controller over the controller's own scenery, and against exact overlap.
#include "hero_world.hpp"

#include <paperproof/box2d/world_scenery.hpp>

#include "shapes.hpp"
#include "support/box2d_level.hpp"
#include "support/random_runs.hpp"
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

/// The fixtures of a world that the hero overlaps where everything is now: solids, or sensors.
std::vector<const b2Fixture*> overlapped(b2World& world, const Hero& hero, bool sensors = false) {
  SceneryDef now;
  std::vector<MoverMotion<double>> standing;
  std::vector<const b2Fixture*> all;
  const b2Filter& own = hero.body().GetFixtureList()->GetFilterData();
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body == &hero.body() || !body->IsEnabled()) continue;
    b2Transform turned = body->GetTransform();
    const Vec2d at(static_cast<double>(turned.p.x), static_cast<double>(turned.p.y));
    turned.p.SetZero();
    bool any = false;
    for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
      if (fixture->IsSensor() != sensors || (fixture->GetFilterData().maskBits & own.categoryBits) == 0) continue;
      now.colliders.push_back(collider_of(*fixture->GetShape(), turned));
      now.colliders.back().mover = static_cast<MoverIndex>(standing.size());
      all.push_back(fixture);
      any = true;
    }
    if (any) standing.push_back({at, at});
  }
  const Scenery<double> scenery(now);
  const Controller<double> controller(scenery, hero.save().character);
  Scratch<double> scratch = controller.make_scratch();
  std::vector<ColliderIndex> found(all.size());
  found.resize(controller.overlaps(hero.position(), {{0, 0}, frame, standing}, scratch, found).value());
  std::vector<const b2Fixture*> result;
  for (const ColliderIndex collider : found) result.push_back(all[collider]);
  std::sort(result.begin(), result.end());
  return result;
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
      ASSERT_TRUE(!is_checked || overlapped(world, hero).empty()) << "seed " << seed << ", step " << i;
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

bool exists(b2World& world, const b2Fixture* fixture) {
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    if (body->GetFixtureList() == fixture) return true;
  return false;
}

/// What a game does between two steps: to bodies, fixtures and the hero.
class Changes {
 public:
  Changes(b2World& world, Hero& hero, Random& random) : world_(world), hero_(hero), random_(random) {}

  void make() {
    if (random_.chance(0.02)) add_body(world_, random_);
    b2Body* body = any_body();
    if (body == nullptr) return;
    b2Fixture& fixture = *body->GetFixtureList();
    switch (random_.integer(0, 14)) {
      case 0:
        body->SetType(static_cast<b2BodyType>(random_.integer(0, 2)));
        break;
      case 1:
        body->SetTransform(place(), static_cast<float>(random_.chance(0.3) ? 0 : random_.angle()));
        break;
      case 2:
        body->SetEnabled(!body->IsEnabled());
        break;
      case 3:
        world_.DestroyBody(body);
        break;
      case 4:
        fixture.SetSensor(!fixture.IsSensor());
        // Box2D stops at an assertion, if a body that slept on the sensor is woken by another one.
        for (b2Body* each = world_.GetBodyList(); each != nullptr; each = each->GetNext()) each->SetAwake(true);
        break;
      case 5:
        set_mask(fixture, fixture.GetFilterData().maskBits == 0 ? 0xFFFF : 0);
        break;
      case 6:
        if (body->GetType() != b2_staticBody) body->SetAngularVelocity(static_cast<float>(random_.between(-4, 4)));
        break;
      case 7:
        if (body->GetType() != b2_staticBody) body->SetLinearVelocity({static_cast<float>(random_.between(-3, 3)), 0});
        break;
      case 8:
        hero_.place({random_.between(-8, 8), random_.between(-9, -6)});
        break;
      case 9:
        hero_.change(random_.chance(0.5) ? CharacterDef{} : low());
        break;
      case 10:
        hero_.restore(hero_.save());
        break;
      case 11:
        hero_.knock_back({random_.between(-5, 5), random_.between(-5, 9)});
        break;
      default:
        break;
    }
  }

 private:
  static CharacterDef low() {
    CharacterDef result;
    result.shape = CharacterShape(std::array{Vec2d(-0.3, -0.3), Vec2d(0.3, -0.3), Vec2d(0.3, 0.3), Vec2d(-0.3, 0.3)});
    return result;
  }
  static void set_mask(b2Fixture& fixture, std::uint16_t mask) {
    b2Filter filter = fixture.GetFilterData();
    filter.maskBits = mask;
    fixture.SetFilterData(filter);
  }
  b2Vec2 place() {
    const double x = random_.between(-3, 3) + hero_.position().x();
    return {static_cast<float>(x), static_cast<float>(random_.between(-3, 3) + hero_.position().y())};
  }
  /// But the hero's, and the floor, which was made first.
  b2Body* any_body() {
    int left = random_.integer(0, world_.GetBodyCount() - 1);
    b2Body* body = world_.GetBodyList();
    while (left-- > 0) body = body->GetNext();
    return body == &hero_.body() || body->GetNext() == nullptr ? nullptr : body;
  }

  b2World& world_;
  Hero& hero_;
  Random& random_;
};

TEST(HeroInAChangingWorld, is_in_no_solid_and_knows_its_sensors) {
  const int wanted = steps_wanted("PAPERPROOF_HERO_STEPS", 6000);
  int steps = 0;
  int touching = 0;
  int in_sensor = 0;
  int events = 0;
  int in_trouble = 0;
  int rolled_back = 0;
  const auto play = [&](std::uint64_t seed) {
    Random random(seed);
    b2World world({0, -10});
    b2BodyDef ground;
    b2PolygonShape floor;
    floor.SetAsBox(40, 1, {0, -11}, 0);
    world.CreateBody(&ground)->CreateFixture(&floor, 0);
    for (int i = 0; i < 40; ++i) {
      add_body(world, random);
      b2Body& body = *world.GetBodyList();
      body.SetTransform({body.GetPosition().x / 2, body.GetPosition().y - 1}, body.GetAngle());
      body.GetFixtureList()->SetSensor(random.chance(0.2));
    }
    Hero hero(world, {.position = {random.between(-8, 8), 0}});
    Changes changes(world, hero, random);
    std::vector<const b2Fixture*> inside;
    Input input;
    for (int i = 0; i < 300; ++i, ++steps) {
      if (i % 20 == 0) input = random_input(random);
      if (random.chance(0.5)) changes.make();
      world.Step(static_cast<float>(frame), 8, 3);
      if (random.chance(0.5)) changes.make();
      const auto where = [&] { return "seed " + std::to_string(seed) + ", step " + std::to_string(i); };
      const HeroSave before = hero.save();
      const StepStatus status = hero.step(input, frame);
      if (i % 3 == 0) {
        const CharacterState<double> first = hero.state();
        hero.restore(before);
        ASSERT_EQ(hero.step(input, frame), status) << where();
        ASSERT_EQ(hero.position(), first.position) << where();
        ASSERT_EQ(hero.velocity(), first.velocity) << where();
        ASSERT_EQ(hero.grounded(), first.grounded) << where();
        ++rolled_back;
      }
      ASSERT_NE(status, StepStatus::invalid_input) << where();
      ASSERT_NE(status, StepStatus::refused) << where();
      ASSERT_EQ(hero.report().move.position, hero.position()) << where();
      ASSERT_EQ(hero.report().move.path.back().position, hero.position()) << where();
      ASSERT_EQ(hero.grounded(), hero.report().move.grounded) << where();
      ASSERT_LE(hero.grounded(), hero.ground() != nullptr) << where();
      const bool has_room = status == StepStatus::moved || status == StepStatus::dropped;
      if (has_room) {
        ASSERT_TRUE(overlapped(world, hero).empty()) << where();
      }
      in_trouble += !has_room;
      for (const HeroSensorEvent& event : hero.sensors()) {
        const auto known = std::find(inside.begin(), inside.end(), event.sensor);
        const bool enters = event.change == SensorEvent<double>::Change::enter;
        ASSERT_EQ(enters, known == inside.end()) << where();
        if (enters)
          inside.push_back(event.sensor);
        else
          inside.erase(known);
        ++events;
      }
      std::vector<const b2Fixture*> says(hero.inside().begin(), hero.inside().end());
      std::sort(says.begin(), says.end());
      ASSERT_EQ(says, overlapped(world, hero, true)) << where();
      touching += !hero.contacts().empty();
      in_sensor += !says.empty();
      std::erase_if(inside, [&](const b2Fixture* one) { return !exists(world, one); });  // these send no event
      std::sort(inside.begin(), inside.end());
      ASSERT_EQ(inside, says) << where();
    }
  };
  for (std::uint64_t seed = 1; steps < wanted && !HasFatalFailure(); ++seed) play(seed);
  EXPECT_GE(rolled_back, steps / 4);
  EXPECT_GE(touching, steps / 12);
  EXPECT_GE(in_sensor, steps / 100);
  EXPECT_GE(events, steps / 100);
  EXPECT_LE(in_trouble, steps / 10);
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
