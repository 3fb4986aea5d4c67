/// What a step is given beside state and input: filters; a step of a game that owns its velocities; and questions.
#include "campaign/shapes.hpp"
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace paperproof::stepping {
namespace {

const ColliderDef ground = box(-9, -1, 9, 0);

// That two filters collide as Box2D says is in tests/box2d_adapter/world_scenery_test.cpp.

TEST(Filter, with_a_predicate_leaves_nothing_in_the_scratch) {
  Stepper standing({ground});
  standing.at(0, half_height + 1e-3).steps(20);
  ColliderFilter nothing;
  nothing.is_there = [](ColliderIndex /*collider*/, const void* /*user*/) { return false; };
  const CharacterState before = standing.state;
  standing.filter = &nothing;
  standing.step();
  EXPECT_EQ(standing.sweep().overlaps({0, 0}, standing.context(), standing.scratch), 0U);
  standing.state = before;
  standing.filter = nullptr;
  standing.step();
  EXPECT_EQ(standing.state.position, before.position);
  EXPECT_EQ(standing.sweep().overlaps({0, 0}, {}, standing.scratch), 1U);
}

TEST(Filter, leaves_room_for_the_events_of_what_is_there) {
  std::vector<ColliderDef> many;
  for (int i = 0; i < 81; ++i) {
    many.push_back(box(1 + 0.01 * i, -1, 1.005 + 0.01 * i, 1));
    many.back().sensor = true;
    many.back().filter.category = i < 80 ? 2 : 1;
  }
  Stepper flyer(many);
  ColliderFilter light;
  light.mask = 1;
  flyer.sweep().move(flyer.state, {6, 0}, {{}, 1, {}, &light}, flyer.scratch, flyer.report);
  EXPECT_EQ(flyer.report.sensors.size(), 2U);
}

TEST(Filter, that_a_technique_does_not_have_is_refused) {
  const ColliderFilter ghost{{.category = 2}};
  Stepper boxed({ground}, {}, "bounding_box");
  boxed.filter = &ghost;
  EXPECT_EQ(boxed.step(), StepStatus::invalid_input);
  ColliderDef filtered = ground;
  filtered.filter.mask = 2;
  EXPECT_THROW(Stepper({filtered}, {}, "bounding_box"), std::invalid_argument);
}

StepStatus move(Stepper& stepper, const Vec2d& displacement, double dt = frame) {
  return stepper.sweep().move(stepper.state, displacement, {{0, -99}, dt, stepper.movers}, stepper.scratch,
                              stepper.report);
}

TEST(Move, goes_by_its_displacement_and_slides) {
  Stepper stepper({ground, box(2, 0, 3, 5)});
  stepper.at(0, half_height + 1);
  EXPECT_EQ(move(stepper, {0.25, -0.5}), StepStatus::moved);
  EXPECT_EQ(stepper.state.position, Vec2d(0.25, half_height + 0.5)) << "no gravity is added";
  EXPECT_EQ(stepper.state.velocity, Vec2d(0.25, -0.5) / frame);
  move(stepper, {4, -1});
  EXPECT_NEAR(stepper.state.position.x(), 2 - half_width, 1e-6);
  EXPECT_NEAR(stepper.state.position.y(), half_height, 1e-6);
  EXPECT_EQ(stepper.state.velocity, Vec2d(0, 0));
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_EQ(stepper.report.move.contacts.size(), 2U);
}

TEST(Move, is_carried_in_the_same_step) {
  Stepper rider({box(-3, -1, 3, 0, 0)});
  rider.at(0, half_height + 1e-3).steps(10);
  ASSERT_TRUE(rider.state.grounded);
  const Vec2d before = rider.state.position;
  rider.movers[0] = {{0, 0}, {0.5, 0.25}};
  move(rider, {0.125, 0});
  EXPECT_NEAR(rider.state.position.x(), before.x() + 0.625, 1e-12);
  EXPECT_NEAR(rider.state.position.y(), before.y() + 0.25, 1e-12);
}

TEST(Move, lets_the_time_of_a_jump_pass) {
  Stepper climber({ground}, {.coyote_time = 0.1, .jump_buffer = 0.1});
  climber.at(0, half_height + 1e-3).steps(5);
  for (int step = 0; step < 60; ++step) move(climber, {0.01, 0.1});
  EXPECT_EQ(climber.state.coyote_left, 0);
  climber.step({.jump = true});
  EXPECT_FALSE(climber.state.jumping) << "in the air";
  climber.step();
  EXPECT_TRUE(climber.state.jump_pending);
  for (int step = 0; step < 10; ++step) move(climber, {0, 0});
  EXPECT_FALSE(climber.state.jump_pending);
}

TEST(Move, refuses_what_a_step_refuses_and_changes_nothing) {
  Stepper stepper({ground});
  stepper.at(0, 3);
  const CharacterState before = stepper.state;
  EXPECT_EQ(move(stepper, {nan, 0}), StepStatus::invalid_input);
  EXPECT_EQ(move(stepper, {1, 0}, 0), StepStatus::invalid_input);
  EXPECT_EQ(move(stepper, {1e300, 0}, 1e-300), StepStatus::invalid_input) << "no finite velocity";
  EXPECT_EQ(move(stepper, {3e6, 0}), StepStatus::out_of_range);
  EXPECT_EQ(stepper.state, before);
  for (double CharacterState::*left : {&CharacterState::coyote_left, &CharacterState::pending_left}) {
    stepper.state.*left = nan;
    EXPECT_EQ(move(stepper, {0, 0}), StepStatus::invalid_input);
    stepper.state.*left = 0;
  }
}

// What it finds: see query_test.
TEST(Query, finds_nothing_where_it_may_not_be_asked) {
  const Stepper asked({ground});
  const Controller& controller = asked.sweep();
  Scratch own = controller.make_scratch();
  Scratch foreign = Stepper({ground}).scratch;
  ColliderDef moving = ground;
  moving.mover = 0;
  const Stepper with_mover({moving});
  Scratch of_other = with_mover.sweep().make_scratch();
  EXPECT_TRUE(controller.cast({0, 2}, {0, -5}, {}, own));
  EXPECT_FALSE(controller.cast({0, 2}, {0, -5}, {}, foreign));
  EXPECT_FALSE(controller.cast({0, infinity}, {0, -5}, {}, own));
  EXPECT_FALSE(controller.cast({0, 2}, {0, -5e6}, {}, own));
  EXPECT_FALSE(with_mover.sweep().cast({0, 2}, {0, -5}, {}, of_other));
  EXPECT_FALSE(with_mover.sweep().overlaps({0, 0}, {}, of_other));
  EXPECT_FALSE(controller.overlaps({0, nan}, {}, own));
  EXPECT_FALSE(controller.nearest({0, 2}, 1, {}, own)) << "nothing is that near";
  EXPECT_NEAR(controller.nearest({0, 2}, 2, {}, own)->separation, 2 - half_height, 1e-12);
}

TEST(PeersSituation, a_wall_is_still_found_without_a_key) {
  Stepper idle({box(-9, -1, 9, 0), box(1, 0, 2, 4)});
  idle.at(0, half_height + 5e-7).steps(60, {.move = 1});
  ASSERT_TRUE(idle.state.wall_right);
  idle.steps(60, {.move = 0});
  EXPECT_FALSE(idle.state.wall_right) << "nothing was wanted to the right";
  std::array<Contact, 4> found;
  const std::size_t count = idle.sweep().contacts_at(idle.state.position, 1e-6, {.dt = idle.dt}, idle.scratch, found);
  EXPECT_GT(std::ranges::count(std::span(found).first(count), Side::right, &Contact::side), 0);
}

TEST(ContactsAt, have_no_normal_of_a_seam_beside_the_foot) {
  Stepper stepper({box(-1, -1, 0, 0), box(0, -1, 1, 0)});
  std::array<Contact, 4> found;
  // Of the tile to the left its side is farther away than its top.
  const Vec2d at(5 * px + 5e-7, half_height + 1e-7);
  const std::size_t count = stepper.sweep().contacts_at(at, 1e-6, {.dt = stepper.dt}, stepper.scratch, found);
  ASSERT_EQ(count, 1U);
  EXPECT_EQ(found[0].normal, Vec2d(0, 1));
}

}  // namespace
}  // namespace paperproof::stepping
