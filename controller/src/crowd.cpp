#include <paperproof/crowd.hpp>
#include <paperproof/joint_technique.hpp>
#include <paperproof/scenery_facts.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

#include "crowd/sweep_together.hpp"
#include "step_parts.hpp"

namespace paperproof {

template <class Scalar>
struct Crowd<Scalar>::Rules {
  bool may_ride;  ///< Some ground may carry a character.
  /// What `octagon_sweep` needs to move several characters. Null: the controller has a joint technique.
  std::unique_ptr<crowd::SweepRules<Scalar>> sweep{};
};

namespace {

/// Contacts are not found in the order of their times.
template <class Scalar>
void sort_by_time(FixedVector<CrowdContact<Scalar>, 16>& met) noexcept {
  std::sort(met.begin(), met.end(), [](const CrowdContact<Scalar>& a, const CrowdContact<Scalar>& b) {
    return std::tie(a.fraction, a.other, a.side) < std::tie(b.fraction, b.other, b.side);
  });
}

/// @param controller made with a joint technique.
template <class Scalar>
const JointTechnique<Scalar>& joint_technique(const Controller<Scalar>& controller) noexcept {
  return static_cast<const JointTechnique<Scalar>&>(controller.technique());
}

/// Any number of movers may crush one character.
template <class Scalar>
void make_room_for_movers(std::size_t count, crowd::CrowdMemory<Scalar>& memory) {
  memory.path.crushed.reserve(count);
  for (crowd::Member<Scalar>& member : memory.members) {
    member.plan.crushed.reserve(count);
    member.crushed_memory = ReportMemory<ColliderIndex>(count);
  }
}

}  // namespace

template <class Scalar>
Crowd<Scalar>::Crowd(std::unique_ptr<const Rules> rules, Controller<Scalar> controller)
    : rules_(std::move(rules)), controller_(std::move(controller)) {}

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Crowd([&] {
        Rules rules{.may_ride = scenery.mover_count() > 0 || has_conveyors(scenery)};
        rules.sweep = std::make_unique<crowd::SweepRules<Scalar>>(scenery, character, sweep.iterations);
        CharacterDef walker = character;
        walker.step_height = 0;  // a path that goes up at once is not swept against the paths of others
        auto technique = octagon_sweep::make_sweep_in_parts(sweep, rules.sweep->scenery, walker);
        rules.sweep->sweep = technique.get();
        return Crowd(std::make_unique<const Rules>(std::move(rules)),
                     Controller<Scalar>(scenery, character, std::move(technique), sweep.search));
      }()) {}

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
                     std::unique_ptr<const JointTechnique<Scalar>> technique, PieceSearch search)
    : Crowd(std::make_unique<const Rules>(Rules{.may_ride = true}),
            Controller<Scalar>(scenery, character, std::move(technique), search)) {}

template <class Scalar>
Crowd<Scalar>::~Crowd() = default;
template <class Scalar>
Crowd<Scalar>::Crowd(Crowd&&) noexcept = default;
template <class Scalar>
Crowd<Scalar>& Crowd<Scalar>::operator=(Crowd&&) noexcept = default;

template <class Scalar>
CrowdScratch Crowd<Scalar>::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<crowd::CrowdMemory<Scalar>>();
  memory->states.resize(most_characters);
  memory->requests.resize(most_characters);
  if (rules_->sweep == nullptr) {
    memory->scratch = controller_.completed(joint_technique(controller_).make_joint_scratch(most_characters));
  } else {
    memory->scratch = controller_.make_scratch();
    memory->members.resize(most_characters);
    memory->impacts.resize(most_characters);
    memory->motions.resize(rules_->sweep->scenery.mover_count());
    make_room_for_movers(count_moving_colliders(rules_->sweep->scenery), *memory);
  }
  return {most_characters, std::move(memory), rules_};
}

/// Writes no state before it is certain that no state is refused.
template <class Scalar>
StepStatus Crowd<Scalar>::step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                               const StepContext<Scalar>& given, CrowdScratch& scratch,
                               CrowdReport<Scalar>& report) const noexcept {
  const std::size_t count = states.size();
  if (scratch.most_characters < count || report.members.size() < count || inputs.size() != count ||
      !step_parts::is_made_by(rules_, scratch.maker))
    return report.status = StepStatus::invalid_input;
  StepContext<Scalar> context = given;
  ColliderFilter filter;
  if (const ColliderFilter* used = controller_.filter_of(given)) {
    filter = *used;
    if (rules_->sweep != nullptr) filter.end = rules_->sweep->first_slot;
    context.filter = &filter;
  }
  auto& memory = static_cast<crowd::CrowdMemory<Scalar>&>(*scratch.own);
  for (std::size_t i = 0; i < count; ++i) {
    report.members[i] = {};
    report.members[i].island = static_cast<CharacterIndex>(i);
    const bool rides = states[i].ride.ground != Ride<Scalar>::none;
    if ((rides && !rules_->may_ride) || !controller_.begin_together(states[i], inputs[i], context, memory.states[i],
                                                                    memory.requests[i], report.members[i].step))
      return report.status = StepStatus::invalid_input;
  }
  const bool in_range =
      rules_->sweep != nullptr
          ? crowd::sweep_together<Scalar>({*rules_->sweep, memory, report, std::span(memory.members).first(count),
                                           context.gravity, context.dt, context.movers, context.filter, context.up},
                                          states)
          : joint_technique(controller_).move_together(std::span(memory.requests).first(count), memory.scratch, report);
  if (!in_range) return report.status = StepStatus::out_of_range;
  for (std::size_t i = 0; i < count; ++i) {
    sort_by_time(report.members[i].met);
    controller_.end_together(inputs[i], context, memory.scratch, memory.states[i], report.members[i].step);
    states[i] = memory.states[i];
  }
  return report.status = StepStatus::moved;
}

template class Crowd<float>;
template class Crowd<double>;

}  // namespace paperproof
