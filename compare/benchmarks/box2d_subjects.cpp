#include "subject.hpp"

#include "box2d_adapter/twin/src/fixtures.hpp"

#include <paperproof/box2d/reference_world.hpp>
#include <paperproof/controller.hpp>

#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <stdexcept>

namespace paperproof::benchmarks {
namespace {

box2d::ReferenceWorldDef definition(Box2dScenery scenery) {
  return {.mode = scenery == Box2dScenery::pieces ? box2d::SceneryMode::pieces : box2d::SceneryMode::chain_loops};
}

class RecordedBox2d final : public Subject {
 public:
  RecordedBox2d(const Workload& workload, Box2dScenery scenery)
      : workload_(workload),
        world_(workload.scenery, workload.scene.character, workload.scene.start.position, definition(scenery)) {
    restart();
  }

  void restart() override {
    state_ = {};
    state_.velocity = workload_.scene.start.velocity;
    world_.place(workload_.scene.start.position, state_.velocity);
  }

  void run() override {
    for (const Input& input : workload_.inputs) step(input);
  }

  /// @return the velocity that was wanted.
  Vec2d step(const Input& input) {
    const compare::Scene& scene = workload_.scene;
    const Vec2d wanted = desired_velocity(scene.character, scene.gravity, input, scene.dt, state_).velocity;
    const box2d::TwinStep& twin = world_.step(wanted, scene.dt);
    state_.velocity = twin.velocity;
    state_.grounded = twin.grounded;
    if (twin.grounded && twin.velocity.y() <= 0) state_.jumping = false;
    return wanted;
  }

  [[nodiscard]] Vec2d position() const override { return world_.position(); }

 private:
  const Workload& workload_;
  box2d::ReferenceWorld world_;
  CharacterState state_;
};

class BareBox2d final : public Subject {
 public:
  BareBox2d(const Workload& workload, Box2dScenery scenery) : workload_(workload), iterations_(definition(scenery)) {
    const b2BodyDef ground;
    const SceneryDef as_run = box2d::rounded(workload.scenery.as_run());
    const box2d::Part still = box2d::parts_of(as_run, 0).front();
    box2d::SceneryFixtures fixtures;
    add_solids(*world_.CreateBody(&ground), workload.scenery, still, iterations_.mode, fixtures);
    if (fixtures.size.fixtures == 0) throw std::logic_error("there is nothing in the world");
    world_.SetAllowSleeping(false);
    add_character();
    RecordedBox2d twin(workload, scenery);
    for (const Input& input : workload.inputs) velocities_.push_back(box2d::rounded(twin.step(input)));
    restart();
    run();
    if (position() != twin.position()) throw std::logic_error("the bare world and the twin went different ways");
  }

  void restart() override {
    body_->SetEnabled(false);  // drops its contacts
    body_->SetTransform(box2d::rounded(workload_.scene.start.position), 0);
    body_->SetEnabled(true);
  }

  void run() override {
    const auto dt = static_cast<float>(workload_.scene.dt);
    for (const b2Vec2& velocity : velocities_) {
      body_->SetLinearVelocity(velocity);
      world_.Step(dt, iterations_.velocity_iterations, iterations_.position_iterations);
    }
  }

  [[nodiscard]] Vec2d position() const override { return box2d::widened(body_->GetPosition()); }

 private:
  void add_character() {
    const b2PolygonShape shape = box2d::character_polygon(workload_.scene.character.shape.hull());
    b2BodyDef body;
    body.type = b2_dynamicBody;
    body.fixedRotation = body.bullet = true;
    body.allowSleep = false;
    body_ = world_.CreateBody(&body);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 1;
    fixture.friction = fixture.restitution = 0;
    body_->CreateFixture(&fixture);
    b2MassData mass;
    mass.mass = body_->GetMass();
    mass.center.SetZero();
    mass.I = 0;
    body_->SetMassData(&mass);
  }

  const Workload& workload_;
  box2d::ReferenceWorldDef iterations_;
  b2World world_{b2Vec2(0, 0)};
  b2Body* body_ = nullptr;
  std::vector<b2Vec2> velocities_;
};

}  // namespace

std::unique_ptr<Subject> make_bare_box2d(const Workload& workload, Box2dScenery scenery) {
  return std::make_unique<BareBox2d>(workload, scenery);
}

std::unique_ptr<Subject> make_recorded_box2d(const Workload& workload, Box2dScenery scenery) {
  return std::make_unique<RecordedBox2d>(workload, scenery);
}

}  // namespace paperproof::benchmarks
