#include "runs/engine_intent.hpp"

#include "oracle/intent.hpp"
#include "oracle/turning.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/controller.hpp>

namespace paperproof::compare {

EngineCharacter character_at(const Pose& pose) {
  EngineCharacter character{state_at(pose), pose.ground_normal};
  if (pose.state.ride && !pose.state.ride->character) {
    character.state.ride.ground = pose.state.ride->collider;
    character.state.ride.velocity = pose.state.ride->velocity;
  }
  return character;
}

Pose pose_of(const EngineCharacter& character, const Vec2d& position) {
  Pose pose = pose_of(character.state);
  pose.position = position;
  pose.ground_normal = character.ground_normal;
  return pose;
}

void clear(TraceStep& record) {
  record.path.clear();
  record.contacts.clear();
  record.met.clear();
  record.movers.clear();
  record.vertex_ways.clear();
  record.sensors.clear();
  record.dropped_through.clear();
  record.requested = Vec2d::Zero();
  record.steered = 0;
  record.stuck = record.dropped = record.capped = false;
}

Vec2d EngineIntent::wanted(EngineCharacter& who, const Vec2d& at, const Input& player, const StepInput& input) {
  who.state.velocity -= who.state.ride.velocity;
  const Vec2d carried = velocity_of_ground(who.state.ride.ground, who.ground_normal, input);
  const double move = player.move.value_or(0);
  const bool may_press = player.jump || who.state.jump_pending;
  bool wall_ahead = false;
  if (header_.character.no_jump_toward_wall && may_press && who.state.grounded && move != 0) {
    if (!solids_) solids_ = std::make_unique<ExactScenery>(detail::TurningJudge::exact_part(header_), header_.points);
    wall_ahead = is_wall_ahead(header_, *solids_, {at, input.movers, 0}, input.up, move);
  }
  const DesiredVelocity own =
      desired_velocity(header_.character, input.gravity, player, input.dt, who.state, wall_ahead);
  who.steered = own.steered;
  return carried + own.velocity;
}

/// A character that comes to rest on what carries is carried at once; one with a speed of its own keeps it, as for the
/// controller.
void EngineIntent::take_over(const EngineStep& step, const StepInput& input, std::span<const Contact> contacts,
                             EngineCharacter& who) const {
  CharacterState& state = who.state;
  state.velocity = step.velocity;
  state.grounded = step.grounded;
  state.wall_left = state.wall_right = false;
  for (const Contact& contact : contacts) {
    state.wall_left = state.wall_left || contact.side == Side::left;
    state.wall_right = state.wall_right || contact.side == Side::right;
  }
  const bool comes_to_rest = state.ride.ground == Ride::none && state.velocity.x() == 0;
  state.ride = {};
  if (step.ground) {
    const ColliderDef& ground = header_.scenery.colliders[step.ground->collider];
    if (ground.mover != no_mover || ground.surface_speed != 0) {
      who.ground_normal = step.ground->normal;
      state.ride.ground = step.ground->collider;
      state.ride.velocity = velocity_of_ground(step.ground->collider, who.ground_normal, input);
      if (comes_to_rest) state.velocity.x() = state.ride.velocity.x();
    }
  }
  // Of what rides, float keeps no more than this [m/s].
  const double at_rest = state.ride.ground == Ride::none ? 0 : 1e-4;
  if (step.grounded && step.velocity.y() <= state.ride.velocity.y() + at_rest) state.jumping = false;
}

/// In one step [m/s]; a conveyor's surface runs along the ground, to the right where its speed is positive.
Vec2d EngineIntent::velocity_of_ground(ColliderIndex ground, const Vec2d& normal, const StepInput& input) const {
  if (ground == Ride::none) return Vec2d::Zero();
  const ColliderDef& collider = header_.scenery.colliders[ground];
  Vec2d velocity = collider.surface_speed * Vec2d(normal.y(), -normal.x());
  if (collider.mover != no_mover) {
    const MoverMotion& motion = input.movers[collider.mover];
    velocity += (motion.to - motion.from) / input.dt;
  }
  return velocity;
}

}  // namespace paperproof::compare
