#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;

ColliderDef moving(ColliderDef def, MoverIndex mover = 0) {
  def.mover = mover;
  return def;
}

TraceStep among(TraceStep step, std::vector<MoverMotion<double>> movers) {
  step.movers = std::move(movers);
  return step;
}

/// From one place to another, straight.
TraceStep leg(const Vec2d& from, const Vec2d& to, std::vector<MoverMotion<double>> movers) {
  return among(step({from, to}), std::move(movers));
}

TEST(JudgeMovers, a_paper_that_sweeps_over_a_resting_character_is_tunnelled_at_the_papers_speed) {
  constexpr double thickness = 1.0 / 128;
  Judge judge(header({moving(box(0, -4, thickness, 4))}));
  const StepJudgement judged = judge.judge(leg({0, 0}, {0, 0}, {{{-3, 0}, {5, 0}}}));
  EXPECT_EQ(judged.tunnelled, Colliders{0});
  EXPECT_TRUE(judged.end_overlap.empty());
  ASSERT_EQ(judged.passings.size(), 1U);
  EXPECT_DOUBLE_EQ(judged.passings[0].speed, 8 / dt);
  EXPECT_NEAR(judged.passings[0].thickness, thickness, 1e-15);
  EXPECT_DOUBLE_EQ(judged.passings[0].angle, 90);
}

TEST(JudgeMovers, a_paper_that_stops_closer_than_a_contact_is_need_not_be_reported_and_may_be) {
  constexpr double gap = 6e-7;  // less than the reach of a contact, 1e-6 m, more than what has to be seen, 1e-7 m
  const TraceHeader paper = header({moving(box(-1, -1, -0.3125 - gap, 1))});
  TraceStep comes = leg({0, 0}, {0, 0}, {{{-0.0625, 0}, {0, 0}}});
  StepJudgement judged = Judge(paper).judge(comes);
  EXPECT_TRUE(judged.contacts.empty());
  EXPECT_EQ(judged.dont_care, Colliders{0});
  comes.contacts = {{.collider = 0, .normal = {1, 0}, .fraction = 1, .separation = gap, .side = Side::left}};
  EXPECT_EQ(Judge(paper).judge(comes).contacts.size(), 1U);
  // It goes on for as long again, and would be met after half of the step, or in its last micrometre.
  for (const double end : {0.0625, 2 * gap}) {
    const StepJudgement met = Judge(paper).judge(leg({0, 0}, {0, 0}, {{{-0.0625, 0}, {end, 0}}}));
    EXPECT_EQ(met.contacts.size(), 1U) << end;
  }
}

TEST(JudgeMovers, going_along_with_a_paper_is_free) {
  Judge judge(header({moving(box(0, -4, 0.125, 4))}));
  const StepJudgement judged = judge.judge(leg({-1, 0}, {7, 0}, {{{0, 0}, {8, 0}}}));
  EXPECT_TRUE(judged.tunnelled.empty());
  EXPECT_TRUE(judged.end_overlap.empty());
  EXPECT_TRUE(judged.contacts.empty());
}

TEST(JudgeMovers, waiting_at_a_corner_while_a_paper_passes_is_tunnelling) {
  Judge judge(header({moving(chain({{0, -4}, {0, 4}}))}));
  // It waits at the origin from 0.25 to 0.75, then follows.
  TraceStep step = leg({-0.5, 0}, {4, 0}, {{{-8, 0}, {8, 0}}});
  step.path = {{{-0.5, 0}, 0}, {{0, 0}, 0.25}, {{0, 0}, 0.75}, {{4, 0}, 1}};
  EXPECT_EQ(judge.judge(step).tunnelled, Colliders{0});
}

TEST(JudgeMovers, two_papers_that_swap_sides_are_both_tunnelled) {
  Judge judge(header({moving(chain({{0, -4}, {0, 4}}), 0), moving(chain({{0, -4}, {0, 4}}), 1)}));
  const StepJudgement judged = judge.judge(leg({0, 0}, {0, 0}, {{{-2, 0}, {2, 0}}, {{2, 0}, {-2, 0}}}));
  EXPECT_EQ(judged.tunnelled, (Colliders{0, 1}));
}

TEST(JudgeMovers, a_mover_that_passes_steps_later_is_tunnelled_on_the_side_it_leaves) {
  for (const bool back : {false, true}) {
    Judge judge(header({moving(box(0, -4, 1, 4))}));
    const StepJudgement in = judge.judge(leg({0, 0}, {0, 0}, {{{-2, 0}, {-0.5, 0}}}));
    EXPECT_EQ(in.end_overlap, Colliders{0});
    EXPECT_EQ(in.entered, Colliders{0});
    EXPECT_EQ(in.max_penetration, 0.5 + 0.3125);
    const StepJudgement out = judge.judge(leg({0, 0}, {0, 0}, {{{-0.5, 0}, {back ? -2.0 : 2.0, 0}}}));
    EXPECT_EQ(out.tunnelled, back ? Colliders{} : Colliders{0});
    EXPECT_TRUE(out.entered.empty());
  }
}

TEST(JudgeMovers, a_mover_that_is_put_elsewhere_between_steps_begins_anew) {
  Judge judge(header({moving(box(0, -4, 1, 4))}));
  (void)judge.judge(leg({0, 0}, {0, 0}, {{{-3, 0}, {-3, 0}}}));
  const StepJudgement judged = judge.judge(leg({0, 0}, {0, 0}, {{{-0.5, 0}, {-0.5, 0}}}));
  EXPECT_EQ(judged.end_overlap, Colliders{0});
  EXPECT_TRUE(judged.entered.empty()) << "it was inside when the step began";
}

TEST(JudgeMovers, a_rider_touches_what_carries_it_and_nothing_else) {
  // The lift rises by 0.5; the request is that and gravity's 0.01.
  Judge judge(header({moving(box(-1, -1, 1, 0)), box(1.5, -1, 2, 3)}));
  constexpr double gap = 5e-7;
  TraceStep ride = leg({0, 0.625 + gap}, {0, 1.125 + gap}, {{{0, 0}, {0, 0.5}}});
  ride.requested = {0, 0.49};
  const StepJudgement judged = judge.judge(ride);
  ASSERT_EQ(judged.contacts.size(), 1U);
  EXPECT_EQ(judged.contacts[0].collider, 0U);
  EXPECT_EQ(judged.contacts[0].side, Side::bottom);
  EXPECT_TRUE(judged.end_overlap.empty());
  EXPECT_TRUE(judged.tunnelled.empty());
}

TEST(JudgeMovers, a_lift_that_falls_faster_than_its_rider_is_no_contact) {
  Judge judge(header({moving(box(-1, -1, 1, 0))}));
  const StepJudgement judged = judge.judge(leg({0, 0.6250005}, {0, 0.6150005}, {{{0, 0}, {0, -0.5}}}));
  EXPECT_TRUE(judged.contacts.empty());
  EXPECT_FALSE(judged.first_impact);
}

TEST(JudgeMovers, the_first_impact_is_that_of_the_relative_motion) {
  Judge judge(header({moving(box(2, -1, 3, 1))}));
  TraceStep push = leg({0, 0}, {0, 0}, {{{0, 0}, {-2, 0}}});
  push.requested = {1, 0};
  push.path = {{{0, 0}, 0}, {{0.5625, 0}, 0.5625}, {{-0.3125, 0}, 1}};
  const StepJudgement judged = judge.judge(push);
  ASSERT_TRUE(judged.first_impact);
  EXPECT_DOUBLE_EQ(*judged.first_impact, (2 - 0.3125) / 3);
  EXPECT_TRUE(judged.first_impact_comparable);
  ASSERT_EQ(judged.contacts.size(), 1U);
  EXPECT_EQ(judged.contacts[0].side, Side::right);
}

TEST(JudgeMovers, what_a_mover_pushes_into_is_neither_right_nor_wrong) {
  // Pushed to the left by the mover into the wall; nothing was requested.
  Judge judge(header({moving(box(0.3125, -1, 1, 1)), box(-2, -1, -0.5, 1)}));
  TraceStep push = leg({0, 0}, {-0.1874995, 0}, {{{0, 0}, {-0.1874990, 0}}});
  push.requested = {0, 0};
  push.velocity = {0, 0};
  Contact<double> wall;
  wall.collider = 1;
  wall.normal = {1, 0};
  wall.fraction = 1;
  wall.side = Side::left;
  push.contacts = {wall};
  const StepJudgement judged = judge.judge(push);
  EXPECT_EQ(judged.dont_care, Colliders{1});
  EXPECT_LE(judged.max_contact_gap, 1e-6);
  push.movers = {{{0, 0}, {0, 0}}};  // without the push the contact is wrong
  Judge still(header({moving(box(0.3125, -1, 1, 1)), box(-2, -1, -0.5, 1)}));
  EXPECT_TRUE(still.judge(push).dont_care.empty());
}

TEST(JudgeMovers, too_few_motions_are_refused) {
  Judge judge(header({moving(box(0, 0, 1, 1), 1)}));
  EXPECT_THROW((void)judge.judge(leg({5, 5}, {5, 5}, {{}})), std::invalid_argument);
}

ColliderDef sensor(ColliderDef def) {
  def.sensor = true;
  return def;
}

SensorEvent<double> event(SensorEvent<double>::Change change, double fraction, ColliderIndex collider = 0) {
  return {collider, change, fraction};
}

constexpr auto enter = SensorEvent<double>::Change::enter;
constexpr auto leave = SensorEvent<double>::Change::exit;

TEST(JudgeSensors, a_thin_sensor_is_entered_and_left_at_exact_fractions) {
  // Falling by 4 past a line at height 0: the feet reach it after 1 - 0.625, the head after 1 + 0.625.
  for (const bool moves : {false, true}) {
    ColliderDef line = sensor(chain({{-4, 0}, {4, 0}}));
    if (moves) line.mover = 0;
    Judge judge(header({line}));
    // Where the sensor moves it comes half of the way.
    TraceStep fall = moves ? leg({0, 1}, {0, -1}, {{{0, 0}, {0, 2}}}) : leg({0, 1}, {0, -3}, {});
    fall.sensors = {event(enter, 0.09375), event(leave, 0.40625 + 1e-9)};
    const StepJudgement judged = judge.judge(fall);
    ASSERT_EQ(judged.sensor_events.size(), 2U);
    EXPECT_EQ(judged.sensor_events[0].fraction, (Exact(1) - Exact(0.625)) / 4);
    EXPECT_EQ(judged.sensor_events[1].fraction, (Exact(1) + Exact(0.625)) / 4);
    EXPECT_EQ(judged.sensor_events_missing, 0);
    EXPECT_EQ(judged.sensor_events_extra, 0);
    EXPECT_NEAR(judged.max_sensor_error, 1e-9, 1e-15);
    EXPECT_TRUE(judged.tunnelled.empty()) << "a sensor is no solid";
  }
}

TEST(JudgeSensors, missing_and_extra_events_are_counted) {
  Judge judge(header({sensor(chain({{-4, 0}, {4, 0}}))}));
  TraceStep fall = leg({0, 1}, {0, -3}, {});
  fall.sensors = {event(leave, 0.4), event(leave, 0.5), event(enter, std::nan(""))};
  const StepJudgement judged = judge.judge(fall);
  EXPECT_EQ(judged.sensor_events_missing, 1);
  EXPECT_EQ(judged.sensor_events_extra, 2);
}

TEST(JudgeSensors, a_stay_over_several_steps_has_one_enter_and_one_exit_wherever_the_steps_end) {
  // Down through a concave sensor whose cut into parts must not show, in steps that end in it, at its rim, on corners.
  const ColliderDef hook = sensor(polygon({{-2, 0}, {2, 0}, {2, 3}, {1, 3}, {1, 1}, {-1, 1}, {-1, 3}, {-2, 3}}));
  Judge judge(header({hook}));
  int entered = 0;
  int left = 0;
  const double down[] = {4, 3.625, 1.625, 1.5, 1.5, -0.625, -0.75, -1};
  for (std::size_t i = 0; i + 1 < std::size(down); ++i) {
    const StepJudgement judged = judge.judge(leg({1.5, down[i]}, {1.5, down[i + 1]}, {}));
    for (const ExactSensorEvent& one : judged.sensor_events) (one.change == enter ? entered : left) += 1;
    if (i == 1) {
      ASSERT_EQ(judged.sensor_events.size(), 1U) << "touching as it begins, inside at once";
      EXPECT_EQ(judged.sensor_events[0].fraction, 0);
    }
    if (i == 4) {
      ASSERT_EQ(judged.sensor_events.size(), 1U) << "touching as it ends";
      EXPECT_EQ(judged.sensor_events[0].fraction, 1);
    }
  }
  EXPECT_EQ(entered, 1);
  EXPECT_EQ(left, 1);
}

TEST(JudgeSensors, a_corner_of_the_way_inside_a_sensor_is_no_event) {
  Judge judge(header({sensor(box(-1, -1, 1, 1))}));
  const StepJudgement judged = judge.judge(step({{-4, 0}, {0, 0}, {0, 0.25}, {4, 0}}));
  ASSERT_EQ(judged.sensor_events.size(), 2U);
  EXPECT_EQ(judged.sensor_events[0].change, enter);
  EXPECT_EQ(judged.sensor_events[1].change, leave);
  EXPECT_EQ(judged.sensor_events[0].fraction, (Exact(4) - Exact(1.3125)) / 4 * (Exact(1.0 / 3)));
}

TEST(JudgeSensors, agree_with_overlap_tested_at_many_instants) {
  constexpr std::uint64_t seed = 51;
  Random random(seed);
  int events = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2d centre = random.point(1);
    const ColliderDef shape = polygon(star(random, centre, 1, 3 + random.below(6)));
    const ExactScenery sensors(scenery({moving(sensor(shape))}), octagon());
    const ExactScenery solids(scenery({moving(shape)}), octagon());
    const std::vector<MoverMotion<double>> movers{{random.point(1), random.point(1)}};
    const double turn = random.between(0.1, 0.9);
    const std::vector<Place> path{
        {random.point(3), movers, 0}, {random.point(2), movers, turn}, {random.point(3), movers, 1}};
    bool inside = solids.overlaps(path[0], 0);
    const std::vector<ExactSensorEvent> found = sensors.sensor_events(path);
    events += static_cast<int>(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].change, inside ? leave : enter) << "seed " << seed << " round " << i;
      inside = !inside;
    }
    EXPECT_EQ(inside, solids.overlaps(path[2], 0)) << "seed " << seed << " round " << i;
    // Half-way between two events the overlap is what the events say.
    inside = solids.overlaps(path[0], 0);
    for (std::size_t k = 0; k <= found.size(); ++k) {
      const double begin = k == 0 ? 0 : static_cast<double>(found[k - 1].fraction);
      const double end = k == found.size() ? 1 : static_cast<double>(found[k].fraction);
      const double t = (begin + end) / 2;
      const Vec2d at = t < turn
                           ? Vec2d(path[0].position + t / turn * (path[1].position - path[0].position))
                           : Vec2d(path[1].position + (t - turn) / (1 - turn) * (path[2].position - path[1].position));
      if (end - begin > 1e-9) {
        EXPECT_EQ(solids.overlaps(Place(at, movers, t), 0), inside) << "seed " << seed << " round " << i;
      }
      inside = !inside;
    }
  }
  EXPECT_GT(events, 200);
}

/// Kept at a contact [m].
constexpr double kept = 5e-7;

bool is_deflected(const TraceHeader& header, TraceStep step, const Contact<double>& first,
                  const Contact<double>& second) {
  step.requested.setZero();
  step.contacts = {first, second};
  const StepJudgement judged = Judge(header).judge(step);
  const auto& deflected = judged.deflected;
  return std::find(deflected.begin(), deflected.end(), std::pair(second.collider, second.side)) != deflected.end();
}

/// A corner of a box touches the octagon's lower right flank, whose middle is at (0.234375, -0.46875), and goes left:
/// it pushes the octagon up against a ceiling. If it goes right, nothing does.
TEST(JudgeMovers, a_contact_into_which_a_mover_pushes_is_right) {
  const Vec2d flank = Vec2d(-2, 1).normalized();
  const Vec2d corner = Vec2d(0.234375, -0.46875) - kept * flank;
  const TraceHeader there =
      promising({moving(box(corner.x(), corner.y() - 0.5, corner.x() + 1, corner.y())), box(-4, 0.625 + kept, 4, 2)});
  for (const double way : {-0.125, 0.125}) {
    const TraceStep pushed = leg({0, 0}, {std::min(way, 0.0), 0}, {{{0, 0}, {way, 0}}});
    EXPECT_EQ(is_deflected(there, pushed,
                           {.collider = 0, .point = corner, .normal = flank, .separation = kept, .side = Side::right},
                           {.collider = 1, .normal = {0, -1}, .separation = kept, .side = Side::top}),
              way < 0);
  }
}

/// A floor comes up under the octagon beside a wall: it carries to the left, into the wall, or to the right.
TEST(JudgeMovers, a_contact_into_which_ground_carries_is_right) {
  const TraceHeader there = promising({moving(box(-0.5, -2, 4, -1)), box(-2, -0.5, -0.3125 - kept, 2)});
  constexpr double rise = 0.5;
  constexpr double met = (1 - 0.625) / rise;
  for (const double way : {-0.125, 0.125}) {
    const TraceStep carried =
        among(step({{0, 0}, {0, 0}, {std::max(0.0, way * (1 - met)), rise * (1 - met)}}), {{{0, 0}, {way, rise}}});
    TraceStep at_its_time = carried;
    at_its_time.path[1] = {{0, 0}, met - 2 * kept / rise};
    EXPECT_EQ(is_deflected(there, at_its_time,
                           {.collider = 0, .normal = {0, 1}, .fraction = met, .separation = kept, .side = Side::bottom},
                           {.collider = 1, .normal = {1, 0}, .fraction = met, .separation = kept, .side = Side::left}),
              way < 0);
  }
}

/// A walker runs into a corner of a box with his lower right flank, and goes on with the box, along that normal: down,
/// onto the floor, if the box goes away.
TEST(JudgeMovers, a_contact_into_which_a_face_leads_that_ends_the_motion_is_right) {
  const Vec2d flank = Vec2d(-2, 1).normalized();
  const Vec2d corner = Vec2d(0.234375, -0.46875) - kept * flank;
  const TraceHeader there =
      promising({moving(box(corner.x(), corner.y() - 0.1, corner.x() + 1, corner.y())), box(-4, -2, 4, -0.625 - kept)});
  for (const double way : {-0.05, 0.0, 0.05}) {
    TraceStep walk = leg({0, 0}, {std::max(0.8 * way, -0.05), 0}, {{{0, 0}, {way, 0}}});
    walk.requested = {0.3, 0};
    walk.contacts = {{.collider = 0, .point = corner, .normal = flank, .separation = kept, .side = Side::right},
                     {.collider = 1, .normal = {0, 1}, .separation = kept, .side = Side::bottom}};
    const StepJudgement judged = Judge(there).judge(walk);
    EXPECT_EQ(!judged.deflected.empty(), way > 0) << way;
  }
}

}  // namespace
}  // namespace paperproof::compare
