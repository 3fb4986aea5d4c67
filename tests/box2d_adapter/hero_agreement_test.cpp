/// A hero among random bodies, against exact overlap.
#include "hero_world.hpp"

#include "float_geometry.hpp"
#include "shapes.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/box2d/world_scenery.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace paperproof::box2d::hero_test {
namespace {

using compare::PlayLevel;
using compare::Random;
using test::steps_wanted;

float between(Random& random, double low, double high) { return static_cast<float>(random.between(low, high)); }

/// The pieces of a level as static fixtures: convex polygons, and chains of one segment each.
void build_level(b2World& world, const Scenery& scenery) {
  const b2BodyDef still;
  b2Body& body = *world.CreateBody(&still);
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    std::vector<b2Vec2> points;
    for (const Vec2d& point : scenery.vertices_of(piece)) points.push_back(rounded(point));
    if (points.size() > b2_maxPolygonVertices) points.resize(b2_maxPolygonVertices);
    b2PolygonShape polygon;
    b2ChainShape chain;
    if (points.size() >= 3)
      polygon.Set(points.data(), static_cast<int>(points.size()));
    else
      chain.CreateChain(points.data(), 2, points[0], points[1]);
    body.CreateFixture(points.size() >= 3 ? static_cast<b2Shape*>(&polygon) : &chain, 0);
  }
}

/// Crates, balls, planks: whatever turns.
b2Body& add_body(b2World& world, Random& random) {
  b2BodyDef def;
  def.type = random.chance(0.7) ? b2_dynamicBody : b2_kinematicBody;
  def.position = b2Vec2{between(random, -20, 20), between(random, -8, 14)};
  def.angle = static_cast<float>(random.angle());
  if (def.type == b2_kinematicBody) def.linearVelocity = {between(random, -2, 2), 0};
  def.angularVelocity = between(random, -3, 3);
  b2CircleShape circle;
  circle.m_radius = between(random, 0.1, 1);
  b2PolygonShape box;
  const float half = between(random, 0.1, 1.5);
  box.SetAsBox(half, between(random, 0.05, 0.6));
  const auto density = static_cast<float>(random.log_between(0.05, 50));
  b2Body& body = *world.CreateBody(&def);
  body.CreateFixture(random.chance(0.3) ? static_cast<b2Shape*>(&circle) : &box, density);
  return body;
}

enum class Kind : std::uint8_t { solid, sensor };

/// The fixtures of a kind that the hero overlaps where everything is now.
std::set<const b2Fixture*> overlapped(b2World& world, const Hero& hero, Kind kind) {
  SceneryDef now;
  std::vector<MoverMotion> standing;
  std::vector<const b2Fixture*> all;
  const b2Filter& own = hero.body().GetFixtureList()->GetFilterData();
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body == &hero.body() || !body->IsEnabled()) continue;
    b2Transform turned = body->GetTransform();
    const Vec2d at = widened(turned.p);
    turned.p.SetZero();
    const std::size_t before = all.size();
    for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
      if (fixture->IsSensor() != (kind == Kind::sensor)) continue;
      if ((fixture->GetFilterData().maskBits & own.categoryBits) == 0) continue;
      now.colliders.push_back(collider_of(*fixture->GetShape(), turned));
      now.colliders.back().mover = static_cast<MoverIndex>(standing.size());
      all.push_back(fixture);
    }
    if (all.size() > before) standing.push_back({at, at});
  }
  const Scenery scenery(now);
  const Controller controller(scenery, hero.save().character);
  Scratch scratch = controller.make_scratch();
  std::vector<ColliderIndex> found(all.size());
  found.resize(controller.overlaps(hero.position(), {{0, 0}, frame, standing}, scratch, found).value());
  std::set<const b2Fixture*> result;
  for (const ColliderIndex collider : found) result.insert(all[collider]);
  return result;
}

bool has_room(StepStatus status) { return status == StepStatus::moved || status == StepStatus::dropped; }

/// What a game does between two steps: to a body, to its fixture, and to the hero.
void change_something(b2World& world, Hero& hero, Random& random) {
  if (random.chance(0.02)) add_body(world, random);
  int left = random.integer(0, world.GetBodyCount() - 1);
  b2Body* body = world.GetBodyList();
  while (left-- > 0) body = body->GetNext();
  if (body == &hero.body() || body->GetNext() == nullptr) return;  // the floor was made first
  b2Fixture& fixture = *body->GetFixtureList();
  const auto near_hero = [&] {
    return rounded(hero.position()) + b2Vec2{between(random, -3, 3), between(random, -3, 3)};
  };
  const std::array<std::function<void()>, 12> changes{
      [&] { body->SetType(static_cast<b2BodyType>(random.integer(0, 2))); },
      [&] {
        const float angle = random.chance(0.3) ? 0 : static_cast<float>(random.angle());
        body->SetTransform(near_hero(), angle);
      },
      [&] { body->SetEnabled(!body->IsEnabled()); },
      [&] { world.DestroyBody(body); },
      [&] {
        fixture.SetSensor(!fixture.IsSensor());
        // Box2D stops at an assertion, if a body that slept on the sensor is woken by another one.
        for (b2Body* each = world.GetBodyList(); each != nullptr; each = each->GetNext()) each->SetAwake(true);
      },
      [&] {
        b2Filter filter = fixture.GetFilterData();
        filter.maskBits = filter.maskBits == 0 ? 0xFFFF : 0;
        fixture.SetFilterData(filter);
      },
      [&] { body->SetAngularVelocity(between(random, -4, 4)); },
      [&] { body->SetLinearVelocity(b2Vec2(between(random, -3, 3), 0)); },
      [&] {
        hero.place({random.chance(0.2) ? 35.0 : random.between(-8, 8), random.between(-9, -6)});
      },
      [&] { hero.change(random.chance(0.5) ? CharacterDef{} : low()); },
      [&] { hero.restore(hero.save()); },
      [&] {
        hero.knock_back({random.between(-5, 5), random.between(-5, 9)});
      }};
  const auto which = static_cast<std::size_t>(random.below(15));
  if (which < changes.size()) changes[which]();
}

bool exists(b2World& world, const b2Fixture* fixture) {
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    if (body->GetFixtureList() == fixture) return true;
  return false;
}

/// Nothing: a floor in a world that changes between the steps.
using Level = std::optional<PlayLevel>;

std::vector<Level> all_levels() {
  std::vector<Level> all(test::all_play_levels.begin(), test::all_play_levels.end());
  all.emplace_back();
  return all;
}

class HeroInPlay : public ::testing::TestWithParam<Level> {};
INSTANTIATE_TEST_SUITE_P(EveryLevel, HeroInPlay, ::testing::ValuesIn(all_levels()), [](const auto& level) {
  return level.param ? test::name_of(*level.param) : "changing_world";
});

TEST_P(HeroInPlay, is_in_no_solid_and_knows_its_sensors) {
  const bool is_changing = !GetParam();
  int steps = 0;
  int touching = 0;
  int hit = 0;
  int carried = 0;
  int in_sensor = 0;
  int in_trouble = 0;
  const auto play = [&](std::uint64_t seed) {
    Random random(seed);
    b2World world({0, -10});
    const SceneryDef floor{{compare::box(-40, -12, 40, -10)}};
    build_level(world, Scenery(GetParam() ? compare::play_level(*GetParam(), random) : floor));
    const Scenery scenery(scenery_of(world).scenery);
    const Controller standing(scenery, {});
    Scratch scratch = standing.make_scratch();
    for (int i = 0; i < (is_changing ? 40 : 30); ++i) {
      b2Body& body = add_body(world, random);
      if (!is_changing) continue;
      body.SetTransform({body.GetPosition().x / 2, body.GetPosition().y - 1}, body.GetAngle());
      body.GetFixtureList()->SetSensor(random.chance(0.2));
    }
    Hero hero(world, {.position = {random.between(-20, 20) * (is_changing ? 0.4 : 1), is_changing ? 0 : 16}});
    std::set<const b2Fixture*> inside;
    Input input;
    for (int i = 0; i < 300; ++i, ++steps) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << i);
      if (i % 20 == 0) input = {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
      if (is_changing && random.chance(0.5)) change_something(world, hero, random);
      world.Step(static_cast<float>(frame), 8, 3);
      if (is_changing && random.chance(0.5)) change_something(world, hero, random);
      const HeroSave before = hero.save();
      const StepStatus status = hero.step(input, frame);
      if (i % 3 == 0) {
        const CharacterState first = hero.state();
        hero.restore(before);
        ASSERT_EQ(hero.step(input, frame), status);
        ASSERT_EQ(hero.position(), first.position);
        ASSERT_EQ(hero.velocity(), first.velocity);
        ASSERT_EQ(hero.grounded(), first.grounded);
      }
      ASSERT_NE(status, StepStatus::invalid_input);
      ASSERT_NE(status, StepStatus::refused);
      const MoveResult& move = hero.report().move;
      ASSERT_EQ(move.position, hero.position());
      ASSERT_EQ(move.velocity, hero.velocity());
      ASSERT_EQ(move.path.back().position, hero.position());
      ASSERT_EQ(move.grounded, hero.grounded());
      ASSERT_LE(hero.grounded(), hero.ground() != nullptr);
      ASSERT_TRUE(!has_room(status) || overlapped(world, hero, Kind::solid).empty());
      if (!is_changing) {
        ASSERT_EQ(standing.overlaps(hero.position(), {}, scratch), 0U) << "status " << static_cast<int>(status);
        ASSERT_TRUE(std::abs(hero.position().x()) <= 30 && hero.position().y() >= -12) << "it left the hall";
        ASSERT_LE(hero.velocity().norm(), 40);
      }
      in_trouble += !has_room(status);
      touching += !hero.contacts().empty();
      for (const HeroContact& contact : hero.contacts())
        hit += contact.change == HeroContact::Change::added && contact.fixture->GetBody()->GetType() != b2_staticBody;
      carried += hero.state().ride.ground != Ride::none;
      for (const HeroSensorEvent& event : hero.sensors()) {
        const bool enters = event.change == SensorEvent::Change::enter;
        ASSERT_TRUE(enters ? inside.insert(event.sensor).second : inside.erase(event.sensor) == 1);
      }
      std::erase_if(inside, [&](const b2Fixture* one) { return !exists(world, one); });  // these send no event
      ASSERT_EQ(std::set<const b2Fixture*>(hero.inside().begin(), hero.inside().end()), inside);
      ASSERT_EQ(hero.inside().size(), inside.size()) << "a sensor is listed twice";
      ASSERT_EQ(inside, overlapped(world, hero, Kind::sensor));
      in_sensor += !inside.empty();
    }
  };
  const int wanted = steps_wanted("PAPERPROOF_HERO_STEPS", is_changing ? 6000 : 3000);
  for (std::uint64_t seed = 1; steps < wanted && !HasFatalFailure(); ++seed) play(seed);
  play(87);  // among the arches a hero that was squeezed forgot what it had touched on its way
  EXPECT_GE(touching, steps / 12);
  EXPECT_GE(hit, steps / 600);
  EXPECT_GE(carried, steps / 600);
  EXPECT_GE(in_sensor, is_changing ? steps / 100 : 0);
  EXPECT_LE(in_trouble, steps / 10);
}

/// Any play with the drop button, over random hills of two chains: the hero is never below them. Nor is its middle,
/// where each has few segments: the hero may drop past the end of one into another, which then lifts it out.
TEST(OneSidedChain, holds_any_play_over_random_hills) {
  int in_the_air = 0;
  int steps = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    std::vector<b2Vec2> hills;
    const double steepest = random.log_between(0.01, 4);
    double height = 0;
    for (double x = 12; x > -12;) {
      hills.emplace_back(static_cast<float>(x), static_cast<float>(height));
      const double length = random.between(0.05, 2);
      x -= length;
      height = std::clamp(height + length * random.between(-steepest, steepest), -4.0, 4.0);
    }
    Game game({.position = {0, 8}});
    const bool is_cut_often = seed % 2 == 0;
    for (auto from = hills.begin(), to = from; hills.end() - from > 1; from = to) {
      to = from + std::min(is_cut_often ? 1 + random.below(4) : std::ssize(hills) / 2, hills.end() - from - 1);
      game.chain({from, to + 1});
    }
    Input input;
    for (int i = 0; i < 400; ++i) {
      if (random.chance(0.05)) input.move = random.integer(-1, 1);
      if (random.chance(input.jump ? 0.3 : 0.02)) input.jump = !input.jump;
      input.drop = random.chance(0.3);
      game.go(input);
      if (std::abs(game.x()) > 10) break;
      ++steps;
      in_the_air += !game.hero.grounded();
      const auto to = std::ranges::find_if(hills, [&](const b2Vec2& hill) { return hill.x <= game.x(); });
      const Vec2d left(to[0].x, to[0].y);
      const Vec2d right(to[-1].x, to[-1].y);
      const double ground = left.y() + (right.y() - left.y()) * (game.x() - left.x()) / (right.x() - left.x());
      ASSERT_GE(is_cut_often ? game.hero.position().y() : game.feet(), ground - 1e-6)
          << "seed " << seed << ", frame " << i;
    }
  }
  EXPECT_GT(steps, 4000);
  EXPECT_GT(in_the_air, steps / 10);
  EXPECT_LT(in_the_air, steps * 9 / 10);
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
