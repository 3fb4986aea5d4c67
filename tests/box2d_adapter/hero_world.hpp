/// A small game for tests of `Hero`: a world, and one with a listener and a hero.
#pragma once

#include "campaign/shapes.hpp"

#include <paperproof/box2d/hero.hpp>

#include <box2d/box2d.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace paperproof::box2d::hero_test {

using compare::half_height;
using compare::half_width;

inline constexpr double frame = 1.0 / 60;

/// A character of 0.6 m: it crouches.
inline CharacterDef low() { return {.shape = CharacterShape(compare::box(-0.3, -0.3, 0.3, 0.3).points)}; }

/// What the game's own contact listener sees of the hero.
class HeroListener : public b2ContactListener {
 public:
  void BeginContact(b2Contact* contact) override {
    b2Fixture* other = other_of(*contact);
    if (other == nullptr) return;
    touching.insert(other);
    begun.push_back(other);
    if (on_begin) on_begin();
  }
  void EndContact(b2Contact* contact) override {
    if (b2Fixture* other = other_of(*contact)) touching.erase(other);
  }
  void PreSolve(b2Contact* contact, const b2Manifold* /*before*/) override {
    solved += static_cast<std::size_t>(other_of(*contact) != nullptr);
  }

  const b2Body* hero = nullptr;
  std::multiset<b2Fixture*> touching;
  std::vector<b2Fixture*> begun;
  std::size_t solved = 0;  ///< How often Box2D asked about a contact.
  std::function<void()> on_begin;

 private:
  [[nodiscard]] b2Fixture* other_of(b2Contact& contact) const {
    if (contact.GetFixtureA()->GetBody() == hero) return contact.GetFixtureB();
    if (contact.GetFixtureB()->GetBody() == hero) return contact.GetFixtureA();
    return nullptr;
  }
};

/// Bodies of one fixture each.
struct World {
  b2Fixture& add(b2BodyType type, const b2Vec2& at, const b2Shape& shape, float density = 0) {
    b2BodyDef def;
    def.type = type;
    def.position = at;
    return *world.CreateBody(&def)->CreateFixture(&shape, density);
  }
  b2Fixture& box(b2BodyType type, const b2Vec2& at, float half_width_of_box, float half_height_of_box,
                 float density = 100) {
    b2PolygonShape shape;
    shape.SetAsBox(half_width_of_box, half_height_of_box);
    return add(type, at, shape, density);
  }
  /// Box2D calls it a sensor; it stands.
  b2Fixture& sensor(const b2Vec2& at, float half_size) {
    b2Fixture& fixture = box(b2_staticBody, at, half_size, half_size);
    fixture.SetSensor(true);
    return fixture;
  }
  /// @param points from right to left, where the front is above.
  b2Fixture& chain(const std::vector<b2Vec2>& points, b2BodyType type = b2_staticBody) {
    b2ChainShape shape;
    const b2Vec2 before = points.front() + points.front() - points[1];
    const b2Vec2 after = points.back() + points.back() - points[points.size() - 2];
    shape.CreateChain(points.data(), static_cast<int>(points.size()), before, after);
    return add(type, {0, 0}, shape);
  }
  b2Fixture& floor() { return box(b2_staticBody, {0, -1}, 100, 1); }

  b2World world{{0, -10}};
};

struct Game : World {
  explicit Game(const HeroDef& def = {}) : hero(world, def) {
    world.SetContactListener(&listener);
    listener.hero = &hero.body();
  }

  StepStatus go(const Input& input = {.move = 0.0}) {
    world.Step(static_cast<float>(frame), 8, 3);
    return hero.step(input, frame);
  }
  void run(int frames, const Input& input = {.move = 0.0}) {
    for (int i = 0; i < frames; ++i) go(input);
  }

  [[nodiscard]] double x() const { return hero.position().x(); }
  [[nodiscard]] double feet() const { return hero.position().y() - half_height; }
  /// For the game's listener.
  [[nodiscard]] bool touches(b2Fixture& fixture) const { return listener.touching.count(&fixture) == 1; }
  [[nodiscard]] auto times_begun(const b2Fixture& fixture) const {
    return std::count(listener.begun.begin(), listener.begun.end(), &fixture);
  }

  HeroListener listener;
  Hero hero;
};

/// The floor is at y = 0, and the hero stands on it. In the definition its position is that of its feet.
struct OnFloor : Game {
  explicit OnFloor(HeroDef def = {}) : Game(standing(std::move(def))), ground(floor()) {}

  b2Fixture& ground;

 private:
  static HeroDef standing(HeroDef def) {
    def.position.y() += half_height + 1e-6;
    return def;
  }
};

}  // namespace paperproof::box2d::hero_test
