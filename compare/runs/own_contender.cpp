#include "runs/contender_kinds.hpp"

#include "contains.hpp"
#include "runs/technique_parts.hpp"
#include "runs/vertex_ways.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/in_float.hpp>
#include <paperproof/together.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

/// What the contenders have in common that run our controller.
class OwnContender : public Contender {
 public:
  OwnContender(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene, const Scenery& shared,
               const Planning& planning)
      : scalar_(scalar),
        rounded_(scalar == ScalarKind::binary32 ? std::make_unique<Scenery>(as_run(shared.as_run(), scalar)) : nullptr),
        scenery_(rounded_ ? *rounded_ : shared),
        sides_(sides_of(technique)),
        now_(scene.movers.size()),
        last_(scene.movers.size()),
        header_(header_of(technique, scalar, scenery_, scene, planning)),
        states_(character_count(scene)) {
    for (std::size_t k = 0; k < states_.size(); ++k) states_[k] = state_at(pose_at(start_of(scene, k)), scalar);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }
  [[nodiscard]] Pose pose(std::size_t character) const override { return pose_of(states_[character]); }
  void place(const Pose& pose, std::size_t character) override { states_[character] = state_at(pose, scalar_); }
  void launch(const Vec2d& velocity, std::size_t character) override {
    states_[character].velocity = as_run(velocity, scalar_);
  }

 protected:
  /// What a character's report says. @param carried what the ground added to the displacement [m].
  void fill(TraceStep& record, const StepReport& report, std::size_t character, const Vec2d& carried) const {
    write_report(report, states_[character], sides_, record);
    record.requested += carried;
    record.movers.assign(now_.begin(), now_.end());
  }

  /// A step begins. @return its surroundings, as a technique takes them: in the scalar that runs.
  StepContext begin(const StepInput& input) {
    std::swap(now_, last_);
    last_dt_ = dt_;
    for (std::size_t i = 0; i < now_.size(); ++i)
      now_[i] = {as_run(input.movers[i].from, scalar_), as_run(input.movers[i].to, scalar_)};
    dt_ = as_run(input.dt, scalar_);
    return {.gravity = input.gravity, .dt = dt_, .movers = now_, .up = input.up};
  }

  /// What the ground adds to the displacement of a step that began with this ride [m]. A conveyor's part is what was
  /// left of the ride's velocity in the step before, without its mover's. A character that drops through it goes on as
  /// fast as it went.
  [[nodiscard]] Vec2d carried_by(const Ride& ride, bool drops) const {
    if (ride.ground == Ride::none) return Vec2d::Zero();
    const ColliderInfo& ground = scenery_.collider(ride.ground);
    if (drops && ground.one_way) return ride.velocity * dt_;
    const auto way_in = [&](const std::vector<MoverMotion>& motions) {
      return ground.mover == no_mover ? Vec2d::Zero() : Vec2d(motions[ground.mover].to - motions[ground.mover].from);
    };
    Vec2d carried = way_in(now_);
    if (ground.surface_speed != 0) carried += ride.velocity * dt_ - way_in(last_) * (dt_ / last_dt_);
    return carried;
  }

  ScalarKind scalar_;
  std::unique_ptr<const Scenery> rounded_;  ///< Null in double,
  const Scenery& scenery_;                  ///< where the shared scenery runs.
  Sides sides_;
  std::vector<MoverMotion> now_;   ///< How movers go in the present step, in the scalar that runs,
  std::vector<MoverMotion> last_;  ///< and in the step before.
  double dt_ = 0;                  ///< Of the present step [s],
  double last_dt_ = 0;             ///< and of the step before.
  TraceHeader header_;
  std::vector<CharacterState> states_;
};

/// @throws NotApplicable for another technique than octagon_sweep in float.
TechniqueController controller_for(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene,
                                   const Scenery& scenery, const Planning& planning) {
  const CharacterDef character = rules_for(technique, scene, planning.knobs);
  const TechniqueDef def = definition_of(technique, scene, planning);
  if (scalar == ScalarKind::binary64) return make_controller(scenery, character, def);
  if (computes_in_one(technique.name)) throw NotApplicable(fmt::format("{} computes in double alone", technique.name));
  return TechniqueController(make_controller_in_float(scenery, character, {def.search, def.sweep_iterations}));
}

class TechniqueContender final : public OwnContender {
 public:
  TechniqueContender(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene, const Scenery& shared,
                     const Planning& planning)
      : OwnContender(technique, scalar, scene, shared, planning),
        controller_(controller_for(technique, scalar, scene, scenery_, planning)),
        scratch_(controller_.make_scratch()) {}

  void step(const StepInput& input, std::span<TraceStep> records) override {
    const Ride ride = states_.front().ride;
    step_unrecorded(input);
    fill(records.front(), report_, 0, carried_by(ride, input.players.front().drop));
    refuse_unusable(report_.status, report_.move.refusal);
  }

  void step_unrecorded(const StepInput& input) override {
    controller_.step(states_.front(), input.players.front(), begin(input), scratch_, report_);
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return controller_.memory_bytes(); }

 private:
  TechniqueController controller_;
  Scratch scratch_;
  StepReport report_;
};

/// octagon_sweep in double where something turns.
class LevelContender final : public OwnContender {
 public:
  LevelContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& shared, const Planning& planning)
      : OwnContender(technique, ScalarKind::binary64, scene, shared, planning),
        level_(shared.as_run()),
        controller_(level_, rules_for(technique, scene, planning.knobs)),
        scratch_(controller_.make_scratch()) {
    header_.plan.reset();  // it leaves nothing out
    header_.turning.assign(scene.movers.size(), true);
    scratch_.notes_turned = true;
  }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const CharacterState before = states_.front();
    step_unrecorded(input);
    write_report(report_, states_.front(), sides_, record);
    record.movers.assign(input.movers.begin(), input.movers.end());
    record.vertex_ways = ways_in_level(header_.scenery, Controller::turned(scratch_), input.movers);
    record.requested += carried(before, record.vertex_ways);
    refuse_unusable(report_.status, report_.move.refusal);
  }

  void step_unrecorded(const StepInput& input) override {
    controller_.step(states_.front(), input.players.front(),
                     {.gravity = input.gravity, .dt = input.dt, .movers = input.movers, .up = input.up}, scratch_,
                     report_);
  }

 private:
  /// What the ground adds to the displacement [m].
  [[nodiscard]] Vec2d carried(const CharacterState& before, std::span<const VertexWay> ways) const {
    if (before.ride.ground == Ride::none) return Vec2d::Zero();
    const VertexWay* ground = find_way(ways, before.ride.ground);
    // A circle that turns carries like a conveyor, and its centre does not tell.
    const bool is_circle = header_.scenery.colliders[before.ride.ground].shape == ColliderDef::Shape::circle;
    return ground == nullptr || is_circle ? Vec2d(before.ride.velocity * header_.dt) : carried_along(*ground);
  }

  Level level_;
  Controller controller_;
  Scratch scratch_;
  StepReport report_;
};

/// Several characters that move as a `Crowd`.
class CrowdContender final : public OwnContender {
 public:
  CrowdContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& shared, const Planning& planning)
      : OwnContender(technique, ScalarKind::binary64, scene, shared, planning),
        crowd_(
            make_crowd(shared, rules_for(technique, scene, planning.knobs), definition_of(technique, scene, planning))),
        scratch_(crowd_.make_scratch(states_.size())),
        report_(states_.size()) {}

  void step(const StepInput& input, std::span<TraceStep> records) override {
    const std::vector<CharacterState> before = states_;
    step_unrecorded(input);
    refuse_unusable(report_.status);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const CrowdMember& member = report_.members[k];
      fill(records[k], member.step, k, carried_by(before[k].ride, input.players[k].drop));
      records[k].met.assign(member.met.begin(), member.met.end());
    }
  }

  void step_unrecorded(const StepInput& input) override {
    crowd_.step(states_, input.players, begin(input), scratch_, report_);
  }

 private:
  TechniqueCrowd crowd_;
  CrowdScratch scratch_;
  CrowdReport report_;
};

/// Several characters that take turns, by octagon_sweep.
class TogetherContender final : public OwnContender {
 public:
  TogetherContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& shared,
                    const Planning& planning)
      : OwnContender(technique, ScalarKind::binary64, scene, shared, planning),
        level_(shared.as_run()),
        first_body_(static_cast<ColliderIndex>(level_.size())),
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
  }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    const std::vector<CharacterState> before = states_;
    step_unrecorded(input);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const Ride& ride = before[k].ride;
      Vec2d carried = Vec2d::Zero();
      if (!is_body(ride.ground))
        carried = carried_by(ride, input.players[k].drop);
      else if (contains(companions_[k].moving, ride.ground))
        carried = states_[ride.ground - first_body_].position - before[ride.ground - first_body_].position;
      fill(records[k], reports_[k], k, carried);
      records[k].turn = static_cast<CharacterIndex>(companions_[k].turn);
      records[k].moving.clear();
      for (const ColliderIndex body : companions_[k].moving) records[k].moving.push_back(body - first_body_);
      name_others(records[k]);
      refuse_unusable(reports_[k].status);
    }
  }

  void step_unrecorded(const StepInput& input) override {
    for (std::size_t k = 0; k < states_.size(); ++k) companions_[k].input = input.players[k];
    step_together(companions_, begin(input), together_);
  }

  [[nodiscard]] Pose pose(std::size_t character) const override {
    Pose pose = pose_of(states_[character]);
    name_other(pose.state.ride);
    return pose;
  }

 private:
  [[nodiscard]] bool is_body(ColliderIndex collider) const { return collider != Ride::none && collider >= first_body_; }

  /// A ride on the body of another is one on that character.
  void name_other(std::optional<TraceRide>& ride) const {
    if (ride && is_body(ride->collider))
      ride = TraceRide{.velocity = ride->velocity, .character = ride->collider - first_body_};
  }

  /// Contacts with the bodies of others are those with characters, and so is what carries it.
  void name_others(TraceStep& record) const {
    name_other(record.ride);
    record.met.clear();
    for (const Contact& contact : record.contacts)
      if (contact.collider >= first_body_)
        record.met.push_back({contact.collider - first_body_, contact.normal, contact.fraction, contact.side});
    std::erase_if(record.contacts, [&](const Contact& contact) { return contact.collider >= first_body_; });
  }

  Level level_;
  ColliderIndex first_body_;  ///< The bodies come after the colliders of the scene.
  std::optional<Controller> controller_;
  Scratch scratch_;
  std::vector<StepReport> reports_;
  std::vector<Companion> companions_;
  TogetherScratch together_;
};

/// What the controller of a level is not made for: it has no knobs of the technique.
void check_level(const TechniqueEntry& octagon_sweep, const Scene& scene, const Planning& planning) {
  if (!scene.others.empty())
    throw NotApplicable(fmt::format("octagon_sweep knows one character where something turns, and here are {}",
                                    character_count(scene)));
  for (ColliderIndex i = 0; i < scene.ids.size(); ++i)
    if (const ColliderDef& def = scene.scenery.colliders[i]; def.one_way && def.mover != no_mover)
      throw NotApplicable("octagon_sweep is for one-way colliders that stand where something turns, and \"" +
                          scene.ids[i] + "\" moves");
  for (const KnobSetting& knob : planning.knobs)
    if (knob.key != "jump_rules" && has_knob(octagon_sweep.name, knob.key))
      throw NotApplicable("octagon_sweep has no knob " + knob.key + " where something turns");
}

std::unique_ptr<Contender> make_several(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene,
                                        const Scenery& scenery, const Planning& planning) {
  if (scalar != ScalarKind::binary64) throw NotApplicable("several characters move in double alone");
  if (technique.name == "octagon_sweep")
    return std::make_unique<TogetherContender>(technique, scene, scenery, planning);
  if (!technique.moves_crowds)
    throw NotApplicable(fmt::format("{} knows one character, and here are {}", technique.name, character_count(scene)));
  try {
    return std::make_unique<CrowdContender>(technique, scene, scenery, planning);
  } catch (const std::invalid_argument& error) {
    throw NotApplicable(error.what());
  }
}

}  // namespace

std::unique_ptr<Contender> make_own_contender(const TechniqueEntry& technique, ScalarKind scalar, const Scene& scene,
                                              const Scenery& scenery, const Planning& planning) {
  const auto turning = std::ranges::find_if(scene.movers, [](const MoverDef& mover) { return !mover.turns.empty(); });
  if (turning != scene.movers.end()) {
    if (computes_in_one(technique.name) || scalar != ScalarKind::binary64)
      throw NotApplicable(fmt::format("{}{} is for movers that do not turn, and \"{}\" does", technique.name,
                                      computes_in_one(technique.name) ? "" : " in float", turning->id));
    check_level(technique, scene, planning);
    return std::make_unique<LevelContender>(technique, scene, scenery, planning);
  }
  if (!scene.others.empty()) return make_several(technique, scalar, scene, scenery, planning);
  try {
    return std::make_unique<TechniqueContender>(technique, scalar, scene, scenery, planning);
  } catch (const NotExpressible& error) {
    throw NotApplicable(error.what());
  }
}

}  // namespace paperproof::compare
