/// A hero and Box2D's edges and chains: one-sided ones block from the side from which Box2D lets them block. And the
/// filter of the game.
#include "hero_world.hpp"
#include "support/random_runs.hpp"

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_edge_shape.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace paperproof::box2d::hero_test {
namespace {

constexpr double half_width = 0.3125;  ///< Of the default hero [m].

/// @param points from right to left, where the front is above.
b2Fixture& chain(Game& game, const std::vector<b2Vec2>& points, b2BodyType type = b2_staticBody) {
  b2ChainShape shape;
  const b2Vec2 before = points.front() + points.front() - points[1];
  const b2Vec2 after = points.back() + points.back() - points[points.size() - 2];
  shape.CreateChain(points.data(), static_cast<int>(points.size()), before, after);
  b2BodyDef def;
  def.type = type;
  return *game.world.CreateBody(&def)->CreateFixture(&shape, 0);
}

/// A body of the world that goes where the hero goes, but two metres beside it: it meets the same level by Box2D's
/// rules.
b2Body& witness(Game& game, const b2Vec2& at, const b2Vec2& velocity) {
  b2Body& body = *game.box(b2_dynamicBody, at, 0.3F, 0.3F).GetBody();
  body.SetLinearVelocity(velocity);
  body.SetFixedRotation(true);
  return body;
}

TEST(OneSidedChain, is_jumped_through_from_behind_and_landed_on) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& platform = chain(game, {{4, 2}, {-4, 2}});
  const b2Body& body = witness(game, {3, 0.4F}, {0, 11});
  game.go({.jump = true});
  game.run(150, {.jump = true});
  EXPECT_NEAR(game.hero.position().y(), 2 + half_height, 1e-5);
  EXPECT_EQ(game.hero.ground(), &platform);
  EXPECT_TRUE(game.listener.touching.contains(&platform)) << "the game's listener hears of it";
  EXPECT_NEAR(body.GetPosition().y, 2.3, 0.03) << "as Box2D has it";
}

TEST(OneSidedChain, that_faces_down_is_a_ceiling_and_lets_through_from_above) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  chain(game, {{-4, 2}, {4, 2}});
  const b2Body& below = witness(game, {3, 0.4F}, {0, 11});
  const b2Body& above = witness(game, {-3, 4}, {0, 0});
  double highest = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({.jump = true});
    highest = std::max(highest, game.hero.position().y());
    ASSERT_LT(below.GetPosition().y, 1.8F) << "as Box2D has it";
  }
  EXPECT_NEAR(highest, 2 - half_height, 1e-5);
  game.hero.place({0, 4});
  game.run(120);
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-5);
  EXPECT_NEAR(above.GetPosition().y, 0.3, 0.03) << "as Box2D has it";
}

TEST(OneSidedChain, that_is_a_wall_stops_from_its_front_alone) {
  Game game({.position = {2, half_height + 1e-6}});
  game.floor();
  chain(game, {{0, 4}, {0, 0}});  // downwards: its front is on the left
  game.run(60, {.move = -1.0});
  EXPECT_LT(game.hero.position().x(), -1);
  game.run(120, {.move = 1.0});
  EXPECT_NEAR(game.hero.position().x(), -half_width, 1e-5);
}

TEST(OneSidedChain, is_no_ledge_to_drop_through) {
  Game game({.position = {0, 1.3 + half_height}});
  game.floor();
  b2Fixture& ground = chain(game, {{8, 1}, {2, 1}, {-2, 1.5F}, {-8, 1}});
  for (int i = 0; i < 200; ++i) {
    game.go({.move = i < 100 ? 1.0 : -1.0, .jump = i % 50 == 0, .drop = true});
    ASSERT_GE(game.hero.position().y(), 1 + half_height - 1e-6) << "frame " << i;
  }
  EXPECT_EQ(game.hero.ground(), &ground);
  game.hero.place({0, half_height + 0.001});
  game.run(60, {.drop = true});
  EXPECT_NEAR(game.hero.position().y(), half_height, 1e-5) << "behind it, it is not there";
}

b2Fixture& one_sided_edge(Game& game, const b2Vec2& from, const b2Vec2& to) {
  b2EdgeShape edge;
  edge.SetOneSided(from + from - to, from, to, to + to - from);
  b2BodyDef def;
  return *game.world.CreateBody(&def)->CreateFixture(&edge, 0);
}

TEST(OneSidedEdge, stops_at_a_wall_that_bulges_where_two_meet) {
  for (const float bulge : {-0.6F, -0.1F, -0.02F, 0.0F, 0.02F, 0.1F, 0.6F}) {
    Game game({.position = {0, half_height + 1e-6}});
    game.floor();
    one_sided_edge(game, {3, 12}, {3, 3});  // downwards: its front is on the left
    one_sided_edge(game, {3, 3}, {3 - bulge, 0.6F});
    one_sided_edge(game, {3 - bulge, 0.6F}, {3, -1});
    for (int i = 0; i < 120; ++i) {
      game.go({.move = 1.0, .jump = i > 60});
      ASSERT_LT(game.hero.position().x(), 3 + std::max(0.0F, -bulge)) << "bulge " << bulge << ", frame " << i;
    }
  }
}

TEST(OneSidedEdge, holds_on_the_tip_of_a_roof_of_two) {
  for (const float steepness : {0.5F, 1.1F, 1.5F, 2.0F, 4.0F}) {
    for (float x = -0.3F; x <= 0.3F; x += 0.1F) {
      for (double height = 0.5; height < 8; height += 0.7) {
        Game game({.position = {x, height + half_height}});
        one_sided_edge(game, {2, -2 * steepness}, {0, 0});
        one_sided_edge(game, {0, 0}, {-2, -2 * steepness});
        for (int i = 0; i < 120 && std::abs(game.hero.position().x()) < 1.5; ++i) {
          game.go();
          const double roof = -static_cast<double>(steepness) * std::abs(game.hero.position().x());
          ASSERT_GT(game.hero.position().y(), roof) << "steepness " << steepness << ", x " << x << ", from " << height;
        }
      }
    }
  }
}

TEST(OneSidedChain, with_a_steep_foot_holds_a_hero_that_drops) {
  for (const float flank : {0.45F, 0.6F, 0.9F}) {
    Game game({.position = {3, half_height + 1e-6}});
    chain(game, {{6, 0}, {0, 0}});
    chain(game, {{0, 0}, {-flank, 1.5F}, {-3, 1.5F}, {-6, -1.5F}});
    for (int i = 0; i < 200; ++i) {
      game.go({.move = -1.0, .drop = true});
      ASSERT_GT(game.hero.position().x(), 0) << "flank " << flank << ", frame " << i;
    }
  }
}

TEST(OneSidedChain, holds_the_hero_if_the_game_makes_it_anew) {
  for (const float raised : {0.0F, 1e-6F, 1e-3F, 0.1F}) {
    for (const float slope : {0.0F, 0.37F}) {
      SCOPED_TRACE(testing::Message() << "raised by " << raised << ", slope " << slope);
      const auto at = [&](float x, float up) { return b2Vec2(x, slope * (x - 500) + up); };
      Game game({.position = {500, half_height + 0.3}});
      b2Body* ground = chain(game, {at(510, 0), at(490, 0)}).GetBody();
      game.run(60, {.move = 0.0});
      ASSERT_TRUE(game.hero.grounded());
      b2Body* anew = chain(game, {at(510, raised), at(503.3F, raised), at(490, raised)}).GetBody();
      game.world.DestroyBody(ground);
      game.run(60, {.move = 0.0});
      EXPECT_TRUE(game.hero.grounded());
      EXPECT_EQ(game.hero.ground(), anew->GetFixtureList());
    }
  }
}

TEST(OneSidedChain, that_moves_into_the_hero_holds_it) {
  for (const float by : {1e-6F, 1e-3F, 0.1F}) {
    Game game({.position = {0, half_height + 1e-6}});
    game.floor();
    b2Body* wall = chain(game, {{3, 12}, {3, -1}}).GetBody();  // its front is on the left
    game.run(90, {.move = 1.0});
    ASSERT_GT(game.hero.position().x(), 2);
    wall->SetTransform({-by, 0}, 0);
    for (int i = 0; i < 60; ++i) {
      game.go({.move = 1.0});
      ASSERT_LT(game.hero.position().x(), 3) << "by " << by << ", frame " << i;
    }
  }
}

TEST(OneSidedChain, holds_the_hero_over_shifts_of_the_origin) {
  for (const float wall : {3.3F, 7.1F}) {
    Game game({.position = {0, half_height + 1e-6}});
    game.floor();
    chain(game, {{wall, 12}, {wall, -1}});
    game.run(120, {.move = 1.0});
    for (const float shift : {64.0F, 301.0F, -700.0F, 1000.0F, -665.0F}) {
      game.world.ShiftOrigin({shift, 0});
      game.hero.shift_origin({shift, 0});
      game.run(30, {.move = 1.0});
    }
    EXPECT_LT(game.hero.position().x(), wall);
  }
}

TEST(OneSidedEdge, holds_at_the_top_of_a_cliff_that_is_a_fixture_of_its_own) {
  for (const float overhang : {0.0F, 0.3F, -0.3F}) {
    Game game({.position = {-2, 1.5}});
    chain(game, {{0, 0}, {-6, -1}});
    chain(game, {{overhang, -5}, {0, 0}});
    for (int i = 0; i < 200; ++i) {
      game.go({.move = game.hero.position().x() < -0.1 ? 0.5 : 0.0});
      ASSERT_GT(game.hero.position().y(), 0) << "overhang " << overhang << ", frame " << i;
    }
  }
}

TEST(OneSidedChain, leaves_no_room_to_stand_up_beneath_a_ceiling) {
  CharacterDef low;
  low.shape = CharacterShape(std::array{Vec2d(-0.3, -0.3), Vec2d(0.3, -0.3), Vec2d(0.3, 0.3), Vec2d(-0.3, 0.3)});
  Game game({.character = low, .position = {0, 0.3 + 1e-6}});
  chain(game, {{5, 0}, {-5, 0}});
  chain(game, {{-5, 0.9F}, {5, 0.9F}});
  game.run(5);
  EXPECT_FALSE(game.hero.change({}));
  game.run(30, {.jump = true});
  EXPECT_LT(game.hero.position().y(), 0.9);
}

TEST(OneSidedChain, lifts_the_hero_if_the_game_raises_it) {
  for (const float by : {1e-4F, 0.01F, 0.2F}) {
    Game game({.position = {0, half_height + 1e-6}});
    b2Body* ground = chain(game, {{8, 0}, {-8, 0}}).GetBody();
    game.run(5);
    for (int i = 1; i <= 10; ++i) {
      ground->SetTransform({0, by * static_cast<float>(i)}, 0);
      game.run(3);
    }
    EXPECT_NEAR(game.hero.position().y(), 10 * static_cast<double>(by) + half_height, 1e-4) << "by " << by;
  }
}

TEST(OneSidedEdge, that_becomes_two_sided_in_place_is_seen) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& edge = one_sided_edge(game, {4, 2}, {-4, 2});
  game.run(2);
  static_cast<b2EdgeShape*>(edge.GetShape())->SetTwoSided({4, 2}, {-4, 2});
  double highest = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({.jump = true});
    highest = std::max(highest, game.hero.position().y());
  }
  EXPECT_NEAR(highest, 2 - half_height, 1e-5);
}

TEST(OneSidedChain, is_no_ledge_where_two_meet_at_a_peak) {
  for (double x = -0.4; x <= 0.4; x += 0.02) {
    Game game({.position = {x, 1.2 + half_height}});
    chain(game, {{6, -2}, {0, 1}});
    chain(game, {{0, 1}, {-6, -2}});
    game.run(40);
    game.go({.move = 0.0, .drop = true});
    game.run(10);
    const Vec2d at = game.hero.position();
    ASSERT_GE(at.y() - half_height, 1 - std::abs(at.x()) / 2 - half_width / 2 - 1e-6) << "from " << x;
  }
}

TEST(OneSidedChain, is_no_ledge_on_a_lift) {
  for (const float speed : {-1.0F, -0.2F, 0.0F, 0.2F, 1.0F, 3.0F}) {
    for (const float slant : {0.0F, 0.5F}) {
      Game game({.position = {0, 2.5 + half_height}});
      b2Fixture& lift = chain(game, {{4, 2}, {0, 2 + slant}, {-4, 2}}, b2_kinematicBody);
      game.run(60);
      ASSERT_EQ(game.hero.ground(), &lift);
      lift.GetBody()->SetLinearVelocity({0, speed});
      for (int i = 0; i < 60; ++i) {
        game.go({.move = 0.0, .drop = i % 3 == 0});
        ASSERT_GT(game.hero.position().y() - half_height, lift.GetBody()->GetPosition().y + 1.9F)
            << "speed " << speed << ", slant " << slant << ", frame " << i;
      }
    }
  }
}

TEST(OneSidedChain, lifts_a_hero_that_was_placed_a_little_too_deep) {
  for (const double depth : {0.001, 0.05, 0.5}) {
    Game game({.position = {0, half_height - depth}});
    chain(game, {{8, 0}, {-8, 0}});
    game.run(30);
    EXPECT_NEAR(game.hero.position().y(), half_height, 1e-5) << depth << " m too deep";
  }
}

TEST(OneSidedChain, of_a_loop_blocks_from_both_sides) {
  Game game({.position = {0, 3}});
  const std::vector<b2Vec2> corners{{-4, 0}, {4, 0}, {4, 1}, {-4, 1}};
  b2ChainShape loop;
  loop.CreateLoop(corners.data(), 4);
  b2BodyDef def;
  game.world.CreateBody(&def)->CreateFixture(&loop, 0);
  game.run(90);
  EXPECT_NEAR(game.hero.position().y(), 1 + half_height, 1e-5);
}

TEST(OneSidedChain, can_block_from_everywhere_if_the_game_says_so) {
  Game game({.position = {0, half_height + 1e-6},
             .surface_of = [](b2Fixture&) { return Surface{.blocks = Blocking::from_everywhere}; }});
  game.floor();
  chain(game, {{4, 2}, {-4, 2}});
  double highest = 0;
  for (int i = 0; i < 60; ++i) {
    game.go({.jump = true});
    highest = std::max(highest, game.hero.position().y());
  }
  EXPECT_NEAR(highest, 2 - half_height, 1e-5);
}

TEST(OneSidedChain, of_several_fixtures_is_walked_over_without_a_gap) {
  Game game({.character = {.snap = 0.2}, .position = {-7, half_height + 1e-6}});
  chain(game, {{0, 1}, {-2, 0}, {-9, 0}});
  chain(game, {{3, 0}, {0, 1}});
  chain(game, {{9, -0.5F}, {3, 0}});
  for (int i = 0; i < 140; ++i) {
    game.go({.move = 1.0});
    ASSERT_TRUE(game.hero.grounded()) << "frame " << i << " at " << game.hero.position().transpose();
  }
  EXPECT_GT(game.hero.position().x(), 5);
}

TEST(OneSidedChain, on_a_lift_is_jumped_through_and_carries) {
  Game game({.position = {0, half_height + 1e-6}});
  game.floor();
  b2Fixture& platform = chain(game, {{4, 2}, {-4, 2}}, b2_kinematicBody);
  game.run(150, {.jump = true});
  ASSERT_EQ(game.hero.ground(), &platform);
  platform.GetBody()->SetLinearVelocity({0, 1});
  const double from = game.hero.position().y();
  for (int i = 0; i < 120; ++i) {
    game.go();
    ASSERT_EQ(game.hero.ground(), &platform) << "frame " << i;
  }
  EXPECT_NEAR(game.hero.position().y() - from, 2, 1e-4);
}

TEST(OneSidedEdge, blocks_from_its_front_and_a_two_sided_one_from_both) {
  for (const bool one_sided : {true, false}) {
    Game game({.position = {0, half_height + 1e-6}});
    game.floor();
    b2EdgeShape edge;
    if (one_sided)
      edge.SetOneSided({5, 2}, {4, 2}, {-4, 2}, {-5, 2});
    else
      edge.SetTwoSided({4, 2}, {-4, 2});
    b2BodyDef def;
    game.world.CreateBody(&def)->CreateFixture(&edge, 0);
    game.go({.jump = true});
    game.run(150, {.jump = true});
    EXPECT_NEAR(game.hero.position().y(), (one_sided ? 2 : 0) + half_height, 1e-5);
  }
}

/// Any play with the drop button, over random hills of a chain: the hero is never below them.
TEST(OneSidedChain, holds_any_play_over_random_hills) {
  int in_the_air = 0;
  int steps = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Random random(seed);
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
    const std::size_t cut = hills.size() / 2;
    chain(game, {hills.begin(), hills.begin() + static_cast<std::ptrdiff_t>(cut) + 1});
    chain(game, {hills.begin() + static_cast<std::ptrdiff_t>(cut), hills.end()});
    Input input;
    for (int i = 0; i < 400; ++i) {
      if (random.chance(0.05)) input.move = random.integer(-1, 1);
      if (random.chance(input.jump ? 0.3 : 0.02)) input.jump = !input.jump;
      input.drop = random.chance(0.3);
      game.go(input);
      const Vec2d at = game.hero.position();
      if (std::abs(at.x()) > 10) break;
      ++steps;
      in_the_air += !game.hero.grounded();
      for (std::size_t k = 1; k < hills.size(); ++k) {
        const Vec2d from(hills[k].x, hills[k].y);
        const Vec2d to(hills[k - 1].x, hills[k - 1].y);
        if (at.x() < from.x() || at.x() > to.x()) continue;
        const double ground = from.y() + (to.y() - from.y()) * (at.x() - from.x()) / (to.x() - from.x());
        ASSERT_GE(at.y() - half_height, ground - 1e-6) << "seed " << seed << ", frame " << i;
      }
    }
  }
  EXPECT_GT(steps, 4000);
  EXPECT_GT(in_the_air, steps / 10);
  EXPECT_LT(in_the_air, steps * 9 / 10);
}

/// Bodies of one team do not collide.
class Teams : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
    return a->GetBody()->GetUserData().pointer != b->GetBody()->GetUserData().pointer;
  }
};

TEST(ContactFilterOfTheGame, decides_for_the_hero_too) {
  Game game({.position = {0, half_height + 1e-6}});
  Teams teams;
  game.world.SetContactFilter(&teams);
  game.hero.body().GetUserData().pointer = 1;
  game.floor().GetBody()->GetUserData().pointer = 3;
  b2Body& own = *game.box(b2_staticBody, {2, 1}, 0.1F, 1).GetBody();
  b2Body& other = *game.box(b2_staticBody, {4, 1}, 0.1F, 1).GetBody();
  own.GetUserData().pointer = 1;
  other.GetUserData().pointer = 2;
  game.run(90, {.move = 1.0});
  EXPECT_NEAR(game.hero.position().x(), 3.9 - half_width, 1e-5);
  own.GetUserData().pointer = 2;
  game.run(90, {.move = -1.0});
  EXPECT_NEAR(game.hero.position().x(), 2.1 + half_width, 1e-5) << "it is asked in every step";
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
