/// Several characters, judged from records that are made here.
#include "oracle/company.hpp"
#include "compare/judge_steps.hpp"
#include "oracle/in_turns.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

constexpr double width = 2 * half_width;
const ExactPair& pair() {
  static const ExactPair octagons(octagon());
  return octagons;
}

TEST(ExactPair, touching_is_no_overlap_and_an_ulp_more_is_one) {
  EXPECT_FALSE(pair().overlap({0, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({0x1p-52, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({3, 3}, {3, 3}));
  EXPECT_EQ(pair().separation({0, 0}, {2, 0}), 2 - width);
  EXPECT_EQ(pair().separation({2, 0}, {2.25, 0}), 0.25 - width);
  // A way that slides along the other, and one that does not and ends free as well.
  EXPECT_FALSE(pair().meet_between({0, -5}, {width, 0}, {0, 5}, {width, 0}));
  EXPECT_TRUE(pair().meet_between({0x1p-50, -5}, {width, 0}, {0x1p-50, 5}, {width, 0}));
}

TraceStep resting(const Vec2d& at, const std::optional<Vec2d>& requested = {}) { return step({at, at}, requested); }

TEST(CompanyJudge, another_is_near_within_touch_of_a_corner_of_either_way_and_at_the_same_time) {
  const TraceStep right = step({{-1, 0}, {1, 0}});
  TraceStep waits = step({{-2, 0}, {-2, 0}, {1, 0}});
  waits.path[1].fraction = 0.5;
  const double above = 2 * half_height + gap;
  using Row = std::tuple<const char*, TraceStep, TraceStep, double, bool>;
  for (const auto& [what, one, other, touch, near] :
       {Row{"touched", resting({0, 0}), resting({width + gap, 0}), 0.0, true},
        Row{"2e-6 m away", resting({0, 0}), resting({width + 2e-6, 0}), 0.0, false},
        Row{"within what it calls touching", resting({0, 0}), resting({width + 5e-4, 0}), 7e-4, true},
        Row{"overlapped", resting({0, 0}), resting({0.1, 0}), 0.0, true},
        Row{"in the way of both", resting({0, 0}, Vec2d(0.1, 0)), resting({width + 0.05, 0}, Vec2d(-0.1, 0)), 0.0,
            true},
        Row{"at a corner of the other's way", right, step({{0, 3}, {0, above}, {0, 3}}), 0.0, true},
        Row{"not there at that time", waits, step({{0, 3}, {0, above}, {0, 3}}), 0.0, false}}) {
    std::array<TraceStep, 2> steps{one, other};
    steps[1].character = 1;
    TraceHeader of_two = header({});
    of_two.characters = 2;
    of_two.tolerances = {{"touch", touch}};
    for (const bool turns : {false, true}) {
      if (turns) steps[0].turn = 0;
      if (turns) steps[1].turn = 1;
      for (const TraceStep& each : steps)
        EXPECT_EQ(CompanyJudge(of_two).is_beside_another(each, steps), near && !turns) << what;
    }
  }
}

/// The one goes before the other, or after it.
std::array<TraceStep, 2> in_turns(TraceStep one, CharacterIndex turn, TraceStep other) {
  one.turn = turn;
  other.turn = 1 - turn;
  other.character = 1;
  return {std::move(one), std::move(other)};
}

TraceHeader company_of(std::size_t characters) {
  TraceHeader made = promising({});
  made.characters = characters;
  return made;
}

/// As a step of one among the bodies of both. @param carried by the other, as the step before said.
/// @param moving what it says of the other in its turn.
TraceStep turn_of_first(const TraceHeader& header, std::array<TraceStep, 2> steps, bool carried, bool moving) {
  steps[0].respawn = carried;
  if (carried) steps[0].from = TraceState{.ride = TraceRide{.character = 1}};
  if (moving) steps[0].moving = {1};
  return InTurns(header, 0).turns(steps)[0];
}

TEST(InTurns, another_goes_evenly_where_it_is_said_to_and_carries_leaves_or_pushes_and_else_stands) {
  const Vec2d beside(width + gap, 0);
  const Vec2d below(0, -2 * half_height - gap);
  const Vec2d right(0.125, 0);
  const Vec2d up(0, 0.125);
  for (const auto& [what, moving, turn, from, to, begin, end] :
       {std::tuple{"its ground, which rises later", true, 0U, below, Vec2d(below + up), 0, 1},
        {"its ground, which goes aside later", true, 0U, below, Vec2d(below + right), 0, 1},
        {"its ground, which has sunk", true, 1U, below, Vec2d(below - up), 0, 1},
        {"its ground, which does not take it along", false, 0U, below, Vec2d(below + up), 0, 0},
        {"has left", true, 1U, beside, Vec2d(beside + right), 0, 1},
        {"has left, and is said to stand", false, 1U, beside, Vec2d(beside + right), 1, 1},
        {"has gone along it", true, 1U, beside, Vec2d(beside + up), 0, 1},
        {"has gone below it, farther away", true, 1U, beside, Vec2d(Vec2d(0.9 * beside) + 2 * below), 1, 1},
        {"will leave", false, 0U, beside, Vec2d(beside + right), 0, 0},
        {"has come near", true, 1U, Vec2d(beside + right), beside, 1, 1},
        {"will come near", false, 0U, Vec2d(beside + right), beside, 0, 0},
        {"will come in, and pushes", true, 0U, Vec2d(beside + right), Vec2d(beside - right), 0, 1},
        {"will come near, and is said to push", true, 0U, Vec2d(beside + right), beside, 0, 0},
        {"will come in after it has left", false, 0U, Vec2d(beside + right), Vec2d(beside - right), 0, 0},
        {"above it, and will rise", false, 0U, Vec2d(-below), Vec2d(up - below), 0, 0}}) {
    const TraceStep other = step({from, from + Vec2d(0, -3), to}, Vec2d(9, 9));
    const TraceStep made = turn_of_first(company_of(2), in_turns(resting({0, 0}), turn, other), from == below, moving);
    ASSERT_EQ(made.movers.size(), 2U);
    EXPECT_EQ(made.movers[1].from, begin == 0 ? from : to) << what;
    EXPECT_EQ(made.movers[1].to, end == 0 ? from : to) << what;
    EXPECT_GT(made.movers[0].from.x(), 50) << "its own body is far away";
  }
}

TEST(InTurns, whom_it_met_is_a_contact_with_the_body) {
  TraceStep one = resting({0, 0});
  one.contacts = {contact(0, {0, 1})};
  one.contacts[0].fraction = 0.75;
  one.met = {{.other = 1, .normal = {-1, 0}, .fraction = 0.5, .side = Side::right}};
  TraceHeader two = promising({box(-4, -9, 4, -8)});
  two.characters = 2;
  const TraceStep made = turn_of_first(two, in_turns(one, 0, resting({width + gap, 0})), false, false);
  ASSERT_EQ(made.contacts.size(), 2U);
  EXPECT_EQ(made.contacts[0].collider, 2U) << "after the scenery, and its own body";
  EXPECT_EQ(made.contacts[0].normal, Vec2d(-1, 0));
  EXPECT_EQ(made.contacts[0].fraction, 0.5);
  EXPECT_EQ(made.contacts[0].side, Side::right);
  EXPECT_EQ(made.contacts[1].collider, 0U);
  EXPECT_TRUE(made.met.empty());
}

/// What is said of the first of two that take turns, whose fall is wanted.
StepJudgement judged_in_turns(const std::array<TraceStep, 2>& steps, bool carried = false, bool moving = false) {
  const Wanted wanted = wanting(steps[0].requested);
  return Judge(InTurns(company_of(2), 0).header()).judge(turn_of_first(company_of(2), steps, carried, moving), &wanted);
}

TEST(InTurns, a_fall_ends_at_where_the_other_stands_then) {
  // Both fall, and 0.03 m are between them.
  const Vec2d fall(0, -0.1);
  TraceStep stops = step({{0, 2 * half_height + 0.03}, {0, 2 * half_height + gap}, {0, 2 * half_height + gap}}, fall);
  stops.velocity.setZero();
  const TraceStep below = step({{0, 0}, fall});
  EXPECT_FALSE(judged_in_turns(in_turns(stops, 0, below)).hangs) << "the other falls later";
  EXPECT_TRUE(judged_in_turns(in_turns(stops, 1, below)).hangs) << "it has fallen";
}

TEST(InTurns, only_a_head_that_carries_lifts_before_it_goes) {
  const Vec2d up(0, 0.1);
  const TraceStep head = step({{0, 0}, up});
  for (const bool lifts : {true, false}) {
    const Vec2d begin(0, 2 * half_height + (lifts ? gap : 0.05));
    TraceStep rides = step({begin, begin + up}, Vec2d(0, -0.01));
    rides.grounded = lifts;
    const StepJudgement judged = judged_in_turns(in_turns(rides, 0, head), lifts, true);
    EXPECT_EQ(judged.way_gained == 0 && judged.speed_gained == 0, lifts);
    EXPECT_FALSE(judged.hangs || judged.ground_refuted);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
