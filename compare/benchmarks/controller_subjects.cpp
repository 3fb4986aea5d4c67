#include "subject.hpp"

#include "runs/contender.hpp"

#include <paperproof/controller.hpp>

namespace paperproof::benchmarks {
namespace {

class ControllerSubject final : public Subject {
 public:
  ControllerSubject(const Workload& workload, const SweepDef& technique)
      : workload_(workload),
        scenery_(workload.scenery.as_run()),
        controller_(scenery_, workload.scene.character, technique),
        scratch_(controller_.make_scratch()) {
    restart();
  }

  void restart() override {
    state_ = {};
    state_.position = workload_.scene.start.position;
    state_.velocity = workload_.scene.start.velocity;
  }

  void run() override {
    const Vec2d gravity = workload_.scene.gravity;
    const auto dt = workload_.scene.dt;
    for (const Input& input : workload_.inputs) controller_.step(state_, input, {gravity, dt}, scratch_, report_);
  }

  [[nodiscard]] Vec2d position() const override { return state_.position; }

 private:
  const Workload& workload_;
  Scenery scenery_;
  Controller controller_;
  Scratch scratch_;
  CharacterState state_;
  StepReport report_;
};

class ContenderSubject final : public Subject {
 public:
  ContenderSubject(const Workload& workload, std::string_view kind)
      : workload_(workload),
        contender_(compare::make_contender(kind, compare::ScalarKind::binary64, workload.scene, workload.scenery)) {}

  void restart() override {
    const compare::Start& start = workload_.scene.start;
    contender_->place({.position = start.position, .velocity = start.velocity});
  }
  void run() override {
    for (const Input& input : workload_.inputs)
      contender_->step_unrecorded({.dt = workload_.scene.dt, .players = {&input, 1}, .movers = {}, .turns = {}});
  }
  [[nodiscard]] Vec2d position() const override { return contender_->pose().position; }

 private:
  const Workload& workload_;
  std::unique_ptr<compare::Contender> contender_;
};

}  // namespace

std::unique_ptr<Subject> make_controller(const Workload& workload, const SweepDef& technique) {
  return std::make_unique<ControllerSubject>(workload, technique);
}

std::unique_ptr<Subject> make_contender(const Workload& workload, std::string_view kind) {
  return std::make_unique<ContenderSubject>(workload, kind);
}

}  // namespace paperproof::benchmarks
