/// Characters against characters, where the answer is a formula.
#include "controller/together.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace paperproof {
namespace {

using namespace stepping;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

ColliderDef floor_at_zero() { return rectangle(-20, -1, 20, 0); }

/// Standing side by side.
Together on_floor(std::vector<double> at, const CharacterDef& character = {}) {
  std::vector<Vec2d> positions;
  for (const double x : at) positions.push_back({x, half_height + 5e-7});
  Together all(positions, {floor_at_zero()}, character);
  all.gravity = {0, -30};
  all.dt = 1.0 / 60;
  return all;
}

TEST(Crowd, head_on_they_meet_after_distance_over_the_sum_of_speeds) {
  for (const double v1 : {0.5, 3.0, 100.0}) {
    for (const double v2 : {0.25, 7.0, 1000.0}) {
      const double d = 0.4;
      Together two({{0, 0}, {2 * half_width + d, 0}});
      two.states[0].velocity = {v1, 0};
      two.states[1].velocity = {-v2, 0};
      ASSERT_EQ(two.step(), StepStatus::moved);
      ASSERT_EQ(two.report.members[0].met.size(), 1U);
      ASSERT_EQ(two.report.members[1].met.size(), 1U);
      const CrowdContact<double>& first = two.report.members[0].met[0];
      const CrowdContact<double>& second = two.report.members[1].met[0];
      EXPECT_NEAR(first.fraction, d / (v1 + v2), 1e-12);
      EXPECT_EQ(first.fraction, second.fraction);
      EXPECT_EQ(first.normal, Vec2d(-1, 0));
      EXPECT_EQ(second.normal, Vec2d(1, 0));
      EXPECT_EQ(first.side, Side::right);
      EXPECT_EQ(second.side, Side::left);
      EXPECT_EQ(first.other, 1U);
      EXPECT_EQ(second.other, 0U);
      EXPECT_NEAR(two.states[0].position.x(), v1 * d / (v1 + v2), 1e-6);
      EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
      EXPECT_EQ(two.states[0].velocity, Vec2d(0, 0));
      EXPECT_EQ(two.states[1].velocity, Vec2d(0, 0));
    }
  }
}

TEST(Crowd, of_three_in_a_row_the_nearer_two_meet_first) {
  const double d1 = 0.5;
  const double d2 = 0.3;
  const double v = 2;
  // The left one runs at the middle one, which stands; the right one comes at half the speed.
  Together three({{0, 0}, {2 * half_width + d1, 0}, {4 * half_width + d1 + d2, 0}});
  three.states[0].velocity = {v, 0};
  three.states[2].velocity = {-v / 2, 0};
  three.step();
  ASSERT_EQ(three.report.members[1].met.size(), 2U);
  EXPECT_EQ(three.report.members[1].met[0].other, 0U);
  EXPECT_NEAR(three.report.members[1].met[0].fraction, d1 / v, 1e-12);
  EXPECT_EQ(three.report.members[1].met[1].other, 2U);
  EXPECT_NEAR(three.report.members[1].met[1].fraction, d2 / (v / 2), 1e-12);
  EXPECT_EQ(three.states[1].position, Vec2d(2 * half_width + d1, 0)) << "neither pushes";
  EXPECT_TRUE(gap_of_a_contact(three.gap(0, 1)));
  EXPECT_TRUE(gap_of_a_contact(three.gap(1, 2)));
}

TEST(Crowd, the_second_impact_is_with_what_is_left_after_the_first) {
  // 0 catches up with 1 and goes on at its speed; together they come to 2, which stands.
  const double d1 = 0.5;
  const double d2 = 0.75;
  Together three({{0, 0}, {2 * half_width + d1, 0}, {4 * half_width + d1 + d2, 0}});
  three.states[0].velocity = {3, 0};
  three.states[1].velocity = {1, 0};
  three.step();
  EXPECT_NEAR(three.report.members[0].met[0].fraction, d1 / (3 - 1), 1e-12);
  EXPECT_NEAR(three.report.members[2].met[0].fraction, d2 / 1, 1e-12);
  EXPECT_NEAR(three.states[1].position.x(), 2 * half_width + d1 + d2, 1e-6);
  EXPECT_TRUE(gap_of_a_contact(three.gap(0, 1))) << three.gap(0, 1);
  EXPECT_TRUE(gap_of_a_contact(three.gap(1, 2))) << three.gap(1, 2);
  EXPECT_EQ(three.states[0].velocity, Vec2d(0, 0));
  EXPECT_EQ(three.states[1].velocity, Vec2d(0, 0));
}

TEST(Crowd, who_catches_up_keeps_the_speed_of_the_one_in_front) {
  Together two({{0, 0}, {1, 0}});
  two.states[0].velocity = {5, 0};
  two.states[1].velocity = {3, 0};
  two.step();
  EXPECT_EQ(two.states[1].position, Vec2d(4, 0)) << "as if it were alone";
  EXPECT_EQ(two.states[1].velocity, Vec2d(3, 0));
  EXPECT_NEAR(two.states[0].velocity.x(), 3, 1e-12);
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
}

TEST(Crowd, the_part_along_the_other_is_kept) {
  Together two({{0, 0}, {1, 0}});
  two.states[0].velocity = {5, 0.25};
  two.step();
  EXPECT_NEAR(two.states[0].position.y(), 0.25, 1e-15);
  EXPECT_EQ(two.states[0].velocity, Vec2d(0, 0.25));
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1)));
}

TEST(Crowd, who_moves_out_of_the_way_in_time_is_not_met) {
  // At half of the step the second is 2 half heights up, when the first would be 0.1 m short of it.
  Together two({{0, 0}, {2 * half_width + 1, 0}});
  two.states[0].velocity = {1.8, 0};
  two.states[1].velocity = {0, 4 * half_height};
  two.step();
  EXPECT_TRUE(two.report.members[0].met.empty());
  EXPECT_EQ(two.states[0].position, Vec2d(1.8, 0));
  EXPECT_EQ(two.states[1].position, Vec2d(2 * half_width + 1, 4 * half_height));
}

TEST(Crowd, two_bullets_do_not_pass_through_each_other) {
  Together two({{-1000, 0}, {1000, 0.01}});
  two.states[0].velocity = {1e5, 0};
  two.states[1].velocity = {-1e5, 0};
  two.step();
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
  EXPECT_NEAR(two.report.members[0].met[0].fraction, (2000 - 2 * half_width) / 2e5, 1e-12);
}

TEST(Crowd, whom_nobody_meets_moves_as_by_the_controller_bit_for_bit) {
  CharacterDef character;
  character.snap = 0.25;
  const std::vector<ColliderDef> level{floor_at_zero(), polygon({{2, -0.5}, {6, -0.5}, {6, 2}}),
                                       rectangle(-8, 0, -7, 9)};
  Together two({{0, 1}, {-5, 1}}, level, character);
  two.gravity = {0, -30};
  two.dt = 1.0 / 60;
  Stepper<double> alone(level, character);
  alone.gravity = two.gravity;
  alone.dt = two.dt;
  alone.at(0, 1);
  Stepper<double> other(level, character);
  other.gravity = two.gravity;
  other.dt = two.dt;
  other.at(-5, 1);
  for (int step = 0; step < 300; ++step) {
    two.inputs[0] = {.move = step % 100 < 70 ? 1 : 0.5, .jump = step % 50 > 40};
    two.inputs[1] = {.move = -1, .jump = step % 30 > 20};
    two.step();
    alone.step(two.inputs[0]);
    other.step(two.inputs[1]);
    ASSERT_TRUE(same_bits(two.states[0], alone.state)) << step;
    ASSERT_TRUE(same_bits(two.states[1], other.state)) << step;
  }
  EXPECT_EQ(two.report.impacts, 0U);
}

TEST(Crowd, what_jumps_onto_a_head_stands_on_it) {
  Together two = on_floor({0, 1.5});
  two.steps(5);
  two.inputs[0] = {.move = 1, .jump = true};
  bool landed = false;
  for (int step = 0; step < 120 && !landed; ++step) {
    if (two.states[0].position.x() > 1.45) two.inputs[0] = {.move = 0};
    two.step();
    landed = two.states[0].grounded && two.states[0].position.y() > 2 * half_height;
  }
  ASSERT_TRUE(landed);
  EXPECT_NEAR(two.states[0].position.y() - two.states[1].position.y(), 2 * half_height + 5e-7, 3e-7);
  EXPECT_FALSE(two.states[0].jumping);
  EXPECT_EQ(two.report.members[0].met[0].side, Side::bottom);
  EXPECT_EQ(two.report.members[1].met[0].side, Side::top);
  EXPECT_TRUE(two.states[1].grounded);

  two.inputs[0] = {.move = 0};
  two.steps(60);
  const Vec2d rest = two.states[0].position;
  for (int step = 0; step < 1000; ++step) {
    two.step();
    ASSERT_TRUE(same_bits(two.states[0].position, rest)) << step;
    ASSERT_TRUE(two.states[0].grounded) << step;
    ASSERT_TRUE(same_bits(two.states[0].velocity, Vec2d(0, 0))) << step;
  }
  two.inputs[0] = {.move = 0, .jump = true};
  two.step();
  EXPECT_GT(two.states[0].position.y(), rest.y() + 0.1) << "and jumps off it";
}

TEST(Crowd, standing_on_a_head_with_snap_is_not_pulled_through) {
  CharacterDef character;
  character.snap = 1;
  Together two({{0, half_height + 5e-7}, {0.1, 3 * half_height + 1e-3}}, {floor_at_zero()}, character);
  two.gravity = {0, -30};
  two.dt = 1.0 / 60;
  for (int step = 0; step < 300; ++step) {
    two.inputs[1] = {.move = (step + 2) % 8 < 4 ? 1 : -1};  // to and fro on the flat of the head
    two.step();
    ASSERT_TRUE(two.states[1].grounded || step == 0) << step;
    ASSERT_NEAR(two.states[1].position.y() - two.states[0].position.y(), 2 * half_height, 1.1e-3) << step;
    ASSERT_FALSE(two.report.members[1].stayed) << step;
  }
}

TEST(Crowd, two_that_press_against_each_other_at_rest_keep_their_bits) {
  Together two = on_floor({0, 1});
  two.inputs = {{.move = 1}, {.move = -1}};
  two.steps(60);
  const std::vector<CharacterState<double>> rest = two.states;
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
  for (int step = 0; step < 10000; ++step) {
    two.step();
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(same_bits(two.states[i], rest[i])) << step;
      ASSERT_TRUE(two.states[i].grounded) << step;
    }
  }
}

TEST(Crowd, a_queue_against_a_wall_comes_to_rest) {
  Together queue({{0, half_height + 5e-7}, {1, half_height + 5e-7}, {2, half_height + 5e-7}, {3, half_height + 5e-7}},
                 {floor_at_zero(), rectangle(5, 0, 6, 5)});
  queue.gravity = {0, -30};
  queue.dt = 1.0 / 60;
  for (Input& input : queue.inputs) input.move = 1;
  queue.steps(180);
  const std::vector<CharacterState<double>> rest = queue.states;
  queue.steps(1000);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(same_bits(queue.states[i], rest[i])) << i;
    EXPECT_TRUE(queue.states[i].grounded) << i;
    EXPECT_FALSE(queue.report.members[i].stayed) << i;
  }
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(gap_of_a_contact(queue.gap(i - 1, i))) << i;
}

TEST(Crowd, who_walks_into_another_stays_on_the_ground) {
  Together two = on_floor({0, 1});
  two.inputs = {{.move = 1}, {.move = 0}};
  for (int step = 0; step < 100; ++step) {
    two.step();
    ASSERT_TRUE(two.states[0].grounded) << step;
  }
  EXPECT_FALSE(two.report.members[0].met.empty());
  two.inputs[0].jump = true;
  two.step();
  EXPECT_GT(two.states[0].velocity.y(), 11);
}

/// The first is held between a wall and the second's shoulder; the second jumps from under it.
Together between_wall_and_shoulder() {
  Together two({{half_width + 5e-7, 1.4993281862229892}, {0.8128372159054997, half_height + 5e-7}},
               {floor_at_zero(), rectangle(-1, 0, 0, 9)});
  two.gravity = {0, -30};
  two.dt = 1.0 / 60;
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
  EXPECT_LE((two.states[1].position - Vec2d(0.8128372159054997, half_height + 5e-7) - kept / 60).norm(), 1e-12);
}

TEST(Crowd, scenery_that_turns_one_into_another_is_a_contact_although_nothing_moves) {
  Together two = between_wall_and_shoulder();
  two.inputs[1] = {.move = 0};
  two.inputs[0] = {.move = -1};
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

TEST(Crowd, exact_neighbours_fall_and_walk_together) {
  // Exactly touching, in pixels: no gap at all.
  Together two({{0, 1}, {20 * px, 1}}, {floor_at_zero()});
  two.gravity = {0, -30};
  two.dt = 1.0 / 60;
  two.step();
  EXPECT_NEAR(two.states[0].velocity.y(), -0.5, 1e-15);
  EXPECT_NEAR(two.states[1].velocity.y(), -0.5, 1e-15);
  EXPECT_TRUE(two.report.members[0].met.empty());
  two.steps(60);
  two.inputs = {{.move = -1}, {.move = 1}};
  two.steps(30);
  EXPECT_GT(two.gap(0, 1), 1);
}

TEST(Crowd, those_that_overlap_say_so_and_only_part) {
  Together two({{0, 0}, {0.3, 0}});
  two.states[0].velocity = {0.1, 0};
  two.step();
  ASSERT_EQ(two.report.members[0].started_overlapping.size(), 1U);
  EXPECT_EQ(two.report.members[0].started_overlapping[0], 1U);
  EXPECT_EQ(two.report.members[1].started_overlapping[0], 0U);
  EXPECT_EQ(two.states[0].position, Vec2d(0, 0)) << "no deeper";
  two.states[0].velocity = {-1, 0};
  two.step();
  EXPECT_EQ(two.states[0].position, Vec2d(-1, 0)) << "but out";
  two.step();
  EXPECT_TRUE(two.report.members[0].started_overlapping.empty());
}

TEST(Crowd, the_order_in_which_they_are_given_makes_no_difference_where_times_differ) {
  const auto run = [](bool turned) {
    std::vector<Vec2d> at{{0, 1}, {1.3, 2}, {2.1, 0.7}, {3.4, 1.1}};
    std::vector<double> wanted{1, -1, 0.3, -0.7};
    if (turned) {
      std::reverse(at.begin(), at.end());
      std::reverse(wanted.begin(), wanted.end());
    }
    Together all(at, {floor_at_zero()});
    all.gravity = {0, -30};
    all.dt = 1.0 / 60;
    for (std::size_t i = 0; i < 4; ++i) all.inputs[i].move = wanted[i];
    all.steps(40);
    if (turned) std::reverse(all.states.begin(), all.states.end());
    return all.states;
  };
  const auto one = run(false);
  const auto other = run(true);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR((one[i].position - other[i].position).norm(), 0, 1e-9) << i;
}

TEST(Crowd, an_input_that_is_refused_changes_nothing_for_anybody) {
  const auto refused = [](auto spoil, StepStatus expected) {
    Together three({{0, 1}, {2, 1}, {4, 1}});
    three.states[0].velocity = {1, 1};
    spoil(three);
    const std::vector<CharacterState<double>> before = three.states;
    EXPECT_EQ(three.step(), expected);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(three.states[i], before[i]));
  };
  const StepStatus invalid = StepStatus::invalid_input;
  refused([](Together& t) { t.states[2].position.x() = nan; }, invalid);
  refused([](Together& t) { t.states[1].velocity.y() = infinite; }, invalid);
  refused([](Together& t) { t.inputs[2].move = nan; }, invalid);
  refused([](Together& t) { t.inputs[2].move = infinite; }, invalid);
  refused([](Together& t) { t.gravity.y() = -infinite; }, invalid);
  refused([](Together& t) { t.dt = 0; }, invalid);
  refused([](Together& t) { t.dt = nan; }, invalid);
  refused([](Together& t) { t.inputs.pop_back(); }, invalid);
  refused([](Together& t) { t.states[1].ride.ground = 0; }, invalid);
  refused([](Together& t) { t.scratch = t.crowd.make_scratch(2); }, invalid);
  refused([](Together& t) { t.report = CrowdReport<double>(2); }, invalid);
  refused([](Together& t) { t.states[1].velocity = {3e6, 0}; }, StepStatus::out_of_range);
}

TEST(Crowd, a_stage_that_is_left_out_is_not_asked_for) {
  Together still({{0, 1}}, {}, {}, {.stages = {.jump = false, .gravity = false}});
  EXPECT_EQ(still.step(), StepStatus::moved);
  still.gravity = {0, -1};
  EXPECT_EQ(still.step(), StepStatus::invalid_input);
  still.gravity = {0, 0};
  still.inputs[0].jump = true;
  EXPECT_EQ(still.step(), StepStatus::invalid_input);
}

TEST(Crowd, another_technique_is_refused) {
  EXPECT_THROW(Together({{0, 5}}, {}, {}, {.kind = TechniqueKind::discrete}), std::invalid_argument);
}

TEST(Crowd, a_step_allocates_nothing) {
  std::vector<Vec2d> at;
  for (int i = 0; i < 12; ++i) at.push_back({i * 0.7, half_height + 0.2 * (i % 3)});
  Together all(at, {floor_at_zero()});
  all.gravity = {0, -30};
  all.dt = 1.0 / 60;
  std::size_t impacts = 0;
  const std::size_t before = tests::allocations();
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < all.inputs.size(); ++i)
      all.inputs[i] = {.move = i % 2 == 0 ? 1 : -1, .jump = step % 40 == static_cast<int>(i)};
    all.step();
    impacts += all.report.impacts;
  }
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_GT(impacts, 100U);
}

TEST(Crowd, nobody_is_a_crowd_too) {
  Together none({});
  EXPECT_EQ(none.step(), StepStatus::moved);
}

TEST(Crowd, floats_keep_apart_as_well) {
  const Scenery<float> scenery(SceneryDef{{floor_at_zero()}});
  const Crowd<float> crowd(scenery, {});
  CrowdScratch scratch = crowd.make_scratch(2);
  CrowdReport<float> report(2);
  std::vector<CharacterState<float>> states(2);
  states[0].position = {0, 1};
  states[1].position = {2, 1};
  const std::vector<Input> inputs{{.move = 1}, {.move = -1}};
  for (int step = 0; step < 120; ++step) crowd.step(states, inputs, {0, -30}, 1.0F / 60, scratch, report);
  const float gap = states[1].position.x() - states[0].position.x() - static_cast<float>(2 * half_width);
  EXPECT_GT(gap, 0);
  EXPECT_LT(gap, 1e-3F);
}

}  // namespace
}  // namespace paperproof
