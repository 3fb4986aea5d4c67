#include <paperproof/crowd.hpp>
#include <paperproof/joint_technique.hpp>
#include <paperproof/scenery_facts.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "crowd/parts.hpp"
#include "crowd/stepper.hpp"
#include "step/octagon_sweep.hpp"
#include "step_parts.hpp"

namespace paperproof {
namespace {

/// With the stages that places for other characters need.
SweepDef among_companions(SweepDef sweep) {
  sweep.stages.movers = sweep.stages.slopes = true;
  return sweep;
}

/// All that `Controller::step` does not look at in the form it is called here.
template <class Scalar>
bool usable(const Stages& stages, bool may_ride, std::span<const CharacterState<Scalar>> states,
            std::span<const Input> inputs, const Vec2<Scalar>& gravity, Scalar dt) noexcept {
  const auto steers = [&](const Input& input) {
    return std::isfinite(input.move.value_or(0)) && (stages.jump || !input.jump);
  };
  const auto walks = [&](const CharacterState<Scalar>& state) {
    return (may_ride || state.ride.ground == Ride<Scalar>::none) && std::isfinite(state.velocity.x()) &&
           std::isfinite(state.velocity.y());
  };
  return std::isfinite(dt) && dt > 0 && std::isfinite(gravity.x()) && std::isfinite(gravity.y()) &&
         (stages.gravity || (gravity.x() == 0 && gravity.y() == 0)) && inputs.size() == states.size() &&
         std::all_of(inputs.begin(), inputs.end(), steers) && std::all_of(states.begin(), states.end(), walks);
}

}  // namespace

template <class Scalar>
struct Crowd<Scalar>::Rules : crowd::CrowdRules<Scalar> {
  std::size_t movers;
  bool may_ride;                                                ///< Something may carry a character that stands on it.
  std::unique_ptr<const crowd::Surrounded<Scalar>> surrounded;  ///< Null for a joint technique.
};

namespace {

template <class Scalar>
struct CrowdMemory final : OwnMemory {
  crowd::WalkerMemory<Scalar> walking;
  std::vector<CharacterState<Scalar>> states;  ///< Of those that are moved at once, as they will be.
  std::vector<MoveRequest<Scalar>> requests;   ///< What they want.
  Scratch<Scalar> technique;
};

/// Any number of movers may crush one character.
template <class Scalar>
void reserve_names(const Scenery<Scalar>& scenery, crowd::WalkerMemory<Scalar>& memory) {
  const std::size_t most = count_moving_colliders(scenery);
  memory.way.crushed.reserve(most);
  for (crowd::Walker<Scalar>& walker : memory.walkers) {
    walker.plan.crushed.reserve(most);
    memory.crushed.emplace_back(most);
  }
}

}  // namespace

template <class Scalar>
Crowd<Scalar>::Crowd(std::unique_ptr<const Rules> rules, Controller<Scalar> controller)
    : rules_(std::move(rules)),
      controller_(std::move(controller)),
      joint_(dynamic_cast<const JointTechnique<Scalar>*>(&controller_.technique())) {}

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Crowd([&] {
        auto surrounded = std::make_unique<const crowd::Surrounded<Scalar>>(scenery, character.shape);
        const SweepDef def = among_companions(sweep);
        auto technique = octagon_sweep::make_sweep_in_parts(def, surrounded->scenery, character);
        const auto* const sweep_in_parts = technique.get();
        Controller<Scalar> controller(surrounded->scenery, character, std::move(technique), def.stages);
        return Crowd(std::make_unique<const Rules>(
                         Rules{{crowd::PairSpace<Scalar>(character.shape), character.walkable_cosine<Scalar>(),
                                sweep.iterations, sweep.stages, sweep_in_parts},
                               scenery.mover_count(),
                               scenery.mover_count() > 0 || has_conveyors(scenery),
                               std::move(surrounded)}),
                     std::move(controller));
      }()) {}

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
                     std::unique_ptr<const JointTechnique<Scalar>> technique, const Stages& stages)
    : Crowd(std::make_unique<const Rules>(
                Rules{{crowd::PairSpace<Scalar>(character.shape), character.walkable_cosine<Scalar>(),
                       SweepDef{}.iterations, stages, nullptr},
                      scenery.mover_count(),
                      true,
                      nullptr}),
            Controller<Scalar>(scenery, character, std::move(technique), stages)) {}

template <class Scalar>
Crowd<Scalar>::~Crowd() = default;
template <class Scalar>
Crowd<Scalar>::Crowd(Crowd&&) noexcept = default;
template <class Scalar>
Crowd<Scalar>& Crowd<Scalar>::operator=(Crowd&&) noexcept = default;

template <class Scalar>
CrowdScratch Crowd<Scalar>::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<CrowdMemory<Scalar>>();
  if (joint_ != nullptr) {
    memory->states.resize(most_characters);
    memory->requests.resize(most_characters);
    memory->technique = controller_.completed(joint_->make_joint_scratch(most_characters));
    return {most_characters, std::move(memory), rules_};
  }
  memory->walking.walkers.resize(most_characters);
  memory->walking.rows.resize(most_characters);
  memory->walking.motions.resize(rules_->surrounded->scenery.mover_count());
  reserve_names(rules_->surrounded->scenery, memory->walking);
  memory->technique = controller_.make_scratch();
  return {most_characters, std::move(memory), rules_};
}

template <class Scalar>
StepStatus Crowd<Scalar>::step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                               const Vec2<Scalar>& gravity, Scalar dt, std::span<const MoverMotion<Scalar>> movers,
                               CrowdScratch& scratch, CrowdReport<Scalar>& report) const noexcept {
  const bool room = scratch.most_characters >= states.size() && report.members.size() >= states.size();
  if (!room || !step_parts::is_made_by(rules_, scratch.maker) || movers.size() != rules_->movers ||
      !usable<Scalar>(rules_->stages, rules_->may_ride, states, inputs, gravity, dt))
    return report.status = StepStatus::invalid_input;
  if (joint_ != nullptr) return step_jointly(states, inputs, gravity, dt, movers, scratch, report);
  for (std::size_t i = 0; i < states.size(); ++i) report.members[i].island = static_cast<CharacterIndex>(i);
  auto& memory = static_cast<CrowdMemory<Scalar>&>(*scratch.own);
  crowd::Stepper<Scalar> step(controller_, *rules_->surrounded, *rules_, memory.walking, memory.technique, report,
                              states.size(), gravity, dt, movers);
  report.status = step.begin(states, inputs);
  if (report.status != StepStatus::moved) return report.status;
  step.solve();
  step.finish(states);
  return report.status;
}

/// Nobody's state is written before it is known that no step is refused.
template <class Scalar>
StepStatus Crowd<Scalar>::step_jointly(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                                       const Vec2<Scalar>& gravity, Scalar dt,
                                       std::span<const MoverMotion<Scalar>> movers, CrowdScratch& scratch,
                                       CrowdReport<Scalar>& report) const noexcept {
  auto& memory = static_cast<CrowdMemory<Scalar>&>(*scratch.own);
  for (std::size_t i = 0; i < states.size(); ++i) {
    CrowdMember<Scalar>& member = report.members[i];
    crowd::clear(member);
    if (!controller_.begin_together(states[i], inputs[i], gravity, dt, movers, memory.states[i], memory.requests[i],
                                    member.step))
      return report.status = StepStatus::invalid_input;
  }
  if (!joint_->move_together(std::span(memory.requests).first(states.size()), memory.technique, report))
    return report.status = StepStatus::out_of_range;
  for (std::size_t i = 0; i < states.size(); ++i) {
    CrowdMember<Scalar>& member = report.members[i];
    crowd::sort_by_time(member.met);
    controller_.end_together(inputs[i], movers, memory.technique, memory.states[i], member.step);
    states[i] = memory.states[i];
  }
  return report.status = StepStatus::moved;
}

template class Crowd<float>;
template class Crowd<double>;

}  // namespace paperproof
