/// Bodies and joints that Box2D must not see. tests/situations/box2d.json compares the motion of bodies with formulas.
#include "levels.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <limits>

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

  BodyWorld world;
  std::vector<MoverMotion> motions;
};

JointDef spring(double stiffness, double damping = 0) {
  return {.point = {0.5, 1}, .end = {0.5, 9}, .length = 8, .stiffness = stiffness, .damping = damping};
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
  bodies.world.step(frame, bodies.motions);
  EXPECT_EQ(bodies.motions[0].from, Vec2d(0, 0));
}

/// Two boxes of 1 m far above the ground, each a body.
Bodies joined_by(const JointDef& joint) {
  return {{box(-900, -901, 900, -900), box(0, 0, 1, 1, 0), box(3, 0, 4, 1, 1)}, {{}, {}}, gravity, {joint}};
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
  for (const JointDef& joint : bad) EXPECT_THROW(joined_by(joint), InvalidDefinition) << &joint - &bad[0];
  EXPECT_NO_THROW(joined_by(spring(10)));
}

}  // namespace
}  // namespace paperproof::box2d::test
