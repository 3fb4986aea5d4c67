/// Joints between bodies and the ground, against closed forms.
#include "levels.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::test {
namespace {

using Kind = JointDef::Kind;

/// Boxes of 1 m on a grid far above the ground, each a body.
struct Joined {
  Joined(const std::vector<BodyDef>& defs, const std::vector<JointDef>& joints, const Vec2d& gravity)
      : world(places(defs.size()), std::vector<std::optional<BodyDef>>(defs.begin(), defs.end()), gravity, joints),
        motions(defs.size()) {}

  static Scenery<double> places(std::size_t count) {
    std::vector<ColliderDef> colliders{box(-900, -901, 900, -900)};
    for (std::size_t i = 0; i < count; ++i) {
      colliders.push_back(box(3.0 * static_cast<double>(i), 0, 3.0 * static_cast<double>(i) + 1, 1));
      colliders.back().mover = static_cast<MoverIndex>(i);
    }
    return level(std::move(colliders));
  }
  void step(double dt) { world.step(dt, motions); }

  BodyWorld world;
  std::vector<MoverMotion<double>> motions;
};

JointDef spring(double stiffness, double damping = 0) {
  return {.point = {0.5, 1}, .end = {0.5, 9}, .length = 8, .stiffness = stiffness, .damping = damping};
}

/// Implicit Euler, v' (1 + h d/m + h² k/m) = v + h g - h k/m x, is what the soft constraint is for one spring.
TEST(Spring, goes_as_implicit_euler_has_it_step_by_step) {
  constexpr double mass = 4;
  struct Case {
    double stiffness, damping, dt;
  };
  for (const Case& one : {Case{100, 0, frame}, Case{1000, 8, frame}, Case{1e5, 0, frame}, Case{1e4, 1e3, 1e-3}}) {
    Joined joined({{.mass = mass}}, {spring(one.stiffness, one.damping)}, {0, -10});
    double speed = 0;
    double way = 0;
    double farthest = 0;
    for (int n = 0; n < 240; ++n) {
      joined.step(one.dt);
      speed = (speed - 10 * one.dt - one.dt * one.stiffness / mass * way) /
              (1 + one.dt * one.damping / mass + one.dt * one.dt * one.stiffness / mass);
      way += one.dt * speed;
      farthest = std::max(farthest, std::abs(way));
      ASSERT_NEAR(joined.motions[0].to.y(), way, 1e-5 + 1e-3 * farthest) << one.stiffness << " step " << n;
    }
    EXPECT_GT(farthest, 0.9 * mass * 10 / one.stiffness) << "it moved";
  }
}

/// z² (1 + ω²h²) - 2 z + 1 = 0 has |z| = 1/√(1 + ω²h²) and an angle of atan(ωh).
TEST(Spring, has_the_period_and_the_decay_of_the_implicit_method) {
  constexpr double mass = 4;
  constexpr double stiffness = 400;  // 10 rad/s
  const double omega_h = std::sqrt(stiffness / mass) * frame;
  Joined joined({{.mass = mass}}, {spring(stiffness)}, {0, -10});
  const double sag = -mass * 10 / stiffness;
  std::vector<double> turns;  // [steps] where it comes up through the sag, between two steps
  std::vector<double> peaks;
  double before = -sag;  // of y - sag
  double peak = 0;
  for (int n = 1; n <= 400; ++n) {
    joined.step(frame);
    const double now = joined.motions[0].to.y() - sag;
    if (before < 0 && now >= 0) {
      turns.push_back(n - now / (now - before));
      peaks.push_back(peak);
      peak = 0;
    }
    peak = std::max(peak, now);
    before = now;
  }
  ASSERT_GE(turns.size(), 6U);
  const double period = (turns.back() - turns.front()) / static_cast<double>(turns.size() - 1);
  const double exact = 2 * std::numbers::pi / std::atan(omega_h);  // 38.0 steps; 37.7 without the method's error
  EXPECT_NEAR(period, exact, 0.02);
  EXPECT_GT(exact - 2 * std::numbers::pi / omega_h, 0.2) << "the bound tells it from the continuous period";
  const double decay = std::pow(1 + omega_h * omega_h, -exact / 2);
  EXPECT_NEAR(peaks[3] / peaks[2], decay, 0.02);
}

TEST(Spring, sags_by_weight_over_stiffness) {
  for (const double stiffness : {100.0, 1e4, 1e6}) {
    const double damping = 2 * std::sqrt(stiffness * 4);  // critical
    Joined joined({{.mass = 4}}, {spring(stiffness, damping)}, {0, -10});
    for (int n = 0; n < 600; ++n) joined.step(frame);
    EXPECT_NEAR(joined.motions[0].to.y(), -40 / stiffness, 1e-6 + 1e-4 * 40 / stiffness) << stiffness;
    EXPECT_NEAR((joined.motions[0].to - joined.motions[0].from).norm(), 0, 1e-6);
  }
}

TEST(Rod, keeps_its_length_and_swings_like_a_pendulum) {
  // 8 m, 0.1 m aside: 2 pi sqrt(8 / 10) = 5.62 s, less than 1 % more for the angle.
  JointDef rod = spring(0);
  rod.end.x() += 0.1;
  const double length = (rod.end - rod.point).norm();
  rod.length = length;
  Joined joined({{.mass = 4}}, {rod}, {0, -10});
  double half = 0;  // when it comes to rest on the other side
  double farthest = 0;
  for (int n = 1; n <= 400; ++n) {
    joined.step(frame);
    EXPECT_NEAR((rod.point + joined.motions[0].to - rod.end).norm(), length, least_length) << n;
    if (joined.motions[0].to.x() > farthest) half = n * frame;
    farthest = std::max(farthest, joined.motions[0].to.x());
  }
  EXPECT_NEAR(farthest, 0.2, 0.004);
  EXPECT_NEAR(half, std::numbers::pi * std::sqrt(length / 10), 0.05);
}

TEST(Rail, leaves_a_body_one_direction) {
  Joined joined({{.velocity = {3, 4}}}, {{.kind = Kind::prismatic, .axis = {2, 0}}}, {0, -10});
  for (int n = 1; n <= 60; ++n) {
    joined.step(frame);
    EXPECT_NEAR(joined.motions[0].to.x(), 3 * n * frame, 1e-4);
    EXPECT_NEAR(joined.motions[0].to.y(), 0, 1e-4);
  }
}

TEST(Pin, holds_a_body_in_place_and_two_to_each_other) {
  Joined held({{.velocity = {3, 4}}}, {{.kind = Kind::revolute, .point = {0.5, 0.5}}}, {0, -10});
  Joined both({{.mass = 1, .velocity = {4, 0}}, {.mass = 3}}, {{.kind = Kind::revolute, .other = 1, .point = {2, 0.5}}},
              {0, -10});
  for (int n = 1; n <= 60; ++n) {
    held.step(frame);
    both.step(frame);
    EXPECT_NEAR(held.motions[0].to.norm(), 0, 0.01) << n;
    EXPECT_NEAR((both.motions[0].to - both.motions[1].to).norm(), 0, 0.01) << n;
  }
  EXPECT_NEAR(both.motions[1].to.x(), 1, 0.02) << "momentum: 1 kg of 4 kg at 4 m/s";
  EXPECT_NEAR(both.motions[1].to.y(), -10 * frame * frame * 60 * 61 / 2, 0.01);
}

TEST(Joints, change_no_collision_but_of_what_is_pinned) {
  // A spring to the ground: the body still lands. Two boxes side by side, pinned: they do not push each other away.
  const std::vector<ColliderDef> scene{box(-9, -1, 9, 0), [] {
                                         ColliderDef one = box(0, 0.5, 1, 1.5);
                                         one.mover = 0;
                                         return one;
                                       }()};
  const JointDef slack = {.point = {0.5, 1.5}, .end = {0.5, 9}, .length = 7.5, .stiffness = 1};
  BodyWorld world(level(scene), std::vector<std::optional<BodyDef>>{BodyDef{}}, {0, -10}, std::span(&slack, 1));
  std::vector<MoverMotion<double>> motions(1);
  for (int n = 0; n < 120; ++n) world.step(frame, motions);
  EXPECT_NEAR(0.5 + motions[0].to.y(), rest_gap, 0.006);
}

TEST(Joints, that_box2d_must_not_see_are_refused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const JointDef& joint) {
    EXPECT_THROW(Joined({{}, {}}, {joint}, {0, -10}), InvalidDefinition);
  };
  EXPECT_NO_THROW(Joined({{}, {}}, {spring(10)}, {0, -10}));
  refused({.body = 2, .end = {0, 9}});
  refused({.other = 5, .end = {0, 9}});
  refused({.other = 0, .end = {0, 9}});
  refused({.point = {nan, 0}, .end = {0, 9}});
  refused({.point = {0, 1}, .end = {0, 1.004}});
  for (const double bad : {-1.0, 1e13, nan}) {
    refused(spring(bad));
    refused(spring(1, bad));
  }
  for (const double bad : {0.0, 0.004, nan}) refused({.end = {0, 9}, .length = bad});
  refused({.kind = Kind::prismatic, .axis = {0, 0}});
  refused({.kind = Kind::prismatic, .axis = {nan, 0}});
  refused({.kind = Kind::revolute, .point = {0, nan}});
}

}  // namespace
}  // namespace paperproof::box2d::test
