/// Characters that stand on, lean against and press each other.
#include "controller/together.hpp"

#include <gtest/gtest.h>

namespace paperproof {
namespace {

using namespace stepping;
using compare::box;

TEST(Crowd, what_stands_on_a_head_rests_and_jumps_off_it) {
  Together two = under_gravity({{0, half_height + rest_gap}, {0.1, 3 * half_height + 0.05}}, {floor_at_zero()});
  two.inputs = {{.move = 0}, {.move = 0}};
  two.steps(60);
  EXPECT_NEAR(two.states[1].position.y() - two.states[0].position.y(), 2 * half_height + rest_gap, 3e-7);
  EXPECT_EQ(two.report.members[1].met[0].side, Side::bottom);
  EXPECT_EQ(two.report.members[0].met[0].side, Side::top);
  const Vec2d rest = two.states[1].position;
  for (int step = 0; step < 1000; ++step) {
    two.step();
    ASSERT_TRUE(same_bits(two.states[1].position, rest)) << step;
    ASSERT_TRUE(two.states[0].grounded && two.states[1].grounded) << step;
    ASSERT_TRUE(same_bits(two.states[1].velocity, Vec2d(0, 0))) << step;
  }
  two.inputs[1].jump = true;
  two.step();
  EXPECT_GT(two.states[1].position.y(), rest.y() + 0.1);
}

TEST(Crowd, standing_on_a_head_with_snap_is_not_pulled_through) {
  CharacterDef character;
  character.snap = 1;
  Together two =
      under_gravity({{0, half_height + rest_gap}, {0.1, 3 * half_height + 1e-3}}, {floor_at_zero()}, character);
  for (int step = 0; step < 300; ++step) {
    two.inputs[1] = {.move = (step + 2) % 8 < 4 ? 1 : -1};  // to and fro on the flat of the head
    two.step();
    ASSERT_TRUE(two.states[1].grounded || step == 0) << step;
    ASSERT_NEAR(two.states[1].position.y() - two.states[0].position.y(), 2 * half_height, 1.1e-3) << step;
    ASSERT_FALSE(two.report.members[1].stayed) << step;
    ASSERT_EQ(two.report.members[0].step.move.ground.collider, ColliderIndex{0}) << step;
    ASSERT_EQ(two.report.members[1].step.move.ground.collider, no_collider) << "a character is no collider";
  }
}

TEST(Crowd, those_that_press_against_each_other_or_in_a_queue_against_a_wall_keep_their_bits) {
  Together two = standing({0, 1});
  two.inputs = {{.move = 1}, {.move = -1}};
  Together queue = standing({0, 1, 2, 3}, {floor_at_zero(), box(5, 0, 6, 5)});
  for (Input& input : queue.inputs) input.move = 1;
  for (Together* all : {&two, &queue}) {
    all->steps(180);
    const std::vector<CharacterState<double>> rest = all->states;
    for (int step = 0; step < 3000; ++step) {
      all->step();
      for (std::size_t i = 0; i < rest.size(); ++i) {
        ASSERT_TRUE(same_bits(all->states[i], rest[i])) << i << " in step " << step;
        ASSERT_TRUE(all->states[i].grounded && !all->report.members[i].stayed) << i << " in step " << step;
      }
    }
    for (std::size_t i = 1; i < rest.size(); ++i) EXPECT_TRUE(gap_of_a_contact(all->gap(i - 1, i))) << i;
    all->inputs[0].jump = true;
    all->step();
    EXPECT_GT(all->states[0].velocity.y(), 11) << "who walks into another may jump";
  }
}

/// The first is held between a wall and the second's shoulder; the second jumps from under it.
Together between_wall_and_shoulder() {
  Together two =
      under_gravity({{half_width + rest_gap, 1.4993281862229892}, {0.8128372159054997, half_height + rest_gap}},
                    {floor_at_zero(), box(-1, 0, 0, 9)});
  two.states[0].grounded = two.states[1].grounded = true;
  two.inputs = {{.move = 0}, {.move = 1, .jump = true}};
  return two;
}

TEST(Crowd, who_goes_along_another_is_not_halted_by_rounding) {
  Together two = between_wall_and_shoulder();
  two.step();
  // It wants (1, 11.5) m/s, and keeps what is along the facet with the normal (2, -1).
  const Vec2d wanted(1, 11.5);
  const Vec2d facet = Vec2d(1, 2) / std::sqrt(5.0);
  const Vec2d kept = facet * facet.dot(wanted);
  EXPECT_LE((two.states[1].velocity - kept).norm(), 1e-12);
  EXPECT_LE((two.states[1].position - Vec2d(0.8128372159054997, half_height + rest_gap) - kept / 60).norm(), 1e-12);
}

TEST(Crowd, scenery_that_turns_one_into_another_is_a_contact_although_nothing_moves) {
  Together two = between_wall_and_shoulder();
  two.inputs = {{.move = -1}, {.move = 0}};
  for (int step = 0; step < 3; ++step) {
    two.step();
    const auto& contacts = two.report.members[0].step.move.contacts;
    ASSERT_EQ(contacts.size(), 1U) << step;
    EXPECT_EQ(contacts[0].collider, 1U);
    EXPECT_EQ(contacts[0].side, Side::left);
    EXPECT_TRUE(gap_of_a_contact(contacts[0].separation));
    EXPECT_TRUE(two.states[0].wall_left);
    EXPECT_TRUE(two.states[0].grounded);
  }
}

}  // namespace
}  // namespace paperproof
