/// What becomes of a velocity that met surfaces: both laws in closed form.
#include "oracle/engine_laws.hpp"
#include "oracle/response_laws.hpp"

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace paperproof::compare {
namespace {

const double half = std::sqrt(0.5);

MetSurface surface(double x, double y) { return {.normal = {x, y}}; }
MetSurface ground(double x = 0, double y = 1) {
  MetSurface one = surface(x, y);
  one.walkable = true;
  return one;
}
bool has(const std::vector<Vec2d>& outcomes, const Vec2d& velocity) {
  return distance_from(outcomes, velocity) <= 1e-12;
}

using Velocities = std::vector<Vec2d>;
using Surfaces = std::vector<MetSurface>;

TEST(FrictionlessLaw, loses_the_part_into_what_holds_relative_to_it) {
  const Surfaces slope{surface(-half, half)};
  const Surfaces corner{surface(0, 1), surface(-1, 0)};
  const Surfaces lift{{.normal = {0, 1}, .velocity = {0, 2}}};
  for (const auto& [what, wanted, surfaces, made, not_made] :
       {std::tuple{"not by the law of the controller", Vec2d(1, 0), slope, Vec2d(0.5, 0.5), Vec2d(1, 1)},
        {"it ends between two that both hold", Vec2d(2, -3), corner, Vec2d(0, 0), Vec2d(-2, 0)},
        {"the floor may be met alone", Vec2d(2, -3), corner, Vec2d(2, 0), Vec2d(-2, 0)},
        {"relative to what moves", Vec2d(1, 0), lift, Vec2d(1, 2), Vec2d(1, 0.5)}}) {
    EXPECT_TRUE(has(frictionless_outcomes(wanted, surfaces), made)) << what;
    EXPECT_FALSE(has(frictionless_outcomes(wanted, surfaces), not_made)) << what;
  }
  EXPECT_EQ(frictionless_outcomes({-1, 0}, slope).size(), 1U) << "what leaves a surface stays as it is";
}

/// Between a wall and a slope of 45 degrees each round halves what is left: cos² of the angle between the normals.
TEST(IteratedLaw, leaves_a_part_that_shrinks_with_every_round) {
  const std::array corner{surface(-1, 0), surface(-half, half)};
  const Vec2d wanted(1, -0.5);
  Vec2d v = wanted;
  double of_wall = 0;
  double of_slope = 0;
  const auto push = [&v](const Vec2d& n, double& sum) {
    const double next = std::max(sum - v.dot(n), 0.0);
    v += (next - sum) * n;
    sum = next;
  };
  for (int round = 1; round <= 8; ++round) {
    push(corner[1].normal, of_slope);
    push(corner[0].normal, of_wall);
    EXPECT_TRUE(is_short_of_limit(wanted, v, corner, Vec2d::Zero(), round)) << round;
    EXPECT_LE(v.norm(), 2 * std::pow(0.5, round)) << round;
  }
  EXPECT_FALSE(is_short_of_limit(wanted, v + Vec2d(0.1, 0), corner, Vec2d::Zero(), 8)) << "more than 8 rounds leave";
  EXPECT_FALSE(is_short_of_limit(wanted, wanted, std::array{surface(-1, 0)}, Vec2d::Zero(), 8)) << "one surface";
  EXPECT_FALSE(is_short_of_limit({0, 1}, {0, 2}, corner, Vec2d::Zero(), 1)) << "no push along the normals makes that";
}

TEST(TiltedLaw, is_a_push_along_nearly_the_normal_that_ends_the_entering) {
  const std::array floor{surface(0, 1)};
  const Vec2d wanted(2, -1);
  const Vec2d normal = Vec2d(-0.01, 1).normalized();
  const Vec2d turned = wanted - wanted.dot(normal) * normal;
  EXPECT_TRUE(is_turned_by_tilt(wanted, turned, floor, 0.011));
  EXPECT_FALSE(is_turned_by_tilt(wanted, turned, floor, 0.009));
  EXPECT_FALSE(is_turned_by_tilt(wanted, wanted - 0.9 * wanted.dot(normal) * normal, floor, 0.011));
  EXPECT_FALSE(is_turned_by_tilt(wanted, wanted, floor, 0.011)) << "nothing was turned";
}

/// What one surface makes, and two without motion, is in `RandomLaw`.
TEST(ControlledLaw, makes_of_what_was_wanted) {
  const Vec2d up(0, 1);
  const Surfaces wedge{surface(-0.8, 0.6), ground()};
  const Surfaces in_turn{wedge[0], {.normal = up, .walkable = true, .met = 0.5}};
  const Surfaces past_wall{{.normal = {1, 0}, .left = 0.5}, {.normal = up, .walkable = true, .met = 0.5}};
  const Surfaces rims{surface(0.8, 0.6), surface(-0.8, 0.6)};
  const Surfaces left_rims{{.normal = {0.8, 0.6}, .left = 1}, {.normal = {-0.8, 0.6}, .left = 1}};
  // A slope down to a rim, where the other one is met.
  const Surfaces slid_to_rim{{.normal = {0.8, 0.6}, .left = 0.5, .past_rim = true},
                             {.normal = {-0.8, 0.6}, .met = 0.5, .left = 1}};
  const Surfaces past_corner{{.normal = up, .walkable = true, .left = 1, .is_beside = true},
                             {.normal = {-0.8, 0.6}, .left = 1}};
  const Surfaces pressed{ground(), {.normal = {half, -half}, .velocity = {0.5, -0.5}}};
  const Surfaces aside{{.normal = up, .velocity = {3, 0}, .walkable = true}};
  const Surfaces ridden{{.normal = up, .velocity = {3, 0}, .walkable = true, .ridden = true}};
  const Surfaces lift{{.normal = up, .velocity = {2, 1}, .walkable = true}};
  const Surfaces at_end{{.normal = up, .walkable = true, .met = 1}};
  const Surfaces side{{.normal = {-1, 0}, .is_side = true}};
  using Row = std::tuple<const char*, Surfaces, Vec2d, double, Velocities, Velocities>;
  const std::vector<Row> rows{
      {"between ground and what pushes along it", pressed, {-1, -0.5}, 0, {{1, 0}}, {{-1, 0}}},
      {"a lift carries at once who lands", aside, {0, -0.5}, 0, {{3, 0}}, {}},
      {"and not who rides it and walks against it", ridden, {0, -0.5}, 0, {{0, 0}}, {{3, 0}}},
      {"a landing without speed across up", lift, {0, -3}, 0, {{2, 1}}, {}},
      {"what rounding leaves across a turned up is no speed", lift, {6e-16, -3}, 0, {{2, 1}}, {}},
      {"a landing with speed across up", lift, {0.5, -3}, 0, {{0.5, 1}}, {{2, 1}}},
      {"between ground and a steep surface", {surface(-half, half), ground()}, {0, -0.5}, 1, {{0, 0}}, {{1, 0}}},
      // The steep one leaves the fall, which slides away and down to the ground. The ground leaves a run into it.
      {"a run into a wedge", in_turn, {2, -1}, 0, {{-0.48, 0}}, {{0, 0}}},
      {"both met at one place", wedge, {2, -1}, 0, {{0, 0}, {-0.48, 0}}, {{2, 0}}},
      {"rims on both sides", rims, {0, -1}, 0, {{0, 0}}, {}},
      {"rims that are left behind hold no fall", left_rims, {0, -1}, 0, {{0, -1}}, {{0, 0}}},
      {"nor do those between which a slide ends", slid_to_rim, {0, -1}, 0, {{0, -0.64}}, {{-0.3072, -0.2304}}},
      {"the corner of ground may, and may not", past_corner, {0, -1}, 0, {{0, -1}, {0, 0}}, {}},
      {"alone it does", {past_corner[0]}, {0, -1}, 0, {{0, 0}}, {{0, -1}}},
      {"a slide ends on the floor", {surface(half, half), ground()}, {0, -4}, 0, {{2, 0}}, {{2, 2}}},
      {"a wall takes steering", {surface(1, 0), ground()}, {0, -4}, -1, {{0, 0}}, {}},
      {"it is there again when the wall is left", past_wall, {0, -4}, -1, {{-1, 0}}, {{0, 0}}},
      {"touched only where the step ends", at_end, {1, -3}, 0, {{1, -3}, {1, 0}}, {}},
      {"a rise goes on at a side", side, {3, 5}, 0, {{0, 5}}, {}},
  };
  for (const auto& [what, surfaces, unsteered, steering, made, not_made] : rows) {
    const ControlledStep step{.wanted = unsteered + Vec2d(steering, 0), .unsteered = unsteered};
    for (const Vec2d& v : made) EXPECT_TRUE(has(controlled_outcomes(step, surfaces), v)) << what;
    for (const Vec2d& v : not_made) EXPECT_FALSE(has(controlled_outcomes(step, surfaces), v)) << what;
  }
  const Surfaces ceiling{surface(0.6, -0.8)};
  const Vec2d rise(0.8 - 1.8e8, 0.6 + 2.4e8);
  EXPECT_LE(distance_from(controlled_outcomes({rise, rise}, ceiling), {0.8, 0.6}), 1e-6) << "however fast it came";
  const ControlledStep slanted{.wanted = {0, -1}, .unsteered = {0, -1}, .sides = {{0.6, -0.8}}};
  EXPECT_TRUE(has(controlled_outcomes(slanted, left_rims), {0.48, -0.64})) << "along a side, where up is slanted";
  EXPECT_FALSE(has(controlled_outcomes(slanted, rims), {0.48, -0.64}));
  const ControlledStep ruled{.wanted = {3, 5}, .unsteered = {3, 5}, .side_hit_ends_rise = true};
  EXPECT_TRUE(has(controlled_outcomes(ruled, side), {0, 0})) << "the article's rule";
  EXPECT_FALSE(has(controlled_outcomes(ruled, side), {0, 5}));
  // A corner of 31 and 59 degrees, gravity not along up: from rest nothing goes up the slope.
  const double s = std::sin(0.54), c = std::cos(0.54);
  const ControlledStep rests{{-0.056, -0.5}, {-0.056, -0.5}};
  const Surfaces corner{ground(-s, c), surface(c, s)};
  for (const Vec2d& velocity : controlled_outcomes(rests, corner)) EXPECT_LE(velocity.y(), 1e-12);
}

TEST(MetSurface, is_known_apart_along_itself_and_across) {
  MetSurface slope{.normal = {0.6, 0.8}, .velocity = {1, 2}, .spread = 0.5, .spread_along = 0.1};
  const Box2 box = slope.velocities();
  EXPECT_NEAR((box.upper - Vec2d(1 + 0.3 + 0.08, 2 + 0.4 + 0.06)).norm(), 0, 1e-12);
  EXPECT_NEAR((box.lower - Vec2d(1 - 0.3 - 0.08, 2 - 0.4 - 0.06)).norm(), 0, 1e-12);
  slope.normal = {0, 1};
  slope.spread = std::numeric_limits<double>::infinity();
  EXPECT_EQ(slope.velocities().upper.x(), slope.spread);
}

TEST(ControlledBounds, hold_nobody_between_a_face_and_itself_at_another_time) {
  std::array floor{ground(), ground(0.01, 1)};
  floor[1].normal.normalize();
  floor[0].spread = floor[1].spread = 0.5;
  const ControlledRange falls{.unsteered = {{0, -1}, {0, -1}}, .squeezed = 10};
  EXPECT_GT(controlled_bounds(falls, floor).upper.x(), 5);
  floor[0].turning = floor[1].turning = 0;
  EXPECT_GT(controlled_bounds(falls, floor).upper.x(), 5) << "at one time";
  floor[1].stands_at = 1;
  EXPECT_LT(controlled_bounds(falls, floor).upper.x(), 0.1);
}

TEST(LeaveNoMotion, holds_of_what_closes_or_presses_out_too_fast) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const auto leave_none = [](const Surfaces& surfaces, double most) { return leave_no_motion(surfaces, most); };
  MetSurface press{.normal = {1, 0}, .velocity = {1, 0}};
  MetSurface wall{.normal = {-1, 0}};
  EXPECT_TRUE(leave_none({press, wall}, any));
  EXPECT_FALSE(leave_none({press}, any)) << "it goes along";
  EXPECT_FALSE(leave_none({wall, {.normal = {1, 0}, .velocity = {-1, 0}}}, any)) << "they part";
  const MetSurface slope{.normal = {-std::sin(60 * degree), std::cos(60 * degree)}};
  EXPECT_TRUE(leave_none({press, slope}, 1.99));
  EXPECT_FALSE(leave_none({press, slope}, 2.01)) << "up the slope, at twice the speed of the press";
  const MetSurface ceiling{.normal = {0, -1}};
  EXPECT_TRUE(leave_none({press, slope, ceiling}, any));
  press.turning = wall.turning = 0;
  wall.stands_at = 1;
  EXPECT_FALSE(leave_none({press, wall}, any)) << "one mover, at two times";
}

/// Of an upright character whose climb limit is 50 degrees, at surfaces that rest.
class RandomLaw : public testing::Test {
 protected:
  static constexpr double climb_limit = 50 * degree;
  static constexpr int all = 20'000;

  /// @param along_axes how many look up, down, left or right.
  MetSurface random_surface(double along_axes) {
    const double angle = random_.chance(along_axes) ? random_.integer(0, 3) * 90 * degree : random_.angle();
    const Vec2d normal = towards(angle);
    return {.normal = normal,
            .walkable = normal.y() >= std::cos(climb_limit),
            .is_side = std::abs(normal.x()) > std::abs(normal.y())};
  }
  ControlledStep random_step() {
    const double speed = random_.log_between(0.01, 100);
    const double steering = random_.chance(0.4) ? 0 : random_.between(-1, 1) * speed;
    const Vec2d unsteered = speed * towards(random_.angle());
    return {.wanted = unsteered + Vec2d(steering, 0), .unsteered = unsteered};
  }
  /// The one velocity that the law makes.
  static Vec2d outcome(const ControlledStep& step, const Surfaces& surfaces) {
    const std::vector<Vec2d> outcomes = controlled_outcomes(step, surfaces);
    EXPECT_EQ(outcomes.size(), 1U);
    return outcomes.front();
  }
  static double size_of(const ControlledStep& step) { return std::max(step.wanted.norm(), step.unsteered.norm()); }
  /// Only that velocity is faultless, in the frame of any up.
  void expect_only(const ControlledStep& step, const Surfaces& surfaces, const Vec2d& velocity) {
    const Eigen::Rotation2Dd turn(random_.angle());
    const ControlledStep turned{.wanted = turn * step.wanted, .unsteered = turn * step.unsteered, .up = turn * step.up};
    Surfaces there = surfaces;
    for (MetSurface& at : there) at.normal = turn * at.normal;
    EXPECT_EQ(velocity_fault(step, surfaces, velocity), std::nullopt);
    // 1e-9 of the wanted velocity, at least 1 m/s, is allowed; turning adds some ulps.
    EXPECT_EQ(velocity_fault(turned, there, turn * velocity), std::nullopt);
    const Vec2d wrong = velocity + 1e-8 * std::max(1.0, size_of(step)) * towards(random_.angle());
    EXPECT_TRUE(velocity_fault(step, surfaces, wrong).has_value());
    EXPECT_TRUE(velocity_fault(turned, there, turn * wrong).has_value());
  }

  Random random_{28};
};

/// What §4 of the design says of one contact.
TEST_F(RandomLaw, of_one_contact_is_that_of_the_design) {
  int leaves = 0, ground = 0, steep = 0, pressed = 0, ceilings = 0, climbs = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    MetSurface at = random_surface(0.2);
    at.climbs = random_.chance(0.3);
    const ControlledStep step = random_step();
    const Vec2d v = outcome(step, {at});
    const Vec2d& w = step.wanted;
    const Vec2d& n = at.normal;
    const double size = size_of(step);
    const double rounding = 1e-12 * size;
    const bool rises = w.y() > 0;
    if (w.dot(n) >= 0) {
      ++leaves;
      EXPECT_EQ(v, w);
    } else if (w.dot(n) > -1e-6 * size) {
      // It hardly enters.
    } else if (at.walkable) {
      ++ground;
      EXPECT_LE((v - Vec2d(w.x(), -w.x() * n.x() / n.y())).norm(), rounding)
          << "it follows: the part across up is kept";
    } else if (n.y() >= 0) {
      ++steep;
      EXPECT_GE(v.dot(n), -1e-9 * size) << "it enters no more";
      const double steering = (w - step.unsteered).x();
      if (steering * n.x() < 0) {
        ++pressed;
        const double idle = outcome({.wanted = step.unsteered, .unsteered = step.unsteered}, {at}).y();
        EXPECT_NEAR(v.y(), idle > 0 && at.climbs ? 0 : idle, rounding) << "the key uphill changes no height";
      } else {
        EXPECT_LE(v.y(), std::max(w.y(), 0.0) + rounding) << "a fall becomes no climb";
      }
      if (steering == 0 && w.x() * n.x() < 0) {
        const Vec2d u(0, at.climbs ? std::min(w.y(), 0.0) : w.y());  // what presses in dies
        EXPECT_LE((v - (u - std::min(u.dot(n), 0.0) * n)).norm(), rounding);
      }
    } else {
      ++ceilings;
      climbs += rises && at.climbs ? 1 : 0;
      EXPECT_GE(v.dot(n), -1e-9 * size) << "it enters no more";
      EXPECT_TRUE(rises || std::abs(v.y() - w.y()) <= rounding) << "a fall goes on";
      EXPECT_TRUE(!rises || !at.climbs || v.y() <= rounding) << "the climb of a walk ends with the walk";
      EXPECT_TRUE(!rises || at.climbs || (v - (w - w.dot(n) * n)).norm() <= rounding);
    }
    EXPECT_LE(v.norm(), size / std::cos(climb_limit) + rounding) << "nothing gives speed";
    expect_only(step, {at}, v);
  }
  EXPECT_NEAR(leaves, all / 2, all / 6);
  for (const int some : {ground, steep, ceilings}) EXPECT_GE(some, all / 20);
  for (const int some : {pressed, climbs}) EXPECT_GE(some, all / 50);
}

/// Two surfaces that are both touched: what is left enters neither, and both together end what only both can hold.
TEST_F(RandomLaw, of_two_contacts_enters_neither) {
  int held = 0, second_only = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    // Where the normals are square to each other rounding decides whether the second response enters the first again.
    Surfaces two{random_surface(0), random_surface(0)};
    two[0].met = 0.25;
    two[1].met = 0.5;
    const ControlledStep step = random_step();
    const Vec2d a = two[0].normal;
    const Vec2d b = two[1].normal;
    if (std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-3) continue;  // of one direction
    const Vec2d v = outcome(step, two);
    const double size = size_of(step);
    const Vec2d alone = outcome(step, {two[0]});
    const bool both = step.wanted.dot(a) < 0 && alone.dot(b) < -1e-6 * size;
    // Steering that a steep surface took is there again on the ground behind it.
    const double most = step.unsteered.norm() + (step.wanted - step.unsteered).norm();
    EXPECT_LE(v.norm(), most / std::cos(climb_limit) * (1 + 1e-12));
    EXPECT_TRUE(step.wanted.dot(a) >= -1e-6 * size || v.dot(a) >= -1e-8 * size);
    EXPECT_TRUE(!both || v.dot(b) >= -1e-8 * size);
    EXPECT_TRUE(alone.dot(b) < 0 || v == alone);
    if (both && step.wanted == step.unsteered) {
      const Vec2d in_turns = outcome({.wanted = alone, .unsteered = alone}, {two[1]});
      const bool each_enters_the_other = in_turns.dot(a) < -1e-6 * size;
      held += each_enters_the_other;
      EXPECT_TRUE(!each_enters_the_other || v.norm() <= 1e-8 * size);
      Surfaces left = two;
      left[0].left = left[1].met;
      EXPECT_LE((outcome(step, left) - in_turns).norm(), 1e-12 * size) << "a surface that was left holds nothing";
      ++second_only;
    }
    expect_only(step, two, v);
  }
  EXPECT_GE(held, all / 100);
  EXPECT_GE(second_only, all / 40);
}

/// Whatever the law makes is within its bounds; and what is steep and rests gives no rise.
TEST_F(RandomLaw, is_within_its_bounds) {
  constexpr double any = std::numeric_limits<double>::infinity();
  int changed = 0, moving = 0, steep = 0, crushed = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    const ControlledStep step = random_step();
    Surfaces surfaces;
    const bool rest = random_.chance(0.5);
    const bool climbs = random_.chance(0.3);
    for (int i = random_.integer(1, 3); i > 0; --i) {
      MetSurface at = random_surface(0.3);
      const Vec2d velocity = size_of(step) * random_.point(1);
      if (!rest) at.velocity = at.walkable ? velocity : Vec2d(velocity.dot(at.normal) * at.normal);
      at.met = random_.between(surfaces.empty() ? 0 : surfaces.back().met, 1);
      if (random_.chance(0.3)) at.met = 1;
      if (random_.chance(0.3)) at.left = random_.between(at.met, 1);
      at.climbs = climbs;
      at.returned = random_.chance(0.2);
      surfaces.push_back(at);
    }
    const double steering = (step.wanted - step.unsteered).x();
    const Box2 bounds = controlled_bounds({.unsteered = {step.unsteered, step.unsteered},
                                           .least_steering = std::min(steering, 0.0),
                                           .most_steering = std::max(steering, 0.0),
                                           .squeezed = any},
                                          surfaces);
    double size = size_of(step);
    // Where the surfaces leave no motion it is a crush: bounds do not hold how the law ends that.
    const std::vector<Vec2d> allowed = frictionless_outcomes(step.wanted, surfaces);
    const bool is_crush = std::none_of(allowed.begin(), allowed.end(), [&](const Vec2d& v) {
      return std::all_of(surfaces.begin(), surfaces.end(), [&](const MetSurface& at) {
        return (v - at.velocity).dot(at.normal) >= -1e-9 * std::max(size, v.norm());
      });
    });
    crushed += is_crush;
    if (is_crush) continue;
    for (const Vec2d& outcome : controlled_outcomes(step, surfaces)) {
      size = std::max(size, outcome.norm());
      EXPECT_TRUE(bounds.inflated(1e-9 * size).contains({outcome, outcome})) << outcome.transpose();
      changed += outcome != step.wanted;
    }
    moving += !rest;
    if (!rest || std::any_of(surfaces.begin(), surfaces.end(), [](const MetSurface& at) { return at.walkable; }))
      continue;
    EXPECT_LE(bounds.upper.y(), std::max(step.unsteered.y(), 0.0) + 1e-9 * size);
    ++steep;
  }
  for (const int some : {changed, moving, steep}) EXPECT_GE(some, all / 10);
  EXPECT_LE(crushed, all / 20) << "the exception is not the rule";
}

TEST(VelocityFault, names_what_is_expected) {
  EXPECT_EQ(velocity_fault({{1, -1}, {1, -1}}, Surfaces{ground()}, {0.5, 0}),
            "ends with (0.5, 0) m/s; of (1, -1) the law makes (1, 0) at 1 surface");
}

TEST(VelocityFault, is_what_is_off_by_more_than_is_known_or_rounded) {
  const Vec2d up(0, 1);
  const Surfaces turning{{.normal = up, .walkable = true, .spread = 0.01}};
  // Of a wall that pushes at 1e7 m/s the velocity is known to a share of that, not of what was wanted.
  const ControlledStep falls{{0, -0.5}, {0, -0.5}};
  const Surfaces fast{{.normal = {-half, half}, .velocity = {-1e7, 1e7}}};
  const Vec2d pushed = controlled_outcomes(falls, fast).front();
  EXPECT_GT(pushed.norm(), 1e7);
  // A character falls along a wall of two tiles and lands: the upper tile is left behind, the lower one is not.
  const ControlledStep lands{.wanted = {-1, -6.5}, .unsteered = {0, -6.5}};
  const MetSurface upper{.normal = {1, 0}, .is_side = true, .left = 0.9};
  const MetSurface lower{.normal = {1, 0}, .is_side = true};
  const MetSurface floor{.normal = up, .walkable = true, .met = 0.9};
  // Who is lifted off the floor by what pushes, and snaps back to it, follows it.
  const ControlledStep walks{.wanted = {-5, -0.5}, .unsteered = {-4, -0.5}};
  const Vec2d normal = Vec2d(2, 1).normalized();
  const MetSurface pusher{.normal = normal, .velocity = 2.25 * normal, .climbs = true, .met = 0.7};
  const MetSurface returned{.normal = up, .walkable = true, .left = 0.7, .returned = true};
  const Surfaces lifting{{.normal = up, .walkable = true, .left = 0.7}, pusher};
  const Vec2d lifted = controlled_outcomes(walks, lifting).front();
  ASSERT_GT(lifted.y(), 0.1);
  const ControlledStep step{{1, -1}, {1, -1}};
  using Row = std::tuple<const char*, ControlledStep, Surfaces, Vec2d, bool>;
  for (const auto& [what, asked, surfaces, velocity, is_fault] : {
           Row{"less than a turning surface is known", step, turning, {1.0099, 0}, false},
           Row{"more than that", step, turning, {1.0101, 0}, true},
           Row{"the rounding of the fastest surface", falls, fast, pushed + Vec2d(1e-3, 0), false},
           Row{"more than that", falls, fast, pushed + Vec2d(0.1, 0), true},
           Row{"a flush neighbour goes on to hold", lands, {upper, lower, floor}, {0, 0}, false},
           Row{"through it", lands, {upper, lower, floor}, {-1, 0}, true},
           Row{"there is none", lands, {upper, floor}, {-1, 0}, false},
           Row{"ground that was left is not followed", walks, lifting, {lifted.x(), 0}, true},
           Row{"unless it was come back to", walks, {returned, pusher}, {lifted.x(), 0}, false},
           Row{"and with what is left", walks, {returned, pusher}, {0, 0}, true},
       })
    EXPECT_EQ(velocity_fault(asked, surfaces, velocity).has_value(), is_fault) << what;
}

}  // namespace
}  // namespace paperproof::compare
