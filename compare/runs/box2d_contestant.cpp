#include "runs/box2d_contestant.hpp"

#include <paperproof/controller.hpp>

namespace paperproof::compare {
namespace {

class Box2dContestant final : public Contestant {
 public:
  Box2dContestant(box2d::SceneryMode mode, const Scene& scene, const Scenery<double>& scenery)
      : character_(scene.character),
        gravity_(scene.gravity),
        dt_(scene.dt),
        world_(scenery, scene.character, scene.start.position, {.mode = mode}) {
    if (!(dt_ >= box2d::least_step)) throw box2d::InvalidDefinition("Box2D takes no steps shorter than 1e-9 s");
    header_.scene = scene.name;
    header_.contender = mode == box2d::SceneryMode::pieces ? "box2d_pieces" : "box2d";
    header_.scalar = name_of(ScalarKind::binary32);
    header_.dt = scene.dt;
    header_.points = world_.points_as_run();
    header_.scenery = world_.as_run();
    header_.ids = scene.ids;
    header_.box2d = box2d::box2d_version();
    header_.tolerances = {{"rest_gap", box2d::rest_gap},
                          {"touch_gap", box2d::touch_gap},
                          {"max_travel_per_step", box2d::max_travel_per_step}};
    header_.path_exact = false;
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const box2d::TwinStep& twin = advance(input);
    record.path = twin.path;
    record.requested = requested_;
    record.velocity = twin.velocity;
    record.grounded = twin.grounded;
    record.jumping = state_.jumping;
    record.contacts = twin.contacts;
    record.movers = twin.movers;
    record.sensors = twin.sensors;
    record.stuck = record.dropped = false;
    record.capped = twin.capped;
  }

  void step_unrecorded(const StepInput& input) override { advance(input); }

  [[nodiscard]] Pose pose(std::size_t) const override {
    return {.position = world_.position(),
            .velocity = state_.velocity,
            .grounded = state_.grounded,
            .jumping = state_.jumping,
            .jump_held = state_.jump_held,
            .jump_pending = state_.jump_pending,
            .ride = state_.ride,
            .ground_normal = ground_normal_};
  }

  void place(const Pose& pose, std::size_t) override {
    state_ = {};
    state_.velocity = pose.velocity;
    state_.grounded = pose.grounded;
    state_.jumping = pose.jumping;
    state_.jump_held = pose.jump_held;
    state_.jump_pending = pose.jump_pending;
    state_.ride = pose.ride;
    ground_normal_ = pose.ground_normal;
    world_.place(pose.position, pose.velocity);
  }

 private:
  /// On ground that carries the intent is relative to it, as it is for the controller.
  const box2d::TwinStep& advance(const StepInput& input) {
    state_.velocity -= state_.ride.velocity;
    const Vec2d carried = velocity_of_ground(state_.ride.ground, ground_normal_, input.movers);
    const Vec2d velocity = carried + desired_velocity(character_, gravity_, input.players.front(), dt_, state_);
    requested_ = velocity * dt_;
    const box2d::TwinStep& twin = step_world(velocity, input.movers);
    state_.velocity = twin.velocity;
    state_.grounded = twin.grounded;
    ride_on(twin);
    // Of what rides, float keeps no more than this [m/s].
    const double at_rest = state_.ride.ground == Ride<double>::none ? 0 : 1e-4;
    if (twin.grounded && twin.velocity.y() <= state_.ride.velocity.y() + at_rest) state_.jumping = false;
    return twin;
  }

  const box2d::TwinStep& step_world(const Vec2d& velocity, std::span<const MoverMotion<double>> movers) {
    try {
      return world_.step(velocity, dt_, movers);
    } catch (const box2d::InvalidDefinition& reason) {
      throw LeftRange(std::string(reason.what()) + ": beyond what Box2D is given, and the run ends there");
    }
  }

  void ride_on(const box2d::TwinStep& twin) {
    state_.ride = {};
    if (!twin.ground) return;
    const ColliderDef& ground = header_.scenery.colliders[twin.ground->collider];
    if (ground.mover == no_mover && ground.surface_speed == 0) return;
    ground_normal_ = twin.ground->normal;
    state_.ride.ground = twin.ground->collider;
    state_.ride.velocity = velocity_of_ground(twin.ground->collider, ground_normal_, twin.movers);
  }

  /// In one step [m/s]; a conveyor's surface runs along the ground, to the right where its speed is positive.
  [[nodiscard]] Vec2d velocity_of_ground(ColliderIndex ground, const Vec2d& normal,
                                         std::span<const MoverMotion<double>> movers) const {
    Vec2d velocity = Vec2d::Zero();
    if (ground == Ride<double>::none) return velocity;
    const ColliderDef& collider = header_.scenery.colliders[ground];
    if (collider.mover != no_mover) velocity = (movers[collider.mover].to - movers[collider.mover].from) / dt_;
    return velocity + collider.surface_speed * Vec2d(normal.y(), -normal.x());
  }

  CharacterDef character_;
  Vec2d gravity_;
  double dt_;
  box2d::ReferenceWorld world_;
  TraceHeader header_;
  CharacterState<double> state_;
  Vec2d ground_normal_{Vec2d::UnitY()};  ///< Of what the ride is on.
  Vec2d requested_{Vec2d::Zero()};
};

}  // namespace

std::unique_ptr<Contestant> make_box2d_contestant(box2d::SceneryMode mode, const Scene& scene,
                                                  const Scenery<double>& scenery) {
  return std::make_unique<Box2dContestant>(mode, scene, scenery);
}

}  // namespace paperproof::compare
