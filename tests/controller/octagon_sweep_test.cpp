/// octagon_sweep: what no situation of tests/situations can say. What its report calls the ground, the climb limit on
/// exact slopes, and starts inside a solid.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::stepping {
namespace {

/// Two floors, and a step down to a third one.
TEST(Ground, names_the_collider_that_is_stood_on) {
  Stepper walker({rectangle(-4, -1, 0, 0), rectangle(0, -1, 2, 0), rectangle(2, -1, 9, -0.05)}, {.snap = 0.5});
  walker.at(-1, half_height + 0.01).steps(20);
  std::vector<ColliderIndex> grounds;
  for (int step = 0; step < 50; ++step) {
    walker.step({.move = 1});
    ASSERT_TRUE(walker.state.grounded) << step;
    if (grounds.empty() || grounds.back() != walker.report.move.ground.collider)
      grounds.push_back(walker.report.move.ground.collider);
  }
  EXPECT_EQ(grounds, (std::vector<ColliderIndex>{0, 1, 2}));
  walker.step({.move = {}, .jump = true});
  EXPECT_EQ(walker.report.move.ground.state, GroundState::air);
}

TEST(Ground, is_air_walkable_or_steep) {
  // A slope of 60 degrees that ends on a floor.
  const double rise = 4 * std::tan(60 * degree);
  Stepper faller({rectangle(-1, -1, 20, 0), rectangle(-1, 0, 0, rise), polygon({{0, rise}, {0, 0}, {4, 0}})});
  faller.gravity = {0, -30};
  faller.at(2, rise).step();
  EXPECT_EQ(faller.report.move.ground.state, GroundState::air);
  int slides = 0;
  for (int step = 0; step < 200 && !faller.state.grounded; ++step) {
    faller.step();
    if (faller.report.move.ground.state != GroundState::steep) continue;
    ++slides;
    ASSERT_EQ(faller.report.move.ground.collider, ColliderIndex{2});
    ASSERT_NEAR(faller.report.move.ground.normal.y(), 0.5, 1e-12);
  }
  EXPECT_GT(slides, 5);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::walkable);
  EXPECT_EQ(faller.report.move.ground.normal, Vec2d(0, 1));
  EXPECT_EQ(faller.report.move.ground.velocity, Vec2d(0, 0));
}

TEST(Ground, is_a_wedge_between_two_steep_faces) {
  Stepper faller({polygon({{0, 0}, {2, 5}, {3, 5}, {3, -1}, {-3, -1}, {-3, 5}, {-2, 5}})});
  faller.at(0.01, 3).steps(240);
  EXPECT_TRUE(faller.state.grounded);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::wedge);
  EXPECT_EQ(faller.report.move.ground.collider, ColliderIndex{0});
}

/// On a slope of a whole number in a whole number, whose limit in degrees is what a designer computes.
/// @param less of the limit than what it is exactly [radians].
bool is_climbed(std::uint64_t seed, double less) {
  test::Random random(seed);
  Vec2d along;
  do {
    along = {static_cast<double>(random.integer(1, 64)), static_cast<double>(random.integer(1, 64))};
    if (random.chance(0.2)) along.y() = along.x();
  } while (along.y() < 0.1 * along.x() || along.y() > 4 * along.x());
  const double sign = random.chance(0.5) ? 1 : -1;
  const double sixteenths = random.integer(1, 400) / 16.0;
  const Vec2d far{random.integer(-16000, 16000) / 16.0, random.integer(-16000, 16000) / 16.0};
  const Vec2d foot = random.chance(0.3) ? Vec2d(0, 0) : far;
  // At least 6 m wide, and exact.
  const Vec2d top = foot + (sixteenths + std::ceil(6 / along.x())) * Vec2d(sign * along.x(), along.y());
  CharacterDef character;
  character.max_climb_degrees =
      along.x() == along.y() && less == 0 ? 45 : (std::atan2(along.y(), along.x()) - less) * 180 / std::numbers::pi;
  const double behind = foot.x() - sign * 20;
  Stepper player({polygon({foot, top, {top.x(), foot.y() - 1}, {behind, foot.y() - 1}, {behind, foot.y()}})},
                 character);
  player.gravity = {0, -30};
  player.at(foot.x() - sign, foot.y() + 0.7).steps(60, {.move = sign});
  return player.state.position.y() > foot.y() + half_height + 0.1;
}

TEST(ClimbLimit, includes_itself_on_exact_slopes_of_every_place_and_size_and_nothing_steeper) {
  constexpr double microradian = 1e-6;
  const std::uint64_t cases = test::sampled(10000U);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    ASSERT_TRUE(is_climbed(seed, 0)) << "seed " << seed;
    ASSERT_FALSE(is_climbed(seed, microradian)) << "seed " << seed;
  }
}

TEST(StartInside, of_hundreds_of_solids_at_once_does_not_allocate) {
  std::vector<ColliderDef> colliders;
  for (int k = 0; k < 300; ++k)
    colliders.push_back(rectangle(-1 - k * 0.01, -1 - k * 0.01, 1 + k * 0.01, 1 + k * 0.01));
  Stepper stepper(colliders);
  stepper.gravity = {-30, 0};  // back to them: the step touches something, too
  stepper.at(0.1, 0.3);
  stepper.sweep().reserve({{-5, -5}, {5, 5}}, stepper.scratch);
  stepper.report.reserve(400);
  const std::size_t before = tests::allocations();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(stepper.report.move.contacts.empty());
  EXPECT_NEAR(stepper.state.position.x(), 3.99 + half_width, 1e-6);
}

TEST(StartInside, without_a_way_out_counts_the_steps_as_far_as_a_byte_goes) {
  Stepper stepper({rectangle(-2, -2, 2, 2), rectangle(-3, -3, -2.5, 3), rectangle(2.5, -3, 3, 3),
                   rectangle(-2.5, -3, 2.5, -2.5), rectangle(-2.5, 2.5, 2.5, 3)});
  stepper.at(0.5, 1);
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
  }
}

}  // namespace
}  // namespace paperproof::stepping
