/// Circles in a level, and on movers that turn: wheels, planks with round ends.
#include <paperproof/level.hpp>

#include "geometry/circle.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace paperproof::test {
namespace {

constexpr double frame = 1.0 / 60;
constexpr double half_height = 0.625;  ///< Of the article's character [m].

ColliderDef box_from(double left, double bottom, double right, double top, MoverIndex mover = no_mover) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}, .mover = mover};
}

ColliderDef disc(double x, double y, double radius, MoverIndex mover = no_mover) {
  return {.shape = ColliderDef::Shape::circle, .points = {{x, y}}, .mover = mover, .radius = radius};
}

/// A level, a character, and movers that turn.
struct Ride {
  explicit Ride(SceneryDef def, const CharacterDef& of = {})
      : level(def), character(of), controller(level, character), movers(level.mover_count()) {}

  StepStatus step(const Input& input = {}) { return controller.step(state, input, {{0, -30}, frame, movers}, report); }
  /// The movers go on from where they are, each by a turn and a way.
  StepStatus step_by(double turn, const Vec2d& way = {0, 0}, const Input& input = {}) {
    for (PoseMotion& mover : movers) mover = {mover.to, {mover.to.position + way, mover.to.angle + turn}};
    return step(input);
  }
  /// Where the circle's centre is at a fraction of the step, as the step says.
  [[nodiscard]] Vec2d centre(ColliderIndex circle, double fraction) const {
    const ColliderDef& def = *level.find(circle);
    for (const TurnedCollider& turned : controller.turned()) {
      if (turned.collider != circle) continue;
      std::size_t i = 1;
      while (i + 1 < turned.instants.size() && turned.instants[i] < fraction) ++i;
      const double begin = turned.instants[i - 1];
      const double share = std::clamp((fraction - begin) / (turned.instants[i] - begin), 0.0, 1.0);
      return turned.vertices[i - 1][0] + (turned.vertices[i][0] - turned.vertices[i - 1][0]) * share;
    }
    if (def.mover == no_mover) return def.points[0];
    const PoseMotion& motion = movers[def.mover];
    const auto place = [&](const Pose& pose) -> Vec2d {
      const double c = std::cos(pose.angle);
      const double s = std::sin(pose.angle);
      return pose.position +
             Vec2d(c * def.points[0].x() - s * def.points[0].y(), s * def.points[0].x() + c * def.points[0].y());
    };
    return place(motion.from) + (place(motion.to) - place(motion.from)) * fraction;
  }
  /// Least separation on the way of the last step [m].
  [[nodiscard]] double least_gap(ColliderIndex circle) const {
    const double radius = level.find(circle)->radius;
    double least = 1e9;
    const auto& path = report.move.path;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      // Both go straight between the instants of either.
      std::vector<double> instants{path[k].fraction, path[k + 1].fraction};
      for (const TurnedCollider& turned : controller.turned())
        if (turned.collider == circle)
          for (const double instant : turned.instants)
            if (instant > path[k].fraction && instant < path[k + 1].fraction) instants.push_back(instant);
      std::sort(instants.begin(), instants.end());
      const double length = path[k + 1].fraction - path[k].fraction;
      for (const double instant : instants) {
        const double share = length > 0 ? (instant - path[k].fraction) / length : 0;
        const Vec2d at = path[k].position + (path[k + 1].position - path[k].position) * share;
        least = std::min(least, gap_at(at, centre(circle, instant), radius));
      }
      // And in between, where it may be nearer still.
      for (std::size_t i = 0; i + 1 < instants.size() && length > 0; ++i)
        for (int part = 1; part < 16; ++part) {
          const double instant = instants[i] + (instants[i + 1] - instants[i]) * part / 16;
          const double share = (instant - path[k].fraction) / length;
          const Vec2d at = path[k].position + (path[k + 1].position - path[k].position) * share;
          least = std::min(least, gap_at(at, centre(circle, instant), radius));
        }
    }
    return least;
  }
  [[nodiscard]] double gap_at(const Vec2d& at, const Vec2d& centre, double radius) const {
    return geometry::near_circle<double>(character.shape.hull(), at, {centre, radius}).separation;
  }

  Level level;
  CharacterDef character;
  LevelController controller;
  std::vector<PoseMotion> movers;
  CharacterState<double> state;
  StepReport<double> report;
};

/// Rounding of the poses [m].
constexpr double rounding = 1e-9;

TEST(CircleInALevel, is_stood_on_replaced_and_removed) {
  Ride ride({{disc(0, -5, 5)}});
  ride.state.position = {0, 3};
  for (int i = 0; i < 60; ++i) ride.step();
  EXPECT_TRUE(ride.state.grounded);
  EXPECT_NEAR(ride.state.position.y(), half_height, 1e-6);
  ASSERT_TRUE(ride.level.replace(0, disc(0, -5, 4)));
  for (int i = 0; i < 60; ++i) ride.step();
  EXPECT_NEAR(ride.state.position.y(), half_height - 1, 1e-6);
  ASSERT_TRUE(ride.level.remove(0));
  for (int i = 0; i < 60; ++i) ride.step();
  EXPECT_FALSE(ride.state.grounded);
  EXPECT_LT(ride.state.position.y(), -2);
}

TEST(CircleInALevel, of_a_hundred_kilometres_is_found_where_it_is_touched) {
  Ride ride({{disc(3e4, -1e5, std::hypot(3e4, 1e5))}});
  ride.state.position = {0, 3};
  for (int i = 0; i < 60; ++i) ride.step();
  EXPECT_TRUE(ride.state.grounded);
}

TEST(CircleInALevel, is_refused_as_in_a_scenery) {
  Level level;
  EXPECT_THROW(level.add(disc(0, 0, 0)), InvalidScenery);
  ColliderDef box = box_from(0, 0, 1, 1);
  box.radius = 1;
  EXPECT_THROW(level.add(box), InvalidScenery);
}

TEST(WheelThatTurns, carries_its_rider_round_until_it_is_too_steep) {
  // 0.5 rad/s clockwise: the rider goes to the right as the top of the wheel does, as far as the climb limit.
  Ride ride({{disc(0, 0, 3, 0)}});
  ride.state.position = {0, 3 + half_height + 0.01};
  for (int i = 0; i < 20; ++i) ride.step_by(0);
  ASSERT_TRUE(ride.state.grounded);
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_NE(ride.step_by(-0.5 * frame), StepStatus::crushed) << i;
    EXPECT_GT(ride.least_gap(0), -rounding) << i;
    fastest = std::max(fastest, ride.state.position.x());
  }
  // Half a radian of a circle of 3 m, and of the foot beyond its first touch.
  EXPECT_NEAR(fastest, 3 * std::sin(0.5), 0.35);
  EXPECT_GT(ride.state.position.x(), 1);
}

TEST(WheelThatTurns, carries_at_any_speed) {
  for (const double spin : {0.1, 1.0, 3.0, -5.0}) {  // [rad/s]
    Ride ride({{disc(0, 0, 2, 0)}});
    ride.state.position = {0, 2 + half_height + 0.01};
    for (int i = 0; i < 20; ++i) ride.step_by(0);
    ride.step_by(spin * frame);
    ride.step_by(spin * frame);
    EXPECT_NEAR(ride.state.position.x(), -2 * spin * 2 * frame, 0.05 * std::abs(spin) * frame) << spin;
    EXPECT_TRUE(ride.controller.turned().empty()) << "no step need be divided";
  }
}

TEST(RiderOfAWheel, stays_on_it_without_a_snap_until_it_is_too_steep) {
  const int wheels = steps_wanted("PAPERPROOF_RIDERS", sampled(200));
  int walked = 0;
  int carried = 0;
  for (int wheel = 1; wheel <= wheels; ++wheel) {
    Random random(static_cast<std::uint64_t>(wheel));
    const double radius = random.log_between(0.3, 10);
    const double spin = random.either_sign_log_between(0.02, 3 / std::max(1.0, radius));  // surface: up to 3 m/s
    const Vec2d way = random.chance(0.5) ? Vec2d(0, 0) : Vec2d(0.02, 0.01) * random.between(-1, 1);
    const double move = random.chance(0.5) ? 0 : random.between(-0.3, 0.3);
    Ride ride({{disc(0, 0, radius, 0)}});
    ride.state.position = {0, radius + half_height + 0.01};
    for (int i = 0; i < 20; ++i) ride.step_by(0);
    ASSERT_TRUE(ride.state.grounded) << "wheel " << wheel;
    for (int i = 0; i < 200; ++i) {
      ride.step_by(spin * frame, way, {.move = move});
      if (i == 0) continue;  // it starts with a jerk
      const Vec2d normal = ride.report.move.ground.normal;
      const double limit = std::cos((ride.character.max_climb_degrees - 5) * std::numbers::pi / 180);
      const double turn = (std::abs(spin) + std::abs(move) * ride.character.walk_speed / radius) * frame;
      if (ride.state.grounded && std::acos(normal.y()) + turn > std::acos(limit)) break;
      ASSERT_TRUE(ride.state.grounded) << "wheel " << wheel << " of radius " << radius << ", step " << i;
      ASSERT_EQ(ride.state.ride.ground, 0U) << "wheel " << wheel << ", step " << i;
      (move == 0 ? carried : walked) += normal.y() < 1;
    }
  }
  EXPECT_GT(carried, wheels);
  EXPECT_GT(walked, wheels);
}

TEST(WheelThatTurns, about_another_point_pushes_and_never_overlaps) {
  // A disc on the rim of a wheel that turns about the origin comes from the left, again and again.
  Ride ride({{disc(-2, 0.3, 0.3, 0), box_from(-9, -1, 9, 0)}});
  ride.state.position = {1.5, half_height + 1e-6};
  int pushed = 0;
  double fastest = 0;
  for (int i = 0; i < 600; ++i) {
    ride.step_by(-0.03, {0, 0}, {.move = ride.state.position.x() > 1.5 ? -1.0 : 1.0});
    pushed += std::any_of(ride.report.move.contacts.begin(), ride.report.move.contacts.end(),
                          [](const Contact<double>& contact) { return contact.collider == 0; });
    fastest = std::max(fastest, ride.state.velocity.norm());
    if (ride.report.move.crushed.empty() && !ride.state.crushed) {
      ASSERT_GT(ride.least_gap(0), -rounding) << i;
    }
  }
  EXPECT_GT(pushed, 5);
  EXPECT_LT(fastest, 3 * 2.05 * 0.03 / frame) << "squeezed between disc and floor, too";
}

TEST(PlankWithRoundEnds, carries_and_pushes_as_it_turns) {
  // A see-saw of a board and two discs, one mover.
  Ride ride({{box_from(-3, -0.2, 3, 0.2, 0), disc(-3, 0, 0.2, 0), disc(3, 0, 0.2, 0), box_from(-9, -4, 9, -3)}});
  ride.state.position = {2.9, 0.2 + half_height + 0.01};
  for (int i = 0; i < 20; ++i) ride.step_by(0);
  ASSERT_TRUE(ride.state.grounded);
  int grounded = 0;
  for (int i = 0; i < 300; ++i) {
    const double before = 0.4 * std::sin(i * 0.05);
    const double after = 0.4 * std::sin((i + 1) * 0.05);
    ride.step_by(after - before);
    grounded += ride.state.grounded;
    if (!ride.report.move.crushed.empty() || ride.state.crushed) continue;
    for (const ColliderIndex end : {1U, 2U}) ASSERT_GT(ride.least_gap(end), -rounding) << i;
  }
  EXPECT_GT(grounded, 100);
}

TEST(AmongRandomWheels, nothing_is_overlapped) {
  const int wanted = steps_wanted("PAPERPROOF_WHEEL_STEPS", sampled(3000));
  int steps = 0;
  int contacts = 0;
  int riding = 0;
  int turned = 0;
  int crushed = 0;
  int stuck = 0;
  double least = 1;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    SceneryDef def{{box_from(-8, -1, 8, 0), box_from(-9, -1, -8, 9), box_from(8, -1, 9, 9)}};
    const int wheels = random.integer(1, 5);
    for (int i = 0; i < wheels; ++i) {
      const auto mover = static_cast<MoverIndex>(i);
      const double radius = random.log_between(0.1, 2);
      const double off = random.chance(0.5) ? 0 : random.between(-1, 1);
      def.colliders.push_back(disc(off, 0, radius, mover));
      if (random.chance(0.3)) def.colliders.push_back(disc(off + radius, 0, radius / 2, mover));
      if (random.chance(0.3)) def.colliders.push_back(box_from(-1.5, -0.1, 1.5, 0.1, mover));
    }
    Ride ride(def);
    std::vector<Vec2d> places;
    std::vector<double> spins;
    std::vector<Vec2d> reaches;
    for (int i = 0; i < wheels; ++i) {
      places.push_back(Vec2d{random.between(-6, 6), random.between(-0.5, 3)});
      spins.push_back(random.either_sign_log_between(0.03, 10));
      reaches.push_back(random.chance(0.5) ? Vec2d(0, 0) : Vec2d{random.between(-1, 1), random.between(-1, 1)});
    }
    double time = 0;
    const auto pose = [&](std::size_t i) -> Pose { return {places[i] + reaches[i] * std::sin(time), spins[i] * time}; };
    for (std::size_t i = 0; i < ride.movers.size(); ++i) ride.movers[i] = {pose(i), pose(i)};
    do {
      ride.state.position = {random.between(-6, 6), 0};
      ride.state.position.y() = random.between(0.7, 6);
    } while (ride.controller.overlaps(ride.state.position, {{0, -30}, frame, ride.movers}) != std::size_t{0});
    Input input;
    for (int i = 0; i < 80; ++i, ++steps) {
      if (random.chance(0.1)) input = {.move = random.integer(-1, 1), .jump = random.chance(0.3)};
      time += frame;
      for (std::size_t k = 0; k < ride.movers.size(); ++k) ride.movers[k] = {ride.movers[k].to, pose(k)};
      const CharacterState<double> before = ride.state;
      const StepStatus status = ride.step(input);
      ASSERT_TRUE(ride.state.position.allFinite()) << "seed " << seed << ", step " << i;
      crushed += status == StepStatus::crushed;
      stuck += status == StepStatus::stuck;
      riding += ride.state.ride.ground != no_collider;
      turned += !ride.controller.turned().empty();
      contacts += static_cast<int>(ride.report.move.contacts.size());
      if (before.crushed || ride.state.crushed || before.stuck_steps > 0 || status == StepStatus::stuck) continue;
      for (ColliderIndex collider = 0; collider < def.colliders.size(); ++collider) {
        const auto& out = ride.report.move.crushed;
        if (def.colliders[collider].shape != ColliderDef::Shape::circle) continue;
        if (std::find(out.begin(), out.end(), collider) != out.end()) continue;
        const double gap = ride.least_gap(collider);
        least = std::min(least, gap);
        ASSERT_GT(gap, -rounding) << "seed " << seed << ", step " << i << ", collider " << collider;
      }
    }
  }
  std::printf("%d steps: %d contacts, %d riding, %d with turns near, %d crushed, %d stuck; least gap %.3g m\n", steps,
              contacts, riding, turned, crushed, stuck, least);
  EXPECT_GT(contacts, steps / 10);
  EXPECT_GT(turned, steps / 20);
  if (wanted >= 3000) {
    EXPECT_GT(riding, steps / 100);
  }
}

}  // namespace
}  // namespace paperproof::test
