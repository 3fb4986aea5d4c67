/// Bodies that Box2D moves, free and joined, against closed forms, as in tests/situations/box2d.json; bad definitions
/// never reach Box2D.
#include "levels.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::box2d::test {
namespace {

using Kind = JointDef::Kind;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A world with a body for each mover of the colliders.
struct Bodies {
  Bodies(std::vector<ColliderDef> colliders, const std::vector<BodyDef>& defs, const Vec2d& pull,
         const std::vector<JointDef>& joints = {})
      : world(level(std::move(colliders)), std::vector<std::optional<BodyDef>>(defs.begin(), defs.end()), pull, joints),
        motions(defs.size()) {}

  void step() { world.step(frame, motions); }

  BodyWorld world;
  std::vector<MoverMotion> motions;
};

JointDef spring(double stiffness, double damping = 0) {
  return {.point = {0.5, 1}, .end = {0.5, 9}, .length = 8, .stiffness = stiffness, .damping = damping};
}

TEST(BodyWorld, equal_masses_exchange_their_velocities_and_a_heavy_one_goes_on) {
  for (const double mass : {1.0, 1000.0}) {
    Bodies bodies({box(-9, -9, 9, -8), box(0, 0, 1, 1, 0), box(2, 0, 3, 1, 1)},
                  {{.mass = mass, .restitution = 1, .velocity = {6, 0}}, {.mass = 1, .restitution = 1}}, {0, 0});
    for (int n = 0; n < 60; ++n) bodies.step();
    const auto speed = [&bodies](std::size_t i) { return (bodies.motions[i].to - bodies.motions[i].from).x() / frame; };
    EXPECT_NEAR(speed(0), 6 * (mass - 1) / (mass + 1), 0.02) << mass;
    EXPECT_NEAR(speed(1), 6 * 2 * mass / (mass + 1), 0.02) << mass;
  }
}

TEST(BodyWorld, bad_definitions_and_steps_are_refused_before_box2d_sees_them) {
  const std::vector<ColliderDef> colliders{box(-9, -9, 9, -8), box(0, 0, 1, 1, 0)};
  std::vector<BodyDef> bad{{.velocity = {nan, 0}}};
  for (const double mass : {0.0, -1.0, nan, 1e10}) bad.push_back({.mass = mass});
  for (const double friction : {-1.0, nan}) bad.push_back({.friction = friction});
  for (const double rise : {-0.1, 1.1, nan}) bad.push_back({.restitution = rise});
  for (const BodyDef& def : bad) EXPECT_THROW(Bodies(colliders, {def}, gravity), InvalidDefinition) << &def - &bad[0];
  EXPECT_THROW(Bodies(colliders, {{}}, {0, nan}), InvalidDefinition);
  EXPECT_THROW(Bodies(colliders, {{}, {}}, gravity), InvalidDefinition);
  Bodies bodies(colliders, {{}}, gravity);
  std::vector<MoverMotion> two(2);
  for (const double dt : {0.0, nan}) EXPECT_THROW(bodies.world.step(dt, bodies.motions), InvalidDefinition);
  EXPECT_THROW(bodies.world.step(frame, two), InvalidDefinition);
  bodies.step();
  EXPECT_EQ(bodies.motions[0].from, Vec2d(0, 0));
}

/// Boxes of 1 m in a row far above the ground, each a body.
Bodies joined(const std::vector<BodyDef>& defs, const std::vector<JointDef>& joints) {
  std::vector<ColliderDef> colliders{box(-900, -901, 900, -900)};
  for (MoverIndex i = 0; i < defs.size(); ++i) colliders.push_back(box(3.0 * i, 0, 3.0 * i + 1, 1, i));
  return {std::move(colliders), defs, gravity, joints};
}

TEST(Rod, keeps_its_length_and_swings_like_a_pendulum) {
  // 8 m, 0.1 m aside: 2 pi sqrt(8 / 10) = 5.62 s, less than 1 % more for the angle.
  JointDef rod = spring(0);
  rod.end.x() += 0.1;
  rod.length = (rod.end - rod.point).norm();
  Bodies bodies = joined({{.mass = 4}}, {rod});
  double half = 0;  // when it comes to rest on the other side
  double farthest = 0;
  for (int n = 1; n <= 400; ++n) {
    bodies.step();
    EXPECT_NEAR((rod.point + bodies.motions[0].to - rod.end).norm(), rod.length, least_length) << n;
    if (bodies.motions[0].to.x() > farthest) half = n * frame;
    farthest = std::max(farthest, bodies.motions[0].to.x());
  }
  EXPECT_NEAR(farthest, 0.2, 0.004);
  EXPECT_NEAR(half, std::numbers::pi * std::sqrt(rod.length / 10), 0.05);
}

TEST(Joints, that_box2d_must_not_see_are_refused) {
  std::vector<JointDef> bad{{.body = 2, .end = {0, 9}},
                            {.other = 5, .end = {0, 9}},
                            {.other = 0, .end = {0, 9}},
                            {.point = {nan, 0}, .end = {0, 9}},
                            {.point = {0, 1}, .end = {0, 1.004}},
                            {.kind = Kind::prismatic, .axis = {0, 0}},
                            {.kind = Kind::prismatic, .axis = {nan, 0}},
                            {.kind = Kind::revolute, .point = {0, nan}}};
  for (const double value : {-1.0, 1e13, nan}) bad.insert(bad.end(), {spring(value), spring(1, value)});
  for (const double value : {0.0, 0.004, nan}) bad.push_back({.end = {0, 9}, .length = value});
  for (const JointDef& joint : bad) EXPECT_THROW(joined({{}, {}}, {joint}), InvalidDefinition) << &joint - &bad[0];
  EXPECT_NO_THROW(joined({{}, {}}, {spring(10)}));
}

}  // namespace
}  // namespace paperproof::box2d::test
