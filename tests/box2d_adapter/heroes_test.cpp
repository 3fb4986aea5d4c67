/// Several heroes of one world that take turns.
#include "box2d_adapter/hero_world.hpp"
#include "controller/states.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace paperproof::box2d {
namespace {

using hero_test::frame;
using hero_test::half_height;
using hero_test::half_width;

b2Body& add(b2World& world, b2BodyType type, const b2Vec2& at, const b2PolygonShape& shape, float density = 0) {
  b2BodyDef def;
  def.type = type;
  def.position = at;
  b2Body& body = *world.CreateBody(&def);
  body.CreateFixture(&shape, density);
  return body;
}

b2Body& add_box(b2World& world, b2BodyType type, const b2Vec2& at, float half_x, float half_y, float density = 0) {
  b2PolygonShape shape;
  shape.SetAsBox(half_x, half_y);
  return add(world, type, at, shape, density);
}

b2Body* add_floor(b2World& world) { return &add_box(world, b2_staticBody, {0, -1}, 60, 1); }
b2Body* add_lift(b2World& world) { return &add_box(world, b2_kinematicBody, {0, -1}, 4, 1); }

b2Body* add_slope(b2World& world) {
  add_box(world, b2_staticBody, {-20, -1}, 20, 1);
  b2PolygonShape shape;
  const std::array<b2Vec2, 3> corners{b2Vec2{0, 0}, {60, 0}, {60, 60 * std::tan(30 * b2_pi / 180)}};
  shape.Set(corners.data(), 3);
  return &add(world, b2_staticBody, {0, 0}, shape);
}

b2Body* add_wall(b2World& world) {
  add_floor(world);
  return &add_box(world, b2_kinematicBody, {-2.5F, 1.5F}, 0.5F, 1.4F);
}

b2Body* add_crate(b2World& world) {
  add_floor(world);
  return &add_box(world, b2_dynamicBody, {0, 0.505F}, 0.5F, 0.5F, 100);
}

/// Of planks, from -7 m to 7 m.
b2Body* add_bridge(b2World& world) {
  b2Body* before = &add_box(world, b2_staticBody, {-8, -1}, 1, 0.125F);
  const auto join = [&](b2Body& next, float x) {
    b2RevoluteJointDef joint;
    joint.Initialize(before, &next, {x, -1});
    world.CreateJoint(&joint);
    before = &next;
  };
  for (int i = 0; i < 14; ++i) {
    const auto x = static_cast<float>(i);
    join(add_box(world, b2_dynamicBody, {-6.5F + x, -1}, 0.5F, 0.125F, 20), -7 + x);
  }
  join(add_box(world, b2_staticBody, {8, -1}, 1, 0.125F), 7);
  return before;
}

/// Where heroes are, and how what carries or pushes them goes.
struct Place {
  const char* name;
  b2Body* (*build)(b2World&);
  Vec2d first;                                                      ///< The feet of the first one.
  Vec2d next{0, 2 * half_height + 0.01};                            ///< From one to the next.
  b2Vec2 (*velocity)(double) = [](double) { return b2Vec2_zero; };  ///< At a time [m/s].
  double swing = 0;                                                 ///< [radians/s]
  double move = 0;                                                  ///< Of the first one.
};

const std::array places{
    Place{.name = "slow_lift",
          .build = add_lift,
          .first = {0, 0},
          .velocity =
              [](double) {
                return b2Vec2{0, 1e-4F};
              }},
    Place{.name = "lift",
          .build = add_lift,
          .first = {0, 0},
          .velocity =
              [](double) {
                return b2Vec2{0, 1};
              }},
    Place{.name = "lift_on_a_sine",
          .build = add_lift,
          .first = {0, 0},
          .velocity =
              [](double t) {
                return b2Vec2{static_cast<float>(2 * std::cos(1.3 * t)), static_cast<float>(3 * std::sin(2 * t))};
              }},
    Place{.name = "rocking_plank", .build = add_lift, .first = {0, 0}, .swing = 0.4},
    Place{.name = "wall",
          .build = add_wall,
          .first = {-1.4, 0},
          .next = {0.7, 0},
          .velocity =
              [](double) {
                return b2Vec2{3, 0};
              }},
    Place{.name = "slope", .build = add_slope, .first = {-1, 0}, .move = 1},
    Place{.name = "crate", .build = add_crate, .first = {0, 1.01}},
    Place{.name = "bridge", .build = add_bridge, .first = {0, -0.8}}};

struct Outcome {
  int crushed = 0;
  int stuck = 0;
  int in_the_air = 0;  ///< Of all, after a second in which they come down.
  std::vector<Vec2d> ends{};
};

Outcome run(const Place& place, int count, bool last_first) {
  b2World world({0, -10});
  b2Body& body = *place.build(world);
  std::vector<std::unique_ptr<Hero>> heroes;
  std::vector<Hero*> party;
  std::vector<Input> inputs;
  for (int i = 0; i < count; ++i) {
    const Vec2d at = place.first + i * place.next + Vec2d(0, half_height + 0.005);
    heroes.push_back(
        std::make_unique<Hero>(world, HeroDef{.character = {.snap = 0.2, .step_height = 0.2}, .position = at}));
    party.push_back(heroes.back().get());
    inputs.push_back({.move = 0.0});
  }
  if (last_first) {
    std::reverse(party.begin(), party.end());
    std::reverse(inputs.begin(), inputs.end());
  }
  Outcome outcome;
  for (int step = -60; step < 600; ++step) {
    const double time = step * frame;
    if (step == 0) inputs[last_first ? inputs.size() - 1 : 0].move = place.move;
    if (step >= 0 && body.GetType() == b2_kinematicBody) {
      body.SetLinearVelocity(place.velocity(time));
      body.SetAngularVelocity(static_cast<float>(place.swing * std::cos(1.5 * time)));
    }
    world.Step(static_cast<float>(frame), 8, 3);
    step_together(party, inputs, frame);
    for (const auto& hero : heroes) {
      outcome.crushed += !hero->crushed_by().empty();
      outcome.stuck += hero->report().status == StepStatus::stuck;
      outcome.in_the_air += step >= 0 && !hero->grounded();
    }
  }
  for (const auto& hero : heroes) outcome.ends.push_back(hero->position());
  return outcome;
}

class Heroes : public ::testing::TestWithParam<Place> {};

TEST_P(Heroes, are_carried_and_pushed_as_one_alone_would_be) {
  const Outcome alone = run(GetParam(), 1, false);
  for (const int count : {2, 4}) {
    for (const bool last_first : {false, true}) {
      SCOPED_TRACE(testing::Message() << count << (last_first ? ", the last one first" : ""));
      const Outcome party = run(GetParam(), count, last_first);
      EXPECT_EQ(party.crushed, 0);
      EXPECT_EQ(party.stuck, 0);
      EXPECT_LE(party.in_the_air, alone.in_the_air);
      for (int i = 0; i < count; ++i) {
        const bool is_row = GetParam().next.x() > 0;
        const Vec2d apart = is_row ? Vec2d(2 * half_width * i, 0) : Vec2d(0, 2 * half_height * i);
        EXPECT_LE((party.ends[static_cast<std::size_t>(i)] - alone.ends[0] - apart).norm(), 1e-3) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(On, Heroes, ::testing::ValuesIn(places),
                         [](const auto& place) { return std::string(place.param.name); });

TEST(HeroAlone, steps_together_as_by_itself) {
  hero_test::OnFloor one;
  hero_test::OnFloor other;
  Hero* const party = &other.hero;
  for (hero_test::OnFloor* game : {&one, &other}) {
    game->box(b2_dynamicBody, {2, 0.5F}, 0.5F, 0.5F);
    game->box(b2_kinematicBody, {-3, 0.5F}, 0.5F, 0.5F).GetBody()->SetLinearVelocity({0.5F, 0.1F});
  }
  for (int i = 0; i < 400; ++i) {
    const Input input{.move = i / 50 % 3 - 1, .jump = i % 40 < 3};
    one.go(input);
    other.world.Step(static_cast<float>(frame), 8, 3);
    step_together({&party, 1}, {&input, 1}, frame);
    ASSERT_TRUE(stepping::same_step(one.hero.state(), one.hero.report(), other.hero.state(), other.hero.report())) << i;
  }
}

TEST(HeroAlone, and_others_are_refused_without_time) {
  hero_test::OnFloor game;
  Hero second(game.world, {.position = {3, 1}});
  const std::array<Hero*, 2> party{&game.hero, &second};
  const std::array<Input, 2> inputs{};
  const CharacterState before = second.state();
  step_together(party, inputs, 0);
  for (const Hero* hero : party) EXPECT_EQ(hero->report().status, StepStatus::invalid_input);
  EXPECT_EQ(second.state(), before);
}

}  // namespace
}  // namespace paperproof::box2d
