/// What becomes of a velocity that met surfaces: both laws in closed form.
#include "oracle/response_laws.hpp"

#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace paperproof::compare {
namespace {

const double half = std::sqrt(0.5);

MetSurface surface(double x, double y, bool walkable = false) {
  MetSurface one{.normal = {x, y}};
  one.walkable = walkable;
  return one;
}

bool has(const std::vector<Vec2d>& outcomes, const Vec2d& velocity) {
  return distance_from(outcomes, velocity) <= 1e-12;
}

TEST(FrictionlessLaw, loses_the_part_into_one_surface) {
  const std::array slope{surface(-half, half)};
  EXPECT_TRUE(has(frictionless_outcomes({1, 0}, slope), {0.5, 0.5}));
  EXPECT_FALSE(has(frictionless_outcomes({1, 0}, slope), {1, 1})) << "that is the law of the controller";
  EXPECT_EQ(frictionless_outcomes({-1, 0}, slope).size(), 1U) << "what leaves a surface stays as it is";
}

TEST(FrictionlessLaw, ends_between_two_surfaces_that_both_hold) {
  const std::array corner{surface(0, 1), surface(-1, 0)};
  EXPECT_TRUE(has(frictionless_outcomes({2, -3}, corner), {0, 0}));
  EXPECT_TRUE(has(frictionless_outcomes({2, -3}, corner), {2, 0})) << "the floor may be met alone";
  EXPECT_FALSE(has(frictionless_outcomes({2, -3}, corner), {-2, 0}));
}

TEST(FrictionlessLaw, is_relative_to_what_moves) {
  std::array lift{surface(0, 1)};
  lift[0].velocity = {0, 2};
  EXPECT_TRUE(has(frictionless_outcomes({1, 0}, lift), {1, 2}));
  EXPECT_FALSE(has(frictionless_outcomes({1, 0}, lift), {1, 0.5}));
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

TEST(ControlledLaw, ends_between_ground_and_what_pushes_along_it) {
  std::array pressed{surface(0, 1, true), surface(half, -half)};
  pressed[1].velocity = {0.5, -0.5};
  EXPECT_TRUE(has(controlled_outcomes({{-1, -0.5}, {-1, -0.5}}, pressed), {1, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{-1, -0.5}, {-1, -0.5}}, pressed), {-1, 0}));
}

TEST(ControlledLaw, carries_at_once_who_lands_and_not_who_walks_against_it) {
  std::array lift{surface(0, 1, true)};
  lift[0].velocity = {3, 0};
  const ControlledStep still{{0, -0.5}, {0, -0.5}};
  EXPECT_TRUE(has(controlled_outcomes(still, lift), {3, 0}));
  lift[0].ridden = true;
  EXPECT_FALSE(has(controlled_outcomes(still, lift), {3, 0}));
  EXPECT_TRUE(has(controlled_outcomes(still, lift), {0, 0}));
}

TEST(MetSurface, is_known_apart_along_itself_and_across) {
  MetSurface slope{.normal = {0.6, 0.8}, .velocity = {1, 2}, .spread = 0.5, .spread_along = 0.1};
  const Box2<double> box = slope.velocities();
  EXPECT_NEAR((box.upper - Vec2d(1 + 0.3 + 0.08, 2 + 0.4 + 0.06)).norm(), 0, 1e-12);
  EXPECT_NEAR((box.lower - Vec2d(1 - 0.3 - 0.08, 2 - 0.4 - 0.06)).norm(), 0, 1e-12);
  slope.normal = {0, 1};
  slope.spread = std::numeric_limits<double>::infinity();
  EXPECT_EQ(slope.velocities().upper.x(), slope.spread);
}

TEST(ControlledBounds, hold_nobody_between_a_face_and_itself_at_another_time) {
  std::array floor{surface(0, 1, true), surface(0.01, 1, true)};
  floor[1].normal.normalize();
  floor[0].spread = floor[1].spread = 0.5;
  const ControlledRange falls{.unsteered = {{0, -1}, {0, -1}}, .squeezed = 10};
  EXPECT_GT(controlled_bounds(falls, floor).upper.x(), 5);
  floor[0].turning = floor[1].turning = 0;
  EXPECT_GT(controlled_bounds(falls, floor).upper.x(), 5) << "at one time";
  floor[1].stands_at = 1;
  EXPECT_LT(controlled_bounds(falls, floor).upper.x(), 0.1);
}

TEST(ControlledLaw, keeps_the_horizontal_part_on_walkable_ground_alone) {
  const ControlledStep walk{{1, -0.5}, {1, -0.5}};
  const std::array ground{surface(-half, half, true)};
  EXPECT_TRUE(has(controlled_outcomes(walk, ground), {1, 1}));
  const std::array steep{surface(-half, half)};
  EXPECT_FALSE(has(controlled_outcomes(walk, steep), {1, 1}));
  // The horizontal part that presses in dies, and what falls slides: (0, -0.5) less its part along the normal.
  EXPECT_TRUE(has(controlled_outcomes(walk, steep), {-0.25, -0.25}));
}

TEST(ControlledLaw, steering_holds_no_fall) {
  const std::array steep{surface(-half, half)};
  const ControlledStep uphill{{1, -2}, {0, -2}};
  const ControlledStep idle{{0, -2}, {0, -2}};
  EXPECT_TRUE(has(controlled_outcomes(uphill, steep), {-1, -1}));
  EXPECT_TRUE(has(controlled_outcomes(idle, steep), {-1, -1}));
  EXPECT_FALSE(has(controlled_outcomes(uphill, steep), {-0.5, -0.5}));
}

TEST(ControlledLaw, ends_between_ground_and_a_steep_surface) {
  const std::array corner{surface(-half, half), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{1, -0.5}, {0, -0.5}}, corner), {0, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{1, -0.5}, {0, -0.5}}, corner), {1, 0}));
}

TEST(ControlledLaw, two_that_are_touched_at_once_and_both_stop_the_motion_end_it) {
  // The steep one leaves the fall, which slides away and down to the ground. The ground leaves a run into the steep
  // one.
  std::array corner{surface(-0.8, 0.6), surface(0, 1, true)};
  const ControlledStep run{{2, -1}, {2, -1}};
  EXPECT_TRUE(has(controlled_outcomes(run, corner), {-0.48, 0}));
  EXPECT_FALSE(has(controlled_outcomes(run, corner), {0, 0}));
  corner[1].touched_since = 0;
  EXPECT_TRUE(has(controlled_outcomes(run, corner), {0, 0}));
  EXPECT_FALSE(has(controlled_outcomes(run, corner), {-0.48, 0}));
}

TEST(ControlledLaw, what_stands_between_two_slopes_rests) {
  // A corner of 31 and 59 degrees, gravity not along up: from rest nothing goes up the slope.
  const double s = std::sin(0.54), c = std::cos(0.54);
  std::array corner{surface(-s, c, true), surface(c, s)};
  corner[1].touched_since = 0;
  for (const Vec2d& velocity : controlled_outcomes({{-0.056, -0.5}, {-0.056, -0.5}}, corner))
    EXPECT_LE(velocity.y(), 1e-12);
}

TEST(ControlledLaw, rims_that_are_left_behind_hold_no_fall) {
  std::array rims{surface(0.8, 0.6), surface(-0.8, 0.6)};
  const ControlledStep fall{{0, -1}, {0, -1}};
  EXPECT_TRUE(has(controlled_outcomes(fall, rims), {0, 0}));
  for (MetSurface& rim : rims) rim.left = 1;
  EXPECT_TRUE(has(controlled_outcomes(fall, rims), {0, -0.64})) << "what the first rim leaves of it";
}

TEST(ControlledLaw, a_rise_ends_under_a_ceiling) {
  const std::array ceiling{surface(0, -1)};
  EXPECT_TRUE(has(controlled_outcomes({{1, 3}, {1, 3}}, ceiling), {1, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{1, 3}, {1, 3}}, ceiling), {1, 3}));
}

TEST(ControlledLaw, a_slide_ends_on_the_floor_that_it_comes_to) {
  const std::array foot{surface(half, half), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{0, -4}, {0, -4}}, foot), {2, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{0, -4}, {0, -4}}, foot), {2, 2}));
}

TEST(ControlledLaw, steering_that_a_wall_took_is_there_again_when_the_wall_is_left) {
  std::array past{surface(1, 0), surface(0, 1, true)};
  EXPECT_TRUE(has(controlled_outcomes({{-1, -4}, {0, -4}}, past), {0, 0})) << "beside the wall";
  past[0].left = past[1].met = 0.5;
  EXPECT_TRUE(has(controlled_outcomes({{-1, -4}, {0, -4}}, past), {-1, 0}));
  EXPECT_FALSE(has(controlled_outcomes({{-1, -4}, {0, -4}}, past), {0, 0}));
}

TEST(ControlledLaw, what_is_only_touched_where_the_step_ends_takes_nothing) {
  std::array floor{surface(0, 1, true)};
  floor[0].met = 1;
  EXPECT_TRUE(has(controlled_outcomes({{1, -3}, {1, -3}}, floor), {1, -3}));
  EXPECT_TRUE(has(controlled_outcomes({{1, -3}, {1, -3}}, floor), {1, 0})) << "ground is followed";
}

const Vec2d upright(0, 1);

/// Of an upright character whose climb limit is 50 degrees, at surfaces that rest.
class RandomLaw : public testing::Test {
 protected:
  static constexpr double climb_limit = 50 * std::numbers::pi / 180;

  /// @param along_axes how many look up, down, left or right.
  MetSurface random_surface(double along_axes) {
    const double angle = random_.chance(along_axes) ? random_.integer(0, 3) * std::numbers::pi / 2 : random_.angle();
    const Vec2d normal(std::sin(angle), std::cos(angle));
    MetSurface one{.normal = normal};
    one.walkable = normal.y() >= std::cos(climb_limit);
    one.is_side = std::abs(normal.x()) > std::abs(normal.y());
    return one;
  }
  ControlledStep random_step() {
    const double speed = random_.log_between(0.01, 100);
    const double angle = random_.angle();
    const double steering = random_.chance(0.4) ? 0 : random_.between(-1, 1) * speed;
    ControlledStep step{.unsteered = speed * Vec2d(std::cos(angle), std::sin(angle))};
    step.wanted = step.unsteered + Vec2d(steering, 0);
    return step;
  }
  /// The one velocity that the law makes.
  static Vec2d outcome(const ControlledStep& step, std::span<const MetSurface> surfaces) {
    const std::vector<Vec2d> all = controlled_outcomes(step, surfaces);
    EXPECT_EQ(all.size(), 1U);
    return all.front();
  }
  static double size_of(const ControlledStep& step) { return std::max(step.wanted.norm(), step.unsteered.norm()); }
  /// Only that velocity is faultless, in the frame of any up.
  void expect_only(const ControlledStep& step, const std::vector<MetSurface>& surfaces, const Vec2d& velocity) {
    const double up_angle = random_.angle();
    const Eigen::Rotation2Dd turn(up_angle);
    ControlledStep turned = step;
    turned.wanted = turn * step.wanted;
    turned.unsteered = turn * step.unsteered;
    turned.up = turn * upright;
    std::vector<MetSurface> there = surfaces;
    for (MetSurface& at : there) at.normal = turn * at.normal;
    EXPECT_EQ(velocity_fault(step, surfaces, velocity), std::nullopt);
    // 1e-9 of the wanted velocity, at least 1 m/s, is allowed; turning adds some ulps.
    EXPECT_EQ(velocity_fault(turned, there, turn * velocity), std::nullopt);
    const double off = 1e-8 * std::max(1.0, size_of(step));
    const double angle = random_.angle();
    const Vec2d wrong = velocity + off * Vec2d(std::cos(angle), std::sin(angle));
    EXPECT_TRUE(velocity_fault(step, surfaces, wrong).has_value());
    EXPECT_TRUE(velocity_fault(turned, there, turn * wrong).has_value());
  }

  static constexpr std::uint64_t seed = 28;
  paperproof::test::Random random_{seed};
};

/// What §4 of the design says of one contact.
TEST_F(RandomLaw, of_one_contact_is_that_of_the_design) {
  constexpr int all = 20'000;
  int leaves = 0, ground = 0, steep = 0, pressed = 0, ceilings = 0, climbs = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    MetSurface at = random_surface(0.2);
    at.climbs = random_.chance(0.3);
    const ControlledStep step = random_step();
    const std::array surfaces{at};
    const Vec2d v = outcome(step, surfaces);
    const Vec2d w = step.wanted;
    const Vec2d steering = w - step.unsteered;
    const double rounding = 1e-12 * size_of(step);
    if (w.dot(at.normal) >= 0) {
      ++leaves;
      EXPECT_EQ(v, w);
    } else if (w.dot(at.normal) < -1e-6 * size_of(step)) {
      EXPECT_GE(v.dot(at.normal), -1e-9 * size_of(step)) << "it enters no more";
      if (at.walkable) {
        ++ground;
        EXPECT_NEAR(v.x(), w.x(), rounding) << "the part across up is kept";
        EXPECT_NEAR(v.dot(at.normal), 0, rounding) << "by following the surface";
      } else if (at.normal.y() >= 0) {
        ++steep;
        ControlledStep idle{.wanted = step.unsteered, .unsteered = step.unsteered};
        if (steering.dot(at.normal) < 0) {
          ++pressed;
          EXPECT_NEAR(v.y(), outcome(idle, surfaces).y() > 0 && at.climbs ? 0 : outcome(idle, surfaces).y(), rounding)
              << "the key uphill changes no height";
        } else {
          EXPECT_LE(v.y(), std::max(w.y(), 0.0) + rounding) << "a fall becomes no climb";
        }
        if (steering.isZero(0) && w.x() * at.normal.x() < 0) {
          const Vec2d u(0, at.climbs ? std::min(w.y(), 0.0) : w.y());  // what presses in dies
          const Vec2d expected = u - std::min(u.dot(at.normal), 0.0) * at.normal;
          EXPECT_LE((v - expected).norm(), rounding);
        }
      } else {
        ++ceilings;
        const bool rises = w.y() > 0;
        climbs += rises && at.climbs ? 1 : 0;
        if (rises && at.climbs) {
          EXPECT_EQ(v, Vec2d(Vec2d::Zero())) << "the climb of a walk ends with the walk";
        }
        if (rises && !at.climbs) {
          EXPECT_LE((v - (w - w.dot(at.normal) * at.normal)).norm(), rounding);
        }
        if (!rises) {
          EXPECT_NEAR(v.y(), w.y(), rounding) << "a fall goes on";
        }
      }
    }
    EXPECT_LE(v.norm(), size_of(step) / std::cos(climb_limit) + rounding) << "nothing gives speed";
    expect_only(step, {at}, v);
  }
  EXPECT_GE(leaves, all / 3);
  EXPECT_LE(leaves, all * 2 / 3);
  for (const int some : {ground, steep, ceilings}) EXPECT_GE(some, all / 20);
  for (const int some : {pressed, climbs}) EXPECT_GE(some, all / 50);
}

/// Two surfaces that are both touched: what is left enters neither, and both together end what only both can hold.
TEST_F(RandomLaw, of_two_contacts_enters_neither) {
  constexpr int all = 20'000;
  int held = 0, second_only = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    // Where the normals are square to each other rounding decides whether the second response enters the first again.
    std::vector<MetSurface> two{random_surface(0), random_surface(0)};
    two[0].met = 0.25;
    two[1].met = 0.5;
    ControlledStep step = random_step();
    const Vec2d& a = two[0].normal;
    const Vec2d& b = two[1].normal;
    if (std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-3) continue;  // of one direction
    const Vec2d v = outcome(step, two);
    const double size = size_of(step);
    const Vec2d alone = outcome(step, std::span(two).first(1));
    const bool both = step.wanted.dot(a) < 0 && alone.dot(b) < -1e-6 * size;
    // Steering that a steep surface took is there again on the ground behind it.
    const double most = step.unsteered.norm() + (step.wanted - step.unsteered).norm();
    EXPECT_LE(v.norm(), most / std::cos(climb_limit) * (1 + 1e-12));
    if (step.wanted.dot(a) < -1e-6 * size) {
      EXPECT_GE(v.dot(a), -1e-8 * size);
    }
    if (both) {
      EXPECT_GE(v.dot(b), -1e-8 * size);
    }
    if (alone.dot(b) >= 0) {
      EXPECT_EQ(v, alone);
    }
    const std::vector<MetSurface> only_second{two[1]};
    const Vec2d in_turns = outcome({.wanted = alone, .unsteered = alone}, only_second);
    const bool is_steered = step.wanted != step.unsteered;
    if (both && !is_steered && in_turns.dot(a) < -1e-6 * size) {
      ++held;
      EXPECT_LE(v.norm(), 1e-8 * size) << "each response enters the other surface";
    }
    if (both && !is_steered) {
      std::vector<MetSurface> left = two;
      left[0].left = left[1].met;
      EXPECT_LE((outcome(step, left) - in_turns).norm(), 1e-12 * size) << "a surface that was left holds nothing";
      ++second_only;
    }
    expect_only(step, two, v);
  }
  EXPECT_GE(held, all / 100);
  EXPECT_GE(second_only, all / 40);
}

std::string describe(const ControlledStep& step, const std::vector<MetSurface>& surfaces) {
  std::ostringstream s;
  s << "wants " << step.wanted.transpose() << " unsteered " << step.unsteered.transpose();
  for (const MetSurface& at : surfaces)
    s << "\n n " << at.normal.transpose() << " v " << at.velocity.transpose() << " w " << at.walkable << " climbs "
      << at.climbs << " met " << at.met << " left " << at.left << " ret " << at.returned;
  s << "\n";
  return s.str();
}
/// Whatever the law makes is within its bounds; and what is steep and rests gives no rise.
TEST_F(RandomLaw, is_within_its_bounds) {
  constexpr int all = 20'000;
  int changed = 0, moving = 0, steep = 0, crushed = 0;
  for (int k = 0; k < all && !HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    const ControlledStep step = random_step();
    std::vector<MetSurface> surfaces;
    const bool rest = random_.chance(0.5);
    const bool climbs = random_.chance(0.3);
    for (int i = random_.integer(1, 3); i > 0; --i) {
      MetSurface at = random_surface(0.3);
      const Vec2d velocity = size_of(step) * Vec2d(random_.between(-1, 1), random_.between(-1, 1));
      if (!rest) at.velocity = at.walkable ? velocity : Vec2d(velocity.dot(at.normal) * at.normal);
      at.met = surfaces.empty() ? random_.between(0, 1) : random_.between(surfaces.back().met, 1);
      if (random_.chance(0.3)) at.met = 1;
      if (random_.chance(0.3)) at.left = random_.between(at.met, 1);
      at.climbs = climbs;
      at.returned = random_.chance(0.2);
      surfaces.push_back(at);
    }
    const double steering = (step.wanted - step.unsteered).x();
    const Box2<double> bounds = controlled_bounds({.unsteered = {step.unsteered, step.unsteered},
                                                   .least_steering = std::min(steering, 0.0),
                                                   .most_steering = std::max(steering, 0.0),
                                                   .squeezed = std::numeric_limits<double>::infinity()},
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
      EXPECT_TRUE(bounds.inflated(1e-9 * size).contains({outcome, outcome}))
          << describe(step, surfaces) << outcome.transpose() << " beyond " << bounds.lower.transpose() << ".."
          << bounds.upper.transpose();
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

TEST(VelocityFault, allows_by_how_much_a_turning_surface_is_not_known) {
  std::array ground{surface(0, 1, true)};
  ground[0].spread = 0.01;
  EXPECT_EQ(velocity_fault({{1, -1}, {1, -1}}, ground, {1.0099, 0}), std::nullopt);
  EXPECT_TRUE(velocity_fault({{1, -1}, {1, -1}}, ground, {1.0101, 0}).has_value());
}

/// A wall that pushes at 1e7 m/s: the velocity is known to a share of that, not of what was wanted.
TEST(VelocityFault, allows_the_rounding_of_the_fastest_surface) {
  std::array wall{surface(-half, half)};
  wall[0].velocity = Vec2d(-1e7, 1e7);
  const ControlledStep step{{0, -0.5}, {0, -0.5}};
  const Vec2d pushed = controlled_outcomes(step, wall).front();
  EXPECT_GT(pushed.norm(), 1e7);
  EXPECT_EQ(velocity_fault(step, wall, pushed + Vec2d(1e-3, 0)), std::nullopt);
  EXPECT_TRUE(velocity_fault(step, wall, pushed + Vec2d(0.1, 0)).has_value());
}

TEST(VelocityFault, names_what_is_expected) {
  const std::optional<std::string> fault =
      velocity_fault({{1, -1}, {1, -1}}, std::array{surface(0, 1, true)}, {0.5, 0});
  EXPECT_EQ(fault, "ends with (0.5, 0) m/s; of (1, -1) the law makes (1, 0) at 1 surface");
}

TEST(ControlledLaw, the_articles_rule_ends_a_rise_at_a_side) {
  std::array wall{surface(-1, 0)};
  wall[0].is_side = true;
  const Vec2d jump(3, 5);
  EXPECT_TRUE(has(controlled_outcomes({.wanted = jump, .unsteered = jump}, wall), {0, 5}));
  const ControlledStep ruled{.wanted = jump, .unsteered = jump, .side_hit_ends_rise = true};
  EXPECT_TRUE(has(controlled_outcomes(ruled, wall), {0, 0}));
  EXPECT_FALSE(has(controlled_outcomes(ruled, wall), {0, 5}));
}

/// A lift carries one that lands on it without speed across up, and one that has some keeps it.
TEST(ControlledLaw, a_landing_without_speed_across_up_may_be_carried_at_once) {
  std::array lift{surface(0, 1, true)};
  lift[0].velocity = {2, 1};
  const auto lands = [&](const Vec2d& v) { return controlled_outcomes({.wanted = v, .unsteered = v}, lift); };
  EXPECT_TRUE(has(lands({0, -3}), {2, 1}));
  EXPECT_TRUE(has(lands({0.5, -3}), {0.5, 1}));
  EXPECT_FALSE(has(lands({0.5, -3}), {2, 1}));
  EXPECT_TRUE(has(lands({6e-16, -3}), {2, 1})) << "what rounding leaves across a turned up is no speed";
}

/// A character falls along a wall of two tiles and lands: the upper tile is left behind, the lower one is not.
TEST(VelocityFault, a_flush_neighbour_goes_on_to_hold_where_a_wall_is_left) {
  const ControlledStep step{.wanted = {-1, -6.5}, .unsteered = {0, -6.5}};
  MetSurface upper{.normal = {1, 0}};
  upper.is_side = true;
  upper.left = 0.9;
  MetSurface lower = upper;
  lower.left = std::numeric_limits<double>::infinity();
  MetSurface floor{.normal = {0, 1}};
  floor.walkable = true;
  floor.met = 0.9;
  EXPECT_FALSE(velocity_fault(step, std::vector{upper, lower, floor}, {0, 0}));
  EXPECT_TRUE(velocity_fault(step, std::vector{upper, lower, floor}, {-1, 0}));
  EXPECT_FALSE(velocity_fault(step, std::vector{upper, floor}, {-1, 0}));
}

/// Who is lifted off the floor by what pushes, and snaps back to it, follows it.
TEST(VelocityFault, ground_that_was_left_may_be_followed_again) {
  const ControlledStep step{.wanted = {-5, -0.5}, .unsteered = {-4, -0.5}};
  MetSurface floor{.normal = {0, 1}};
  floor.walkable = true;
  floor.left = 0.7;
  MetSurface pusher{.normal = Vec2d(2, 1).normalized()};
  pusher.velocity = 2.25 * pusher.normal;
  pusher.climbs = true;
  pusher.met = 0.7;
  const Vec2d lifted = controlled_outcomes(step, std::vector{floor, pusher}).front();
  ASSERT_GT(lifted.y(), 0.1);
  EXPECT_TRUE(velocity_fault(step, std::vector{floor, pusher}, {lifted.x(), 0}));
  floor.returned = true;
  EXPECT_FALSE(velocity_fault(step, std::vector{floor, pusher}, {lifted.x(), 0}));
  EXPECT_TRUE(velocity_fault(step, std::vector{floor, pusher}, {0, 0}));
}

}  // namespace
}  // namespace paperproof::compare
