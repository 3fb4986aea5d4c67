/// What octagon_sweep does on the ground: tiles, slopes, wedges, corners, ceilings, shafts.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::stepping {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double largest_gap = 1e-6;
/// Half the width of the octagon's feet [m].
constexpr double half_foot = 5 * px;

Input walking(double move) { return {.move = move}; }

TEST(FewIterations, let_no_velocity_grow_into_what_stops_it) {
  const Scenery<double> scenery(SceneryDef{{rectangle(-4, -1, 4, 0)}});
  for (const int iterations : {1, 2, 3}) {
    const Controller<double> controller(scenery, CharacterDef{}, SweepDef{.iterations = iterations});
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    CharacterState<double> state;
    state.position = {0, 2};
    for (int step = 0; step < 200; ++step) controller.step(state, Input{}, {{0, -30}, 1.0 / 60}, scratch, report);
    EXPECT_EQ(state.velocity.y(), 0) << iterations;
    EXPECT_TRUE(state.grounded) << iterations;
  }
}

TEST(Ground, names_the_collider_that_is_stood_on) {
  CharacterDef character;
  character.snap = 0.5;
  // Two floors, and a step down to a third one.
  Stepper<double> walker({rectangle(-4, -1, 0, 0), rectangle(0, -1, 2, 0), rectangle(2, -1, 9, -0.05)}, character);
  walker.gravity = {0, -30};
  walker.at(-1, half_height + 1).step();
  EXPECT_EQ(walker.report.move.ground.state, GroundState::air);
  walker.steps(60);
  EXPECT_EQ(walker.report.move.ground.collider, ColliderIndex{0});
  std::vector<ColliderIndex> grounds;
  for (int step = 0; step < 50; ++step) {
    walker.step(walking(1));
    ASSERT_TRUE(walker.state.grounded) << step;
    if (grounds.empty() || grounds.back() != walker.report.move.ground.collider)
      grounds.push_back(walker.report.move.ground.collider);
  }
  EXPECT_EQ(grounds, (std::vector<ColliderIndex>{0, 1, 2}));
  walker.step({.move = {}, .jump = true});
  EXPECT_EQ(walker.report.move.ground.state, GroundState::air);
}

TEST(Ground, is_air_walkable_steep_or_a_wedge) {
  // A slope of 60 degrees that ends on a floor.
  const double rise = 4 * std::tan(60 * degree);
  Stepper<double> faller({rectangle(-1, -1, 20, 0), rectangle(-1, 0, 0, rise), polygon({{0, rise}, {0, 0}, {4, 0}})});
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

TEST(Ground, has_the_velocity_of_a_mover_and_a_conveyor) {
  ColliderDef lift = rectangle(-2, -1, 2, 0);
  lift.mover = 0;
  lift.surface_speed = 3;
  Stepper<double> rider({lift});
  rider.at(0, half_height + 1e-3);
  for (int step = 0; step < 20; ++step) rider.step_with_mover_by(0, 0.01);
  ASSERT_TRUE(rider.state.grounded);
  EXPECT_NEAR(rider.report.move.ground.velocity.x(), 3, 1e-9);
  EXPECT_NEAR(rider.report.move.ground.velocity.y(), 0.01 * 60, 1e-9);
}

TEST(Wedge, holds_the_octagon_on_both_sides_without_velocity) {
  for (const double angle : {60.0, 45.0, 30.0, 10.0, 5.0, 2.0, 1.0}) {
    const double half = angle / 2 * degree;
    const double cotangent = 1 / std::tan(half);
    // Whichever meets the sides first: the arms, 10 px to the side and 10 px below the centre, or the feet, 5 and 20.
    const double height = std::max(10 * cotangent + 10, 5 * cotangent + 20) * px;
    const double rim = height + 2;
    const double width = rim / cotangent;
    Stepper<double> faller({polygon({{0, 0},
                                     {width, rim},
                                     {width + 1, rim},
                                     {width + 1, -1},
                                     {-width - 1, -1},
                                     {-width - 1, rim},
                                     {-width, rim}})});
    faller.gravity = {0, -30};
    faller.at(0.001, height + 1).steps(240);
    EXPECT_EQ(faller.state.velocity, Vec2d(0, 0)) << angle << " degrees";
    EXPECT_TRUE(faller.state.grounded) << angle << " degrees";
    EXPECT_EQ(faller.report.move.ground.collider, ColliderIndex{0}) << angle << " degrees";
    EXPECT_EQ(faller.report.move.ground.state, GroundState::wedge) << angle << " degrees";
    // The sides' gaps add up to twice the lift times sin(half the angle); each is in (0, 1e-6] m.
    const double lift = faller.state.position.y() - height;
    EXPECT_GT(lift, 0) << angle << " degrees";
    EXPECT_LE(lift, largest_gap / std::sin(half) + 1e-12) << angle << " degrees";
    EXPECT_LE(std::abs(faller.state.position.x()), largest_gap / std::cos(half)) << angle << " degrees";
  }
}

TEST(ConcaveCorner, is_met_with_both_sides_in_one_step) {
  Stepper<double> faller({rectangle(-4, -1, 4, 0), rectangle(3, 0, 4, 5)});
  const MoveResult<double>& move = faller.at(0, 3).fly(40, -40);
  EXPECT_TRUE(faller.touched(Side::bottom));
  EXPECT_TRUE(faller.touched(Side::right));
  EXPECT_EQ(move.contacts.size(), 2U);
  EXPECT_EQ(move.velocity, Vec2d(0, 0));
  EXPECT_TRUE(move.grounded);
  for (const double gap : {move.position.y() - half_height, 3 - half_width - move.position.x()}) {
    EXPECT_GT(gap, 0);
    EXPECT_LE(gap, largest_gap);
  }
  // The feet fall 3 m less their height, of 40 m; the rest goes along the floor into the wall.
  EXPECT_NEAR(move.contacts[0].fraction, (3 - half_height) / 40, 1e-9);
  EXPECT_NEAR(move.contacts[1].fraction, (3 - half_width) / 40, 1e-9);
}

TEST(FlushTiles, change_neither_speed_nor_height_at_a_hundred_speeds) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 40; ++i) tiles.push_back(rectangle(i - 1, -1, i, 0));
  for (int i = 1; i <= 100; ++i) {
    CharacterDef character;
    character.walk_speed = 0.117 * i;
    Stepper<double> walker(tiles, character);
    walker.at(0.5, half_height + 0.01).steps(20);
    ASSERT_TRUE(walker.state.grounded);
    walker.state.velocity.x() = character.walk_speed;
    const double height = walker.state.position.y();
    double expected = walker.state.position.x();
    for (int n = 0; n < 170; ++n) {
      walker.step(walking(1));
      expected += character.walk_speed * walker.dt;
      ASSERT_EQ(walker.state.velocity, Vec2d(character.walk_speed, 0)) << "step " << n;
      ASSERT_EQ(walker.state.position.y(), height) << "step " << n;
      ASSERT_EQ(walker.state.position.x(), expected) << "step " << n;
      ASSERT_TRUE(walker.state.grounded) << "step " << n;
    }
  }
}

/// Ground whose surface goes through the origin at an angle, and a character that stands on it at x = 0.
Stepper<double> on_slope(double angle, const CharacterDef& character = {}) {
  const double rise = 50 * std::tan(angle);
  const double deep = std::abs(rise) + 5;
  Stepper<double> stepper({polygon({{-50, -deep}, {50, -deep}, {50, rise}, {-50, -rise}})}, character);
  stepper.at(0, half_height + half_foot * std::tan(std::abs(angle)) + 1e-3).steps(10);
  return stepper;
}

/// The gap between the octagon and that surface, along the normal [m].
double gap_to_slope(const Vec2d& position, double angle) {
  const Vec2d n{-std::sin(angle), std::cos(angle)};
  const CharacterShape shape = CharacterShape::article();
  double gap = 1e9;
  for (const Vec2d& point : shape.points()) gap = std::min(gap, n.dot(position + point));
  return gap;
}

TEST(WalkableSlope, keeps_the_horizontal_speed_up_and_down) {
  for (const double degrees : {-49.0, -30.0, -5.0, 0.5, 10.0, 30.0, 49.0}) {
    const double angle = degrees * degree;
    Stepper<double> walker = on_slope(angle);
    walker.state.velocity.x() = 6;
    for (int n = 0; n < 200; ++n) {
      const double from = walker.state.position.x();
      // Downhill without snap a step must bring it down again: gravity does where the slope is kept as velocity.
      walker.step(walking(1));
      ASSERT_EQ(walker.state.velocity.x(), 6) << degrees << " degrees, step " << n;
      ASSERT_NEAR(walker.state.position.x() - from, 0.1, 1e-12) << degrees << " degrees, step " << n;
      if (n == 0 && degrees < 0) continue;  // it walks off the level it stood at
      const double gap = gap_to_slope(walker.state.position, angle);
      ASSERT_GT(gap, 0) << degrees << " degrees, step " << n;
      if (degrees > 0) {
        ASSERT_LE(gap, largest_gap) << degrees << " degrees, step " << n;
      }
    }
  }
}

TEST(SteepSlope, accelerates_by_gravity_along_the_surface) {
  for (const double degrees : {51.0, 60.0, 75.0, 85.0}) {
    for (const double sign : {1.0, -1.0}) {
      const double angle = sign * degrees * degree;
      const double rise = 200 * std::tan(angle);
      const double deep = std::abs(rise) + 5;
      Stepper<double> slider({polygon({{-200, -deep}, {200, -deep}, {200, rise}, {-200, -rise}})});
      const double sine = std::sin(degrees * degree);
      const double cosine = std::cos(degrees * degree);
      // Touching: at the height where the gap along the normal is half a micrometre.
      slider.at(0, 0).state.position.y() = (5e-7 - gap_to_slope({0, 0}, angle)) / cosine;
      for (int n = 1; n <= 60; ++n) {
        slider.step();
        // Of each step's g dt the part along the surface stays, g dt sin; down it is that times sin again.
        const Vec2d expected{-sign * 10.0 / 60 * n * sine * cosine, -10.0 / 60 * n * sine * sine};
        ASSERT_NEAR(slider.state.velocity.x(), expected.x(), 1e-11) << degrees << " degrees, step " << n;
        ASSERT_NEAR(slider.state.velocity.y(), expected.y(), 1e-11) << degrees << " degrees, step " << n;
        ASSERT_FALSE(slider.state.grounded);
        const double gap = gap_to_slope(slider.state.position, angle);
        ASSERT_GT(gap, 0);
        ASSERT_LE(gap, largest_gap);
      }
    }
  }
}

/// What carries nobody, or a belt, or a lift.
struct FaintGround {
  std::string name;
  std::vector<ColliderDef> colliders;
  double slope = 0;           ///< Rise over run, through the origin.
  Vec2d lift{Vec2d::Zero()};  ///< Velocity of mover 0 [m/s].
};

std::vector<FaintGround> faint_grounds() {
  const auto ramp = [](double slope) {
    return polygon({{-60, -60 * slope - 1}, {60, 60 * slope - 1}, {60, 60 * slope}, {-60, -60 * slope}});
  };
  std::vector<ColliderDef> tiles;
  for (int i = -8; i < 64; ++i) tiles.push_back(rectangle(0.25 * i, -1, 0.25 * (i + 1), 0));
  ColliderDef belt = ramp(0);
  belt.surface_speed = 2;
  ColliderDef lift = ramp(0);
  lift.mover = 0;
  ColliderDef ledge = chain({{-60, 0}, {60, 0}}, Vec2d{0, 1});
  return {{"floor", {ramp(0)}}, {"tiles", tiles}, {"uphill", {ramp(0.6)}, 0.6}, {"downhill", {ramp(-0.6)}, -0.6},
          {"one-way", {ledge}}, {"belt", {belt}}, {"lift", {lift}, 0, {1, 2}},  {"sinking", {lift}, 0, {-1, -2}}};
}

/// Walks on ground that gravity presses it onto by less than a rest gap each step: it never loses it, nor sinks.
void expect_steady_walk(const FaintGround& ground, double dt, double gravity, double snap = 0) {
  SCOPED_TRACE(ground.name + testing::PrintToString(std::pair(dt, gravity)));
  CharacterDef character;
  character.snap = snap;
  Stepper<double> walker(ground.colliders, character);
  walker.dt = dt;
  walker.gravity = {0, -gravity};
  const double cosine = 1 / std::sqrt(1 + ground.slope * ground.slope);
  walker.at(0, half_height + std::abs(ground.slope) * half_foot + Tolerances<double>{}.stop / cosine);
  walker.with_velocity(6 + ground.lift.x(), 6 * ground.slope + ground.lift.y());
  int begins = 0;
  bool stood = false;
  double lowest = 1;
  double highest = 0;
  const double way = 12;
  for (int step = 0; step < std::min(2000.0, way / (6 * dt)); ++step) {
    const Vec2d offset = ground.lift * ((step + 1) * dt);
    for (MoverMotion<double>& mover : walker.movers) mover = {mover.to, offset};
    walker.step();
    const bool stands = walker.state.grounded && walker.touched(Side::bottom);
    ASSERT_TRUE(stands || !stood) << "after step " << step;
    begins += stands && !stood;
    stood = stands;
    const Vec2d at = walker.state.position - offset;
    const double gap = (at.y() - half_height - std::abs(ground.slope) * half_foot - ground.slope * at.x()) * cosine;
    ASSERT_GT(gap, 0) << step;
    ASSERT_LE(gap, largest_gap) << step;
    if (step < 100) continue;
    lowest = std::min(lowest, gap);
    highest = std::max(highest, gap);
  }
  EXPECT_EQ(begins, 1);
  EXPECT_LE(highest - lowest, 1e-9);
  EXPECT_NEAR(walker.state.velocity.x(), 6 + ground.lift.x(), 1e-9);
  EXPECT_NEAR(walker.state.velocity.y(), 6 * ground.slope + ground.lift.y(), 1e-9);
}

TEST(FaintGravity, keeps_a_walker_on_its_ground) {
  for (const FaintGround& ground : faint_grounds()) {
    for (const double gravity : {0.05, 0.2, 0.4}) expect_steady_walk(ground, 1e-3, gravity);
    for (const double gravity : {1.0, 2.0, 5.0, 9.81, 29.0, 35.0}) expect_steady_walk(ground, 1e-4, gravity);
    expect_steady_walk(ground, 1.0 / 60, 1e-3);
    expect_steady_walk(ground, 1e-4, 30, 0.25);
  }
}

TEST(FaintGravity, lets_a_walker_go_over_the_edge) {
  Stepper<double> walker({rectangle(-4, -1, 1, 0)});
  walker.dt = 1e-3;
  walker.gravity = {0, -0.2};
  walker.at(0, half_height + Tolerances<double>{}.stop).with_velocity(6, 0);
  for (int step = 0; step < 1000; ++step) {
    const double left_foot = walker.state.position.x() - half_foot;
    walker.step();
    if (step < 5) continue;  // it comes down
    ASSERT_EQ(walker.state.grounded, left_foot + 6 * walker.dt <= 1) << step;
  }
}

TEST(Snap, follows_the_ground_down_to_the_last_step) {
  for (const double snap : {0.0, 0.5}) {
    CharacterDef character;
    character.snap = snap;
    // Level to x = 0, then down 30 degrees.
    const double down = 20 * std::tan(30 * degree);
    Stepper<double> walker({polygon({{-5, 0}, {-5, -20}, {20, -20}, {20, -down}, {0, 0}})}, character);
    walker.at(-2, half_height + 0.01).steps(20);
    walker.state.velocity.x() = 6;
    int airborne = 0;
    for (int n = 0; n < 150; ++n) {
      walker.step(walking(1));
      airborne += walker.state.grounded ? 0 : 1;
      ASSERT_EQ(walker.state.velocity.x(), 6) << "step " << n;
      if (snap == 0) continue;
      const double left_foot = walker.state.position.x() - half_foot;
      const double surface = left_foot > 0 ? -left_foot * std::tan(30 * degree) : 0;
      const double above = walker.state.position.y() - half_height - surface;
      ASSERT_GT(above, 0) << "step " << n;
      ASSERT_LE(above, largest_gap / std::cos(30 * degree)) << "step " << n;
    }
    if (snap == 0)
      EXPECT_GE(airborne, 5) << "without it the character hops where the ground falls away";
    else
      EXPECT_EQ(airborne, 0);
  }
}

TEST(Snap, lets_a_jump_go) {
  CharacterDef character;
  character.snap = 0.5;
  Stepper<double> jumper({rectangle(-9, -1, 9, 0)}, character);
  jumper.at(0, half_height + 0.01).steps(20);
  const double floor = jumper.state.position.y();
  jumper.step({.move = 1, .jump = true});
  EXPECT_FALSE(jumper.state.grounded);
  EXPECT_EQ(jumper.state.velocity.y(), character.jump_speed - 10 * jumper.dt);
  EXPECT_NEAR(jumper.state.position.y(), floor + jumper.state.velocity.y() * jumper.dt, 1e-15);
}

TEST(Snap, does_not_reach_further_than_it_is_long) {
  CharacterDef character;
  character.snap = 0.05;
  Stepper<double> walker({rectangle(-9, -1, 0, 0), rectangle(0, -3, 9, -0.1)}, character);
  walker.at(-0.3, half_height + 0.01).steps(20);
  walker.state.velocity.x() = 6;
  while (walker.state.position.x() - half_foot <= 0) walker.step(walking(1));
  EXPECT_FALSE(walker.state.grounded) << "the step of 10 cm is higher than the snap of 5 cm";
}

TEST(Ceiling, ends_the_rise_and_nothing_else) {
  Stepper<double> jumper({rectangle(-9, 2, 9, 3)});
  jumper.at(0, 1).with_velocity(3, 60).step();
  EXPECT_TRUE(jumper.touched(Side::top));
  EXPECT_EQ(jumper.state.velocity, Vec2d(3, 0));
  EXPECT_FALSE(jumper.state.grounded);
  EXPECT_NEAR(jumper.state.position.x(), 3 * jumper.dt, 1e-15);
  const double gap = 2 - half_height - jumper.state.position.y();
  EXPECT_GT(gap, 0);
  EXPECT_LE(gap, largest_gap);
  jumper.step();
  EXPECT_EQ(jumper.state.velocity.y(), -10 * jumper.dt) << "it falls at once";
}

/// A shaft with a floor. @param half of its width [m].
Stepper<double> in_shaft(double half) {
  Stepper<double> faller(
      {rectangle(-half - 1, -1, -half, 8), rectangle(half, -1, half + 1, 8), rectangle(-half, -1, half, 0)});
  return std::move(faller.at(0, 5));
}

TEST(ExactFitShaft, lets_fall_or_holds_but_never_overlaps) {
  for (const double half : {half_width, std::nextafter(half_width, 1.0)}) {
    Stepper<double> faller = in_shaft(half);
    for (int n = 0; n < 300; ++n) {
      ASSERT_NE(faller.step(), StepStatus::stuck) << "half " << half << ", step " << n;
      // Half the width and the position are far apart in size: long double adds them without rounding.
      ASSERT_GE(static_cast<long double>(faller.state.position.x()) - half_width, -static_cast<long double>(half));
      ASSERT_LE(static_cast<long double>(faller.state.position.x()) + half_width, static_cast<long double>(half));
      ASSERT_GE(faller.state.position.y(), half_height);
      ASSERT_LE(faller.state.position.y(), 5);
    }
  }
}

TEST(ExactFitShaft, with_a_micrometre_of_room_is_no_obstacle) {
  Stepper<double> faller = in_shaft(half_width + 1e-6);
  double height = 5;
  double speed = 0;
  for (int n = 0; height + (speed - 10.0 / 60) / 60 > half_height; ++n) {
    speed -= 10.0 / 60;
    height += speed / 60;
    faller.step();
    ASSERT_NEAR(faller.state.position.y(), height, 1e-12) << "step " << n;
    ASSERT_TRUE(faller.report.move.contacts.empty()) << "step " << n;
    ASSERT_EQ(faller.state.position.x(), 0) << "step " << n;
  }
  faller.steps(10);
  EXPECT_TRUE(faller.state.grounded);
}

TEST(ExactFitShaft, that_is_an_ulp_too_narrow_is_a_start_inside_and_left) {
  // Out over the left wall or the right one: they are 1 m wide, and it is 3 m up to the top.
  const double half = std::nextafter(half_width, 0.0);
  Stepper<double> faller = in_shaft(half);
  faller.gravity = {0, 0};
  EXPECT_EQ(faller.step(), StepStatus::moved);
  EXPECT_NEAR(std::abs(faller.state.position.x()), half + 1 + half_width, largest_gap);
  EXPECT_GT(std::abs(faller.state.position.x()), half + 1 + half_width);
  EXPECT_EQ(faller.state.position.y(), 5);
}

}  // namespace
}  // namespace paperproof::stepping
