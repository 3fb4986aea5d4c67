#include "runs/crowd_contender.hpp"

#include "runs/mover_record.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/together.hpp>

namespace paperproof::compare {
namespace {

class CrowdContender final : public Contender {
 public:
  CrowdContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& scenery, const Planning& planning)
      : crowd_(make_crowd(scenery, rules_for(technique, scene, planning.knobs),
                          definition_of(technique, scene, planning))),
        scratch_(crowd_.make_scratch(character_count(scene))),
        sides_(sides_of(technique)),
        movers_(scene.movers.size(), scenery),
        header_(header_of(technique, ScalarKind::binary64, scenery, scene, planning)),
        states_(character_count(scene)),
        report_(character_count(scene)) {
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    rides_.clear();
    for (const CharacterState& state : states_) rides_.push_back(state.ride);
    step_unrecorded(input);
    refuse_unusable(report_.status);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const CrowdMember& member = report_.members[k];
      write_report(member.step, states_[k], sides_, records[k]);
      records[k].requested += movers_.carried_by(rides_[k], input.players[k].drop);
      movers_.write(records[k]);
      records[k].met.assign(member.met.begin(), member.met.end());
    }
  }

  void step_unrecorded(const StepInput& input) override {
    movers_.take(input.movers, input.dt);
    crowd_.step(states_, input.players, context_of(input, movers_), scratch_, report_);
  }

  [[nodiscard]] Pose pose(std::size_t character) const override { return pose_of(states_[character]); }
  void place(const Pose& pose, std::size_t character) override { states_[character] = state_at(pose); }
  void launch(const Vec2d& velocity, std::size_t character) override { states_[character].velocity = velocity; }

 private:
  TechniqueCrowd crowd_;
  CrowdScratch scratch_;
  Sides sides_;
  MoverRecord movers_;
  TraceHeader header_;
  std::vector<CharacterState> states_;
  std::vector<Ride> rides_;  ///< With which the present step began.
  CrowdReport report_;
};

}  // namespace

std::unique_ptr<Contender> make_crowd_contender(const TechniqueEntry& technique, const Scene& scene,
                                                const Scenery& scenery, const Planning& planning) {
  try {
    return std::make_unique<CrowdContender>(technique, scene, scenery, planning);
  } catch (const std::invalid_argument& error) {
    throw NotApplicable(error.what());
  }
}

}  // namespace paperproof::compare
