#include <paperproof/box2d/body_world.hpp>

#include "scenery_bodies.hpp"

#include <box2d/b2_distance_joint.h>
#include <box2d/b2_prismatic_joint.h>
#include <box2d/b2_revolute_joint.h>

#include <utility>

namespace paperproof::box2d {
namespace {

/// No longest length of a spring [m]. Box2D's own divides by dt to infinity.
constexpr float endless = 1e9F;

void check_spring(const JointDef& joint) {
  const auto within = [](double value, double lowest, double highest) { return value >= lowest && value <= highest; };
  if (!within(joint.length, least_length, largest_number)) throw InvalidDefinition("a joint is 5 mm to 1e9 m long");
  if (!within(joint.stiffness, 0, largest_stiffness) || !within(joint.damping, 0, largest_stiffness))
    throw InvalidDefinition("the stiffness and the damping of a joint are 0 to 1e12");
  if ((joint.end - joint.point).norm() < least_length)
    throw InvalidDefinition("the points of a distance are at least 5 mm apart: nearer ones have no direction");
}

void add_distance(b2World& world, b2Body& ground, b2Body& body, const JointDef& joint) {
  check_spring(joint);
  b2DistanceJointDef def;
  def.bodyA = &ground;
  def.bodyB = &body;
  def.collideConnected = true;
  def.localAnchorA = checked(joint.end, "a joint's point");
  def.localAnchorB = checked(joint.point, "a joint's point");
  def.length = static_cast<float>(joint.length);
  const bool soft = joint.stiffness > 0;
  def.minLength = soft ? 0 : def.length;
  def.maxLength = soft ? endless : def.length;
  def.stiffness = static_cast<float>(joint.stiffness);
  def.damping = static_cast<float>(joint.damping);
  world.CreateJoint(&def);
}

void add_pin(b2World& world, b2Body& ground, b2Body& body, const JointDef& joint) {
  b2RevoluteJointDef def;
  def.bodyA = &ground;
  def.bodyB = &body;
  def.localAnchorA = def.localAnchorB = checked(joint.point, "a joint's point");
  world.CreateJoint(&def);
}

void add_rail(b2World& world, b2Body& ground, b2Body& body, const JointDef& joint) {
  const Vec2d axis = widened(checked(joint.axis, "the axis of a joint"));
  if (!(axis.norm() > 0)) throw InvalidDefinition("the axis of a joint has a length");
  b2PrismaticJointDef def;
  def.bodyA = &ground;
  def.bodyB = &body;
  def.collideConnected = true;
  def.localAxisA = rounded(axis.normalized());
  world.CreateJoint(&def);
}

}  // namespace

struct BodyWorld::Impl {
  Impl(const Scenery& scenery, std::span<const std::optional<BodyDef>> bodies, const Vec2d& gravity,
       std::span<const JointDef> joints)
      : world(checked(gravity, "gravity")), stage(world, scenery, {}, bodies) {
    world.SetAllowSleeping(false);
    stage.parts.clear();
    if (joints.empty()) return;
    const b2BodyDef standing;
    b2Body* ground = world.CreateBody(&standing);
    for (const JointDef& joint : joints) {
      b2Body& body = dynamic_body(joint.body);
      b2Body& other = joint.other == no_mover ? *ground : dynamic_body(joint.other);
      if (&body == &other) throw InvalidDefinition("a joint holds a body to another one, or to the ground");
      add(joint, other, body);
    }
  }

  b2Body& dynamic_body(MoverIndex mover) const {
    if (mover >= stage.movers.size() || !stage.movers[mover].dynamic)
      throw InvalidDefinition("a joint holds bodies alone");
    return *stage.movers[mover].body;
  }

  void add(const JointDef& joint, b2Body& ground, b2Body& body) {
    switch (joint.kind) {
      case JointDef::Kind::distance:
        return add_distance(world, ground, body, joint);
      case JointDef::Kind::revolute:
        return add_pin(world, ground, body, joint);
      case JointDef::Kind::prismatic:
        return add_rail(world, ground, body, joint);
    }
  }

  b2World world;
  SceneryBodies stage;
};

BodyWorld::BodyWorld(const Scenery& scenery, std::span<const std::optional<BodyDef>> bodies, const Vec2d& gravity,
                     std::span<const JointDef> joints)
    : impl_(std::make_unique<Impl>(scenery, bodies, gravity, joints)) {}
BodyWorld::~BodyWorld() = default;
BodyWorld::BodyWorld(BodyWorld&&) noexcept = default;
BodyWorld& BodyWorld::operator=(BodyWorld&&) noexcept = default;

void BodyWorld::step(double dt, std::span<MoverMotion> motions) {
  SceneryBodies& stage = impl_->stage;
  stage.send(dt, motions);
  stage.step({});
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (stage.movers[i].dynamic) motions[i] = stage.motions[i];
}

}  // namespace paperproof::box2d
