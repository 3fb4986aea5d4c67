/// Characters against characters, where the answer is a formula. See also the scenes of built_in_crowd.cpp.
#include "controller/together.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace paperproof {
namespace {

using namespace stepping;
using compare::box;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Crowd, two_bullets_do_not_pass_through_each_other) {
  struct HeadOn {
    double distance;
    double v1;
    double v2;
    double aside;
  };
  for (const auto& [d, v1, v2, aside] :
       {HeadOn{0.4, 0.5, 0.25, 0}, HeadOn{0.4, 100, 1000, 0}, HeadOn{0.4, 3, 0, 0}, HeadOn{2000, 1e5, 1e5, 0.01}}) {
    Together two({{0, 0}, {2 * half_width + d, aside}});
    two.states[0].velocity = {v1, 0};
    two.states[1].velocity = {-v2, 0};
    ASSERT_EQ(two.step(), StepStatus::moved);
    for (const CharacterIndex i : {0U, 1U}) {
      ASSERT_EQ(two.report.members[i].met.size(), 1U);
      const CrowdContact& met = two.report.members[i].met[0];
      EXPECT_NEAR(met.fraction, d / (v1 + v2), 1e-12);
      EXPECT_EQ(met.normal, Vec2d(i == 0 ? -1 : 1, 0));
      EXPECT_EQ(met.side, i == 0 ? Side::right : Side::left);
      EXPECT_EQ(met.other, 1 - i);
      EXPECT_EQ(two.states[i].velocity, Vec2d(0, 0));
    }
    EXPECT_NEAR(two.states[0].position.x(), v1 * d / (v1 + v2), 1e-6);
    EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
  }
}

TEST(Crowd, who_catches_up_keeps_the_speed_of_the_one_in_front_and_the_part_along_it) {
  Together two({{0, 0}, {1, 0}});
  two.states[0].velocity = {5, 0.25};
  two.states[1].velocity = {3, 0};
  two.step();
  EXPECT_EQ(two.states[1].position, Vec2d(4, 0)) << "as if it were alone";
  EXPECT_EQ(two.states[1].velocity, Vec2d(3, 0));
  EXPECT_NEAR(two.states[0].velocity.x(), 3, 1e-12);
  EXPECT_EQ(two.states[0].velocity.y(), 0.25);
  EXPECT_NEAR(two.states[0].position.y(), 0.25, 1e-15);
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << two.gap(0, 1);
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

TEST(Crowd, those_that_overlap_say_so_and_part) {
  Together two({{0, 0}, {0.3, 0}});
  two.step();
  for (const CharacterIndex i : {0U, 1U}) {
    ASSERT_EQ(two.report.members[i].started_overlapping.size(), 1U);
    EXPECT_EQ(two.report.members[i].started_overlapping[0], 1 - i);
  }
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1))) << "by the shortest way, sideways: " << two.gap(0, 1);
  two.step();
  EXPECT_TRUE(two.report.members[0].started_overlapping.empty());
}

TEST(Crowd, those_that_press_each_other_or_a_wall_or_stand_on_a_head_keep_their_bits) {
  Together two = standing({0, 1});
  two.inputs = {{.move = 1}, {.move = -1}};
  Together queue = standing({0, 1, 2, 3}, {floor_at_zero(), box(5, 0, 6, 5)});
  for (Input& input : queue.inputs) input.move = 1;
  Together tower = under_gravity({{0.1, 3 * half_height + 0.05}, {0, half_height + rest_gap}}, {floor_at_zero()});
  for (Together* all : {&two, &queue, &tower}) {
    all->steps(180);
    const std::vector<CharacterState> rest = all->states;
    for (int step = 0; step < 3000; ++step) {
      all->step();
      for (std::size_t i = 0; i < rest.size(); ++i) {
        ASSERT_TRUE(same_bits(all->states[i], rest[i])) << i << " in step " << step;
        ASSERT_TRUE(all->states[i].grounded && !all->report.members[i].stayed) << i << " in step " << step;
      }
    }
    for (std::size_t i = 1; i < rest.size() && all != &tower; ++i)
      EXPECT_TRUE(gap_of_a_contact(all->gap(i - 1, i))) << i;
    const ColliderIndex ground = all == &tower ? no_collider : 0;  // a character is no collider
    EXPECT_EQ(all->report.members[0].step.move.ground.collider, ground);
    all->inputs[0].jump = true;
    all->step();
    EXPECT_GT(all->states[0].velocity.y(), 11) << "may jump";
  }
  EXPECT_NEAR(tower.states[1].position.y(), half_height, 1e-6);
}

TEST(Crowd, who_goes_along_another_is_not_halted_by_rounding) {
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

TEST(Crowd, two_presses_crush_two_in_the_step_that_the_formula_gives_and_are_named) {
  constexpr int with_room = static_cast<int>((3 - 4 * half_width) / 0.06);
  Together two = standing({0, 1}, {floor_at_zero(), box(-2, 0, -1, 8, 0), box(2, 0, 3, 8, 1), box(-20, 1.3, 20, 2)});
  for (int step = 1; step <= with_room + 1; ++step) {
    two.step_with_movers_by({{0.03, 0}, {-0.03, 0}});
    for (const CharacterIndex i : {0U, 1U}) {
      const auto& by = two.report.members[i].step.move.crushed;
      ASSERT_EQ(by.size(), step > with_room ? 1U : 0U) << i << " in step " << step;
      EXPECT_TRUE(by.empty() || by[0] == i + 1) << i;
    }
    EXPECT_GT(two.gap(0, 1), 0) << step;
  }
}

TEST(Crowd, a_sensor_is_entered_once_also_where_an_impact_cuts_the_way_in_two) {
  ColliderDef sensor = box(0.5, -2, 0.7, 2);
  sensor.sensor = true;
  // 0 meets 1, which stands, after half a metre, and is then in the sensor.
  Together all({{0, 0}, {2 * half_width + 0.5, 0}}, {sensor, box(30, 0, 31, 1, 0)});
  all.states[0].velocity = {2, 0.25};
  all.step();
  ASSERT_EQ(all.report.members[0].met.size(), 1U);
  EXPECT_NEAR(all.report.members[0].met[0].fraction, 0.25, 1e-12);
  ASSERT_EQ(all.report.members[0].step.sensors.size(), 1U);
  EXPECT_NEAR(all.report.members[0].step.sensors[0].fraction, (0.5 - half_width) / 2, 1e-9);
  EXPECT_NEAR(all.states[0].position.y(), 0.25, 1e-12);
}

TEST(Crowd, an_input_that_is_refused_changes_nothing_for_anybody) {
  struct Refused {
    const char* what;
    void (*spoil)(Together&);
    StepStatus status = StepStatus::invalid_input;
  };
  const std::vector<Refused> all{
      {"a place", [](Together& t) { t.states[2].position.x() = nan; }},
      {"a velocity", [](Together& t) { t.states[1].velocity.y() = infinite; }},
      {"a wish", [](Together& t) { t.inputs[2].move = nan; }},
      {"an infinite wish", [](Together& t) { t.inputs[2].move = infinite; }},
      {"gravity", [](Together& t) { t.gravity.y() = -infinite; }},
      {"no time", [](Together& t) { t.dt = 0; }},
      {"a time", [](Together& t) { t.dt = nan; }},
      {"an input too few", [](Together& t) { t.inputs.pop_back(); }},
      {"a motion too few", [](Together& t) { t.movers.clear(); }},
      {"a motion from nowhere", [](Together& t) { t.movers[0].from.x() = nan; }},
      {"a motion out of range", [](Together& t) { t.movers[0].to.y() = 3e6; }},
      {"memory for two", [](Together& t) { t.scratch = t.crowd.make_scratch(2); }},
      {"memory that is moved from", [](Together& t) { const CrowdScratch taken = std::move(t.scratch); }},
      {"nobody's memory", [](Together& t) { t.scratch = {.most_characters = 3, .own = {}, .maker = {}}; }},
      {"another's memory",
       [](Together& t) {
         static const Together other({{0, 1}, {2, 1}, {4, 1}}, {box(9, 0, 10, 1, 0)});
         t.scratch = other.crowd.make_scratch(3);
       }},
      {"a report of two", [](Together& t) { t.report = CrowdReport(2); }},
      {"too fast", [](Together& t) { t.states[1].velocity.x() = 3e6; }, StepStatus::out_of_range}};
  for (const std::string_view kind : {"octagon_sweep", "discrete"}) {
    for (const auto& [what, spoil, status] : all) {
      Together three({{0, 1}, {2, 1}, {4, 1}}, {box(9, 0, 10, 1, 0)}, {}, {.name = kind});
      three.states[0].velocity = {1, 1};
      spoil(three);
      const std::vector<CharacterState> before = three.states;
      EXPECT_EQ(three.step(), status) << kind << ": " << what;
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(three.states[i], before[i])) << kind << ": " << what;
    }
  }
  Together rider({{0, 1}});
  rider.states[0].ride.ground = 0;
  EXPECT_EQ(rider.step(), StepStatus::invalid_input) << "a ride where nothing moves";
  EXPECT_EQ(Together({}).step(), StepStatus::moved) << "nobody is a crowd, too";
}

TEST(Crowd, a_technique_that_knows_one_character_is_refused) {
  for (const std::string_view kind : technique_names()) {
    if (find_technique(kind)->moves_crowds) continue;
    EXPECT_THROW(Together({{0, 5}}, {}, {}, {.name = kind}), std::invalid_argument) << kind;
  }
}

TEST(Crowd, a_step_takes_no_memory_on_the_ground_and_on_a_lift) {
  std::vector<Vec2d> at;
  for (int i = 0; i < 12; ++i) at.push_back({i * 0.7, half_height + 0.2 * (i % 3)});
  for (const std::string_view kind : {"octagon_sweep", "discrete"}) {
    for (const MoverIndex mover : {no_mover, MoverIndex{0}}) {
      std::vector<ColliderDef> colliders{box(-20, -1, 20, 0, mover)};
      if (mover != no_mover) colliders.push_back(box(-4, 0.1, -3, 3, 1));
      Together all = under_gravity(at, colliders, {}, {.name = kind});
      const std::vector<Vec2d> ways{{0, 0.02}, {0.02, 0.02}};
      std::size_t impacts = 0;
      const auto step_200_times = [&] {
        for (int step = 0; step < 200; ++step) {
          for (std::size_t i = 0; i < all.inputs.size(); ++i)
            all.inputs[i] = {.move = (step / 20 + static_cast<int>(i)) % 3 - 1,
                             .jump = step % 40 == static_cast<int>(i)};
          all.step_with_movers_by(ways);
          impacts += all.report.impacts;
        }
      };
      const std::vector<CharacterState> at_first = all.states;
      const std::vector<MoverMotion> movers_at_first = all.movers;
      step_200_times();  // scratch and report come to know what there is
      all.states = at_first;
      all.movers = movers_at_first;
      const std::size_t before = tests::allocations();
      step_200_times();
      EXPECT_EQ(tests::allocations(), before) << kind;
      EXPECT_GT(impacts, 100U) << kind;
    }
  }
}

}  // namespace
}  // namespace paperproof
