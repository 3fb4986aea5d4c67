/// octagon_sweep: what no situation of tests/situations can say. What its report calls the ground, the climb limit on
/// exact slopes, starts inside a solid, what a crusher covers, corners that go like standing ones, and rides of an
/// hour.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace paperproof::stepping {
namespace {

/// Two floors, and a step down to a third one.
TEST(Ground, names_the_collider_that_is_stood_on) {
  Stepper walker({box(-4, -1, 0, 0), box(0, -1, 2, 0), box(2, -1, 9, -0.05)}, {.snap = 0.5});
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
  Stepper faller({box(-1, -1, 20, 0), box(-1, 0, 0, rise), polygon({{0, rise}, {0, 0}, {4, 0}})});
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
  Random random(seed);
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
  for (int k = 0; k < 300; ++k) colliders.push_back(box(-1 - k * 0.01, -1 - k * 0.01, 1 + k * 0.01, 1 + k * 0.01));
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
  Stepper stepper(
      {box(-2, -2, 2, 2), box(-3, -3, -2.5, 3), box(2.5, -3, 3, 3), box(-2.5, -3, 2.5, -2.5), box(-2.5, 2.5, 2.5, 3)});
  stepper.at(0.5, 1);
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
  }
}

TEST(CoveredFacet, that_comes_up_while_its_cover_lies_on_the_character_gives_the_normal) {
  // Two tiles that touch in a corner. The character is inside the upper one since a crush, from which side it does not
  // know, so that it stays there, which covers the bevel
  // of the lower one with the normal n = (2, 1) / sqrt(5): that is (2 x + y - 3 m - 30 px) / sqrt(5) away from the
  // lower tile's corner at (1, 1). Its top is 0.1 m below the feet.
  const double slack = 0.4;  // of 2 x + y
  Stepper character({box(0, 0, 1, 1, 0), box(1, 1, 2, 2, 0)});
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
  EXPECT_NEAR(contacts[0].separation, Tolerances{}.stop / 2, 1e-9) << "a hidden facet stops at half the distance";
  EXPECT_NEAR(contacts[0].point.x(), 1, 1e-6);
  EXPECT_NEAR(contacts[0].point.y(), 1 + slack, 1e-5) << "the corner, where it is by then";
}

/// Two seconds of a walker on ground that leads to a slope or a wall on its right, and a jump in the last step. Both
/// are of one body, which stands or goes evenly.
/// @param ground,steep [degrees]
/// @returns where it is and how fast, relative to the body, and in how many steps of the last second it stood.
std::tuple<Vec2d, Vec2d, int> walk_to_corner(double ground, double steep, double move, const Vec2d& velocity) {
  const Vec2d left = -40 * compare::towards(ground * degree);
  const Vec2d right = 8 * compare::towards(steep * degree);
  const MoverIndex mover = velocity != Vec2d::Zero() ? 0 : no_mover;
  Stepper walker({polygon({left, {left.x(), -50}, {0, -50}, {0, 0}}, mover),
                  polygon({{0, 0}, {0, -50}, {9, -50}, {9, right.y()}, right}, mover)},
                 {.snap = 0.2});  // without it a walker hops down steep ground
  walker.at(-0.8, half_height + 0.8).with_velocity(velocity.x(), velocity.y());
  int stood = 0;
  for (int step = 0; step < 120; ++step) {
    walker.step_with_movers_to(velocity * ((step + 1) * walker.dt), {.move = move, .jump = step == 119});
    stood += step >= 59 && step < 119 && walker.state.grounded;
  }
  return {walker.state.position - velocity * (120 * walker.dt), walker.state.velocity - velocity, stood};
}

/// Now and then the steep side pushes a walker that is in the air for a step: see "Found and open" in the README.
TEST(GoingCorner, holds_a_walker_as_one_that_stands_does) {
  int stood = 0;
  int unlike = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double ground = random.between(-40, 40);
    const double steep = random.between(50, 100);
    const double move = random.between(0.5, 1);
    const Vec2d by = random.point(3);
    const auto [place, velocity, steps] = walk_to_corner(ground, steep, move, {0, 0});
    const auto [moving_place, moving_velocity, moving_steps] = walk_to_corner(ground, steep, move, by);
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

const int an_hour = test::shortened(216'000);

/// Distance to the next double.
double ulp(double value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

/// Where a lift is that goes to and fro, 97 steps each way.
Vec2d ping_pong(const Vec2d& by, int step) {
  constexpr int steps_each_way = 97;
  const int phase = step % (2 * steps_each_way);
  const int along = phase <= steps_each_way ? phase : 2 * steps_each_way - phase;
  return by * (static_cast<double>(along) / steps_each_way);
}

/// Goes to and fro by `by`: a lift, or with a speed `belt` [m/s] a belt 8 km long.
struct Carrier {
  Vec2d by;
  double belt = 0;
};

class Carriers : public ::testing::TestWithParam<Carrier> {};

TEST_P(Carriers, carry_for_an_hour_without_a_toggle_or_a_drift) {
  const auto& [by, belt] = GetParam();
  std::vector<ColliderDef> ground;
  if (belt == 0) ground.push_back(box(-1.5, -0.25, 1.5, 0, 0));
  for (int i = -1; i < 8000 && belt > 0; ++i) {
    ground.push_back(box(i, -1, i + 1, 0, by != Vec2d::Zero() ? 0 : no_mover));
    ground.back().surface_speed = belt;
  }
  Stepper rider = player_in(ground, {0.1, half_height + Tolerances{}.stop});
  rider.step();
  const Vec2d start = rider.state.position;
  for (int step = 1; step <= an_hour; ++step) {
    const Vec2d place = ping_pong(by, step);
    rider.step_with_movers_to(place);
    ASSERT_TRUE(rider.state.grounded && rider.state.ride.ground != Ride::none) << step;
    ASSERT_TRUE(rider.report.move.contacts.size() == 1 || belt > 0) << step;
    for (const Eigen::Index i : {0, 1}) {
      const double along = i == 0 ? belt * step * rider.dt : 0;
      const double larger = std::max({std::abs(rider.state.position[i]), std::abs(place[i]), std::abs(start[i])});
      // Each step rounds once along a belt.
      const double most = belt > 0 ? an_hour * ulp(7200) : ulp(larger);
      ASSERT_LE(std::abs((rider.state.position[i] - place[i]) - start[i] - along), most) << step;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LiftsAndBelts, Carriers,
                         ::testing::Values(Carrier{{0, 7.3}}, Carrier{{-3.3, 2.7}}, Carrier{{400.1, -300.7}},
                                           Carrier{{0, 0}, 2}, Carrier{{0, 7.3}, 2}));

}  // namespace
}  // namespace paperproof::stepping
