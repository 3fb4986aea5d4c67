/// What a `Hero` is made of. `hero.cpp` has the calls of a game, `hero_step.cpp` a step, and `hero_body.cpp` the hero's
/// body in the world.
#pragma once

#include "float_geometry.hpp"
#include "near_fixtures.hpp"

#include <paperproof/box2d/hero.hpp>
#include <paperproof/box2d/invalid_definition.hpp>
#include <paperproof/controller.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_world.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace paperproof::box2d {

/// Largest position [m] and speed [m/s] that a call may set.
inline constexpr double largest = 1e6;

inline void require(bool holds, const char* words) {
  if (!holds) throw InvalidDefinition(words);
}

inline void require_number(const Vec2d& value, const char* words) {
  require(std::abs(value.x()) <= largest && std::abs(value.y()) <= largest, words);
}

/// Where the world pulls, as a unit vector the other way.
[[nodiscard]] inline Vec2d up_of(const Vec2d& gravity) {
  const double size = gravity.norm();
  return size > 0 ? Vec2d(-gravity / size) : Vec2d(0, 1);
}

struct Hero::Impl {
  Impl(b2World& in, const HeroDef& from);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] Vec2d gravity() const { return widened(world->GetGravity()); }
  /// The body that carries the hero, if one does. The game may have destroyed it.
  [[nodiscard]] const b2Body* ground_body() const { return fixtures.body_of(state.ride.ground); }

  // hero.cpp
  [[nodiscard]] bool fits(const CharacterDef& character, const Vec2d& position) const;
  void change(const CharacterDef& character);

  // hero_step.cpp
  using Go = std::function<StepStatus(const StepContext& context)>;
  StepStatus advance(double dt, const Go& go);
  [[nodiscard]] bool begin(double dt);
  StepStatus attempt(const StepContext& context, const Go& go);
  void end(double dt);
  [[nodiscard]] StepContext context_of(double dt) const {
    return {.gravity = gravity(), .dt = dt, .up = up_of(gravity())};
  }
  void read_near(const Box2& needed);
  StepStatus step_as_far_as_read(StepContext& context, const Go& go);
  void limit_speed(double dt);
  void note_step();
  void note_sensors_at_begin();
  void note_sensors();
  void note_contacts();

  // hero_body.cpp
  static b2Body& make_body(b2World& world, const HeroDef& def);
  void make_fixture(const b2Filter& filter);
  void remake_fixture();
  void take_impacts();
  [[nodiscard]] Vec2d strike(double dt) const;
  [[nodiscard]] Vec2d place_for_body() const;
  void lead_body(double dt);

  b2World* world;
  HeroDef def;
  b2Body* body;
  NearFixtures fixtures;
  Controller controller;
  Scratch scratch;
  CharacterState state;
  /// When the present step begins.
  struct Begun {
    CharacterState state;
    Vec2d own_velocity{Vec2d::Zero()};   ///< With the impacts on its body [m/s].
    Vec2d body_velocity{Vec2d::Zero()};  ///< [m/s]
  } begun;
  Vec2d struck{Vec2d::Zero()};  ///< See `strike`.
  StepReport report;
  std::vector<HeroContact> contacts;
  std::vector<HeroContact> contacts_before;
  std::vector<HeroContact> contacts_now;
  std::vector<HeroSensorEvent> sensors;
  std::vector<b2Fixture*> inside;  ///< Sensors that it overlaps.
  std::vector<b2Fixture*> crushed_by;
  std::vector<b2Fixture*> skipped;
};

}  // namespace paperproof::box2d
