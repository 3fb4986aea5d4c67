#include "runs/crowd_contender.hpp"

#include "runs/mover_record.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/crowd.hpp>

namespace paperproof::compare {
namespace {

template <class Scalar>
class CrowdContender final : public Contender {
 public:
  CrowdContender(const TechniqueEntry& technique, const Scene& scene, const Scenery<double>& scenery,
                 const Planning& planning)
      : scenery_(scenery),
        crowd_(make_crowd(scenery_.get(), rules_for(technique, scene, planning.knobs),
                          definition_of(technique, scene, planning))),
        scratch_(crowd_.make_scratch(character_count(scene))),
        sides_(sides_of(technique)),
        movers_(scene.movers.size(), scenery_.get()),
        header_(header_of(technique, scenery_.get(), scene, planning)),
        states_(character_count(scene)),
        report_(character_count(scene)) {
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    rides_.clear();
    for (const CharacterState<Scalar>& state : states_) rides_.push_back(state.ride);
    step_unrecorded(input);
    refuse_unusable(report_.status);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const CrowdMember<Scalar>& member = report_.members[k];
      write_report(member.step, states_[k], sides_, records[k]);
      records[k].requested += movers_.carried_by(rides_[k], input.players[k].drop);
      movers_.write(records[k]);
      records[k].met.clear();
      for (const CrowdContact<Scalar>& contact : member.met)
        records[k].met.push_back({.other = contact.other,
                                  .normal = contact.normal.template cast<double>(),
                                  .fraction = static_cast<double>(contact.fraction),
                                  .side = contact.side});
    }
  }

  void step_unrecorded(const StepInput& input) override {
    movers_.take(input.movers, input.dt);
    crowd_.step(states_, input.players, context_of(input, movers_), scratch_, report_);
  }

  [[nodiscard]] Pose pose(std::size_t character) const override { return pose_of(states_[character]); }
  void place(const Pose& pose, std::size_t character) override { states_[character] = state_at<Scalar>(pose); }
  void launch(const Vec2d& velocity, std::size_t character) override {
    states_[character].velocity = velocity.cast<Scalar>();
  }

 private:
  OwnScenery<Scalar> scenery_;
  TechniqueCrowd<Scalar> crowd_;
  CrowdScratch scratch_;
  Sides sides_;
  MoverRecord<Scalar> movers_;
  TraceHeader header_;
  std::vector<CharacterState<Scalar>> states_;
  std::vector<Ride<Scalar>> rides_;  ///< With which the present step began.
  CrowdReport<Scalar> report_;
};

}  // namespace

std::unique_ptr<Contender> make_crowd_contender(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene,
                                                const Scenery<double>& scenery, const Planning& planning) {
  try {
    if (scalar == ScalarKind::binary32)
      return std::make_unique<CrowdContender<float>>(technique, scene, scenery, planning);
    return std::make_unique<CrowdContender<double>>(technique, scene, scenery, planning);
  } catch (const std::invalid_argument& error) {
    throw NotApplicable(error.what());
  }
}

}  // namespace paperproof::compare
