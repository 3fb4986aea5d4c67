/// octagon_sweep among movers: what a crusher covers, and going corners like standing ones.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace paperproof::stepping {
namespace {

constexpr Tolerances tolerances{};

TEST(CoveredFacet, that_comes_up_while_its_cover_lies_on_the_character_gives_the_normal) {
  // Two tiles that touch in a corner. The character is inside the upper one since a crush, from which side it does not
  // know, so that it stays there, which covers the bevel
  // of the lower one with the normal n = (2, 1) / sqrt(5): that is (2 x + y - 3 m - 30 px) / sqrt(5) away from the
  // lower tile's corner at (1, 1). Its top is 0.1 m below the feet.
  const double slack = 0.4;  // of 2 x + y
  Stepper character({compare::box(0, 0, 1, 1, 0), compare::box(1, 1, 2, 2, 0)});
  const double y = 1 + half_height + 0.1;
  character.at((3 + 30 * px + slack - y) / 2, y).state.crushed = true;
  character.state.crushers.push_back({.collider = 1, .has_side = false});
  character.gravity = {0, 0};
  ASSERT_EQ(character.step_with_mover_by(0, 1.5 * slack), StepStatus::crushed);
  const auto& contacts = character.report.move.contacts;
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].collider, 0U);
  EXPECT_LE((contacts[0].normal - Vec2d{2, 1} / std::sqrt(5.0)).norm(), 1e-15);
  EXPECT_NEAR(contacts[0].fraction, 1 / 1.5, 1e-9);
  EXPECT_NEAR(contacts[0].separation, tolerances.stop / 2, 1e-9) << "a hidden facet stops at half the distance";
  EXPECT_NEAR(contacts[0].point.x(), 1, 1e-6);
  EXPECT_NEAR(contacts[0].point.y(), 1 + slack, 1e-5) << "the corner, where it is by then";
}

/// Ground that leads to a slope or a wall on its right. Both are of one body, which stands or goes evenly.
struct Corner {
  double ground;  ///< [degrees]
  double steep;   ///< [degrees]
  Vec2d velocity{0, 0};

  [[nodiscard]] std::vector<ColliderDef> colliders() const {
    const Vec2d left = -40 * compare::towards(ground * std::numbers::pi / 180);
    const Vec2d right = 8 * compare::towards(steep * std::numbers::pi / 180);
    std::vector<ColliderDef> result{polygon({left, {left.x(), -50}, {0, -50}, {0, 0}}),
                                    polygon({{0, 0}, {0, -50}, {9, -50}, {9, right.y()}, right})};
    if (velocity != Vec2d::Zero())
      for (ColliderDef& collider : result) collider.mover = 0;
    return result;
  }

  /// Two seconds of a walker, and a jump in the last step.
  /// @returns where it is and how fast, relative to the body, and in how many steps of the last second it stood.
  [[nodiscard]] std::tuple<Vec2d, Vec2d, int> play(const CharacterDef& character, double move) const {
    Stepper walker(colliders(), character);
    walker.at(-0.8, half_height + 0.8).with_velocity(velocity.x(), velocity.y());
    int stood = 0;
    for (int step = 0; step < 120; ++step) {
      if (!walker.movers.empty()) walker.movers[0] = {walker.movers[0].to, velocity * ((step + 1) * walker.dt)};
      walker.step({.move = move, .jump = step == 119});
      stood += step >= 59 && step < 119 && walker.state.grounded;
    }
    const Vec2d by = walker.movers.empty() ? Vec2d(0, 0) : walker.movers[0].to;
    return {walker.state.position - by, walker.state.velocity - velocity, stood};
  }
};

/// Now and then the steep side pushes a walker that is in the air for a step: see "Found and open" in the README.
TEST(GoingCorner, holds_a_walker_as_one_that_stands_does) {
  int stood = 0;
  int unlike = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    article_tests::Random random(seed);
    Corner corner{random.between(-40, 40), random.between(50, 100)};
    const double move = random.between(0.5, 1);
    const CharacterDef character{.snap = 0.2};  // without it a walker hops down steep ground
    const auto [place, velocity, steps] = corner.play(character, move);
    const double across = random.between(-3, 3);  // compilers differ in the order of arguments
    corner.velocity = Vec2d(across, random.between(-3, 3));
    const auto [moving_place, moving_velocity, moving_steps] = corner.play(character, move);
    unlike +=
        (place - moving_place).norm() > 1e-3 || (velocity - moving_velocity).norm() > 1e-3 || steps != moving_steps;
    EXPECT_LT((place - moving_place).norm(), 0.05);
    EXPECT_GE(moving_steps, 30);
    EXPECT_GT(moving_velocity.y(), 10) << "it could not jump";
    stood += steps == 60;
  }
  EXPECT_GT(stood, 300);
  EXPECT_LE(unlike, 4);
}

}  // namespace
}  // namespace paperproof::stepping
