/// Several heroes of one world that take turns.
#include "box2d_adapter/hero_world.hpp"
#include "controller/states.hpp"
#include "float_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace paperproof::box2d {
namespace {

using hero_test::frame;
using hero_test::half_height;
using hero_test::half_width;
using hero_test::World;

b2Body* lift(World& world) { return world.box(b2_kinematicBody, {0, -1}, 4, 1).GetBody(); }

b2Body* slope(World& world) {
  world.box(b2_staticBody, {-20, -1}, 20, 1);
  b2PolygonShape shape;
  const std::array<b2Vec2, 3> corners{b2Vec2{0, 0}, {60, 0}, {60, 60 * std::tan(30 * b2_pi / 180)}};
  shape.Set(corners.data(), 3);
  return world.add(b2_staticBody, {0, 0}, shape).GetBody();
}

b2Body* stairs(World& world) {
  b2Body* last = world.box(b2_staticBody, {-20, -1}, 20, 1).GetBody();
  for (float x = 0; x < 60; x += 0.6F) last = world.box(b2_staticBody, {x + 0.3F, x / 6}, 0.3F, x / 6 + 0.2F).GetBody();
  return last;
}

b2Body* wall(World& world) {
  world.floor();
  return world.box(b2_kinematicBody, {-2.5F, 1.5F}, 0.5F, 1.4F).GetBody();
}

b2Body* crate(World& world) {
  world.floor();
  return world.box(b2_dynamicBody, {0, 0.505F}, 0.5F, 0.5F).GetBody();
}

/// Of planks, from -7 m to 7 m.
b2Body* bridge(World& world) {
  b2Body* before = world.box(b2_staticBody, {-8, -1}, 1, 0.125F).GetBody();
  const auto join = [&](b2Fixture& next, float x) {
    b2RevoluteJointDef joint;
    joint.Initialize(before, next.GetBody(), {x, -1});
    world.world.CreateJoint(&joint);
    before = next.GetBody();
  };
  for (float x = -7; x < 7; ++x) join(world.box(b2_dynamicBody, {x + 0.5F, -1}, 0.5F, 0.125F, 20), x);
  join(world.box(b2_staticBody, {8, -1}, 1, 0.125F), 7);
  return before;
}

/// Where heroes are, and how what carries or pushes them goes.
struct Place {
  const char* name;
  b2Body* (*build)(World&);
  Vec2d first{0, 0};                      ///< The feet of the first one.
  Vec2d next{0, 2 * half_height + 0.01};  ///< From one to the next.
  Vec2d velocity{0, 0};                   ///< [m/s]
  Vec2d swing{0, 0};                      ///< The most of it, there and back across at 1.3 radians/s, and up at 2.
  double spin = 0;                        ///< [radians/s] The most, there and back.
  double move = 0;                        ///< Of the first one.
};

const std::array places{Place{.name = "slow_lift", .build = lift, .velocity = {0, 1e-4}},
                        Place{.name = "lift", .build = lift, .velocity = {0, 1}},
                        Place{.name = "lift_on_a_sine", .build = lift, .swing = {2, 3}},
                        Place{.name = "rocking_plank", .build = lift, .spin = 0.4},
                        Place{.name = "wall", .build = wall, .first = {-1.4, 0}, .next = {0.7, 0}, .velocity = {3, 0}},
                        Place{.name = "slope", .build = slope, .first = {-1, 0}, .move = 1},
                        Place{.name = "stairs", .build = stairs, .first = {-1, 0}, .move = 1},
                        Place{.name = "crate", .build = crate, .first = {0, 1.01}},
                        Place{.name = "bridge", .build = bridge, .first = {0, -0.8}}};

struct Outcome {
  int crushed = 0;
  int stuck = 0;
  int in_the_air = 0;  ///< Of all, after a second in which they come down.
  std::vector<Vec2d> ends{};
};

Outcome run(const Place& place, int count, bool last_first) {
  World all;
  b2World& world = all.world;
  b2Body& body = *place.build(all);
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
      const Vec2d swing = place.swing.cwiseProduct(Vec2d(std::cos(1.3 * time), std::sin(2 * time)));
      body.SetLinearVelocity(rounded(place.velocity + swing));
      body.SetAngularVelocity(static_cast<float>(place.spin * std::cos(1.5 * time)));
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
