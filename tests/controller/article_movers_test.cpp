/// The article's techniques among movers: what pushes, what carries, what crushes.
#include "controller/passenger.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::article_tests {
namespace {

constexpr double rounding = 1e-12;
constexpr double gap = Tolerances<double>{}.stop;
constexpr std::array moving_kinds{"discrete", "penetration_resolution", "speculative_march", "speculative"};
constexpr std::array carrying_kinds{"discrete", "speculative_march", "speculative"};

/// That a technique leaves to what stands still before it [m].
double gap_of(std::string_view kind) { return kind == "discrete" ? gap : 0; }
/// By how much more that may be: the march stops up to a unit short [m].
double slack_of(std::string_view kind) { return kind == "speculative_march" ? px : rounding; }

TEST(MovingPaper, that_sweeps_over_a_resting_character_pushes_it_from_the_time_of_impact_on) {
  // From 2 m on the left by 5 m to the right; the arm is at -10 px. The march sees no paper that is thinner than a
  // unit.
  const ColliderDef line = of_mover(chain({{-2, -2}, {-2, 2}}));
  for (const std::string_view kind : speculative_kinds) {
    SCOPED_TRACE(kind);
    const double thickness = kind == "speculative" ? 0.0001 : 1.5 * px;
    for (const ColliderDef& mover : {of_mover(rectangle(-2 - thickness, -2, -2, 2)), line}) {
      Passenger passenger(kind, {mover});
      const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {5, 0}}});
      const double slack = slack_of(kind);
      EXPECT_NEAR(result.position.x(), 3 + half_width, slack);
      EXPECT_GE(result.position.x(), 3 + half_width) << "on the side that it was on";
      EXPECT_EQ(result.position.y(), 0);
      EXPECT_EQ(result.velocity, Vec2d(5, 0));
      const Contact<double>& contact = only_contact(result);
      EXPECT_EQ(contact.side, Side::left);
      EXPECT_NEAR(contact.fraction, (2 - half_width) / 5, slack / 4);
      EXPECT_EQ(contact.normal, Vec2d(1, 0));
      EXPECT_NEAR(contact.point.x(), -half_width, slack) << "where it was at that time";
      EXPECT_NEAR(contact.separation, 0, slack);
      ASSERT_EQ(result.path.size(), 3U);
      EXPECT_EQ(result.path[1].position, Vec2d(0, 0)) << "it rests until then";
      EXPECT_EQ(result.path[1].fraction, contact.fraction);
    }
  }
}

TEST(MovingPaper, passes_one_who_looks_only_at_where_things_arrive) {
  for (const std::string_view kind : {"discrete", "penetration_resolution"}) {
    SCOPED_TRACE(kind);
    Passenger passenger(kind, {of_mover(rectangle(-2.01, -2, -2, 2))});
    EXPECT_TRUE(passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {5, 0}}}).contacts.empty());
    EXPECT_EQ(passenger.position, Vec2d(0, 0));
  }
}

TEST(MovingBlock, that_arrives_over_a_resting_character_pushes_it_by_units_or_by_what_it_would_overlap) {
  // Its right face arrives 4.5 px inside the left arm: five units, or 4.5 px and the gap.
  const double by = 2 - half_width + 4.5 * px;
  for (const std::string_view kind : {"discrete", "penetration_resolution"}) {
    SCOPED_TRACE(kind);
    const bool by_units = kind == "penetration_resolution";
    Passenger passenger(kind, {of_mover(rectangle(-6, -2, -2, 2))});
    const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {by, 0}}});
    EXPECT_NEAR(result.position.x(), by_units ? 5 * px : 4.5 * px + gap, by_units ? 0 : rounding);
    EXPECT_EQ(result.position.y(), 0);
    EXPECT_EQ(result.velocity, Vec2d(by, 0));
    EXPECT_EQ(result.status, MoveStatus::moved);
    EXPECT_EQ(only_contact(result).side, Side::left);
    EXPECT_NEAR(only_contact(result).fraction, by_units ? 1 : (2 - half_width) / by, rounding);
    EXPECT_NEAR(only_contact(result).separation, by_units ? px / 2 : gap, rounding);
  }
}

TEST(MovingPaper, head_on_adds_its_speed) {
  for (const std::string_view kind : carrying_kinds) {
    SCOPED_TRACE(kind);
    const double thickness = kind == "discrete" ? 36 : 1.5 * px;
    Passenger passenger(kind, {of_mover(rectangle(4, -2, 4 + thickness, 2))});
    const MoveResult<double>& result = passenger.fly({0, 0}, {3, 0}, {{{0, 0}, {-5, 0}}});
    EXPECT_NEAR(only_contact(result).fraction, (4 - half_width) / (3 + 5), slack_of(kind) / 8);
    const double end = 4 - 5 - half_width - gap_of(kind);
    EXPECT_NEAR(result.position.x(), end, slack_of(kind));
    EXPECT_LE(result.position.x(), end + rounding);
    EXPECT_EQ(result.velocity.x(), -5);
  }
}

TEST(SeveralMovers, are_met_in_order_of_time_and_not_of_number_or_side) {
  // From the left at 16 m/s, 3 m away; from above at 8 m/s, 1 m away; from the right at 2 m/s.
  const std::vector<ColliderDef> papers{of_mover(rectangle(-3.01 - half_width, -9, -3 - half_width, 9), 0),
                                        of_mover(rectangle(-9, 1 + half_height, 9, 1.01 + half_height), 1),
                                        of_mover(rectangle(15, -9, 15.01, 9), 2)};
  Passenger passenger("speculative", papers);
  const MoveResult<double>& result =
      passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {16, 0}}, {{0, 0}, {0, -8}}, {{0, 0}, {-2, 0}}});
  ASSERT_GE(result.contacts.size(), 3U);  // then the first runs over the feet
  // Pushed to the right by the first, against the third: (15 - 10 px) - 16 (t - 3/16) = 2 t.
  const std::array times{1.0 / 8, 3.0 / 16, (15 - half_width + 3) / 18};
  const std::array<ColliderIndex, 3> order{1, 0, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(result.contacts[i].collider, order[i]) << i;
    EXPECT_NEAR(result.contacts[i].fraction, times[i], rounding) << i;
  }
}

TEST(Riding, keeps_its_place_on_the_mover_and_its_contact_from_the_first_step_on) {
  for (const Vec2d& reach : {Vec2d{0, 3}, Vec2d{5, 0}, Vec2d{-4, 2.5}}) {
    for (const std::string_view kind : carrying_kinds) {
      SCOPED_TRACE(kind);
      Passenger passenger(kind, {rectangle(-90, -9, 90, -5), of_mover(rectangle(-2, -1, 2, 0))});
      passenger.position = {0.3, half_height + gap_of(kind)};
      Vec2d place{Vec2d::Zero()};
      Motions motions(1);
      const std::size_t before = tests::allocations();
      for (int step = 0; step < test::sampled(20000); ++step) {
        const MoverMotion<double>& motion = motions[0] = {swing(reach, step), swing(reach, step + 1)};
        const MoveResult<double>& result = passenger.step(motions);
        ASSERT_TRUE(result.grounded) << "step " << step;
        ASSERT_EQ(result.ride.ground, 1U) << "step " << step;
        ASSERT_EQ(result.contacts.size(), 1U) << "step " << step;
        ASSERT_EQ(result.position, motion.to + result.ride.place) << "step " << step;
        ASSERT_EQ(result.velocity, Vec2d((motion.to - motion.from) / passenger.dt)) << "step " << step;
        if (step == 0) place = result.ride.place;
        ASSERT_LE((result.ride.place - place).norm(), gap_of(kind) > 0 ? rounding : 0) << "step " << step;
      }
      EXPECT_EQ(tests::allocations(), before);
      // With a gap, the lift has gone on a little until the first fall has closed it.
      EXPECT_NEAR(place.x(), 0.3, gap);
    }
  }
}

TEST(Riding, is_walked_relative_to_the_ground_and_ends_with_its_momentum) {
  Passenger passenger("speculative", {of_mover(rectangle(-20, -1, 20, 0))});
  passenger.position = {0, half_height};
  const auto motion = [](int step) {
    return MoverMotion<double>{{0.125 * step, 0.0625 * step}, {0.125 * (step + 1), 0.0625 * (step + 1)}};
  };
  for (int step = 0; step < 64; ++step) {
    if (step > 0) passenger.velocity.x() = passenger.ride.velocity.x() + 2;  // 1/32 m per step
    passenger.step({motion(step)});
    ASSERT_NEAR(passenger.position.x(), 0.125 * (step + 1) + step / 32.0, rounding);
    ASSERT_NEAR(passenger.position.y(), half_height + 0.0625 * (step + 1), rounding);
    ASSERT_TRUE(passenger.rig.result.grounded);
    ASSERT_EQ(passenger.velocity, Vec2d(step > 0 ? 10 : 8, 4)) << "64 steps per second";
  }
  passenger.velocity.y() += 12;  // a jump from the lift: 12 m/s relative to it
  const Vec2d from = passenger.position;
  const MoveResult<double>& result = passenger.step({motion(64)});
  EXPECT_EQ(result.ride.ground, Ride<double>::none);
  EXPECT_EQ(result.velocity, Vec2d(10, 4 + 12 - 0.5));
  EXPECT_LE((result.position - from - Vec2d(10, 15.5) / 64).norm(), rounding);
}

TEST(ClosingWalls, crush_at_the_step_that_the_gap_gives) {
  // The ceiling comes down at 1/64 m per step onto a character of 40 px, from 40 px + room above the floor.
  const double room = 10.4 / 64;
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Passenger passenger(kind, {rectangle(-9, -3, 9, 0), of_mover(rectangle(-9, 2 * half_height + room, 9, 9))});
    passenger.position = {0, half_height + gap_of(kind)};
    int crushed_at = 0;
    Motions motions(1);
    const std::size_t before = tests::allocations();
    for (int step = 1; step <= 30; ++step) {
      motions[0] = {{0, -(step - 1) / 64.0}, {0, -step / 64.0}};
      const MoveResult<double>& result = passenger.step(motions);
      ASSERT_GE(passenger.position.y(), half_height - rounding) << "never pushed into the floor";
      ASSERT_LE(passenger.position.y(), half_height + px);
      if (result.status != MoveStatus::crushed) continue;
      if (crushed_at == 0) crushed_at = step;
      ASSERT_EQ(result.crushed.size(), 1U);
      EXPECT_EQ(result.crushed[0], 1U);
    }
    EXPECT_EQ(tests::allocations(), before);
    // Who searches stands up to a unit, two steps of the ceiling, above the floor.
    const bool exact = kind == "speculative" || kind == "discrete";
    EXPECT_GE(crushed_at, exact ? 11 : 9);
    EXPECT_LE(crushed_at, 11);
  }
}

TEST(ClosingWalls, a_line_without_thickness_crushes_too) {
  Passenger passenger("speculative", {rectangle(1, -9, 2, 9), of_mover(chain({{-2, -9}, {-2, 9}}))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {2.5, 0}}});
  EXPECT_EQ(result.status, MoveStatus::crushed);
  ASSERT_EQ(result.crushed.size(), 1U);
  EXPECT_EQ(result.crushed[0], 1U);
  EXPECT_NEAR(result.position.x(), 1 - half_width, rounding) << "pushed as far as the wall and no farther";
}

TEST(ClosingWalls, a_push_stops_at_thin_paper_that_stands_still) {
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    // What is thinner than a unit the march does not see, whoever moves.
    const double thickness = kind == "speculative_march" ? 1.5 * px : 0.001;
    Passenger passenger(kind, {rectangle(0.5, -9, 0.5 + thickness, 9), of_mover(rectangle(-6, -2, -2, 2))});
    const double by = kind == "discrete" ? 4 : 2 - half_width + 20 * px;
    const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {by, 0}}});
    EXPECT_EQ(result.status, MoveStatus::crushed);
    ASSERT_EQ(result.crushed.size(), 1U);
    EXPECT_EQ(result.crushed[0], 1U);
    EXPECT_LE(result.position.x(), 0.5 - half_width);
    if (kind != "discrete") continue;
    EXPECT_EQ(result.position, Vec2d(0, 0)) << "its last free position";
    EXPECT_EQ(result.velocity, Vec2d(0, 0));
  }
}

TEST(Conveyor, carries_what_stands_on_it_and_no_farther_than_a_wall) {
  for (const std::string_view kind : carrying_kinds) {
    SCOPED_TRACE(kind);
    Passenger passenger(kind, {conveyor(rectangle(-9, -1, 9, 0), 2), rectangle(2, 0, 3, 5)});
    passenger.position = {0, half_height + gap_of(kind)};
    // With a gap, in the first step only from the time on at which the fall has closed it.
    const double first = gap_of(kind) > 0 ? 1.0 / 32 : 0;
    for (int step = 1; step <= 30; ++step) {
      passenger.step({});
      ASSERT_NEAR(passenger.position.x(), step / 32.0, first);
      ASSERT_NEAR(passenger.position.y(), half_height, gap_of(kind) + (first > 0 ? rounding : 0));
      ASSERT_EQ(passenger.ride.ground, 0U);
      ASSERT_EQ(passenger.velocity.x(), 2);
    }
    for (int step = 0; step < 60; ++step) passenger.step({});
    EXPECT_NEAR(passenger.position.x(), 2 - half_width, px);
    EXPECT_LE(passenger.position.x(), 2 - half_width);
  }
}

TEST(MovingLine, never_gets_past_whom_it_pushes_however_both_move) {
  Random random(31);
  int pushes = 0;
  for (int run = 0; run < 200; ++run) {
    Passenger passenger("speculative", {rectangle(-900, -9, 900, 0), of_mover(chain({{0, -50}, {0, 50}}))});
    passenger.position = {11 * px, half_height};
    MoverMotion<double> motion;
    for (int step = 0; step < 60; ++step) {
      motion = {motion.to, motion.to + Vec2d{random.between(-0.2, 0.8), random.between(-0.3, 0.3)}};
      passenger.velocity.x() = passenger.ride.velocity.x() + random.between(-30, 20);
      const MoveResult<double>& result = passenger.step({motion});
      ASSERT_GT(passenger.position.x() - half_width, motion.to.x()) << "seed 31, run " << run << ", step " << step;
      ASSERT_NEAR(passenger.position.y(), half_height, rounding) << "seed 31, run " << run << ", step " << step;
      pushes += result.contacts.size() > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(pushes, 200 * 60 * 3 / 10);
  EXPECT_LT(pushes, 200 * 60 * 9 / 10);
}

TEST(StandingMovers, are_scenery_like_any_other) {
  // A mover that does not move in the step, wherever it has come to, holds what a static collider there would.
  const Vec2d offset{0.5, 0.25};
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Passenger passenger(kind, {of_mover(rectangle(-2.5, -2.25, 1.5, -0.25))});
    const MoveResult<double>& result = passenger.fly({0, 24 * px}, {10 * px, -10.25 * px}, {{offset, offset}});
    Rig<double> fixed(kind, {rectangle(-2, -2, 2, 0)});
    const MoveResult<double>& expected = fixed.move({0, 24 * px}, {10 * px, -10.25 * px});
    EXPECT_NEAR((result.position - expected.position).norm(), 0, 1e-14);
    EXPECT_EQ(result.velocity, expected.velocity);
    EXPECT_EQ(result.grounded, expected.grounded);
    EXPECT_EQ(result.ride.ground, 0U) << "it may move on in the next step";
  }
}

TEST(MovingRefusals, of_steps_that_movers_or_conveyors_make_too_long) {
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Passenger by_mover(kind, {of_mover(rectangle(5, 5, 6, 6))});
    EXPECT_EQ(by_mover.fly({1, 1}, {1, 0}, {{{0, 0}, {1e9, 0}}}).status, MoveStatus::out_of_range);
    EXPECT_EQ(by_mover.position, Vec2d(1, 1));
    Passenger by_conveyor(kind, {conveyor(rectangle(-9, -1, 9, 0), 1e300)});
    EXPECT_EQ(by_conveyor.fly({0, 1}, {0, -2}, {}).status, MoveStatus::out_of_range);
    EXPECT_EQ(by_conveyor.position, Vec2d(0, 1));
  }
}

TEST(MovingRefusals, of_techniques_for_scenery_that_stands_still_say_so) {
  const auto refusal = [](std::string_view kind, const ColliderDef& collider) {
    return refusal_by<NotExpressible>([&] { Rig<double>(kind, {collider}); });
  };
  const ColliderDef mover = of_mover(rectangle(0, 0, 1, 1));
  const ColliderDef belt = conveyor(rectangle(0, 0, 1, 1), 1);
  for (const std::string_view kind : {"grid", "pixel_colour", "pixel_tile", "mask", "wind_back"})
    for (const ColliderDef& each : {mover, belt})
      EXPECT_EQ(refusal(kind, each), std::string(kind) + " is for scenery that stands still");
  EXPECT_EQ(refusal("bounding_box", mover), "");
  EXPECT_EQ(refusal("bounding_box", belt), "bounding_box carries nobody: there is a conveyor");
}

}  // namespace
}  // namespace paperproof::article_tests
