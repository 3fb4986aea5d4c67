#include "runs/technique_contender.hpp"

#include "runs/mover_record.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/in_float.hpp>

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

/// @throws NotApplicable for another technique than octagon_sweep in float.
TechniqueController controller_for(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene,
                                   const Scenery& scenery, const Planning& planning) {
  const CharacterDef character = rules_for(technique, scene, planning.knobs);
  const TechniqueDef def = definition_of(technique, scene, planning);
  if (scalar == ScalarKind::binary64) return make_controller(scenery, character, def);
  if (computes_in_one(technique.name)) throw NotApplicable(fmt::format("{} computes in double alone", technique.name));
  return TechniqueController(make_controller_in_float(scenery, character, {def.search, def.sweep_iterations}));
}

class TechniqueContender final : public Contender {
 public:
  /// @param shared by all contenders of a scene, and must outlive them; one in float brings its own, rounded.
  TechniqueContender(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene, const Scenery& shared,
                     const Planning& planning)
      : scalar_(scalar),
        rounded_(scalar == ScalarKind::binary32 ? std::make_unique<Scenery>(as_run(shared.as_run(), scalar)) : nullptr),
        scenery_(rounded_ ? *rounded_ : shared),
        controller_(controller_for(technique, scalar, scene, scenery_, planning)),
        scratch_(controller_.make_scratch()),
        sides_(sides_of(technique)),
        movers_(scene.movers.size(), scenery_, scalar),
        header_(header_of(technique, scalar, scenery_, scene, planning)) {
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const Ride ride = state_.ride;
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

  void place(const Pose& pose, std::size_t) override { state_ = state_at(pose, scalar_); }
  void launch(const Vec2d& velocity, std::size_t) override { state_.velocity = as_run(velocity, scalar_); }

 private:
  ScalarKind scalar_;
  std::unique_ptr<const Scenery> rounded_;  ///< Null in double,
  const Scenery& scenery_;                  ///< where the shared scenery runs.
  TechniqueController controller_;
  Scratch scratch_;
  Sides sides_;
  MoverRecord movers_;
  TraceHeader header_;
  CharacterState state_;
  StepReport report_;
};

}  // namespace

std::unique_ptr<Contender> make_technique_contender(const TechniqueEntry& technique, ScalarKind scalar,
                                                    const Scene& scene, const Scenery& scenery,
                                                    const Planning& planning) {
  return std::make_unique<TechniqueContender>(technique, scalar, scene, scenery, planning);
}

}  // namespace paperproof::compare
