/// What a step is given beside state and input: filters; and a step of a game that owns its velocities.
#include "controller/stepping.hpp"
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace paperproof::stepping {
namespace {

constexpr double frame = 1.0 / 60;

TEST(Filter, has_the_rule_of_box2d) {
  EXPECT_TRUE(collide({}, {}));
  EXPECT_FALSE(collide({.mask = 2}, {}));
  EXPECT_FALSE(collide({}, {.mask = 2}));
  EXPECT_TRUE(collide({.category = 2, .mask = 4}, {.category = 4, .mask = 2}));
  EXPECT_FALSE(collide({.category = 2, .mask = 4}, {.category = 4, .mask = 1}));
  EXPECT_FALSE(collide({.group = -3}, {.group = -3})) << "one negative group";
  EXPECT_TRUE(collide({.mask = 0, .group = 3}, {.mask = 0, .group = 3})) << "one positive group";
  EXPECT_TRUE(collide({.group = -3}, {.group = -4})) << "of other groups";
}

/// A floor that only category 2 sees, above one that everybody sees.
Stepper<double> above_two_floors() {
  ColliderDef upper = rectangle(-9, 1, 9, 2);
  upper.filter = {.category = 1, .mask = 2};
  Stepper<double> stepper({rectangle(-9, -1, 9, 0), upper});
  stepper.gravity = {0, -30};
  stepper.at(0, 4);
  return stepper;
}

TEST(Filter, leaves_out_what_does_not_collide) {
  ColliderFilter heavy;
  heavy.category = 2;
  for (const ColliderFilter* filter : {static_cast<const ColliderFilter*>(nullptr), &std::as_const(heavy)}) {
    Stepper<double> faller = above_two_floors();
    for (int step = 0; step < 120; ++step)
      faller.controller.step(faller.state, {}, {{0, -30}, frame, {}, filter}, faller.scratch, faller.report);
    ASSERT_TRUE(faller.state.grounded);
    EXPECT_NEAR(faller.state.position.y(), half_height + (filter == nullptr ? 0 : 2), 1e-6);
    EXPECT_EQ(faller.report.move.ground.collider, filter == nullptr ? ColliderIndex{0} : ColliderIndex{1});
  }
}

TEST(Filter, of_a_step_is_forgotten_in_the_next) {
  Stepper<double> faller = above_two_floors();
  ColliderFilter heavy;
  heavy.category = 2;
  const StepContext<double> with_filter{{0, -30}, frame, {}, &heavy};
  for (int step = 0; step < 120; ++step)
    faller.controller.step(faller.state, {}, with_filter, faller.scratch, faller.report);
  ASSERT_NEAR(faller.state.position.y(), half_height + 2, 1e-6);
  faller.steps(120);
  EXPECT_NEAR(faller.state.position.y(), half_height, 1e-6);
}

TEST(Filter, asks_a_predicate_for_movers_and_sensors_too) {
  ColliderDef lift = rectangle(-1, -0.2, 1, 0);
  lift.mover = 0;
  ColliderDef coin = rectangle(-0.1, 1, 0.1, 1.2);
  coin.sensor = true;
  struct Gone {
    ColliderIndex collider;
  };
  ColliderFilter filter;
  filter.is_there = [](ColliderIndex collider, const void* user) {
    return collider != static_cast<const Gone*>(user)->collider;
  };
  for (const ColliderIndex gone : {no_collider, ColliderIndex{0}, ColliderIndex{1}}) {
    const Gone user{gone};
    filter.user = &user;
    Stepper<double> faller({lift, coin});
    faller.at(0, 2);
    int events = 0;
    for (int step = 0; step < 60; ++step) {
      faller.controller.step(faller.state, {}, {{0, -10}, frame, faller.movers, &filter}, faller.scratch,
                             faller.report);
      events += static_cast<int>(faller.report.sensors.size());
    }
    EXPECT_EQ(faller.state.grounded, gone != 0) << gone;
    EXPECT_EQ(events, gone == 1 ? 0 : gone == 0 ? 2 : 1) << gone;
  }
}

TEST(Filter, with_a_predicate_leaves_nothing_in_the_scratch) {
  Stepper<double> standing({rectangle(-9, -1, 9, 0)});
  standing.at(0, half_height + 1e-3).steps(20);
  ASSERT_TRUE(standing.state.grounded);
  ColliderFilter nothing;
  nothing.is_there = [](ColliderIndex /*collider*/, const void* /*user*/) { return false; };
  const ColliderFilter plain;
  CharacterState<double> ghost = standing.state;
  for (const ColliderFilter* filter : {&plain, static_cast<const ColliderFilter*>(nullptr)}) {
    standing.controller.step(ghost, {}, {{0, -30}, frame, {}, &nothing}, standing.scratch, standing.report);
    const Vec2d before = standing.state.position;
    standing.controller.step(standing.state, {}, {{0, -30}, frame, {}, filter}, standing.scratch, standing.report);
    EXPECT_EQ(standing.state.position, before);
    EXPECT_EQ(standing.controller.overlaps({0, 0}, {.filter = &nothing}, standing.scratch), 0U);
    EXPECT_EQ(standing.controller.overlaps({0, 0}, {.filter = filter}, standing.scratch), 1U);
  }
}

TEST(Filter, leaves_room_for_the_events_of_what_is_there) {
  std::vector<ColliderDef> many;
  for (int i = 0; i < 80; ++i) {
    many.push_back(rectangle(1 + 0.01 * i, -1, 1.005 + 0.01 * i, 1));
    many.back().sensor = true;
    many.back().filter.category = 2;
  }
  many.push_back(rectangle(3, -1, 3.5, 1));
  many.back().sensor = true;
  Stepper<double> flyer(many);
  ColliderFilter light;
  light.mask = 1;
  flyer.controller.move(flyer.state, {6, 0}, {{}, 1, {}, &light}, flyer.scratch, flyer.report);
  EXPECT_EQ(flyer.report.sensors.size(), 2U);
  EXPECT_FALSE(flyer.report.sensors.overflowed());
}

TEST(Filter, that_a_technique_does_not_have_is_refused) {
  ColliderDef floor = rectangle(-9, -1, 9, 0);
  const ColliderFilter ghost{{.category = 2}};
  Stepper<double> boxed({floor}, {}, "bounding_box");
  EXPECT_EQ(boxed.controller.step(boxed.state, {}, {{0, -10}, frame, {}, &ghost}, boxed.scratch, boxed.report),
            StepStatus::invalid_input);
  floor.filter.mask = 2;
  EXPECT_THROW(Stepper<double>({floor}, {}, "bounding_box"), std::invalid_argument);
}

TEST(Filter, of_a_crowd_leaves_the_others_there) {
  ColliderDef wall = rectangle(1, 0, 2, 4);
  wall.filter.mask = 2;
  Together two = standing({-1, 3}, {floor_at_zero(), wall});
  two.inputs = {{.move = 1}, {}};
  const ColliderFilter nothing_else{{.category = 4, .mask = 1}};
  for (int step = 0; step < 120; ++step)
    two.crowd.step(two.states, two.inputs, {two.gravity, two.dt, two.movers, &nothing_else}, two.scratch, two.report);
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << "through the wall, up to the other: " << two.gap(0, 1);
}

TEST(Move, goes_by_its_displacement_and_slides) {
  Stepper<double> stepper({rectangle(-9, -1, 9, 0), rectangle(2, 0, 3, 5)});
  stepper.at(0, half_height + 1);
  const StepContext<double> context{.gravity = {0, -99}, .dt = frame};
  EXPECT_EQ(stepper.controller.move(stepper.state, {0.25, -0.5}, context, stepper.scratch, stepper.report),
            StepStatus::moved);
  EXPECT_EQ(stepper.state.position, Vec2d(0.25, half_height + 0.5)) << "no gravity is added";
  EXPECT_EQ(stepper.state.velocity, Vec2d(0.25, -0.5) / frame);
  stepper.controller.move(stepper.state, {4, -1}, context, stepper.scratch, stepper.report);
  EXPECT_NEAR(stepper.state.position.x(), 2 - half_width, 1e-6);
  EXPECT_NEAR(stepper.state.position.y(), half_height, 1e-6);
  EXPECT_EQ(stepper.state.velocity, Vec2d(0, 0));
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_EQ(stepper.report.move.contacts.size(), 2U);
}

TEST(Move, is_carried_in_the_same_step) {
  ColliderDef lift = rectangle(-3, -1, 3, 0);
  lift.mover = 0;
  Stepper<double> rider({lift});
  rider.at(0, half_height + 1e-3).steps(10);
  ASSERT_TRUE(rider.state.grounded);
  const Vec2d before = rider.state.position;
  rider.movers[0] = {{0, 0}, {0.5, 0.25}};
  rider.controller.move(rider.state, {0.125, 0}, {{}, frame, rider.movers}, rider.scratch, rider.report);
  EXPECT_NEAR(rider.state.position.x(), before.x() + 0.625, 1e-12);
  EXPECT_NEAR(rider.state.position.y(), before.y() + 0.25, 1e-12);
}

TEST(Move, lets_the_time_of_a_jump_pass) {
  CharacterDef character;
  character.coyote_time = 0.1;
  character.jump_buffer = 0.1;
  Stepper<double> climber({rectangle(-9, -1, 9, 0)}, character);
  climber.at(0, half_height + 1e-3).steps(5);
  for (int step = 0; step < 60; ++step)
    climber.controller.move(climber.state, {0.01, 0.1}, {{}, frame}, climber.scratch, climber.report);
  EXPECT_EQ(climber.state.coyote_left, 0);
  climber.step({.move = {}, .jump = true});
  EXPECT_FALSE(climber.state.jumping) << "in the air";
  climber.step();
  EXPECT_TRUE(climber.state.jump_pending);
  for (int step = 0; step < 10; ++step)
    climber.controller.move(climber.state, {0, 0}, {{}, frame}, climber.scratch, climber.report);
  EXPECT_FALSE(climber.state.jump_pending);
}

TEST(Move, refuses_what_a_step_refuses_and_changes_nothing) {
  Stepper<double> stepper({rectangle(-9, -1, 9, 0)});
  stepper.at(0, 3);
  const CharacterState<double> before = stepper.state;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto move = [&](const Vec2d& displacement, double dt) {
    return stepper.controller.move(stepper.state, displacement, {{}, dt}, stepper.scratch, stepper.report);
  };
  EXPECT_EQ(move({nan, 0}, frame), StepStatus::invalid_input);
  EXPECT_EQ(move({1, 0}, 0), StepStatus::invalid_input);
  EXPECT_EQ(move({1e300, 0}, 1e-300), StepStatus::invalid_input) << "no finite velocity";
  EXPECT_EQ(move({3e6, 0}, frame), StepStatus::out_of_range);
  EXPECT_EQ(stepper.state, before);
  for (double CharacterState<>::*left : {&CharacterState<>::coyote_left, &CharacterState<>::pending_left}) {
    stepper.state.*left = nan;
    EXPECT_EQ(move({0, 0}, frame), StepStatus::invalid_input);
    stepper.state.*left = 0;
  }
}

TEST(Query, tells_whether_a_taller_shape_fits) {
  CharacterDef tall;
  tall.shape = CharacterShape(std::vector<Vec2d>{{-0.3, -0.6}, {0.3, -0.6}, {0.3, 1.2}, {-0.3, 1.2}});
  const Scenery scenery(SceneryDef{{rectangle(-9, -1, 9, 0), rectangle(2, 1.5, 5, 2)}});
  const Controller standing(scenery, tall);
  Scratch<> scratch = standing.make_scratch();
  std::array<ColliderIndex, 4> found{};
  EXPECT_EQ(standing.overlaps({0, 0.7}, {}, scratch), 0U);
  EXPECT_EQ(standing.overlaps({3, 0.7}, {}, scratch, found), 1U);
  EXPECT_EQ(found[0], 1U);
  EXPECT_EQ(standing.overlaps({3, 0.5}, {}, scratch), 2U);
}

TEST(Query, finds_the_tiles_that_it_is_deep_inside_of) {
  const Scenery scenery(SceneryDef{{rectangle(0, -5, 1, 1), rectangle(1, -5, 2, 1)}});
  const Controller controller(scenery, CharacterDef{});
  Scratch<> scratch = controller.make_scratch();
  std::array<Contact<>, 8> found;
  EXPECT_EQ(controller.overlaps({1, -2}, {}, scratch), 2U);
  EXPECT_EQ(controller.contacts_at({1, -2}, 0.5, {}, scratch, found), 2U);
  EXPECT_LT(found[0].separation, 0);
}

TEST(Query, leaves_nothing_in_the_scratch) {
  Stepper<double> walker({rectangle(-9, -1, 9, 0)});
  walker.at(0, half_height + 1e-3).steps(5);
  std::array<Contact<>, 8> found;
  EXPECT_EQ(walker.controller.contacts_at({0, 5}, 1e5, {}, walker.scratch, found), 1U);
  EXPECT_FALSE(walker.scratch.solids.valid) << "a wide question would make the next steps slow";
}

TEST(Query, finds_nothing_where_it_may_not_be_asked) {
  const Scenery scenery(SceneryDef{{rectangle(-9, -1, 9, 0)}});
  const Controller controller(scenery, CharacterDef{});
  const Controller other(scenery, CharacterDef{});
  Scratch<> own = controller.make_scratch();
  Scratch<> foreign = other.make_scratch();
  EXPECT_TRUE(controller.cast({0, 2}, {0, -5}, {}, own));
  EXPECT_FALSE(controller.cast({0, 2}, {0, -5}, {}, foreign));
  EXPECT_FALSE(controller.cast({0, std::numeric_limits<double>::infinity()}, {0, -5}, {}, own));
  EXPECT_FALSE(controller.cast({0, 2}, {0, -5e6}, {}, own));
  const std::vector<MoverMotion<>> one(1);
  EXPECT_FALSE(controller.cast({0, 2}, {0, -5}, {.movers = one}, own)) << "the scenery has no mover";
  EXPECT_FALSE(controller.overlaps({0, 0}, {.movers = one}, own));
  EXPECT_FALSE(controller.overlaps({0, std::numeric_limits<double>::quiet_NaN()}, {}, own));
  EXPECT_FALSE(controller.nearest({0, 2}, 1, {}, own)) << "nothing is that near";
  EXPECT_NEAR(controller.nearest({0, 2}, 2, {}, own)->separation, 2 - half_height, 1e-12);
}

}  // namespace
}  // namespace paperproof::stepping
