/// What becomes of a velocity that met surfaces: both laws in closed form.
#include "oracle/response_laws.hpp"
#include "oracle/engine_laws.hpp"

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "compare/table_file.hpp"
#include "records/collider_json.hpp"
#include "scenes/formula.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <variant>
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

using Surfaces = std::vector<MetSurface>;

/// The rows of laws.json, with all numbers computed: tables/README.md says what they are.
Json rows_of(const char* law) {
  static const Json file = computed(read_table("laws.json"), constants());
  return file.at(law);
}
Surfaces surfaces_of(const Json& row) {
  using Member = std::variant<bool MetSurface::*, double MetSurface::*, Vec2d MetSurface::*>;
  static const std::map<std::string, Member> members{
      {"normal", &MetSurface::normal},     {"velocity", &MetSurface::velocity}, {"walkable", &MetSurface::walkable},
      {"is_side", &MetSurface::is_side},   {"ridden", &MetSurface::ridden},     {"is_beside", &MetSurface::is_beside},
      {"past_rim", &MetSurface::past_rim}, {"returned", &MetSurface::returned}, {"climbs", &MetSurface::climbs},
      {"met", &MetSurface::met},           {"left", &MetSurface::left},         {"stands_at", &MetSurface::stands_at},
      {"spread", &MetSurface::spread}};
  Surfaces all;
  for (const Json& told : row.at("surfaces")) {
    MetSurface& at = all.emplace_back(MetSurface{.normal = point_of(told.at("normal"))});
    for (const auto& [key, value] : told.items())
      if (key == "turning")
        at.turning = value.get<MoverIndex>();
      else
        std::visit([&at, &said = value](auto member) { said.get_to(at.*member); }, members.at(key));
  }
  return all;
}

ControlledStep step_of(const Json& row) {
  const Vec2d unsteered = point_of(row.at("unsteered"));
  return {.wanted = unsteered + Vec2d(row.value("steering", 0.0), 0), .unsteered = unsteered};
}

void expect_outcomes(const std::vector<Vec2d>& outcomes, const Json& row) {
  const std::string what = row.at("what");
  for (const Json& made : row.value("makes", Json::array()))
    EXPECT_LE(distance_from(outcomes, point_of(made)), row.value("within", 1e-12)) << what;
  for (const Json& not_made : row.value("makes_not", Json::array()))
    EXPECT_FALSE(has(outcomes, point_of(not_made))) << what;
  if (row.contains("outcomes")) {
    EXPECT_EQ(outcomes.size(), row["outcomes"]) << what;
  }
}

TEST(FrictionlessLaw, loses_the_part_into_what_holds_relative_to_it) {
  for (const Json& row : rows_of("frictionless"))
    expect_outcomes(frictionless_outcomes(point_of(row.at("wanted")), surfaces_of(row)), row);
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
  for (const Json& row : rows_of("controlled")) {
    ControlledStep step = step_of(row);
    step.side_hit_ends_rise = row.value("side_hit_ends_rise", false);
    for (const Json& side : row.value("sides", Json::array())) step.sides.push_back(point_of(side));
    expect_outcomes(controlled_outcomes(step, surfaces_of(row)), row);
  }
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
  for (const Json& row : rows_of("leave_no_motion"))
    EXPECT_EQ(leave_no_motion(surfaces_of(row), row.value("most", any)), row.at("of").get<bool>()) << row.at("what");
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
  for (const Json& row : rows_of("velocity_fault")) {
    const auto fault = velocity_fault(step_of(row), surfaces_of(row), point_of(row.at("velocity")));
    EXPECT_EQ(fault.has_value(), row.at("is_fault").get<bool>()) << row.at("what") << ": " << fault.value_or("none");
  }
}

}  // namespace
}  // namespace paperproof::compare
