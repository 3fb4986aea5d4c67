/// octagon_sweep among movers: carried, pushed, met head-on, crushed.
#include "controller/stepping.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr Tolerances<double> tolerances{};
constexpr int an_hour = test::sampled(216'000);

ColliderDef moving(ColliderDef collider, MoverIndex mover = 0) {
  collider.mover = mover;
  return collider;
}

/// Distance to the next double.
double ulp(double value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

/// Where a lift is that goes to and fro.
Vec2d ping_pong(const Vec2d& by, int steps_each_way, int step) {
  const int phase = step % (2 * steps_each_way);
  const int along = phase <= steps_each_way ? phase : 2 * steps_each_way - phase;
  return by * (static_cast<double>(along) / steps_each_way);
}

struct RideResult {
  double furthest_off_in_ulps = 0;
  int begins = 0;
  int ends = 0;
};

/// Rides for an hour on a lift 3 m wide whose top is at y = 0, and compares with where it stood on it.
RideResult ride(const Vec2d& by, int steps_each_way) {
  Stepper<double> rider({moving(rectangle(-1.5, -0.25, 1.5, 0))});
  rider.gravity = {0, -30};
  rider.at(0.1, half_height + tolerances.stop);
  rider.step();
  const Vec2d start = rider.state.position;
  RideResult result;
  bool touched = true;
  for (int step = 0; step < an_hour; ++step) {
    rider.movers[0] = {rider.movers[0].to, ping_pong(by, steps_each_way, step + 1)};
    rider.step();
    const Vec2d& lift = rider.movers[0].to;
    for (const Eigen::Index i : {0, 1}) {
      const double off = std::abs((rider.state.position[i] - lift[i]) - start[i]);
      const double larger = std::max({std::abs(rider.state.position[i]), std::abs(lift[i]), std::abs(start[i])});
      result.furthest_off_in_ulps = std::max(result.furthest_off_in_ulps, off / ulp(larger));
    }
    const bool touches = rider.state.grounded && rider.report.move.contacts.size() == 1;
    result.begins += touches && !touched;
    result.ends += !touches && touched;
    touched = touches;
  }
  return result;
}

class Lift : public ::testing::TestWithParam<Vec2d> {};

TEST_P(Lift, carries_for_an_hour_without_a_step_of_difference) {
  const RideResult result = ride(GetParam(), 97);
  EXPECT_LE(result.furthest_off_in_ulps, 1);
  EXPECT_EQ(result.begins, 0) << "besides the first";
  EXPECT_EQ(result.ends, 0);
}

INSTANTIATE_TEST_SUITE_P(UpDownAndSideways, Lift,
                         ::testing::Values(Vec2d{0, 7.3}, Vec2d{0, -7.3}, Vec2d{5.1, 0}, Vec2d{-3.3, 2.7},
                                           Vec2d{400.1, -300.7}));

TEST(HeadOn, is_met_when_the_sum_of_the_speeds_has_closed_the_distance) {
  for (const double paper : {0.0, 1e-6, 0.01}) {
    for (const double own : {0.1, 3.7, 950.0}) {
      for (const double other : {0.2, 13.3, 1e5}) {
        const double distance = 0.7 * std::min(1.0, own + other);
        const double left = half_width + distance;
        ColliderDef def = paper > 0 ? rectangle(left, -5, left + paper, 5) : chain({{left, -5}, {left, 5}});
        Stepper<double> flyer({moving(def)});
        flyer.movers[0].to = {-other, 0};
        const MoveResult<double>& move = flyer.fly(own, 0);
        ASSERT_EQ(move.contacts.size(), 1U) << own << " " << other;
        EXPECT_NEAR(move.contacts[0].fraction, (left - half_width) / (own + other), 1e-12);
        EXPECT_EQ(move.contacts[0].side, Side::right);
        EXPECT_LT(move.position.x() + half_width, left - other) << "on the side it came from";
      }
    }
  }
}

TEST(Push, by_a_wall_gives_its_normal_speed_and_nothing_along_it) {
  Stepper<double> pushed({moving(rectangle(-3, -9, -2, 9))});
  pushed.at(0, 0);
  pushed.movers[0].to = {5, 3};
  pushed.fly(0, 0);
  EXPECT_NEAR(pushed.state.position.x(), 3 + half_width, 2 * tolerances.touch);
  EXPECT_EQ(pushed.state.position.y(), 0);
  EXPECT_EQ(pushed.state.velocity.x(), 5);
  EXPECT_EQ(pushed.state.velocity.y(), 0);
  ASSERT_EQ(pushed.report.move.contacts.size(), 1U);
  // The wall's right side is at -2, the arm at -half_width.
  EXPECT_NEAR(pushed.report.move.contacts[0].fraction, (2 - half_width) / 5, 1e-12);
}

TEST(Crush, is_reported_in_the_step_that_closes_the_gap) {
  // Floor and ceiling close at 1 m/s each.
  const double gap = 1.505;
  Stepper<double> pressed({moving(rectangle(-5, -1, 5, 0), 0), moving(rectangle(-5, 2 * half_height + gap, 5, 9), 1)});
  pressed.at(0, half_height + gap / 2);
  pressed.gravity = {0, 0};
  const double closed_by_a_step = 2.0 / 60;
  const int expected = static_cast<int>(std::ceil(gap / closed_by_a_step));
  int step = 0;
  do {
    ++step;
    pressed.movers[0] = {pressed.movers[0].to, Vec2d{0, step / 60.0}};
    pressed.movers[1] = {pressed.movers[1].to, Vec2d{0, -step / 60.0}};
  } while (pressed.step() != StepStatus::crushed && step < 1000);
  EXPECT_EQ(step, expected);
  EXPECT_FALSE(pressed.report.move.crushed.empty());
}

TEST(Crush, never_pushes_through_what_stands_still) {
  Stepper<double> pressed({rectangle(-5, -1, 5, 0), moving(rectangle(-5, 3, 5, 4))});
  pressed.at(0, half_height + 0.5);
  for (int step = 1; step <= 300; ++step) {
    const StepStatus status = pressed.step_with_mover_by(0, step <= 150 ? -0.02 : 0.02);
    ASSERT_GE(pressed.state.position.y(), half_height) << step;
    // The press, 3 m above the floor, is at the character's height of 1.25 m after 87.5 and after 212.5 steps.
    const bool closed = step >= 88 && step <= 212;
    EXPECT_EQ(status == StepStatus::crushed, step == 88) << step;
    EXPECT_EQ(status == StepStatus::stuck, closed && step > 88) << step;
  }
  EXPECT_TRUE(pressed.state.grounded);
}

TEST(PaperSweep, over_a_resting_character_meets_it_at_distance_over_speed_and_stays_on_its_side) {
  for (const double speed : {0.9, 7.0, 500.0, 1e5}) {
    const double distance = std::min(0.5, speed / 3);
    const double left = half_width + distance;
    Stepper<double> resting({rectangle(-4, -1, 4, 0), moving(rectangle(left, 0.25, left + 1e-3, 5))});
    resting.at(0, half_height + tolerances.stop);
    resting.dt = 1;
    resting.movers[0].to = {-speed, 0};
    resting.step();
    const auto& contacts = resting.report.move.contacts;
    const auto* const met = std::find_if(contacts.begin(), contacts.end(),
                                         [](const Contact<double>& contact) { return contact.collider == 1; });
    ASSERT_NE(met, contacts.end());
    EXPECT_NEAR(met->fraction, (left - half_width) / speed, 1e-12);
    EXPECT_LT(resting.state.position.x() + half_width, left - speed) << "on the side it was on";
    EXPECT_EQ(resting.state.position.y(), half_height + tolerances.stop) << "on the ground";
  }
}

/// A tooth whose facet, 30 degrees steep, is met by a character at `p`: from below, rising to the right, or from above,
/// falling to the right.
ColliderDef tooth(const Vec2d& p, bool floor) {
  const double up = floor ? 1 : -1;
  const Vec2d along{std::cos(std::numbers::pi / 6), up * std::sin(std::numbers::pi / 6)};
  const Vec2d met = p + Vec2d{5 * px, -up * half_height};  // by the right foot, or the right of the head
  const std::vector<Vec2d> corners{met - 0.05 * along, met + 0.2 * along, met + Vec2d{0.05, -up}};
  return polygon(corners);
}

TEST(SawtoothCorridor, of_k_teeth_crossed_in_one_step_gives_k_impacts_at_their_times) {
  for (const int teeth : {1, 2, 3, 7, 12}) {
    const double wanted = 200;
    // A rising tooth keeps what is horizontal (it is ground), a falling one halves it: from (1, tan 30) the part into
    // the normal (-1/2, -cos 30) is 1, which leaves (1/2, -tan(30)/2). Half a metre from one to the next.
    std::vector<ColliderDef> colliders;
    std::vector<double> fractions;
    Vec2d p{0, 0};
    double share = 1;
    double spent = 0;
    double slope = 0;
    for (int k = 0; k < teeth; ++k) {
      p += Vec2d{0.5, 0.5 * slope};
      spent += 0.5 / share;
      fractions.push_back(spent / wanted);
      const bool floor = k % 2 == 0;
      colliders.push_back(tooth(p, floor));
      slope = (floor ? 1 : -1) * std::tan(std::numbers::pi / 6);
      if (!floor) share /= 2;
    }
    const Scenery<double> scenery(SceneryDef{colliders});
    const Controller<double> controller(scenery, {}, {.iterations = teeth + 1});
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    CharacterState<double> state;
    state.velocity = {wanted, 0};
    EXPECT_EQ(controller.step(state, {}, {{0, 0}, 1.0}, scratch, report), StepStatus::moved) << teeth;
    ASSERT_EQ(report.move.contacts.size(), static_cast<std::size_t>(teeth));
    for (std::size_t k = 0; k < fractions.size(); ++k) {
      EXPECT_EQ(report.move.contacts[k].collider, k);
      // Each is stopped at up to 2 gaps early, and what that shifts grows with the shares that follow.
      EXPECT_NEAR(report.move.contacts[k].fraction, fractions[k], 1e-6) << k << " of " << teeth;
    }
  }
}

TEST(Leaving, by_a_jump_keeps_the_speed_of_the_lift) {
  Stepper<double> rider({moving(rectangle(-3, -1, 3, 0))});
  rider.at(0, half_height + tolerances.stop);
  rider.gravity = {0, -30};
  const Vec2d by{0.05, 0.03};
  for (int step = 0; step < 10; ++step) rider.step_with_mover_by(by.x(), by.y());
  ASSERT_TRUE(rider.state.grounded);
  rider.step_with_mover_by(by.x(), by.y(), {.move = std::nullopt, .jump = true});
  EXPECT_FALSE(rider.state.grounded);
  EXPECT_EQ(rider.state.ride.ground, Ride<double>::none);
  // Both come out of offsets of up to 0.6 m: 1e-12 is far above their rounding.
  EXPECT_NEAR(rider.state.velocity.x(), by.x() * 60, 1e-12);
  EXPECT_NEAR(rider.state.velocity.y(), 12 - 30.0 / 60 + by.y() * 60, 1e-12);
}

TEST(Leaving, over_the_edge_keeps_the_speed_of_the_lift) {
  Stepper<double> rider({moving(rectangle(-3, -1, 3, 0))});
  rider.at(1.5, half_height + tolerances.stop);
  rider.step_with_mover_by(-0.05, 0);
  int steps = 0;
  while (rider.state.grounded && ++steps < 60) rider.step_with_mover_by(-0.05, 0, {.move = 1});
  EXPECT_FALSE(rider.state.grounded);
  EXPECT_NEAR(rider.state.velocity.x(), 6 - 0.05 * 60, 1e-12);
}

TEST(Walking, on_a_lift_is_as_fast_as_on_the_ground) {
  Stepper<double> rider({moving(rectangle(-30, -1, 30, 0))});
  Stepper<double> walker({rectangle(-30, -1, 30, 0)});
  rider.at(0, half_height + tolerances.stop);
  walker.at(0, half_height + tolerances.stop);
  rider.step_with_mover_by(0.04, 0.02);
  walker.step();
  for (int step = 0; step < 120; ++step) {
    rider.step_with_mover_by(0.04, 0.02, {.move = 1});
    walker.step({.move = 1});
    ASSERT_TRUE(rider.state.grounded) << step;
  }
  EXPECT_NEAR(rider.state.position.x() - rider.movers[0].to.x(), walker.state.position.x(), 1e-12);
  EXPECT_NEAR(rider.state.position.y() - rider.movers[0].to.y(), walker.state.position.y(), 1e-12);
}

TEST(Conveyor, carries_what_stands_on_it_along_its_surface) {
  for (const double speed : {-2.0, 3.0}) {
    ColliderDef belt = rectangle(-30, -1, 30, 0);
    belt.surface_speed = speed;
    Stepper<double> rider({belt});
    rider.at(0, half_height + tolerances.stop).steps(60);
    EXPECT_NEAR(rider.state.position.x(), speed, 1e-12);
    EXPECT_EQ(rider.state.position.y(), half_height + tolerances.stop);
    EXPECT_TRUE(rider.state.grounded);
  }
}

/// A belt of tiles 8 km long, which stands, or is a lift that goes up and down.
class Belt : public ::testing::TestWithParam<double> {};

TEST_P(Belt, carries_for_an_hour_without_a_toggle) {
  std::vector<ColliderDef> tiles;
  for (int i = -1; i < 8000; ++i) {
    ColliderDef tile = rectangle(i, -1, i + 1, 0);
    tile.surface_speed = 2;
    tiles.push_back(GetParam() != 0 ? moving(tile) : tile);
  }
  Stepper<double> rider(tiles);
  rider.gravity = {0, -30};
  rider.at(0, half_height + tolerances.stop).step();
  const Vec2d start = rider.state.position;
  int toggles = 0;
  double furthest_off = 0;
  for (int step = 1; step <= an_hour; ++step) {
    for (MoverMotion<double>& lift : rider.movers) lift = {lift.to, ping_pong({0, GetParam()}, 97, step)};
    rider.step();
    toggles += !rider.state.grounded || rider.state.ride.ground == Ride<double>::none;
    const Vec2d lift = rider.movers.empty() ? Vec2d(0, 0) : rider.movers[0].to;
    furthest_off = std::max(furthest_off, (rider.state.position - lift - start - Vec2d(step / 30.0, 0)).norm());
  }
  std::printf("belt that moves by %g m: %d steps without ground, %.3g m off\n", GetParam(), toggles, furthest_off);
  EXPECT_EQ(toggles, 0);
  EXPECT_LE(furthest_off, an_hour * ulp(7200)) << "each step rounds once along the belt";
}

INSTANTIATE_TEST_SUITE_P(StandingAndMoving, Belt, ::testing::Values(0, 7.3));

TEST(Conveyor, up_a_slope_goes_with_its_speed_along_the_slope) {
  ColliderDef belt = polygon({{-40, -30}, {40, -30}, {40, 30}, {-40, -30 + 1e-9}});
  belt.surface_speed = 2;
  Stepper<double> rider({belt});
  const Vec2d along = Vec2d{80, 60}.normalized();
  // The right foot, at (5, -20) px, stands on the line y = 3/4 x.
  rider.at(0, half_height + 0.75 * 5 * px + 1e-3).steps(10);
  const Vec2d from = rider.state.position;
  rider.steps(60);
  EXPECT_NEAR((rider.state.position - from).x(), 2 * along.x(), 1e-8);
  EXPECT_NEAR((rider.state.position - from).y(), 2 * along.y(), 1e-8);
}

TEST(Push, up_a_slope_follows_the_slope) {
  // 30 degrees: the wall pushes by 0.5 m to the right, the slope takes it up.
  const double rise = std::tan(std::numbers::pi / 6);
  Stepper<double> pushed(
      {polygon({{-9, -9}, {9, -9}, {9, 9 * rise}, {-9, -9 * rise}}), moving(rectangle(-4, -5, -3, 9))});
  pushed.at(0, half_height + 5 * px * rise + 1e-3).steps(5);
  ASSERT_TRUE(pushed.state.grounded);
  const Vec2d from = pushed.state.position;
  for (int step = 0; step < 40; ++step) pushed.step_with_mover_by(0.1, 0);
  // The wall's right side has gone from -3 to 1.
  EXPECT_NEAR(pushed.state.position.x(), 1 + half_width, 2 * tolerances.touch);
  EXPECT_NEAR(pushed.state.position.y() - from.y(), (pushed.state.position.x() - from.x()) * rise, 1e-6);
}

TEST(Wedge, of_two_movers_ends_a_fall_and_is_not_climbed) {
  CharacterDef steep_at_once;
  steep_at_once.max_climb_degrees = 20;
  for (const double side : {1.0, -1.0}) {
    // It falls onto the steeper one, and what it slides with points up the other.
    const ColliderDef flatter = polygon({{0, -1}, {-3 * side, -1}, {-3 * side, 0.7}});
    const ColliderDef steeper = polygon({{0, -1}, {3 * side, -1}, {3 * side, 2.5}});
    Stepper<double> fallen({moving(flatter, 0), moving(steeper, 1)}, steep_at_once);
    fallen.movers = {{{0, 0}, {-8e-4 * side, 0}}, {{0, 0}, {0, -9e-4}}};
    fallen.at(0.3 * side, 2).with_velocity(0, -300);
    fallen.step();
    EXPECT_LE(fallen.report.move.contacts.size(), 6U);
    for (std::size_t k = 1; k < fallen.report.move.path.size(); ++k)
      EXPECT_LE(fallen.report.move.path[k].position.y(), fallen.report.move.path[k - 1].position.y() + 1e-6) << side;
  }
}

TEST(OneWayLift, carries_from_above_and_is_passed_from_below) {
  Stepper<double> rider({moving(chain({{-3, 0}, {3, 0}}, Vec2d{0, 1}))});
  rider.at(0, half_height + tolerances.stop);
  for (int step = 0; step < 60; ++step) rider.step_with_mover_by(0, 0.05);
  EXPECT_NEAR(rider.state.position.y(), 3 + half_height, 1e-6);
  EXPECT_TRUE(rider.state.grounded);

  Stepper<double> below({rectangle(-4, -2, 4, -1), moving(chain({{-3, 0}, {3, 0}}, Vec2d{0, 1}))});
  below.at(0, half_height - 1 + tolerances.stop);
  for (int step = 0; step < 60; ++step) below.step_with_mover_by(0, -0.02);
  EXPECT_EQ(below.state.position.y(), half_height - 1 + tolerances.stop) << "it comes down through the character";
}

TEST(CoveredFacet, that_comes_up_while_its_cover_lies_on_the_character_gives_the_normal) {
  // Two tiles that touch in a corner. The character is inside the upper one since a crush, from which side it does not
  // know, so that it stays there, which covers the bevel
  // of the lower one with the normal n = (2, 1) / sqrt(5): that is (2 x + y - 3 m - 30 px) / sqrt(5) away from the
  // lower tile's corner at (1, 1). Its top is 0.1 m below the feet.
  const double slack = 0.4;  // of 2 x + y
  Stepper<double> character({moving(rectangle(0, 0, 1, 1)), moving(rectangle(1, 1, 2, 2))});
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

TEST(Crush, by_another_knows_from_which_side_of_what_lies_on_it_the_character_came) {
  // A slab 0.2 m thick comes down through a character that stands on the floor beside a wall, until it lies on the
  // floor. Then a block 0.5 m high comes from the left, 2 m in one step: there is room above it, but that is above the
  // slab as well, under which the character was.
  const double to_wall = 0.1;
  Stepper<double> pressed({rectangle(-5, -1, 5, 0), rectangle(half_width + to_wall, 0, 2, 9),
                           moving(rectangle(-2, 1.5, 2, 1.7), 0), moving(rectangle(-4, 0, -1.9, 0.5), 1)});
  pressed.gravity = {0, 0};
  pressed.at(0, half_height + tolerances.stop);
  pressed.step();
  for (const double down : {0.75, 1.5}) {
    pressed.movers[0] = {pressed.movers[0].to, {0, -down}};
    pressed.step();
    ASSERT_TRUE(pressed.state.crushed);
    ASSERT_EQ(pressed.state.crushers.size(), 1U);
    EXPECT_EQ(pressed.state.crushers[0].collider, 2U);
    EXPECT_EQ(pressed.state.crushers[0].last_free, pressed.state.position);
    // It met the head at a height of 1.25 m.
    EXPECT_NEAR(pressed.state.crushers[0].displacement.y(), 0.25 - down, 1e-5)
        << "since the character was free below it";
  }
  pressed.movers[0].from = pressed.movers[0].to;
  pressed.movers[1].to = {2, 0};
  EXPECT_EQ(pressed.step(), StepStatus::crushed);
  ASSERT_EQ(pressed.report.move.crushed.size(), 1U);
  EXPECT_EQ(pressed.report.move.crushed[0], 3U);
  EXPECT_LE(pressed.state.position.y(), half_height + 1e-6);
}

TEST(Stages, that_the_scenery_needs_cannot_be_left_out) {
  const auto make = [](std::vector<ColliderDef> colliders, const Stages& stages) {
    const Scenery<double> scenery(SceneryDef{std::move(colliders)});
    const Controller<double> controller(scenery, {}, {.stages = stages});
  };
  const ColliderDef floor = rectangle(-4, -1, 4, 0);
  ColliderDef belt = floor;
  belt.surface_speed = 1;
  const ColliderDef slope = polygon({{0, 0}, {4, 0}, {4, 3}});
  EXPECT_NO_THROW(make({floor}, {.movers = false, .one_way = false, .slopes = false}));
  EXPECT_THROW(make({moving(floor)}, {.movers = false}), std::invalid_argument);
  EXPECT_THROW(make({belt}, {.movers = false}), std::invalid_argument);
  EXPECT_THROW(make({chain({{0, 0}, {1, 0}}, Vec2d{0, 1})}, {.one_way = false}), std::invalid_argument);
  EXPECT_THROW(make({slope}, {.slopes = false}), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::stepping
