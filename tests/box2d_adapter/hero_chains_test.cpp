/// A hero and Box2D's edges and chains: one-sided ones block from the side from which Box2D lets them block. And the
/// filter of the game.
#include "hero_world.hpp"

#include "campaign/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::box2d::hero_test {
namespace {

using Line = std::vector<b2Vec2>;

/// At a height of 2 m.
b2Fixture& made(Game& game, const std::string& what) {
  if (what == "chain") return game.chain({{4, 2}, {-4, 2}});
  if (what == "chain that faces down") return game.chain({{-4, 2}, {4, 2}});
  if (what == "loop") {
    b2ChainShape loop;
    loop.CreateLoop(Line{{-4, 2}, {4, 2}, {4, 3}, {-4, 3}}.data(), 4);
    return game.add(b2_staticBody, {0, 0}, loop);
  }
  b2EdgeShape shape;
  shape.SetOneSided({12, 2}, {4, 2}, {-4, 2}, {-12, 2});
  b2Fixture& edge = game.add(b2_staticBody, {0, 0}, shape);
  game.go();
  if (what == "two-sided edge") static_cast<b2EdgeShape*>(edge.GetShape())->SetTwoSided({4, 2}, {-4, 2});  // in place
  return edge;
}

TEST(OneSidedChain, is_jumped_through_from_behind_and_landed_on) {
  struct Case {
    const char* what;
    bool lets_through;  ///< From below.
    double top;         ///< On which the hero lands [m].
  };
  for (const Case& one : {Case{"chain", true, 2}, Case{"chain that faces down", false, 0}, Case{"edge", true, 2},
                          Case{"two-sided edge", false, 2}, Case{"loop", false, 3}}) {
    SCOPED_TRACE(one.what);
    OnFloor game;
    b2Fixture& platform = made(game, one.what);
    const double highest = game.highest(150, {.jump = true});
    EXPECT_NEAR(highest, one.lets_through ? 7.2 : 2 - 2 * half_height, one.lets_through ? 0.2 : 1e-5);
    EXPECT_NEAR(game.feet(), one.lets_through ? one.top : 0, 1e-5);
    EXPECT_EQ(game.touches(platform), one.lets_through) << "the game's listener hears of it";
    game.hero.place({0, 5});
    game.run(120);
    EXPECT_NEAR(game.feet(), one.top, 1e-5);
    EXPECT_EQ(game.hero.ground(), one.top == 0 ? &game.ground : &platform);
  }
}

/// It has both feet above the flanks, and is not in front.
TEST(OneSidedChain, that_reaches_into_a_hero_from_behind_between_its_feet_does_not_move_it) {
  OnFloor game;
  game.chain({{4, 2}, {0.1F, 2}, {0, 2.5F}, {-0.1F, 2}, {-4, 2}});
  game.hero.set_velocity({0, std::sqrt(2 * 10 * 2.3)});
  game.run(40);
  EXPECT_NEAR(game.feet(), 2.3, 0.06);
  EXPECT_EQ(game.x(), 0);
}

/// The lines hold the hero in every frame of a play. @param feet where it begins.
void expect_held(const std::vector<Line>& lines, const Vec2d& feet, const auto& holds, const auto& play) {
  Game game({.character = {.snap = 0.2}, .position = feet + Vec2d(0, half_height)});
  for (const Line& line : lines) game.chain(line);
  for (int i = 0; i < 200 && std::abs(game.x()) <= 7; ++i) {
    game.go(play(game, i));
    ASSERT_TRUE(holds(game)) << "frame " << i << ", at " << game.hero.position().transpose();
  }
}

TEST(OneSidedChain, holds_whatever_the_player_does) {
  for (const float bulge : {-0.6F, -0.1F, -0.02F, 0.0F, 0.02F, 0.1F, 0.6F}) {
    SCOPED_TRACE(testing::Message() << "wall that bulges by " << bulge);
    expect_held(
        {{{10, 0}, {-10, 0}},  // the front of the others is on the left
         {{3, 12}, {3, 3}},
         {{3, 3}, {3 - bulge, 0.6F}},
         {{3 - bulge, 0.6F}, {3, -1}}},
        {0, 1e-6}, [bulge](const Game& game) { return game.x() < 3 + std::max(0.0F, -bulge); },
        [](const Game&, int frame_number) { return Input{.move = 1.0, .jump = frame_number > 60}; });
  }
  for (const float flank : {0.45F, 0.6F, 0.9F}) {
    SCOPED_TRACE(testing::Message() << "steep foot of " << flank);
    expect_held(
        {{{6, 0}, {0, 0}}, {{0, 0}, {-flank, 1.5F}, {-3, 1.5F}, {-6, -1.5F}}}, {3, 1e-6},
        [](const Game& game) { return game.x() > 0; },
        [](const Game&, int) { return Input{.move = -1.0, .drop = true}; });
  }
  for (const float overhang : {0.0F, 0.3F, -0.3F}) {
    SCOPED_TRACE(testing::Message() << "top of a cliff that hangs over by " << overhang);
    expect_held(
        {{{0, 0}, {-6, -1}}, {{overhang, -5}, {0, 0}}}, {-2, 0.875},
        [](const Game& game) { return game.feet() > -half_height; },
        [](const Game& game, int) { return Input{.move = game.x() < -0.1 ? 0.5 : 0.0}; });
  }
  SCOPED_TRACE("hill of several fixtures, that is walked over without a gap");
  expect_held(
      {{{0, 1}, {-2, 0}, {-9, 0}}, {{3, 0}, {0, 1}}, {{9, -0.5F}, {3, 0}}}, {-6.5, 1e-6},
      [](const Game& game) { return game.hero.grounded(); }, [](const Game&, int) { return Input{.move = 1.0}; });
}

TEST(OneSidedChain, holds_the_hero_if_the_game_makes_it_anew) {
  for (const float raised : {0.0F, 1e-6F, 1e-3F, 0.1F}) {
    for (const float slope : {0.0F, 0.37F}) {
      SCOPED_TRACE(testing::Message() << "raised by " << raised << ", slope " << slope);
      const auto at = [&](float x, float up) { return b2Vec2(x, slope * (x - 500) + up); };
      Game game({.position = {500, half_height + 0.3}});
      b2Body* ground = game.chain({at(510, 0), at(490, 0)}).GetBody();
      game.run(60);
      ASSERT_TRUE(game.hero.grounded());
      b2Fixture& anew = game.chain({at(510, raised), at(503.3F, raised), at(490, raised)});
      game.world.DestroyBody(ground);
      game.run(60);
      EXPECT_TRUE(game.hero.grounded());
      EXPECT_EQ(game.hero.ground(), &anew);
    }
  }
}

TEST(OneSidedChain, holds_the_hero_over_shifts_of_the_origin) {
  for (const float wall : {3.3F, 7.1F}) {
    OnFloor game;
    game.chain({{wall, 12}, {wall, -1}});
    game.run(120, {.move = 1.0});
    for (const float shift : {64.0F, 301.0F, -700.0F, 1000.0F, -665.0F}) {
      const Vec2d before = game.hero.position();
      game.world.ShiftOrigin({shift, 0});
      game.hero.shift_origin({shift, 0});
      EXPECT_EQ(game.hero.position(), Vec2d(before - Vec2d(shift, 0)));
      game.run(30, {.move = 1.0});
      EXPECT_TRUE(game.hero.grounded());
    }
    EXPECT_LT(game.x(), wall);
  }
}

TEST(OneSidedChain, leaves_no_room_to_stand_up_beneath_a_ceiling) {
  Game game({.character = low(), .position = {0, 0.3 + 1e-6}});
  game.chain({{5, 0}, {-5, 0}});
  game.chain({{-5, 0.9F}, {5, 0.9F}});
  game.run(5);
  const Vec2d at = game.hero.position();
  EXPECT_FALSE(game.hero.change({}));
  EXPECT_EQ(game.hero.position(), at);
  game.run(30, {.jump = true});
  EXPECT_LT(game.hero.position().y(), 0.9);
}

TEST(OneSidedChain, takes_the_hero_along_if_the_game_moves_it_into_the_hero) {
  for (const bool is_wall : {false, true}) {
    for (const float by : {1e-6F, 1e-4F, 0.01F, 0.1F, 0.2F}) {
      OnFloor game;
      b2Body* moved = game.chain(is_wall ? Line{{3, 12}, {3, -1}} : Line{{8, 0}, {-8, 0}}).GetBody();
      const Input input{.move = is_wall ? 1.0 : 0.0};
      game.run(90, input);
      for (int i = 1; i <= 10; ++i) {
        const float way = by * static_cast<float>(i);
        moved->SetTransform(is_wall ? b2Vec2(-way, 0) : b2Vec2(0, way), 0);
        game.run(3, input);
      }
      EXPECT_NEAR(is_wall ? 3 - half_width - game.x() : game.feet(), 10 * static_cast<double>(by), 1e-4) << is_wall;
    }
  }
}

TEST(OneSidedChain, lifts_a_hero_that_was_placed_a_little_too_deep) {
  for (const double depth : {0.001, 0.05, 0.5}) {
    Game game({.position = {0, half_height - depth}});
    game.chain({{8, 0}, {-8, 0}});
    game.run(30);
    EXPECT_NEAR(game.feet(), 0, 1e-5) << depth << " m too deep";
  }
}

TEST(OneSidedChain, on_a_lift_is_jumped_through_and_carries_and_is_no_ledge) {
  for (const float speed : {-1.0F, -0.2F, 0.0F, 0.2F, 1.0F, 3.0F}) {
    for (const float slant : {0.0F, 0.5F}) {
      SCOPED_TRACE(testing::Message() << "speed " << speed << ", slant " << slant);
      OnFloor game;
      b2Fixture& lift = game.chain({{4, 2}, {0, 2 + slant}, {-4, 2}}, b2_kinematicBody);
      game.run(150, {.jump = true});
      ASSERT_EQ(game.hero.ground(), &lift);
      lift.GetBody()->SetLinearVelocity({0, speed});
      const double from = game.feet();
      for (int i = 0; i < 60; ++i) {
        game.go({.move = 0.0, .drop = i % 3 == 0});
        ASSERT_EQ(game.hero.ground(), &lift) << "frame " << i;
      }
      EXPECT_NEAR(game.feet() - from, speed, slant > 0 ? 0.1 : 1e-4);
    }
  }
}

/// Any play with the drop button, over random hills of two chains: the hero is never below them. Nor is its middle,
/// where each has few segments: the hero may drop past the end of one into another, which then lifts it out.
TEST(OneSidedChain, holds_any_play_over_random_hills) {
  int in_the_air = 0;
  int steps = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    compare::Random random(seed);
    Line hills;
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

/// Bodies of one team do not collide.
class Teams : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
    return a->GetBody()->GetUserData().pointer != b->GetBody()->GetUserData().pointer;
  }
};

TEST(ContactFilterOfTheGame, decides_for_the_hero_too) {
  OnFloor game;
  Teams teams;
  game.world.SetContactFilter(&teams);
  game.hero.body().GetUserData().pointer = 1;
  game.ground.GetBody()->GetUserData().pointer = 3;
  b2Body& own = *game.box(b2_staticBody, {2, 1}, 0.1F, 1).GetBody();
  b2Body& other = *game.box(b2_staticBody, {4, 1}, 0.1F, 1).GetBody();
  own.GetUserData().pointer = 1;
  other.GetUserData().pointer = 2;
  game.run(90, {.move = 1.0});
  EXPECT_NEAR(game.x(), 3.9 - half_width, 1e-5);
  own.GetUserData().pointer = 2;
  game.run(90, {.move = -1.0});
  EXPECT_NEAR(game.x(), 2.1 + half_width, 1e-5) << "it is asked in every step";
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
