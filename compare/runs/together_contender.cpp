#include "runs/together_contender.hpp"

#include "runs/mover_record.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/together.hpp>

namespace paperproof::compare {
namespace {

class TogetherContender final : public Contender {
 public:
  TogetherContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& scenery,
                    const Planning& planning)
      : level_(scenery.as_run()),
        first_body_(static_cast<ColliderIndex>(level_.size())),
        movers_(scene.movers.size(), level_),
        header_(header_of(technique, ScalarKind::binary64, scenery, scene, planning)),
        states_(character_count(scene)),
        rides_(states_.size()),
        reports_(states_.size()) {
    const CharacterDef character = rules_for(technique, scene, planning.knobs);
    const TechniqueDef def = definition_of(technique, scene, planning);
    for (std::size_t i = 0; i < states_.size(); ++i) level_.add(body_of(character));
    controller_.emplace(level_, character, SweepDef{def.search, def.sweep_iterations});
    scratch_ = controller_->make_scratch();
    for (std::size_t i = 0; i < states_.size(); ++i)
      companions_.push_back({.controller = &*controller_,
                             .state = &states_[i],
                             .body = first_body_ + static_cast<ColliderIndex>(i),
                             .scratch = &scratch_,
                             .report = &reports_[i]});
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    std::vector<Vec2d> from;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      rides_[k] = states_[k].ride;
      from.push_back(states_[k].position);
    }
    step_unrecorded(input);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      TraceStep& record = records[k];
      write_report(reports_[k], states_[k], Sides::as_said, record);
      record.turn = static_cast<CharacterIndex>(companions_[k].turn);
      record.requested +=
          rides_[k].ground < first_body_ || rides_[k].ground == Ride::none
              ? movers_.carried_by(rides_[k], input.players[k].drop)
              : Vec2d(states_[rides_[k].ground - first_body_].position - from[rides_[k].ground - first_body_]);
      name_others(record);
      movers_.write(record);
      refuse_unusable(reports_[k].status);
    }
  }

  void step_unrecorded(const StepInput& input) override {
    movers_.take(input.movers, input.dt);
    for (std::size_t k = 0; k < states_.size(); ++k) companions_[k].input = input.players[k];
    step_together(companions_, context_of(input, movers_), together_);
  }

  [[nodiscard]] Pose pose(std::size_t character) const override {
    Pose pose = pose_of(states_[character]);
    if (is_body(pose.ride.ground)) pose.ride = {};
    return pose;
  }
  void place(const Pose& pose, std::size_t character) override { states_[character] = state_at(pose); }
  void launch(const Vec2d& velocity, std::size_t character) override { states_[character].velocity = velocity; }

 private:
  [[nodiscard]] bool is_body(ColliderIndex collider) const { return collider != Ride::none && collider >= first_body_; }

  /// Contacts with the bodies of others are those with characters, and so is what carries it.
  void name_others(TraceStep& record) const {
    if (record.ride && record.ride->collider >= first_body_)
      record.ride = TraceRide{.velocity = record.ride->velocity, .character = record.ride->collider - first_body_};
    record.met.clear();
    for (const Contact& contact : record.contacts)
      if (contact.collider >= first_body_)
        record.met.push_back({contact.collider - first_body_, contact.normal, contact.fraction, contact.side});
    std::erase_if(record.contacts, [&](const Contact& contact) { return contact.collider >= first_body_; });
  }

  Level level_;
  ColliderIndex first_body_;  ///< The bodies come after the colliders of the scene.
  MoverRecord movers_;
  TraceHeader header_;
  std::optional<Controller> controller_;
  Scratch scratch_;
  std::vector<CharacterState> states_;
  std::vector<Ride> rides_;  ///< With which the present step began.
  std::vector<StepReport> reports_;
  std::vector<Companion> companions_;
  TogetherScratch together_;
};

}  // namespace

std::unique_ptr<Contender> make_together_contender(const TechniqueEntry& technique, const Scene& scene,
                                                   const Scenery& scenery, const Planning& planning) {
  return std::make_unique<TogetherContender>(technique, scene, scenery, planning);
}

}  // namespace paperproof::compare
