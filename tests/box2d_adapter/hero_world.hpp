/// A small game for tests of `Hero`: a world, a listener, and a hero.
#pragma once

#include <paperproof/box2d/hero.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_contact.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>
#include <box2d/b2_world_callbacks.h>

#include <set>
#include <vector>

namespace paperproof::box2d::hero_test {

inline constexpr double frame = 1.0 / 60;
inline constexpr double half_height = 0.625;  ///< Of the default hero [m].

/// What the game's own contact listener sees of the hero.
class HeroListener : public b2ContactListener {
 public:
  explicit HeroListener(const b2Body*& hero) : hero_(hero) {}
  void BeginContact(b2Contact* contact) override {
    if (b2Fixture* other = other_of(*contact)) {
      touching.insert(other);
      begun.push_back(other);
    }
  }
  void EndContact(b2Contact* contact) override {
    if (b2Fixture* other = other_of(*contact)) touching.erase(other);
  }

  std::multiset<b2Fixture*> touching;
  std::vector<b2Fixture*> begun;

 private:
  [[nodiscard]] b2Fixture* other_of(b2Contact& contact) const {
    if (contact.GetFixtureA()->GetBody() == hero_) return contact.GetFixtureB();
    if (contact.GetFixtureB()->GetBody() == hero_) return contact.GetFixtureA();
    return nullptr;
  }
  const b2Body*& hero_;
};

struct Game {
  explicit Game(const HeroDef& def = {}) : hero(world, def) {
    world.SetContactListener(&listener);
    hero_body = &hero.body();
  }

  b2Fixture& box(b2BodyType type, const b2Vec2& at, float half_width, float half_height_of_box, float density = 100) {
    b2BodyDef def;
    def.type = type;
    def.position = at;
    b2PolygonShape shape;
    shape.SetAsBox(half_width, half_height_of_box);
    return *world.CreateBody(&def)->CreateFixture(&shape, density);
  }
  b2Fixture& floor() { return box(b2_staticBody, {0, -1}, 100, 1); }

  StepStatus go(const Input& input = {.move = 0.0}) {
    world.Step(static_cast<float>(frame), 8, 3);
    return hero.step(input, frame);
  }
  void run(int frames, const Input& input = {.move = 0.0}) {
    for (int i = 0; i < frames; ++i) go(input);
  }

  b2World world{{0, -10}};
  const b2Body* hero_body = nullptr;
  HeroListener listener{hero_body};
  Hero hero;
};

}  // namespace paperproof::box2d::hero_test
