/// Characters that take turns, where the answer is a formula that tests/situations/together.json cannot say. See also
/// the built-in scenes of crowd.json, and the random runs of tests/agreement/together_test.cpp.
#include "controller/together.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof {
namespace {

using namespace stepping;

/// Ids, which decide the turns, ascend along the characters or descend, and so does the array.
void put_in_order(int order, Together& all) {
  if (order & 1) std::reverse(all.bodies.begin(), all.bodies.end());
  if (order & 2) std::reverse(all.order.begin(), all.order.end());
}

/// Walks up kerbs and follows its ground.
const CharacterDef walker{.snap = 0.2, .step_height = 0.25};

bool nobody_is_crushed(const Together& all) {
  return std::ranges::all_of(all.reports, [](const StepReport& report) {
    return report.move.crushed.empty() && report.status == StepStatus::moved;
  });
}

bool all_stand(const Together& all) { return std::ranges::all_of(all.states, &CharacterState::grounded); }

/// How lifts carry that do not turn is in tests/situations/together.json.
TEST(Together, a_tower_on_a_lift_that_tilts_is_carried_without_a_crush_and_never_in_the_air) {
  std::vector<Vec2d> places;
  for (const int i : {1, 3, 5, 7}) places.emplace_back(0, i * (half_height + rest_gap));
  for (const int order : {0, 1, 2, 3}) {
    SCOPED_TRACE(order);
    Together tower = under_gravity(places, {box(-3, -1, 3, 0, 0)}, walker);
    put_in_order(order, tower);
    for (Input& input : tower.inputs) input.move = 0;
    for (int step = -4; step <= 600; ++step) {
      tower.step_with_mover_turned_to(0.3 * std::sin(1.5 * std::max(step, 0) * frame));
      ASSERT_TRUE(nobody_is_crushed(tower) && (step < 1 || all_stand(tower))) << step;
    }
    EXPECT_EQ(tower.states[0].ride.ground, 0U);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(tower.states[i].ride.ground, tower.bodies[i - 1]);
  }
}

/// By the shortest way, sideways; each leaves the other as it begins.
TEST(Together, those_that_overlap_at_the_start_leave_each_other) {
  constexpr double apart = 0.3;
  Together two({{0, 0}, {apart, 0}});
  two.step();
  EXPECT_GE(two.gap(0, 1), least_gap);
  EXPECT_LE(two.gap(0, 1), 2 * half_width - apart + 2 * most_gap);
  EXPECT_TRUE(nobody_is_crushed(two));
  const std::vector<CharacterState> after = two.states;
  two.step();
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(two.states[i].position, after[i].position);
}

TEST(Together, one_whose_step_is_refused_stands_and_the_others_step_as_if_it_were_not_there) {
  struct Refused {
    const char* what;
    void (*spoil)(Together&);
    StepStatus status = StepStatus::invalid_input;
  };
  for (const auto& [what, spoil, status] :
       {Refused{"a place that is none", [](Together& t) { t.states[2].position.x() = nan; }},
        Refused{"a velocity that is none", [](Together& t) { t.states[2].velocity.y() = nan; }},
        Refused{"a wish that is none", [](Together& t) { t.inputs[2].move = nan; }},
        Refused{"no body of the level", [](Together& t) { t.states[2].ride.ground = 99; }, StepStatus::moved},
        Refused{"too far", [](Together& t) { t.states[2].position.x() = 3e6; }, StepStatus::out_of_range},
        Refused{"too fast", [](Together& t) { t.states[2].velocity.x() = 3e8; }, StepStatus::out_of_range}}) {
    SCOPED_TRACE(what);
    Together three = standing({0, 0.7, 9});
    Together two = standing({0, 0.7});
    three.inputs[0] = two.inputs[0] = {.move = 1};
    three.inputs[1] = two.inputs[1] = {.move = 0.5};
    for (int step = 0; step < 30; ++step) {
      spoil(three);
      const CharacterState before = three.states[2];
      three.step();
      two.step();
      ASSERT_EQ(three.reports[2].status, status);
      ASSERT_TRUE(!is_refused(status) || same_bits(three.states[2], before));
      for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(same_bits(three.states[i], two.states[i])) << i;
    }
  }
}

TEST(Together, a_context_that_is_refused_changes_nothing_for_anybody) {
  for (void (*spoil)(Together&) : {+[](Together& t) { t.gravity.y() = nan; }, +[](Together& t) { t.dt = 0; },
                                   +[](Together& t) { t.movers[0].to.x() = nan; },
                                   +[](Together& t) {
                                     t.up = {0, 2};
                                   }}) {
    Together three({{0, 1}, {0.7, 1}, {4, 1}}, {box(9, 0, 10, 1, 0)});
    three.states[0].velocity = {1, 1};
    const std::vector<CharacterState> before = three.states;
    spoil(three);
    three.step();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(three.reports[i].status, StepStatus::invalid_input);
      EXPECT_TRUE(same_bits(three.states[i], before[i]));
    }
  }
  Together({}).step();  // nobody is several, too
}

TEST(Together, who_goes_along_another_is_not_halted_by_rounding) {
  // The first is held between a wall and the second's shoulder; the second jumps from under it.
  const Vec2d from(0.8128372159054997, half_height + rest_gap);
  Together two =
      under_gravity({{half_width + rest_gap, 1.4993281862229892}, from}, {floor_at_zero(), box(-1, 0, 0, 9)});
  two.states[0].grounded = two.states[1].grounded = true;
  two.inputs = {{.move = 0}, {.move = 1, .jump = true}};
  two.step();
  // It wants (1, 11.5) m/s, and keeps what is along the facet with the normal (2, -1).
  const Vec2d facet = Vec2d(1, 2) / std::sqrt(5.0);
  const Vec2d kept = facet * facet.dot(Vec2d(1, 11.5));
  EXPECT_LE((two.states[1].velocity - kept).norm(), 1e-12);
  EXPECT_LE((two.states[1].position - from - kept / 60).norm(), 1e-12);
}

/// Beside a plank that turns, steps are cut into shorter ones. The plank tips two that stand on it.
TEST(Together, on_a_plank_that_rocks_two_stand_and_one_that_walks_stops_at_the_other) {
  for (const int order : {0, 1, 2, 3}) {
    SCOPED_TRACE(order);
    Together two = under_gravity({{-1, 0.3 + half_height}, {1, 0.3 + half_height}}, {box(-4, -0.2, 4, 0.2, 0)}, walker);
    put_in_order(order, two);
    two.inputs[0].move = 0.5;
    for (int step = 1; step <= 300; ++step) {
      two.step_with_mover_turned_to(0.2 * std::sin(3 * step * frame));
      ASSERT_TRUE(nobody_is_crushed(two) && (step < 20 || all_stand(two))) << step;
    }
    EXPECT_NEAR(two.gap(0, 1), 0, 0.02) << "upright, on ground that is not level";
    EXPECT_GE(two.gap(0, 1), 0);
  }
}

/// Lists of those in the way.
TEST(Together, a_step_takes_less_than_one_piece_of_memory_for_each) {
  for (const MoverIndex mover : {no_mover, MoverIndex{0}}) {
    Together all(a_dozen(), {box(-20, -1, 20, 0, mover), box(-4, 0.1, -3, 3, mover == no_mover ? no_mover : 1)});
    std::size_t met = 0;
    const auto count = [&] {
      for (const StepReport& report : all.reports)
        for (const Contact& contact : report.move.contacts) met += all.is_body(contact.collider);
    };
    EXPECT_LT(allocations_once_known(all, count), 200 * all.inputs.size());
    EXPECT_GT(met, 100U);
  }
}

}  // namespace
}  // namespace paperproof
