/// Up of a character: any unit vector. And the calls that put a character elsewhere, or knock it back.
#include "controller/stepping.hpp"
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr double frame = 1.0 / 60;

/// With gravity along -up.
StepContext<double> standing_with(const Vec2d& up) { return {-30 * up, frame, {}, nullptr, up}; }

StepStatus step_with(Stepper<double>& stepper, const Vec2d& up, const Input& input = {}) {
  return stepper.controller.step(stepper.state, input, standing_with(up), stepper.scratch, stepper.report);
}

std::vector<ColliderDef> walls_of_a_box() {
  return {rectangle(-6, -6, 6, -5), rectangle(5, -6, 6, 6), rectangle(-6, 5, 6, 6), rectangle(-6, -6, -5, 6)};
}

TEST(Up, that_is_no_unit_vector_is_refused) {
  Stepper<double> stepper({rectangle(-9, -1, 9, 0)});
  stepper.at(0, 3);
  const CharacterState<double> before = stepper.state;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec2d& up : {Vec2d{0, 0}, Vec2d{0, 1.0001}, Vec2d{nan, 1}, Vec2d{0, nan}, Vec2d{infinity, 0}, Vec2d{1, 1},
                          Vec2d{0, 1 + 1e-14}}) {
    EXPECT_EQ(step_with(stepper, up), StepStatus::invalid_input) << up.transpose();
    EXPECT_EQ(stepper.controller.move(stepper.state, {1, 0}, standing_with(up), stepper.scratch, stepper.report),
              StepStatus::invalid_input);
    EXPECT_FALSE(stepper.controller.cast({0, 3}, {0, -9}, {.up = up}, stepper.scratch));
    EXPECT_EQ(stepper.state, before);
  }
  for (int i = 0; i < 1000; ++i) {
    const Vec2d up{std::cos(i), std::sin(i)};
    ASSERT_EQ(step_with(stepper, up), StepStatus::moved) << i;
    ASSERT_EQ(step_with(stepper, Vec2d{up.x() * 7, up.y() * 7}.normalized()), StepStatus::moved) << i;
  }
}

TEST(Up, of_another_technique_is_refused) {
  Stepper<double> boxed({rectangle(-9, -1, 9, 0)}, {}, "bounding_box");
  EXPECT_EQ(step_with(boxed, {0, 1}), StepStatus::moved);
  EXPECT_EQ(step_with(boxed, {0, -1}), StepStatus::invalid_input);
}

TEST(Up, that_turns_at_each_corner_lets_a_character_walk_around_in_a_box) {
  for (const double direction : {1.0, -1.0}) {
    CharacterDef square;
    square.shape =
        CharacterShape(std::vector<Vec2d>{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});  // stands on any side
    Stepper<double> walker(walls_of_a_box(), square);
    Vec2d up{0, 1};
    walker.at(0, -4.5 + 1e-3);
    for (int step = 0; step < 10; ++step) step_with(walker, up);
    int corners = 0;
    for (int step = 0; step < 600; ++step) {
      ASSERT_EQ(step_with(walker, up, {.move = direction}), StepStatus::moved);
      ASSERT_TRUE(walker.state.grounded) << direction << ", step " << step;
      ASSERT_EQ(walker.report.move.ground.normal, up);
      ASSERT_EQ(walker.state.wall_left, direction < 0 && walker.touched(Side::left));
      if (!walker.state.wall_left && !walker.state.wall_right) continue;
      ASSERT_EQ(walker.state.wall_right, direction > 0);
      up = direction > 0 ? Vec2d{-up.y(), up.x()} : Vec2d{up.y(), -up.x()};  // the wall becomes the floor
      ++corners;
    }
    EXPECT_GE(corners, 5) << "all around the box: " << direction;
  }
}

TEST(Up, lets_a_character_stand_jump_and_land_below_a_ceiling) {
  Stepper<double> hanging({rectangle(-9, 0, 9, 1)});
  hanging.at(0, -half_height - 1e-3);
  const Vec2d down{0, -1};
  for (int step = 0; step < 10; ++step) step_with(hanging, down);
  ASSERT_TRUE(hanging.state.grounded);
  const Vec2d rest = hanging.state.position;
  for (int step = 0; step < 10; ++step) step_with(hanging, down);
  EXPECT_EQ(hanging.state.position, rest) << "bit for bit";
  step_with(hanging, down, {.move = 1});
  EXPECT_LT(hanging.state.velocity.x(), 0) << "its right is the left of the world";
  step_with(hanging, down, {.move = {}, .jump = true});
  EXPECT_NEAR(hanging.state.velocity.y(), -(12 - 30 * frame), 1e-12);
  int steps_in_air = 0;
  for (; !hanging.state.grounded && steps_in_air < 100; ++steps_in_air) step_with(hanging, down);
  EXPECT_NEAR(steps_in_air, 2 * 12 / 30.0 / frame, 2);
  EXPECT_NEAR(hanging.state.position.y(), rest.y(), 1e-6);
  EXPECT_TRUE(hanging.touched(Side::bottom));
}

TEST(Up, that_is_slanted_makes_a_level_floor_of_a_slope) {
  constexpr double slope = 70 * std::numbers::pi / 180;  // too steep to climb for who is upright
  const Vec2d along{std::cos(slope), std::sin(slope)};
  const Vec2d up{-along.y(), along.x()};
  for (const double mover : {0.0, 1.0}) {
    ColliderDef ramp = polygon({-9 * along, 9 * along, 9 * along - 3 * up, -9 * along - 3 * up});
    if (mover != 0) ramp.mover = 0;
    Stepper<double> walker({ramp});
    walker.state.position = 2 * up;
    const auto step = [&](const Input& input = {}) {
      walker.controller.step(walker.state, input, {-30 * up, frame, walker.movers, nullptr, up}, walker.scratch,
                             walker.report);
    };
    for (int i = 0; i < 60; ++i) step();
    ASSERT_TRUE(walker.state.grounded);
    const Vec2d rest = walker.state.position;
    for (int i = 0; i < 600; ++i) step();
    EXPECT_EQ(walker.state.position, rest) << "bit for bit";
    for (int i = 0; i < 30; ++i) step({.move = 1});
    EXPECT_TRUE(walker.state.grounded);
    EXPECT_NEAR(walker.state.velocity.dot(along), 6, 1e-9);
    EXPECT_NEAR(walker.state.velocity.dot(up), 0, 1e-9);
    step({.move = 1, .jump = true});
    EXPECT_NEAR(walker.state.velocity.dot(up), 12 - 30 * frame, 1e-9);
  }
}

TEST(Up, decides_how_fast_a_fall_may_be) {
  CharacterDef character;
  character.max_fall_speed = 5;
  Stepper<double> faller({rectangle(-9, -99, 9, -98)}, character);
  const Vec2d up{0.6, 0.8};
  for (int step = 0; step < 60; ++step) step_with(faller, up);
  EXPECT_NEAR(faller.state.velocity.dot(up), -5, 1e-12);
  EXPECT_NEAR(faller.state.velocity.dot(Vec2d{0.8, -0.6}), 0, 1e-12);
}

TEST(Up, decides_the_sides_of_questions) {
  const Stepper<double> stepper({rectangle(-9, -1, 9, 0)});
  Scratch<> scratch = stepper.controller.make_scratch();
  const auto side_below = [&](const Vec2d& up) {
    return stepper.controller.nearest({0, 1}, 2, {.up = up}, scratch)->side;
  };
  EXPECT_EQ(side_below({0, 1}), Side::bottom);
  EXPECT_EQ(side_below({0, -1}), Side::top);
  EXPECT_EQ(side_below({1, 0}), Side::right);
  EXPECT_EQ(side_below({-1, 0}), Side::left) << "its right is up in the world";
}

TEST(Up, of_a_crowd_turns_with_the_scene) {
  const auto turn = [](const Vec2d& v, int quarters) {
    Vec2d turned = v;
    for (int i = 0; i < quarters; ++i) turned = {-turned.y(), turned.x()};
    return turned;
  };
  CharacterDef square;
  square.shape = CharacterShape(std::vector<Vec2d>{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  std::vector<Together> scenes;
  for (int quarters = 0; quarters < 4; ++quarters) {
    std::vector<ColliderDef> walls = walls_of_a_box();
    walls.push_back(rectangle(-2, -5, 0, -3));
    for (ColliderDef& wall : walls)
      for (Vec2d& p : wall.points) p = turn(p, quarters);
    std::vector<Vec2d> starts{{-4, 0}, {-3.5, 2}, {1, 0}, {2.5, 1}, {-1, -1}, {-1.25, 3}};
    for (Vec2d& start : starts) start = turn(start, quarters);
    scenes.emplace_back(starts, walls, square);
  }
  int met = 0;
  for (int step = 0; step < 240; ++step) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      Together& scene = scenes[static_cast<std::size_t>(quarters)];
      for (std::size_t i = 0; i < scene.inputs.size(); ++i)
        scene.inputs[i] = {.move = (step / 40 + static_cast<int>(i)) % 3 - 1,
                           .jump = (step + 9 * static_cast<int>(i)) % 50 < 4};
      const Vec2d up = turn({0, 1}, quarters);
      ASSERT_EQ(
          scene.crowd.step(scene.states, scene.inputs, {-30 * up, frame, {}, nullptr, up}, scene.scratch, scene.report),
          StepStatus::moved);
      for (std::size_t i = 0; i < scene.states.size(); ++i) {
        ASSERT_EQ(scene.states[i].position, turn(scenes[0].states[i].position, quarters)) << step << ", " << i;
        const auto& contacts = scene.report.members[i].met;
        ASSERT_EQ(contacts.size(), scenes[0].report.members[i].met.size());
        for (std::size_t k = 0; k < contacts.size(); ++k)
          ASSERT_EQ(contacts[k].side, scenes[0].report.members[i].met[k].side);
        met += static_cast<int>(contacts.size());
      }
    }
  }
  EXPECT_GT(met, 100);
}

TEST(Teleport, keeps_velocity_and_button_and_forgets_the_place) {
  ColliderDef lift = rectangle(-3, -1, 3, 0);
  lift.mover = 0;
  CharacterDef character;
  character.coyote_time = 0.1;
  Stepper<double> rider({lift, rectangle(-1, 2, 1, 3), rectangle(40, -1, 50, 0)}, character);
  rider.at(0, half_height + 1e-3).steps(10);
  rider.step_with_mover_by(0.1, 0);
  ASSERT_NE(rider.state.ride.ground, no_collider);
  rider.state.jump_held = true;
  const Vec2d velocity = rider.state.velocity;
  teleport(rider.state, {45, 3});
  CharacterState<double> expected;
  expected.position = {45, 3};
  expected.velocity = velocity;
  expected.jump_held = true;
  EXPECT_EQ(rider.state, expected);
  EXPECT_NEAR(velocity.x(), 6, 1e-9) << "that of the lift";
  rider.step({.move = {}, .jump = true});
  EXPECT_FALSE(rider.state.jumping) << "no coyote time";
  EXPECT_NEAR(rider.state.velocity.x(), 6, 1e-9);
}

TEST(Teleport, into_a_solid_takes_the_shortest_way_out) {
  Stepper<double> walker({rectangle(-9, -1, 9, 0), rectangle(3, 0, 5, 9)});
  walker.at(0, half_height + 1e-3).steps(10);
  teleport(walker.state, {4.9, 4});  // from the last free position on the left the way would be longer
  walker.step();
  EXPECT_EQ(walker.report.status, StepStatus::moved);
  EXPECT_NEAR(walker.state.position.x(), 5 + half_width, 1e-6);
}

TEST(KnockBack, leaves_the_ground_and_what_carries) {
  ColliderDef lift = rectangle(-3, -1, 3, 0);
  lift.mover = 0;
  CharacterDef character;
  character.coyote_time = 0.1;
  character.snap = 0.5;
  character.jump_cut = 0.25;
  Stepper<double> rider({lift}, character);
  rider.gravity = {0, -30};
  rider.at(0, half_height + 1e-3).steps(10);
  rider.step_with_mover_by(0.05, 0);
  knock_back(rider.state, {1, 3});
  EXPECT_EQ(rider.state.ride.ground, no_collider);
  rider.step_with_mover_by(0.05, 0, {.move = {}, .jump = true});
  EXPECT_FALSE(rider.state.jumping) << "no jump in the air";
  EXPECT_FALSE(rider.state.grounded);
  EXPECT_NEAR(rider.state.velocity.x(), 1 + 0.05 / rider.dt, 1e-9) << "the lift's as well";
  EXPECT_NEAR(rider.state.velocity.y(), 3 - 30 * rider.dt, 1e-9);
  rider.step();
  EXPECT_NEAR(rider.state.velocity.y(), 3 - 60 * rider.dt, 1e-9) << "released, but that does not cut the rise";
}

TEST(Shape, may_change_between_steps) {
  CharacterDef tall;
  tall.shape = CharacterShape(std::vector<Vec2d>{{-0.3, -0.4}, {0.3, -0.4}, {0.3, 1.2}, {-0.3, 1.2}});
  CharacterDef low;
  low.shape = CharacterShape(std::vector<Vec2d>{{-0.3, -0.4}, {0.3, -0.4}, {0.3, 0.4}, {-0.3, 0.4}});
  // A lift that carries the character below a bar, and out again.
  ColliderDef lift = rectangle(-3, -1, 9, 0);
  lift.mover = 0;
  const Scenery<double> scenery(SceneryDef{{lift, rectangle(2, 1, 4, 2)}});
  const Controller<double> standing(scenery, tall);
  const Controller<double> crouching(scenery, low);
  Scratch<double> high = standing.make_scratch();
  Scratch<double> flat = crouching.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
  state.position = {0, 0.401};
  MoverMotion<double> motion;
  int crouched = 0;
  bool is_low = false;
  for (int step = 0; step < 120; ++step) {
    motion = {motion.to, motion.to + Vec2d{0.05, 0}};
    StepContext<double> context{{0, -30}, frame, std::span(&motion, 1)};
    is_low = state.position.x() > 1 && state.position.x() < 2.5;  // the button to crouch
    if (!is_low && standing.overlaps(state.position, context, high) != std::size_t{0}) is_low = true;
    if (is_low)
      crouching.step(state, {}, context, flat, report);
    else
      standing.step(state, {}, context, high, report);
    crouched += is_low;
    ASSERT_EQ(report.status, StepStatus::moved) << step;
    ASSERT_EQ(state.stuck_steps, 0);
    if (step < 2) continue;
    ASSERT_TRUE(state.grounded) << step;
    ASSERT_EQ(state.ride.ground, 0U) << step;
    ASSERT_FALSE(state.wall_left || state.wall_right) << step;
    ASSERT_EQ(state.last_free, state.position);
    ASSERT_NEAR(state.position.x(), 0.05 * (step + 1), 0.1);
  }
  EXPECT_GT(crouched, 60) << "also where the button is up, but the bar is above";
  EXPECT_FALSE(is_low) << "stands again";
}

}  // namespace
}  // namespace paperproof::stepping
