#include "scenery_bodies.hpp"

#include <box2d/b2_fixture.h>

#include <algorithm>
#include <cmath>

namespace paperproof::box2d {
namespace {

/// Of scenery, where there are bodies to rub on it: Box2D's own default. It takes the root of the product of two.
constexpr float scenery_friction = 0.2F;

/// Steps whose length changes by more than this factor start Box2D's solver cold. It scales the stored impulses by the
/// ratio, and a large one overflows.
constexpr float largest_step_ratio = 16;

float checked_step(double dt) {
  if (!(dt >= least_step) || !(dt <= largest_number)) throw InvalidDefinition("a time step must be 1e-9 s to 1e9 s");
  return static_cast<float>(dt);
}

void check_motions(std::size_t movers, std::span<const MoverMotion> motions) {
  if (motions.size() != movers) throw InvalidDefinition("a step takes one motion for each mover");
  for (const MoverMotion& motion : motions) {
    (void)checked(motion.from, "a mover");
    (void)checked(motion.to, "a mover");
    (void)checked(Vec2d(motion.from_angle, motion.to_angle), "the angle of a mover");
  }
}

void check_body(const BodyDef& def) {
  const auto within = [](double value, double lowest, double highest) { return value >= lowest && value <= highest; };
  if (!within(def.mass, least_mass, largest_mass)) throw InvalidDefinition("a body has a mass of 1e-6 kg to 1e9 kg");
  if (!within(def.friction, 0, 1e6)) throw InvalidDefinition("the friction of a body is 0 to 1e6");
  if (!within(def.restitution, 0, 1)) throw InvalidDefinition("the restitution of a body is 0 to 1");
  (void)checked(def.velocity, "the velocity of a body");
}

/// With the centre of mass at the position nothing is lost: Box2D moves the centre and derives the position from it.
void give_mass(b2Body& body, double mass) {
  b2MassData data;
  data.mass = static_cast<float>(mass);
  data.center.SetZero();
  data.I = 0;
  body.SetMassData(&data);
}

void give_surface(b2Body& body, float friction, float restitution) {
  for (b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    fixture->SetFriction(friction);
    fixture->SetRestitution(restitution);
  }
}

/// Of solids that stand and are dynamic for Box2D [kg].
constexpr double standing_mass = 1e9;

b2BodyType type_of(SolidBody solids) {
  switch (solids) {
    case SolidBody::fixed:
      return b2_staticBody;
    case SolidBody::kinematic:
      return b2_kinematicBody;
    case SolidBody::dynamic:
      return b2_dynamicBody;
  }
  return b2_staticBody;
}

b2BodyDef body_of(const Part& part, SolidBody solids, const BodyDef* dynamic) {
  b2BodyDef def;
  def.type = part.mover == no_mover ? type_of(solids) : b2_kinematicBody;
  def.fixedRotation = def.type == b2_dynamicBody;
  def.allowSleep = false;
  if (dynamic != nullptr) {
    check_body(*dynamic);
    def.type = b2_dynamicBody;
    def.fixedRotation = true;
    def.bullet = true;
    def.linearVelocity = rounded(dynamic->velocity);
  }
  return def;
}

}  // namespace

SceneryBodies::SceneryBodies(b2World& world, const Scenery& scenery, const ReferenceWorldDef& def,
                             std::span<const std::optional<BodyDef>> dynamic)
    : as_run(rounded(scenery.as_run())),
      parts(parts_of(as_run, scenery.mover_count())),
      world_(world),
      drive_(def.drive) {
  if (!dynamic.empty() && dynamic.size() != scenery.mover_count())
    throw InvalidDefinition("bodies are given for each mover, or for none");
  std::vector<b2Body*> bodies;
  for (const Part& part : parts) {
    const BodyDef* body = nullptr;
    if (part.mover != no_mover && !dynamic.empty() && dynamic[part.mover]) body = &*dynamic[part.mover];
    const b2BodyDef body_def = body_of(part, def.solids, body);
    bodies.push_back(world.CreateBody(&body_def));
    // Chains have no inside, and what is dynamic needs one to be hit by chains.
    const bool is_dynamic = body_def.type == b2_dynamicBody;
    add_solids(*bodies.back(), scenery, part, is_dynamic ? SceneryMode::pieces : def.mode, fixtures);
    if (is_dynamic && body == nullptr) give_mass(*bodies.back(), standing_mass);
    if (body != nullptr) {
      give_mass(*bodies.back(), body->mass);
      give_surface(*bodies.back(), static_cast<float>(body->friction), static_cast<float>(body->restitution));
    } else if (!dynamic.empty()) {
      give_surface(*bodies.back(), scenery_friction, 0);
    }
    if (part.mover != no_mover) movers.push_back({.body = bodies.back(), .dynamic = body != nullptr});
  }
  add_sensors(bodies, scenery, as_run, fixtures);
  offsets.resize(movers.size(), Vec2d::Zero());
  motions.resize(movers.size());
}

void SceneryBodies::send(double length, std::span<const MoverMotion> wanted) {
  const float checked_length = checked_step(length);
  check_motions(movers.size(), wanted);
  dt = checked_length;
  capped = false;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    Mover& mover = movers[i];
    const b2Vec2 before = mover.body->GetPosition();
    if (!mover.dynamic) send(mover, wanted[i]);
    const bool was_put = drive_ == MoverDrive::transform && !mover.dynamic;
    offsets[i] = was_put ? widened(before) : widened(mover.body->GetPosition());
    motions[i].from_angle = static_cast<double>(mover.body->GetAngle());
  }
}

/// By velocity: Box2D sweeps a body from where the step finds it, and what is put somewhere was never on the way.
void SceneryBodies::send(Mover& mover, const MoverMotion& wanted) {
  const b2Vec2 from = rounded(wanted.from);
  const auto from_angle = static_cast<float>(wanted.from_angle);
  if (!(mover.goal == from) || mover.goal_angle != from_angle) mover.body->SetTransform(from, from_angle);
  mover.goal = rounded(wanted.to);
  mover.goal_angle = static_cast<float>(wanted.to_angle);
  if (drive_ == MoverDrive::transform) {
    mover.body->SetTransform(mover.goal, mover.goal_angle);
    return;
  }
  const b2Vec2 way = mover.goal - mover.body->GetPosition();
  const float angle = mover.goal_angle - mover.body->GetAngle();
  capped = capped || way.LengthSquared() > b2_maxTranslationSquared || angle * angle > b2_maxRotationSquared;
  mover.body->SetLinearVelocity((1 / dt) * way);
  mover.body->SetAngularVelocity(angle / dt);
}

void SceneryBodies::step(const ReferenceWorldDef& def) {
  world_.SetWarmStarting(dt <= largest_step_ratio * last_dt_);
  world_.Step(dt, def.velocity_iterations, def.position_iterations);
  last_dt_ = dt;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    motions[i].from = offsets[i];
    motions[i].to = widened(movers[i].body->GetPosition());
    motions[i].to_angle = static_cast<double>(movers[i].body->GetAngle());
  }
}

}  // namespace paperproof::box2d
