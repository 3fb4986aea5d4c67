#include <paperproof/crowd.hpp>
#include <paperproof/scenery.hpp>

#include <utility>

#include "crowd/sweep_together.hpp"
#include "step_parts.hpp"

namespace paperproof {

struct Crowd::Rules {
  bool may_ride;  ///< Some ground may carry a character.
  crowd::SweepRules sweep;
};

Crowd::Crowd(std::unique_ptr<const Rules> rules, Controller controller)
    : rules_(std::move(rules)), controller_(std::move(controller)) {}

Crowd::Crowd(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Crowd([&] {
        auto rules = std::make_unique<Rules>(
            Rules{scenery.mover_count() > 0 || scenery.counts().conveyors > 0, {scenery, character, sweep.iterations}});
        CharacterDef walker = character;
        walker.step_height = 0;  // a path that goes up at once is not swept against the paths of others
        auto in_parts = octagon_sweep::in_double::make_sweep(sweep, rules->sweep.scenery, walker);
        rules->sweep.sweep = in_parts.get();
        return Crowd(std::move(rules), Controller(scenery, character, std::move(in_parts), sweep.search));
      }()) {}

Crowd::~Crowd() = default;
Crowd::Crowd(Crowd&&) noexcept = default;
Crowd& Crowd::operator=(Crowd&&) noexcept = default;

CrowdScratch Crowd::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<crowd::CrowdMemory>();
  memory->states.resize(most_characters);
  memory->requests.resize(most_characters);
  memory->scratch = controller_.make_scratch();
  memory->members.resize(most_characters);
  memory->impacts.resize(most_characters);
  memory->motions.resize(rules_->sweep.scenery.mover_count());
  return {most_characters, std::move(memory), rules_};
}

/// Writes no state before it is certain that no state is refused.
StepStatus Crowd::step(std::span<CharacterState> states, std::span<const Input> inputs, const StepContext& given,
                       CrowdScratch& scratch, CrowdReport& report) const noexcept {
  const std::size_t count = states.size();
  if (scratch.most_characters < count || report.members.size() < count || inputs.size() != count ||
      !step_parts::is_made_by(rules_, scratch.maker))
    return report.status = StepStatus::invalid_input;
  StepContext context = given;
  context.movers = given.movers.first(std::min(given.movers.size(), controller_.scenery_->mover_count()));
  ColliderFilter filter;
  if (const ColliderFilter* used = controller_.filter_of(given)) {
    filter = *used;
    filter.end = rules_->sweep.first_slot;
    context.filter = &filter;
  }
  auto& memory = static_cast<crowd::CrowdMemory&>(*scratch.own);
  const octagon_sweep::Around here{{}, context.filter, context.up};
  for (std::size_t i = 0; i < count; ++i) {
    report.members[i].clear(static_cast<CharacterIndex>(i));
    const bool rides = states[i].ride.ground != Ride::none;
    if ((rides && !rules_->may_ride) ||
        !controller_.begin_together(states[i], inputs[i], context, here, memory.states[i], memory.requests[i],
                                    report.members[i].step))
      return report.status = StepStatus::invalid_input;
  }
  if (!crowd::sweep_together({rules_->sweep, memory, report, std::span(memory.members).first(count), context.gravity,
                              context.dt, context.movers, context.filter, context.up},
                             states))
    return report.status = StepStatus::out_of_range;
  for (std::size_t i = 0; i < count; ++i) {
    report.members[i].sort_contacts();
    controller_.end_together(inputs[i], context, memory.scratch, memory.states[i], report.members[i].step);
    states[i] = memory.states[i];
  }
  return report.status = StepStatus::moved;
}

}  // namespace paperproof
