/// Characters as bodies of one joint solve: what no scene can say of it. What the law of `discrete` makes of two that
/// meet is in tests/situations/techniques.json.
#include "controller/states.hpp"

#include <gtest/gtest.h>

namespace paperproof {
namespace {

using namespace stepping;

constexpr double gap = Tolerances{}.stop;

/// A step takes a second and nothing pulls: velocities are displacements.
struct Flying {
  explicit Flying(const std::vector<Vec2d>& positions, std::vector<ColliderDef> colliders = {})
      : scenery(SceneryDef{std::move(colliders)}),
        states(positions.size()),
        inputs(positions.size()),
        movers(scenery.mover_count()) {
    for (std::size_t i = 0; i < positions.size(); ++i) states[i].position = positions[i];
  }
  StepStatus step() { return crowd.step(states, inputs, {gravity, dt, movers}, scratch, report); }
  /// From right side to left side [m].
  [[nodiscard]] double gap(std::size_t left, std::size_t right) const {
    return states[right].position.x() - states[left].position.x() - 2 * half_width;
  }

  Scenery scenery;
  std::vector<CharacterState> states;
  TechniqueCrowd crowd = make_crowd(scenery, {}, {.name = "discrete"});
  CrowdScratch scratch = crowd.make_scratch(states.size());
  CrowdReport report{states.size()};
  std::vector<Input> inputs;
  std::vector<MoverMotion> movers;  ///< Of the next step.
  Vec2d gravity{0, 0};
  double dt = 1;
};

TEST(DiscreteCrowd, pushed_against_a_wall_overlap_by_what_four_rounds_leave_a_quarter) {
  // Round by round: halves for both; the wall takes the right one's back; halves of that; and so on.
  const double apart = 0.25;
  const double v = 0.65;
  const double wall = 3 * half_width + apart + gap;
  Flying two({{0, 0}, {2 * half_width + apart, 0}}, {box(wall, -5, wall + 1, 5)});
  two.states[0].velocity = {v, 0};
  two.step();
  EXPECT_NEAR(two.gap(0, 1), -(v - apart) / 4, 4 * gap);
  EXPECT_NEAR(two.states[0].velocity.x(), v / 4, 1e-15);
  EXPECT_EQ(two.states[1].velocity.x(), 0);
  EXPECT_NEAR(two.states[1].position.x() + half_width, wall, 2 * gap);
  EXPECT_EQ(two.report.members[1].step.move.contacts.size(), 1U);
  EXPECT_TRUE(two.states[1].wall_right);
  EXPECT_FALSE(two.states[0].wall_right) << "another is no wall";
}

TEST(DiscreteCrowd, two_pairs_far_apart_are_two_islands_and_a_chain_is_one) {
  const double near = 2 * half_width + 0.1;
  Flying six({{100, 0}, {0, 0}, {100 + near, 0}, {near, 0}, {50, 0}, {2 * near, 0}});
  for (CharacterState& state : six.states) state.velocity = {0.2, 0};
  six.step();
  std::vector<CharacterIndex> islands;
  for (const CrowdMember& member : six.report.members) islands.push_back(member.island);
  EXPECT_EQ(islands, (std::vector<CharacterIndex>{0, 1, 0, 1, 4, 1}));
  for (CharacterState& state : six.states) state.velocity = {0, 0};
  six.step();
  EXPECT_EQ(six.report.members[2].island, 2U) << "boxes that do not overlap: nobody is at risk";
  EXPECT_EQ(six.report.impacts, 0U);
}

TEST(DiscreteCrowd, with_more_pairs_than_there_is_room_for_says_that_something_was_dropped) {
  constexpr std::size_t most = 530;  // 530 * 529 / 2 pairs are more than 256 for each and one piece
  std::vector<Vec2d> places;
  for (std::size_t i = 0; i < most; ++i) places.emplace_back(1e-4 * static_cast<double>(i), 0);
  Flying all(places, {box(-5, -9, 5, -8)});
  for (CrowdMember& member : all.report.members) member.step.reserve(64);
  const std::size_t before = tests::allocations();
  ASSERT_EQ(all.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  for (std::size_t i = 0; i < most; ++i) {
    ASSERT_EQ(all.report.members[i].step.status, StepStatus::dropped);
    ASSERT_TRUE(all.states[i].position.allFinite());
  }
}

TEST(DiscreteCrowd, an_input_that_is_refused_changes_nothing_for_anybody) {
  struct Refused {
    const char* what;
    void (*spoil)(Flying&);
    StepStatus status = StepStatus::invalid_input;
  };
  const std::vector<Refused> all{
      {"a place", [](Flying& t) { t.states[2].position.x() = nan; }},
      {"a velocity", [](Flying& t) { t.states[1].velocity.y() = infinity; }},
      {"a wish", [](Flying& t) { t.inputs[2].move = nan; }},
      {"gravity", [](Flying& t) { t.gravity.y() = -infinity; }},
      {"no time", [](Flying& t) { t.dt = 0; }},
      {"an input too few", [](Flying& t) { t.inputs.pop_back(); }},
      {"a motion too few", [](Flying& t) { t.movers.clear(); }},
      {"a motion from nowhere", [](Flying& t) { t.movers[0].from.x() = nan; }},
      {"a motion out of range", [](Flying& t) { t.movers[0].to.y() = 3e6; }},
      {"memory for two", [](Flying& t) { t.scratch = t.crowd.make_scratch(2); }},
      {"nobody's memory", [](Flying& t) { t.scratch = {.most_characters = 3, .own = {}, .maker = {}}; }},
      {"another's memory",
       [](Flying& t) {
         static const Flying other({{0, 1}, {2, 1}, {4, 1}}, {box(9, 0, 10, 1, 0)});
         t.scratch = other.crowd.make_scratch(3);
       }},
      {"a report of two", [](Flying& t) { t.report = CrowdReport(2); }},
      {"too fast", [](Flying& t) { t.states[1].velocity.x() = 3e6; }, StepStatus::out_of_range}};
  for (const auto& [what, spoil, status] : all) {
    Flying three({{0, 1}, {2, 1}, {4, 1}}, {box(9, 0, 10, 1, 0)});
    three.states[0].velocity = {1, 1};
    spoil(three);
    const std::vector<CharacterState> before = three.states;
    EXPECT_EQ(three.step(), status) << what;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(three.states[i], before[i])) << what;
  }
  EXPECT_EQ(Flying({}).step(), StepStatus::moved) << "nobody is a crowd, too";
}

TEST(DiscreteCrowd, is_no_crowd_of_another_technique) {
  const Scenery scenery;
  for (const std::string_view kind : technique_names()) {
    if (kind == "discrete") continue;
    EXPECT_THROW((void)make_crowd(scenery, {}, {.name = kind}), std::invalid_argument) << kind;
  }
}

/// On the ground and on a lift beside a wall that moves.
TEST(DiscreteCrowd, takes_no_memory_in_a_step) {
  for (const MoverIndex mover : {no_mover, MoverIndex{0}}) {
    Flying all(a_dozen(), {box(-20, -1, 20, 0, mover), box(-4, 0.1, -3, 3, mover == 0 ? 1 : 0)});
    std::size_t impacts = 0;
    EXPECT_EQ(allocations_once_known(all, [&] { impacts += all.report.impacts; }), 0U);
    EXPECT_GT(impacts, 100U);
  }
}

TEST(DiscreteCrowd, who_begins_in_another_comes_out_and_both_say_so) {
  Flying three({{0, 0}, {half_width, 0}, {9, 0}});
  three.step();
  for (const CharacterIndex i : {0U, 1U}) {
    ASSERT_EQ(three.report.members[i].started_overlapping.size(), 1U);
    EXPECT_EQ(three.report.members[i].started_overlapping[0], 1 - i);
  }
  EXPECT_TRUE(three.report.members[2].started_overlapping.empty());
  EXPECT_NEAR(three.gap(0, 1), gap, 1e-15);
  EXPECT_NEAR(three.states[0].position.x() + three.states[1].position.x(), half_width, 1e-15) << "half each";
  three.step();
  EXPECT_TRUE(three.report.members[0].started_overlapping.empty());
}

}  // namespace
}  // namespace paperproof
