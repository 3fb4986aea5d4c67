/// Nothing fast gets through what the twin was given, whatever its thickness.
#include "fixtures.hpp"
#include "levels.hpp"
#include "solid_union.hpp"

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <gtest/gtest.h>

namespace paperproof::box2d::test {
namespace {

/// A solid square ring: outside 10 m, its hole 4 m wide.
ColliderDef square_ring() { return polygon(rectangle(-5, -5, 5, 5), {rectangle(-2, -2, 2, 2)}); }

bool in_material(const Vec2d& point) {
  const double reach = std::max(std::abs(point.x()), std::abs(point.y()));
  return reach > 2 && reach < 5;
}

/// 400 characters at 20 to 110 m/s, half of them in the hole, half outside and towards it.
/// @return how many were ever seen with their centre in the material, or changed sides.
int leaks_of_the_ring(SceneryMode mode) {
  const Scenery<double> scenery = level({square_ring()});
  Random random(1);
  int leaks = 0;
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const bool inside = i % 2 == 0;
    const Vec2d direction = random.direction();
    const double speed = random.between(20, 110);
    const Vec2d start = inside ? Vec2d{random.between(-1, 1), random.between(-1, 1)} : Vec2d(8 * direction);
    ReferenceWorld world(scenery, {}, start, {.mode = mode});
    Vec2d velocity = (inside ? speed : -speed) * direction;
    bool leaked = false;
    bool hit = false;
    for (int k = 0; k < 60; ++k) {
      const TwinStep& step = world.step(velocity, frame);
      const double reach = world.position().cwiseAbs().maxCoeff();
      leaked = leaked || in_material(world.position()) || (inside ? reach > 2 : reach < 5);
      hit = hit || !step.contacts.empty();
    }
    leaks += leaked ? 1 : 0;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 380) << "seed 1";
  return leaks;
}

TEST(Blocking, chain_loops_stop_400_fast_characters_from_both_sides) {
  EXPECT_EQ(leaks_of_the_ring(SceneryMode::chain_loops), 0);
}

TEST(Blocking, pieces_stop_400_fast_characters_from_both_sides) {
  EXPECT_EQ(leaks_of_the_ring(SceneryMode::pieces), 0);
}

/// 400 balls against the outline of a box, wound as `solid_union` winds it or the other way round.
int balls_that_end_inside(bool reversed) {
  Random random(2);
  int inside = 0;
  for (int i = 0; i < 400; ++i) {
    b2World world(b2Vec2(0, 0));
    b2BodyDef ground;
    Ring loop = solid_union(SceneryDef{{box(-5, -5, 5, 5)}}).at(0);
    if (reversed) std::reverse(loop.begin(), loop.end());
    b2ChainShape chain;
    chain.CreateLoop(loop.data(), static_cast<int32>(loop.size()));
    world.CreateBody(&ground)->CreateFixture(&chain, 0);

    b2CircleShape circle;
    circle.m_radius = 0.25F;
    b2BodyDef ball;
    ball.type = b2_dynamicBody;
    ball.bullet = true;
    const Vec2d direction = random.direction();
    ball.position = rounded(Vec2d(9 * direction));
    ball.linearVelocity = rounded(Vec2d(-random.between(5, 100) * direction));
    b2Body* body = world.CreateBody(&ball);
    body->CreateFixture(&circle, 1);
    bool was_inside = false;
    for (int k = 0; k < 120; ++k) {
      world.Step(static_cast<float>(frame), 8, 3);
      was_inside = was_inside || widened(body->GetPosition()).cwiseAbs().maxCoeff() < 5;
    }
    inside += was_inside ? 1 : 0;
  }
  return inside;
}

TEST(Blocking, the_winding_of_the_union_is_the_one_that_box2d_blocks) {
  EXPECT_EQ(balls_that_end_inside(false), 0);
  EXPECT_GT(balls_that_end_inside(true), 300);
}

struct Paper {
  std::string name;
  ColliderDef collider;
};

/// Paper across the way at `angle`, 8 m long.
ColliderDef paper(double thickness, double angle) {
  const Vec2d along(std::cos(angle), std::sin(angle));
  const Vec2d across(-along.y(), along.x());
  const Vec2d half = across * (thickness / 2);
  if (thickness == 0) return chain({-4 * along, 4 * along});
  return polygon({-4 * along - half, 4 * along - half, 4 * along + half, -4 * along + half});
}

/// Shots at 100 m/s (1.67 m per step) at paper of any angle, from both sides, with the article's character.
int shots_through(double thickness, SceneryMode mode) {
  Random random(3);
  int through = 0;
  for (int i = 0; i < 200; ++i) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const Vec2d normal(-std::sin(angle), std::cos(angle));
    const Vec2d along(normal.y(), -normal.x());
    const double height = random.between(1, 3);
    const Vec2d start = normal * height + along * random.between(-2, 2);
    ReferenceWorld world(level({paper(thickness, angle)}), {}, start, {.mode = mode});
    const Vec2d velocity = -100 * normal;
    bool passed = false;
    for (int k = 0; k < 20; ++k) {
      world.step(velocity, frame);
      passed = passed || world.position().dot(normal) < 0;
    }
    through += passed ? 1 : 0;
  }
  return through;
}

class Thickness : public testing::TestWithParam<double> {};

TEST_P(Thickness, stops_characters_at_100_metres_per_second) {
  EXPECT_EQ(shots_through(GetParam(), SceneryMode::chain_loops), 0);
  EXPECT_EQ(shots_through(GetParam(), SceneryMode::pieces), 0);
}

INSTANTIATE_TEST_SUITE_P(Blocking, Thickness,
                         testing::Values(0.1, 0.02, 0.006, 0.005, 0.004, 0.001, 1e-4, 1e-6, 1e-9, 0.0));

/// A solid whose parts are near Box2D's limits: blocks with teeth, steps, slivers and specks.
TEST(Blocking, small_features_on_a_floor_leave_no_hole_in_it) {
  Random random(4);
  int shots = 0;
  for (int world_number = 0; world_number < 40; ++world_number) {
    std::vector<Vec2d> floor{{-6, -1}, {6, -1}, {6, 0}};
    double x = 6;
    while (x > -5.5) {
      x -= random.between(1e-4, random.below(3) == 0 ? 1.0 : 0.01);
      floor.emplace_back(x, random.between(0, random.below(2) == 0 ? 0.004 : 0.1));
    }
    floor.emplace_back(-6, 0);
    const Scenery<double> scenery = level({polygon(floor), box(-1, 0.4, 1, 0.401), box(2, 0.3, 2.003, 0.303)});
    for (int i = 0; i < 20; ++i) {
      ReferenceWorld world(scenery, {}, {random.between(-4.5, 4.5), random.between(2, 3)});
      const Vec2d velocity{random.between(-20, 20), -random.between(5, 100)};
      for (int k = 0; k < 30; ++k) {
        world.step(velocity, frame);
        if (std::abs(world.position().x()) > 5) break;
        ASSERT_GT(world.position().y(), 0) << "seed 4, world " << world_number << ", shot " << i << ", step " << k;
      }
      ++shots;
    }
  }
  EXPECT_EQ(shots, 40 * 20);
}

TEST(Blocking, a_speck_of_two_millimetres_stops_a_character_above_it) {
  for (const SceneryMode mode : {SceneryMode::chain_loops, SceneryMode::pieces}) {
    ReferenceWorld world(level({box(-0.001, -0.002, 0.001, 0)}), {}, {0, 1.5}, {.mode = mode});
    for (int k = 0; k < 10; ++k) world.step({0, -60}, frame);
    EXPECT_GT(world.position().y(), half_height());
  }
}

}  // namespace
}  // namespace paperproof::box2d::test
