#include "runs/technique_contender.hpp"

#include "runs/mover_record.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/controller.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

template <class Scalar>
class TechniqueContender final : public Contender {
 public:
  TechniqueContender(const TechniqueEntry& technique, const Scene& scene, const Scenery<double>& scenery,
                     const Planning& planning)
      : scenery_(scenery),
        controller_(make_controller(scenery_.get(), rules_for(technique, scene, planning.knobs),
                                    definition_of(technique, scene, planning))),
        scratch_(controller_.make_scratch()),
        sides_(sides_of(technique)),
        movers_(scene.movers.size(), scenery_.get()),
        header_(header_of(technique, scenery_.get(), scene, planning)) {
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const Ride<Scalar> ride = state_.ride;
    step_unrecorded(input);
    write_report(report_, state_, sides_, record);
    record.requested += movers_.carried_by(ride, input.players.front().drop);
    movers_.write(record);
    refuse_unusable(report_.status, report_.move.refusal);
  }

  void step_unrecorded(const StepInput& input) override {
    movers_.take(input.movers, input.dt);
    controller_.step(state_, input.players.front(), context_of(input, movers_), scratch_, report_);
  }

  [[nodiscard]] Pose pose(std::size_t) const override { return pose_of(state_); }

  [[nodiscard]] std::size_t memory_bytes() const override { return controller_.memory_bytes(); }

  void place(const Pose& pose, std::size_t) override { state_ = state_at<Scalar>(pose); }
  void launch(const Vec2d& velocity, std::size_t) override { state_.velocity = velocity.cast<Scalar>(); }

 private:
  OwnScenery<Scalar> scenery_;
  TechniqueController<Scalar> controller_;
  Scratch<Scalar> scratch_;
  Sides sides_;
  MoverRecord<Scalar> movers_;
  TraceHeader header_;
  CharacterState<Scalar> state_;
  StepReport<Scalar> report_;
};

}  // namespace

std::unique_ptr<Contender> make_technique_contender(const TechniqueEntry& technique, ScalarKind scalar,
                                                    const Scene& scene, const Scenery<double>& scenery,
                                                    const Planning& planning) {
  if (scalar == ScalarKind::binary32)
    return std::make_unique<TechniqueContender<float>>(technique, scene, scenery, planning);
  return std::make_unique<TechniqueContender<double>>(technique, scene, scenery, planning);
}

}  // namespace paperproof::compare
