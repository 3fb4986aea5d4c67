/// The article's techniques among movers: what carries, what crushes. tests/situations/techniques.json has what pushes.
#include "controller/article_support.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::article_tests {
namespace {

using Motions = std::vector<MoverMotion>;

ColliderDef conveyor(ColliderDef def, double speed) {
  def.surface_speed = speed;
  return def;
}

/// A character among movers, stepped as a controller does it.
struct Passenger : Rig {
  double gravity = 32;

  Passenger(std::string_view kind, std::vector<ColliderDef> colliders) : Rig(kind, std::move(colliders)) {
    request.dt = 1.0 / 64;
  }
  /// Goes on from where it is.
  const MoveResult& step(const Motions& movers) {
    request.position = result.position;
    request.velocity = result.velocity - result.ride.velocity;
    request.velocity.y() -= gravity * request.dt;
    request.displacement = request.velocity * request.dt;
    request.movers = movers;
    request.ride = result.ride;
    technique->move(request, scratch, result);
    return result;
  }
  /// A step of a second without gravity.
  const MoveResult& fly(const Vec2d& from, const Vec2d& by, const Motions& movers) {
    request.dt = 1;
    gravity = 0;
    result.position = from;
    result.velocity = by;
    return step(movers);
  }
};

/// There and back, `reach` far, in 128 steps.
Vec2d swing(const Vec2d& reach, int step) { return reach * (0.5 - 0.5 * std::cos(step * 2 * 3.14159265358979 / 128)); }

constexpr double rounding = 1e-12;
constexpr double gap = Tolerances{}.stop;
constexpr std::array moving_kinds{"discrete", "penetration_resolution", "speculative_march", "speculative"};
constexpr std::array carrying_kinds{"discrete", "speculative_march", "speculative"};

/// That a technique leaves to what stands still before it [m].
double gap_of(std::string_view kind) { return kind == "discrete" ? gap : 0; }

TEST(Riding, keeps_its_place_on_the_mover_and_its_contact_from_the_first_step_on) {
  for (const Vec2d& reach : {Vec2d{0, 3}, Vec2d{5, 0}, Vec2d{-4, 2.5}}) {
    for (const std::string_view kind : carrying_kinds) {
      SCOPED_TRACE(kind);
      Passenger passenger(kind, {rectangle(-90, -9, 90, -5), compare::box(-2, -1, 2, 0, 0)});
      passenger.result.position = {0.3, half_height + gap_of(kind)};
      Vec2d place{Vec2d::Zero()};
      Motions motions(1);
      passenger.result.reserve(8);
      const std::size_t before = tests::allocations();
      for (int step = 0; step < test::sampled(20000); ++step) {
        const MoverMotion& motion = motions[0] = {swing(reach, step), swing(reach, step + 1)};
        const MoveResult& result = passenger.step(motions);
        ASSERT_TRUE(result.grounded) << "step " << step;
        ASSERT_EQ(result.ride.ground, 1U) << "step " << step;
        ASSERT_EQ(result.contacts.size(), 1U) << "step " << step;
        ASSERT_EQ(result.position, motion.to + result.ride.place) << "step " << step;
        ASSERT_EQ(result.velocity, Vec2d((motion.to - motion.from) / passenger.request.dt)) << "step " << step;
        if (step == 0) place = result.ride.place;
        ASSERT_LE((result.ride.place - place).norm(), gap_of(kind) > 0 ? rounding : 0) << "step " << step;
      }
      EXPECT_EQ(tests::allocations(), before);
      // With a gap, the lift has gone on a little until the first fall has closed it.
      EXPECT_NEAR(place.x(), 0.3, gap);
    }
  }
}

TEST(ClosingWalls, crush_at_the_step_that_the_gap_gives) {
  // The ceiling comes down at 1/64 m per step onto a character of 40 px, from 40 px + room above the floor.
  const double room = 10.4 / 64;
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Passenger passenger(kind, {rectangle(-9, -3, 9, 0), compare::box(-9, 2 * half_height + room, 9, 9, 0)});
    passenger.result.position = {0, half_height + gap_of(kind)};
    int crushed_at = 0;
    Motions motions(1);
    passenger.result.reserve(8);
    const std::size_t before = tests::allocations();
    for (int step = 1; step <= 30; ++step) {
      motions[0] = {{0, -(step - 1) / 64.0}, {0, -step / 64.0}};
      const MoveResult& result = passenger.step(motions);
      ASSERT_GE(result.position.y(), half_height - rounding) << "never pushed into the floor";
      ASSERT_LE(result.position.y(), half_height + px);
      if (result.status != StepStatus::crushed) continue;
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

TEST(MovingRefusals, of_steps_that_conveyors_make_too_long) {
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Passenger by_conveyor(kind, {conveyor(rectangle(-9, -1, 9, 0), 1e300)});
    EXPECT_EQ(by_conveyor.fly({0, 1}, {0, -2}, {}).status, StepStatus::out_of_range);
    EXPECT_EQ(by_conveyor.result.position, Vec2d(0, 1));
  }
}

TEST(MovingRefusals, of_what_a_technique_cannot_express_say_so) {
  const auto refusal = [](std::string_view kind, const ColliderDef& collider) {
    return refusal_by<NotExpressible>([&] { Rig(kind, {collider}); });
  };
  const ColliderDef mover = compare::box(0, 0, 1, 1, 0);
  const ColliderDef belt = conveyor(rectangle(0, 0, 1, 1), 1);
  for (const std::string_view kind : {"grid", "pixel_colour", "pixel_tile", "mask", "wind_back"})
    for (const ColliderDef& each : {mover, belt})
      EXPECT_EQ(refusal(kind, each), std::string(kind) + " is for scenery that stands still");
  for (const std::string_view kind : {"wind_back", "penetration_resolution", "speculative", "discrete"})
    EXPECT_EQ(refusal(kind, compare::circle({0, 0}, 1)),
              std::string(kind) + " knows no circles: make a polygon of them");
  EXPECT_EQ(refusal("bounding_box", mover), "");
  EXPECT_EQ(refusal("bounding_box", belt), "bounding_box carries nobody: there is a conveyor");
}

}  // namespace
}  // namespace paperproof::article_tests
