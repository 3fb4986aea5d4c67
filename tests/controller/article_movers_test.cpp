/// The article's techniques among movers: what pushes, what carries, what crushes.
#include "controller/passenger.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace paperproof::article_tests {
namespace {

constexpr std::array moving_kinds{"penetration_resolution", "speculative_march", "speculative"};

TEST(MovingPaper, that_sweeps_over_a_resting_character_pushes_it_from_the_time_of_impact_on) {
  // From 2 m on the left by 5 m to the right; the arm is at -10 px. The march sees no paper that is thinner than a
  // unit.
  const ColliderDef line = of_mover(chain({{-2, -2}, {-2, 2}}));
  for (const std::string_view kind : speculative_kinds) {
    const double thickness = kind == "speculative" ? 0.0001 : 1.5 * px;
    for (const ColliderDef& mover : {of_mover(rectangle(-2 - thickness, -2, -2, 2)), line}) {
      Passenger passenger(kind, {mover});
      const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {5, 0}}});
      const double slack = kind == "speculative" ? 1e-12 : px;  // the march stops up to a unit short
      EXPECT_NEAR(result.position.x(), 3 + 10 * px, slack) << kind;
      EXPECT_GE(result.position.x(), 3 + 10 * px) << "on the side that it was on: " << kind;
      EXPECT_EQ(result.position.y(), 0);
      EXPECT_EQ(result.velocity, Vec2d(5, 0)) << kind;
      const Contact<double>& contact = only_contact(result);
      EXPECT_EQ(contact.side, Side::left);
      EXPECT_NEAR(contact.fraction, (2 - 10 * px) / 5, slack / 4) << kind;
      EXPECT_EQ(contact.normal, Vec2d(1, 0));
      EXPECT_NEAR(contact.point.x(), -10 * px, slack) << "where it was at that time: " << kind;
      EXPECT_NEAR(contact.separation, 0, slack);
      ASSERT_EQ(result.path.size(), 3U);
      EXPECT_EQ(result.path[1].position, Vec2d(0, 0)) << "it rests until then: " << kind;
      EXPECT_EQ(result.path[1].fraction, contact.fraction);
    }
  }
}

TEST(MovingPaper, sweeps_over_one_who_looks_only_at_where_things_arrive) {
  Passenger passenger("penetration_resolution", {of_mover(rectangle(-2.01, -2, -2, 2))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {5, 0}}});
  EXPECT_EQ(result.position, Vec2d(0, 0));
  EXPECT_TRUE(result.contacts.empty());
}

TEST(MovingBlock, that_arrives_over_a_resting_character_pushes_it_out_by_units) {
  // Its right face arrives 4.5 px inside the left arm: five units.
  Passenger passenger("penetration_resolution", {of_mover(rectangle(-4, -2, -2, 2))});
  const double by = 2 - 10 * px + 4.5 * px;
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {by, 0}}});
  EXPECT_EQ(result.position, Vec2d(5 * px, 0));
  EXPECT_EQ(only_contact(result).side, Side::left);
  EXPECT_EQ(result.velocity, Vec2d(by, 0));
  EXPECT_EQ(result.status, MoveStatus::moved);
}

TEST(MovingPaper, head_on_the_speeds_add_up) {
  for (const std::string_view kind : speculative_kinds) {
    Passenger passenger(kind, {of_mover(rectangle(4, -2, 4 + 1.5 * px, 2))});
    const MoveResult<double>& result = passenger.fly({0, 0}, {3, 0}, {{{0, 0}, {-5, 0}}});
    const double slack = kind == "speculative" ? 1e-12 : px / 8;
    EXPECT_NEAR(only_contact(result).fraction, (4 - 10 * px) / (3 + 5), slack) << kind;
    EXPECT_NEAR(result.position.x(), 4 - 5 - 10 * px, px) << kind;
    EXPECT_LE(result.position.x(), 4 - 5 - 10 * px) << kind;
    EXPECT_EQ(result.velocity.x(), -5);
  }
}

TEST(MovingPaper, that_flees_faster_than_the_character_is_not_met) {
  for (const std::string_view kind : moving_kinds) {
    Passenger passenger(kind, {of_mover(rectangle(1, -2, 1.5, 2))});
    EXPECT_TRUE(passenger.fly({0, 0}, {3, 0}, {{{0, 0}, {4, 0}}}).contacts.empty()) << kind;
    EXPECT_EQ(passenger.position, Vec2d(3, 0)) << kind;
  }
}

TEST(SeveralMovers, are_met_in_order_of_time_and_not_of_number_or_side) {
  // From the left at 16 m/s, 3 m away; from above at 8 m/s, 1 m away; from the right at 2 m/s.
  const std::vector<ColliderDef> papers{of_mover(rectangle(-3.01 - 10 * px, -9, -3 - 10 * px, 9), 0),
                                        of_mover(rectangle(-9, 1 + 20 * px, 9, 1.01 + 20 * px), 1),
                                        of_mover(rectangle(15, -9, 15.01, 9), 2)};
  Passenger passenger("speculative", papers);
  const MoveResult<double>& result =
      passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {16, 0}}, {{0, 0}, {0, -8}}, {{0, 0}, {-2, 0}}});
  ASSERT_GE(result.contacts.size(), 3U);  // then the first runs over the feet
  EXPECT_EQ(result.contacts[0].collider, 1U);
  EXPECT_NEAR(result.contacts[0].fraction, 1.0 / 8, 1e-12);
  EXPECT_EQ(result.contacts[1].collider, 0U);
  EXPECT_NEAR(result.contacts[1].fraction, 3.0 / 16, 1e-12);
  // Pushed to the right since then, against the third: (15 - 10 px) - 16 (t - 3/16) = 2 t.
  EXPECT_EQ(result.contacts[2].collider, 2U);
  EXPECT_NEAR(result.contacts[2].fraction, (15 - 10 * px + 3) / 18, 1e-12);
}

TEST(SeveralMovers, that_close_on_a_character_crush_it) {
  Passenger passenger("speculative", {of_mover(rectangle(-5, -9, -2, 9), 0), of_mover(rectangle(2, -9, 5, 9), 1)});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {1.9, 0}}, {{0, 0}, {-1.9, 0}}});
  EXPECT_EQ(result.status, MoveStatus::crushed);
  EXPECT_EQ(result.crushed.size(), 2U);
  EXPECT_TRUE(std::isfinite(result.position.x()));
}

TEST(Riding, keeps_its_place_on_the_mover_to_the_last_bit) {
  for (const Vec2d& reach : {Vec2d{0, 3}, Vec2d{5, 0}, Vec2d{-4, 2.5}}) {
    for (const std::string_view kind : speculative_kinds) {
      Passenger passenger(kind, {rectangle(-90, -9, 90, -5), of_mover(rectangle(-2, -1, 2, 0))});
      passenger.position = {0.3, 20 * px};
      Vec2d place;
      for (int step = 0; step < test::sampled(20000); ++step) {
        const MoverMotion<double> motion{swing(reach, step), swing(reach, step + 1)};
        const MoveResult<double>& result = passenger.step({motion});
        ASSERT_TRUE(result.grounded) << kind << ", step " << step;
        ASSERT_EQ(result.ride.ground, 1U);
        ASSERT_EQ(result.contacts.size(), 1U) << "one contact, in every step";
        ASSERT_EQ(result.position, motion.to + result.ride.place);
        if (step == 0) place = result.ride.place;
        ASSERT_EQ(result.ride.place, place) << kind << ", step " << step;
        ASSERT_EQ(result.velocity, Vec2d((motion.to - motion.from) / passenger.dt));
      }
    }
  }
}

TEST(Riding, begins_where_a_fall_onto_a_rising_lift_ends) {
  // 4 m above a lift that rises at 2 m per step, falling 6 m: they meet at t = 4/8, then rise together.
  for (const std::string_view kind : speculative_kinds) {
    Passenger passenger(kind, {of_mover(rectangle(-2, -1, 2, 0))});
    const MoveResult<double>& result = passenger.fly({0, 4 + 20 * px}, {0, -6}, {{{0, 0}, {0, 2}}});
    EXPECT_NEAR(only_contact(result).fraction, 0.5, px) << kind;
    EXPECT_NEAR(result.position.y(), 2 + 20 * px, px) << kind;
    EXPECT_GE(result.position.y(), 2 + 20 * px) << kind;
    EXPECT_EQ(result.velocity.y(), 2) << kind;
    EXPECT_EQ(result.ride.ground, 0U);
    EXPECT_EQ(result.ride.velocity, Vec2d(0, 2));
  }
}

TEST(Riding, a_walk_on_a_lift_is_relative_to_it_and_stays_on_its_surface) {
  Passenger passenger("speculative", {of_mover(rectangle(-20, -1, 20, 0))});
  passenger.position = {0, 20 * px};
  const auto motion = [](int step) {
    return MoverMotion<double>{{0.0625 * step, 0.125 * step}, {0.0625 * (step + 1), 0.125 * (step + 1)}};
  };
  passenger.step({motion(0)});
  for (int step = 1; step < 64; ++step) {
    passenger.velocity.x() = passenger.ride.velocity.x() + 2;  // 1/32 m per step
    passenger.step({motion(step)});
    ASSERT_NEAR(passenger.position.x(), 0.0625 * (step + 1) + step / 32.0, 1e-12);
    ASSERT_NEAR(passenger.position.y(), 20 * px + 0.125 * (step + 1), 1e-12);
    ASSERT_TRUE(passenger.rig.result.grounded);
  }
}

TEST(Riding, ends_with_the_ground_s_momentum) {
  Passenger passenger("speculative", {of_mover(rectangle(-2, -1, 2, 0))});
  passenger.position = {0, 20 * px};
  passenger.step({{{0, 0}, {0.125, 0.0625}}});
  EXPECT_EQ(passenger.velocity, Vec2d(8, 4)) << "64 steps per second";
  passenger.velocity.y() += 12;  // a jump from the lift: 12 m/s relative to it
  const MoveResult<double>& result = passenger.step({{{0.125, 0.0625}, {0.25, 0.125}}});
  EXPECT_EQ(result.ride.ground, Ride<double>::none);
  EXPECT_EQ(result.velocity, Vec2d(8, 4 + 12 - 0.5));
  EXPECT_NEAR(result.position.y(), 20 * px + 0.0625 + 15.5 / 64, 1e-12);
  EXPECT_NEAR(result.position.x(), 0.25, 1e-12);
}

TEST(Riding, into_a_wall_that_stands_still_the_character_stops_and_the_lift_goes_on) {
  for (const std::string_view kind : speculative_kinds) {
    Passenger passenger(kind, {rectangle(3, -9, 4, 9), of_mover(rectangle(-2, -1, 2, 0))});
    passenger.position = {0, 20 * px};
    for (int step = 0; step < 100; ++step) passenger.step({{{0.05 * step, 0}, {0.05 * (step + 1), 0}}});
    // The lift is below the wall by now, the character still before it, on the lift until that is gone.
    EXPECT_NEAR(passenger.position.x(), 3 - 10 * px, px) << kind;
    EXPECT_LE(passenger.position.x(), 3 - 10 * px) << kind;
    EXPECT_NE(passenger.rig.result.status, MoveStatus::crushed) << kind;
  }
}

TEST(ClosingWalls, crush_at_the_step_that_the_gap_gives) {
  // The ceiling comes down at 1/64 m per step onto a character of 40 px, from 40 px + gap above the floor.
  const double gap = 10.4 / 64;
  for (const std::string_view kind : moving_kinds) {
    Passenger passenger(kind, {rectangle(-9, -3, 9, 0), of_mover(rectangle(-9, 40 * px + gap, 9, 9))});
    passenger.position = {0, 20 * px};
    int crushed_at = 0;
    for (int step = 1; step <= 30; ++step) {
      const MoveResult<double>& result = passenger.step({{{0, -(step - 1) / 64.0}, {0, -step / 64.0}}});
      ASSERT_GE(passenger.position.y(), 20 * px - 1e-12) << "never pushed into the floor: " << kind;
      ASSERT_LE(passenger.position.y(), 20 * px + px) << kind;
      if (result.status == MoveStatus::crushed && crushed_at == 0) crushed_at = step;
      if (result.status == MoveStatus::crushed) {
        EXPECT_EQ(result.crushed.size(), 1U);
        EXPECT_EQ(result.crushed[0], 1U);
      }
    }
    if (kind == "speculative") {
      EXPECT_EQ(crushed_at, 11);
    } else {
      EXPECT_GE(crushed_at, 9) << kind;  // stands up to a unit, two steps of the ceiling, above the floor
      EXPECT_LE(crushed_at, 11) << kind;
    }
  }
}

TEST(ClosingWalls, a_line_without_thickness_crushes_too) {
  Passenger passenger("speculative", {rectangle(1, -9, 2, 9), of_mover(chain({{-2, -9}, {-2, 9}}))});
  const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {2.5, 0}}});
  EXPECT_EQ(result.status, MoveStatus::crushed);
  ASSERT_EQ(result.crushed.size(), 1U);
  EXPECT_EQ(result.crushed[0], 1U);
  EXPECT_NEAR(result.position.x(), 1 - 10 * px, 1e-12) << "pushed as far as the wall and no farther";
}

TEST(ClosingWalls, a_push_stops_at_thin_paper_that_stands_still) {
  for (const std::string_view kind : moving_kinds) {
    // What is thinner than a unit the march does not see, whoever moves.
    const double thickness = kind == "speculative_march" ? 1.5 * px : 0.001;
    Passenger passenger(kind, {rectangle(0.5, -9, 0.5 + thickness, 9), of_mover(rectangle(-4, -2, -2, 2))});
    const double by = 2 - 10 * px + 20 * px;
    const MoveResult<double>& result = passenger.fly({0, 0}, {0, 0}, {{{0, 0}, {by, 0}}});
    EXPECT_EQ(result.status, MoveStatus::crushed) << kind;
    EXPECT_LE(result.position.x(), 0.5 - 10 * px) << kind;
  }
}

TEST(Conveyor, carries_what_stands_on_it_and_no_farther_than_a_wall) {
  for (const std::string_view kind : speculative_kinds) {
    Passenger passenger(kind, {conveyor(rectangle(-9, -1, 9, 0), 2), rectangle(2, 0, 3, 5)});
    passenger.position = {0, 20 * px};
    for (int step = 1; step <= 30; ++step) {
      passenger.step({});
      ASSERT_EQ(passenger.position, Vec2d(step / 32.0, 20 * px)) << kind;
      ASSERT_EQ(passenger.ride.ground, 0U);
      ASSERT_EQ(passenger.velocity.x(), 2) << kind;
    }
    for (int step = 0; step < 60; ++step) passenger.step({});
    EXPECT_NEAR(passenger.position.x(), 2 - 10 * px, px) << kind;
    EXPECT_LE(passenger.position.x(), 2 - 10 * px) << kind;
  }
}

TEST(MovingOneWay, passes_from_below_and_carries_from_above) {
  for (const std::string_view kind : speculative_kinds) {
    Passenger rising(kind, {of_mover(chain({{-2, 0}, {2, 0}}, Vec2d{0, 1}))});
    EXPECT_TRUE(rising.fly({0, -3}, {0, 6}, {{{0, 0}, {0, 1}}}).contacts.empty()) << kind;
    Passenger falling(kind, {of_mover(chain({{-2, 0}, {2, 0}}, Vec2d{0, 1}))});
    const MoveResult<double>& result = falling.fly({0, 3}, {0, -6}, {{{0, 0}, {0, 1}}});
    EXPECT_TRUE(result.grounded) << kind;
    EXPECT_GE(result.position.y(), 1 + 20 * px) << kind;
    EXPECT_NEAR(result.position.y(), 1 + 20 * px, px) << kind;
    Passenger under(kind, {of_mover(chain({{-2, 0}, {2, 0}}, Vec2d{0, 1}))});
    EXPECT_TRUE(under.fly({0, -2}, {0, 0}, {{{0, 0}, {0, -6}}}).contacts.empty()) << "comes down over it: " << kind;
  }
}

bool touched(const MoveResult<double>& result, ColliderIndex collider) {
  return std::any_of(result.contacts.begin(), result.contacts.end(),
                     [&](const Contact<double>& contact) { return contact.collider == collider; });
}

TEST(MovingLine, never_gets_past_whom_it_pushes_however_both_move) {
  Random random(31);
  int pushes = 0;
  for (int run = 0; run < 200; ++run) {
    Passenger passenger("speculative", {rectangle(-900, -9, 900, 0), of_mover(chain({{0, -50}, {0, 50}}))});
    passenger.position = {11 * px, 20 * px};
    Vec2d offset{0, 0};
    for (int step = 0; step < 60; ++step) {
      const MoverMotion<double> motion{offset, offset + Vec2d{random.between(-0.2, 0.8), random.between(-0.3, 0.3)}};
      offset = motion.to;
      passenger.velocity.x() = passenger.ride.velocity.x() + random.between(-30, 20);
      const MoveResult<double>& result = passenger.step({motion});
      ASSERT_GT(passenger.position.x() - 10 * px, offset.x()) << "run " << run << ", step " << step;
      ASSERT_NEAR(passenger.position.y(), 20 * px, 1e-12);
      pushes += touched(result, 1) ? 1 : 0;
    }
  }
  EXPECT_GT(pushes, 200 * 60 * 3 / 10);
  EXPECT_LT(pushes, 200 * 60 * 9 / 10);
}

/// The discrete technique too.
constexpr std::array all_moving_kinds{"discrete", "penetration_resolution", "speculative_march", "speculative"};

TEST(StandingMovers, are_scenery_like_any_other) {
  // A mover that does not move in the step, wherever it has come to, holds what a static collider there would.
  const Vec2d offset{0.5, 0.25};
  for (const std::string_view kind : all_moving_kinds) {
    Passenger passenger(kind, {of_mover(rectangle(-2.5, -2.25, 1.5, -0.25))});
    const MoveResult<double>& result = passenger.fly({0, 24 * px}, {10 * px, -10.25 * px}, {{offset, offset}});
    Rig<double> fixed(kind, {rectangle(-2, -2, 2, 0)});
    const MoveResult<double>& expected = fixed.move({0, 24 * px}, {10 * px, -10.25 * px});
    EXPECT_NEAR((result.position - expected.position).norm(), 0, 1e-14) << kind;
    EXPECT_EQ(result.velocity, expected.velocity) << kind;
    EXPECT_EQ(result.grounded, expected.grounded) << kind;
    EXPECT_EQ(result.ride.ground, 0U) << "it may move on in the next step";
  }
}

TEST(MovingRefusals, of_steps_that_movers_make_too_long) {
  const Motions far{{{0, 0}, {1e9, 0}}};
  for (const std::string_view kind : all_moving_kinds) {
    Passenger passenger(kind, {of_mover(rectangle(5, 5, 6, 6))});
    EXPECT_EQ(passenger.fly({1, 1}, {1, 0}, far).status, MoveStatus::out_of_range) << kind;
    EXPECT_EQ(passenger.position, Vec2d(1, 1)) << kind;
  }
}

TEST(MovingRefusals, of_steps_that_a_conveyor_would_make_too_long) {
  for (const std::string_view kind : all_moving_kinds) {
    Passenger passenger(kind, {conveyor(rectangle(-9, -1, 9, 0), 1e300)});
    EXPECT_EQ(passenger.fly({0, 1}, {0, -2}, {}).status, MoveStatus::out_of_range) << kind;
    EXPECT_EQ(passenger.position, Vec2d(0, 1)) << kind;
  }
}

TEST(MovingRefusals, of_techniques_for_scenery_that_stands_still_say_so) {
  const Scenery<double> movers(SceneryDef{{of_mover(rectangle(0, 0, 1, 1))}});
  const Scenery<double> conveyors(SceneryDef{{conveyor(rectangle(0, 0, 1, 1), 1)}});
  for (const std::string_view kind : {"grid", "pixel_colour", "pixel_tile", "mask", "wind_back"}) {
    for (const Scenery<double>* scenery : {&movers, &conveyors}) {
      try {
        (void)make_technique<double>({.name = kind}, *scenery, {});
        ADD_FAILURE() << kind << " was made";
      } catch (const NotExpressible& refusal) {
        EXPECT_EQ(std::string(refusal.what()), std::string(kind) + " is for scenery that stands still");
      }
    }
  }
}

TEST(MovingRefusals, of_bounding_boxes_are_for_conveyors_alone) {
  const Scenery<double> movers(SceneryDef{{of_mover(rectangle(0, 0, 1, 1))}});
  const Scenery<double> conveyors(SceneryDef{{conveyor(rectangle(0, 0, 1, 1), 1)}});
  EXPECT_NO_THROW((void)make_technique<double>({.name = "bounding_box"}, movers, {}));
  EXPECT_THROW((void)make_technique<double>({.name = "bounding_box"}, conveyors, {}), NotExpressible);
}

/// A box among others of which half move, with a character that flies and rides.
TEST(ManyMovers, leave_every_number_finite_and_nothing_pushed_into_what_stands_still) {
  for (const std::string_view kind : all_moving_kinds) {
    Random random(11);
    int crushed = 0;
    int pushed = 0;
    int rides = 0;
    constexpr int runs = test::sampled(300);
    for (int run = 0; run < runs; ++run) {
      std::vector<ColliderDef> colliders;
      for (int i = 0; i < 12; ++i) {
        const Vec2d corner{random.between(-4, 4), random.between(-4, 4)};
        const Vec2d opposite = corner + Vec2d{random.between(0.01, 2), random.between(0.01, 2)};
        colliders.push_back(rectangle(corner.x(), corner.y(), opposite.x(), opposite.y()));
        if (i >= 6) colliders.back().mover = static_cast<MoverIndex>(i - 6);
      }
      Passenger passenger(kind, colliders);
      passenger.position = {random.between(-4, 4), random.between(-4, 4)};
      const Rig<double> fixed(kind, {colliders.begin(), colliders.begin() + 6});
      Motions motions(6);
      for (int step = 0; step < 60; ++step) {
        for (MoverMotion<double>& motion : motions)
          motion = {motion.to, motion.to + Vec2d{random.between(-0.5, 0.5), random.between(-0.5, 0.5)}};
        const std::size_t before = tests::allocations();
        const MoveResult<double>& result = passenger.step(motions);
        ASSERT_EQ(tests::allocations(), before);
        ASSERT_TRUE(std::isfinite(result.position.x()) && std::isfinite(result.position.y())) << "run " << run;
        ASSERT_TRUE(std::isfinite(result.velocity.x()) && std::isfinite(result.velocity.y())) << "run " << run;
        ASSERT_EQ(result.path.back().position, result.position);
        for (std::size_t i = 1; i < result.path.size(); ++i)
          ASSERT_LT(result.path[i - 1].fraction, result.path[i].fraction);
        crushed += result.status == MoveStatus::crushed ? 1 : 0;
        pushed += std::any_of(result.contacts.begin(), result.contacts.end(),
                              [](const auto& contact) { return contact.collider >= 6; })
                      ? 1
                      : 0;
        rides += result.ride.ground != Ride<double>::none ? 1 : 0;
      }
    }
    EXPECT_GT(crushed, runs / 3) << kind;
    EXPECT_GT(pushed, runs * 4 / 3) << kind;
    EXPECT_GT(rides, runs * 2 / 3) << kind;
  }
}

TEST(FarMovers, change_no_bit_of_a_step_among_what_stands_still) {
  constexpr std::uint64_t seed = 91;
  Random random(seed);
  std::vector<ColliderDef> standing{rectangle(-40, -1, 40, 0)};
  for (int i = 0; i < 60; ++i) {
    const double x = random.between(-30, 30);
    const double y = random.between(0, 3);
    standing.push_back({.points = {{x, y}, {x + random.between(1, 4), y}, {x, y + random.between(0.2, 2)}}});
  }
  std::vector<ColliderDef> with_mover = standing;
  with_mover.push_back(of_mover(rectangle(500, 0, 501, 1)));
  for (const std::string_view kind : moving_kinds) {
    Passenger alone(kind, standing);
    Passenger accompanied(kind, with_mover);
    int hits = 0;
    Motions motions(1);
    for (int step = 0; step < 3000; ++step) {
      if (step % 100 == 0) {
        alone.position = accompanied.position = {random.between(-30, 30), random.between(2, 9)};
        alone.velocity = accompanied.velocity = {random.between(-20, 20), random.between(-20, 20)};
      }
      if (step % 100 == 30) alone.velocity.x() = accompanied.velocity.x() = random.between(-8, 8);
      motions[0] = {motions[0].to, {random.between(-3, 3), 0}};
      const MoveResult<double>& expected = alone.step({});
      const MoveResult<double>& result = accompanied.step(motions);
      ASSERT_EQ(result.position, expected.position) << kind << ", seed " << seed << ", step " << step;
      ASSERT_EQ(result.velocity, expected.velocity) << kind << ", step " << step;
      ASSERT_EQ(result.status, expected.status) << kind << ", step " << step;
      ASSERT_EQ(result.contacts.size(), expected.contacts.size()) << kind << ", step " << step;
      hits += expected.contacts.empty() ? 0 : 1;
    }
    EXPECT_GT(hits, 600) << kind;
    EXPECT_LT(hits, 2700) << kind;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
