#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

const Vec2d here(0, 0);

/// From one place to another, straight.
TraceStep leg(const Vec2d& from, const Vec2d& to, Motions movers) { return among(step({from, to}), std::move(movers)); }
/// It stays while one mover goes.
TraceStep staying(const Vec2d& from, const Vec2d& to) { return leg(here, here, {{from, to}}); }

TEST(JudgeMovers, are_passed_in_their_own_frame) {
  const ColliderDef slab = box(0, -4, 1, 4, 0);
  const ColliderDef line = chain({{0, -4}, {0, 4}}, 0);
  // It waits at the origin from 0.25 to 0.75, then follows.
  TraceStep waits = leg({-0.5, 0}, {4, 0}, {{{-8, 0}, {8, 0}}});
  waits.path = {{{-0.5, 0}, 0}, {here, 0.25}, {here, 0.75}, {{4, 0}, 1}};
  using Row = std::tuple<const char*, std::vector<ColliderDef>, std::vector<TraceStep>, std::vector<const char*>>;
  const std::vector<Row> rows{
      {"going along is free", {box(0, -4, 0.125, 4, 0)}, {leg({-1, 0}, {7, 0}, {{here, {8, 0}}})}, {""}},
      {"a paper passes while it waits at a corner", {line}, {waits}, {"tunnelled 0"}},
      {"two papers swap sides",
       {line, chain(line.points, 1)},
       {leg(here, here, {{{-2, 0}, {2, 0}}, {{2, 0}, {-2, 0}}})},
       {"tunnelled 0 1"}},
      {"it passes steps later",
       {slab},
       {staying({-2, 0}, {-0.5, 0}), staying({-0.5, 0}, {2, 0})},
       {"inside 0, entered 0", "tunnelled 0"}},
      {"it goes back", {slab}, {staying({-2, 0}, {-0.5, 0}), staying({-0.5, 0}, {-2, 0})}, {"inside 0, entered 0", ""}},
      {"put elsewhere between steps it begins inside",
       {slab},
       {staying({-3, 0}, {-3, 0}), staying({-0.5, 0}, {-0.5, 0})},
       {"", "inside 0"}},
      {"a lift falls faster than its rider",
       {box(-1, -1, 1, 0, 0)},
       {leg({0, 0.6250005}, {0, 0.6150005}, {{here, {0, -0.5}}})},
       {""}},
  };
  for (const auto& [what, solids, steps, expected] : rows) {
    Judge judge(header(solids));
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const StepJudgement one = judge.judge(steps[i]);
      EXPECT_EQ(told(one), expected[i]) << what;
      EXPECT_TRUE(*expected[i] != 0 || (one.contacts.empty() && !one.first_impact)) << what;
    }
  }
  EXPECT_EQ(judged(header({slab}), staying({-2, 0}, {-0.5, 0})).max_penetration, 0.5 + half_width);
  EXPECT_THROW((void)judged(header({box(0, 0, 1, 1, 1)}), staying(here, here)), std::invalid_argument) << "too few";
}

TEST(JudgeMovers, a_paper_that_stops_closer_than_a_contact_is_need_not_be_reported_and_may_be) {
  constexpr double near = 6e-7;  // less than the reach of a contact, 1e-6 m, more than what has to be seen, 1e-7 m
  const TraceHeader paper = header({box(-1, -1, -half_width - near, 1, 0)});
  TraceStep comes = staying({-0.0625, 0}, here);
  EXPECT_TRUE(judged(paper, comes).contacts.empty());
  EXPECT_EQ(judged(paper, comes).dont_care, Colliders{0});
  comes.contacts = {contact(0, {1, 0}, 1)};
  comes.contacts[0].separation = near;
  EXPECT_EQ(judged(paper, comes).contacts.size(), 1U);
  // It goes on for as long again, and would be met after half of the step, or in its last micrometre.
  for (const double end : {0.0625, 2 * near})
    EXPECT_EQ(judged(paper, staying({-0.0625, 0}, {end, 0})).contacts.size(), 1U) << end;
}

TEST(JudgeMovers, what_a_mover_pushes_into_is_neither_right_nor_wrong) {
  // Pushed to the left by the mover into the wall, or without the push; nothing was requested.
  for (const double pushed : {-0.1874990, 0.0}) {
    TraceStep push = step({here, {-0.1874995, 0}}, here, {contact(1, {1, 0}, 1)});
    push.velocity = here;
    const StepJudgement one =
        judged(header({box(half_width, -1, 1, 1, 0), box(-2, -1, -0.5, 1)}), among(push, {{here, {pushed, 0}}}));
    EXPECT_EQ(one.dont_care, pushed < 0 ? Colliders{1} : Colliders{});
    EXPECT_LE(one.max_contact_gap, 1e-6);
  }
}

constexpr auto enter = SensorEvent::Change::enter;
constexpr auto leave = SensorEvent::Change::exit;

TEST(JudgeSensors, a_thin_sensor_is_entered_and_left_at_exact_fractions) {
  // Falling by 4 past a line at height 0: the feet reach it after 1 - 0.625, the head after 1 + 0.625. Where the sensor
  // moves it comes half of the way.
  for (const bool moves : {false, true}) {
    const TraceHeader line = header({sensor(chain({{-4, 0}, {4, 0}}, moves ? 0 : no_mover))});
    TraceStep fall = moves ? leg({0, 1}, {0, -1}, {{here, {0, 2}}}) : leg({0, 1}, {0, -3}, {});
    fall.sensors = {{0, enter, 0.09375}, {0, leave, 0.40625 + 1e-9}};
    const StepJudgement fell = judged(line, fall);
    ASSERT_EQ(fell.sensor_events.size(), 2U);
    EXPECT_EQ(fell.sensor_events[0].fraction * 4, 1 - 0.625);
    EXPECT_EQ(fell.sensor_events[1].fraction * 4, 1 + 0.625);
    EXPECT_EQ(fell.sensor_events_missing, 0);
    EXPECT_EQ(fell.sensor_events_extra, 0);
    EXPECT_NEAR(fell.max_sensor_error, 1e-9, 1e-15);
    EXPECT_EQ(told(fell), "") << "a sensor is no solid";
    fall.sensors = {{0, leave, 0.4}, {0, leave, 0.5}, {0, enter, std::nan("")}};
    EXPECT_EQ(judged(line, fall).sensor_events_missing, 1);
    EXPECT_EQ(judged(line, fall).sensor_events_extra, 2);
  }
}

TEST(JudgeSensors, a_corner_of_the_way_is_an_event_only_where_it_is_outside) {
  const TraceHeader there = header({sensor(box(-1, -1, 1, 1))});
  EXPECT_TRUE(judged(there, step({here, {1.3, 0}, here})).sensor_events.empty());
  const auto touched = judged(there, step({here, {1 + half_width, 0}, here})).sensor_events;
  ASSERT_EQ(touched.size(), 2U) << "it is outside for an instant";
  EXPECT_EQ(touched[0].change, leave);
  EXPECT_EQ(touched[1].change, enter);
  for (const ExactSensorEvent& one : touched) EXPECT_EQ(one.fraction, 0.5);
}

Contact touch(ColliderIndex collider, const Vec2d& normal, const Vec2d& point = {0, 0}, double fraction = 0) {
  Contact made = contact(collider, normal, fraction);
  made.point = point;
  made.separation = gap;
  return made;
}
/// Where a corner of a box touches the octagon's lower right side.
Vec2d corner() { return lower_right_middle() - gap * lower_right(); }

/// The corner of a box goes left and pushes the octagon up against a ceiling. If it goes right, nothing does.
TEST(JudgeMovers, a_contact_into_which_a_mover_pushes_is_right) {
  const TraceHeader there =
      promising({box(corner().x(), corner().y() - 0.5, corner().x() + 1, corner().y(), 0), box(-4, 0.625 + gap, 4, 2)});
  for (const double way : {-0.125, 0.125}) {
    const TraceStep pushed =
        step({here, {std::min(way, 0.0), 0}}, here, {touch(0, lower_right(), corner()), touch(1, {0, -1})});
    const Touches right = judged(there, among(pushed, {{here, {way, 0}}})).deflected;
    EXPECT_EQ(std::count(right.begin(), right.end(), std::pair(ColliderIndex{1}, Side::top)), way < 0);
  }
}

/// A floor comes up under the octagon beside a wall: it carries to the left, into the wall, or to the right.
TEST(JudgeMovers, a_contact_into_which_ground_carries_is_right) {
  const TraceHeader there = promising({box(-0.5, -2, 4, -1, 0), box(-2, -0.5, -half_width - gap, 2)});
  constexpr double rise = 0.5;
  constexpr double met = (1 - half_height) / rise;
  for (const double way : {-0.125, 0.125}) {
    TraceStep carried = step({here, here, {std::max(0.0, way * (1 - met)), rise * (1 - met)}}, here,
                             {touch(0, {0, 1}, here, met), touch(1, {1, 0}, here, met)});
    carried.path[1].fraction = met - 2 * gap / rise;
    const Touches right = judged(there, among(carried, {{here, {way, rise}}})).deflected;
    EXPECT_EQ(std::count(right.begin(), right.end(), std::pair(ColliderIndex{1}, Side::left)), way < 0);
  }
}

/// A walker runs into a corner of a box with his lower right flank, and goes on with the box, along that normal: down,
/// onto the floor, if the box goes away.
TEST(JudgeMovers, a_contact_into_which_a_face_leads_that_ends_the_motion_is_right) {
  const TraceHeader there = promising(
      {box(corner().x(), corner().y() - 0.1, corner().x() + 1, corner().y(), 0), box(-4, -2, 4, -0.625 - gap)});
  for (const double way : {-0.05, 0.0, 0.05}) {
    const TraceStep walk = step({here, {std::max(0.8 * way, -0.05), 0}}, Vec2d(0.3, 0),
                                {touch(0, lower_right(), corner()), touch(1, {0, 1})});
    EXPECT_EQ(!judged(there, among(walk, {{here, {way, 0}}})).deflected.empty(), way > 0) << way;
  }
}

}  // namespace
}  // namespace paperproof::compare::test
