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
    place({.position = scene.start.position, .velocity = scene.start.velocity});
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, TraceStep& record) override {
    const box2d::TwinStep& twin = advance(input);
    record.path = twin.path;
    record.requested = requested_;
    record.velocity = twin.velocity;
    record.grounded = twin.grounded;
    record.jumping = state_.jumping;
    record.contacts = twin.contacts;
    record.stuck = record.dropped = false;
    record.capped = twin.capped;
  }

  void step_unrecorded(const StepInput& input) override { advance(input); }

  [[nodiscard]] Pose pose() const override {
    return {.position = world_.position(),
            .velocity = state_.velocity,
            .grounded = state_.grounded,
            .jumping = state_.jumping,
            .jump_held = state_.jump_held,
            .jump_pending = state_.jump_pending};
  }

  void place(const Pose& pose) override {
    state_ = {};
    state_.velocity = pose.velocity;
    state_.grounded = pose.grounded;
    state_.jumping = pose.jumping;
    state_.jump_held = pose.jump_held;
    state_.jump_pending = pose.jump_pending;
    world_.place(pose.position, pose.velocity);
  }

 private:
  const box2d::TwinStep& advance(const StepInput& input) {
    const Vec2d velocity = desired_velocity(character_, gravity_, input.player, dt_, state_);
    requested_ = velocity * dt_;
    const box2d::TwinStep& twin = step_world(velocity);
    state_.velocity = twin.velocity;
    state_.grounded = twin.grounded;
    if (twin.grounded && twin.velocity.y() <= 0) state_.jumping = false;
    return twin;
  }

  const box2d::TwinStep& step_world(const Vec2d& velocity) {
    try {
      return world_.step(velocity, dt_);
    } catch (const box2d::InvalidDefinition& reason) {
      throw LeftRange(std::string(reason.what()) + ": beyond what Box2D is given, and the run ends there");
    }
  }

  CharacterDef character_;
  Vec2d gravity_;
  double dt_;
  box2d::ReferenceWorld world_;
  TraceHeader header_;
  CharacterState<double> state_;
  Vec2d requested_{Vec2d::Zero()};
};

}  // namespace

std::unique_ptr<Contestant> make_box2d_contestant(box2d::SceneryMode mode, const Scene& scene,
                                                  const Scenery<double>& scenery) {
  if (!scene.movers.empty()) throw NotApplicable("the twin's world does not move");
  return std::make_unique<Box2dContestant>(mode, scene, scenery);
}

}  // namespace paperproof::compare
