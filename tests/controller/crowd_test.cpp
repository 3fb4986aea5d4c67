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
  Together two = under_gravity({{0, 1}, {-5, 1}}, level, character);
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

TEST(Crowd, those_that_overlap_say_so_and_part) {
  Together two({{0, 0}, {0.3, 0}});
  two.step();
  ASSERT_EQ(two.report.members[0].started_overlapping.size(), 1U);
  EXPECT_EQ(two.report.members[0].started_overlapping[0], 1U);
  EXPECT_EQ(two.report.members[1].started_overlapping[0], 0U);
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << "by the shortest way, sideways: " << two.gap(0, 1);
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
    Together all = under_gravity(at, {floor_at_zero()});
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

TEST(Crowd, a_technique_that_knows_one_character_is_refused) {
  for (const std::string_view kind : technique_names()) {
    if (find_technique(kind)->moves_crowds) continue;
    EXPECT_THROW(Together({{0, 5}}, {}, {}, {.name = kind}), std::invalid_argument) << kind;
  }
}

TEST(Crowd, a_step_allocates_nothing) {
  std::vector<Vec2d> at;
  for (int i = 0; i < 12; ++i) at.push_back({i * 0.7, half_height + 0.2 * (i % 3)});
  Together all = under_gravity(at, {floor_at_zero()});
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
  for (int step = 0; step < 120; ++step) crowd.step(states, inputs, {{0, -30}, 1.0F / 60}, scratch, report);
  const float gap = states[1].position.x() - states[0].position.x() - static_cast<float>(2 * half_width);
  EXPECT_GT(gap, 0);
  EXPECT_LT(gap, 1e-3F);
}

}  // namespace
}  // namespace paperproof
