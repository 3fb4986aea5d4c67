#include <paperproof/scenery_facts.hpp>
#include <paperproof/technique_controller.hpp>

#include "one_way_chains.hpp"
#include "sensors.hpp"
#include "step_parts.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof {
namespace {

using namespace step_parts;

/// Of a step of a crowd that moves by a joint technique.
template <class Scalar>
struct JointMemory final : OwnMemory {
  std::vector<CharacterState<Scalar>> states;  ///< Those handed to the step, as they will be.
  std::vector<MoveRequest<Scalar>> requests;   ///< What each character wants.
  Scratch<Scalar> scratch;
};

}  // namespace

template <class Scalar>
struct TechniqueController<Scalar>::Driver {
  const Scenery<Scalar>& scenery;
  CharacterDef character;
  std::unique_ptr<const Technique<Scalar>> technique;
  Sensors<Scalar> sensors;
  OneWayChains<Scalar> one_way;

  Driver(const Scenery<Scalar>& where, const CharacterDef& who, std::unique_ptr<const Technique<Scalar>> how,
         PieceSearch search)
      : scenery(where),
        character(who),
        technique(std::move(how)),
        sensors(where, who.shape, search),
        one_way(where, who.shape, search) {
    character.validate();
    if (has_filters(scenery))
      throw std::invalid_argument("the technique " + std::string(technique->name()) +
                                  " has no filter, and there is a collider with one");
  }

  /// @param scratch of the technique.
  [[nodiscard]] Scratch<Scalar> completed(Scratch<Scalar> scratch) const {
    scratch.sensors = sensors.make_candidates();
    scratch.one_way = one_way.make_candidates();
    return scratch;
  }

  [[nodiscard]] bool accepts(const CharacterState<Scalar>& state, const Input& input,
                             const StepContext<Scalar>& context) const noexcept {
    return is_upright(context.up) && context.filter == nullptr && context.dt > 0 &&
           context.movers.size() == scenery.mover_count() &&
           finite(state, input, context.gravity, context.dt, context.movers);
  }

  [[nodiscard]] static MoveRequest<Scalar> request_of(const CharacterState<Scalar>& state,
                                                      const Vec2<Scalar>& displacement, const Vec2<Scalar>& velocity,
                                                      bool drop, const StepContext<Scalar>& context) noexcept {
    return {.position = state.position,
            .displacement = displacement,
            .velocity = velocity,
            .technique_memory = state.technique_memory,
            .drop = drop,
            .movers = context.movers,
            .dt = context.dt,
            .ride = state.ride};
  }

  /// Turns the intent into a request.
  [[nodiscard]] MoveRequest<Scalar> begin(const Input& input, const StepContext<Scalar>& context, bool wall_ahead,
                                          CharacterState<Scalar>& state, StepReport<Scalar>& report) const noexcept {
    if (state.ride.ground != Ride<Scalar>::none) state.velocity -= state.ride.velocity;
    const auto [velocity, steered] = desired_velocity(character, context.gravity, input, context.dt, state, wall_ahead);
    report.requested = velocity * context.dt;
    report.steered = steered * context.dt;
    return request_of(state, report.requested, velocity, input.drop, context);
  }

  /// Tries a move towards the wall that `move` (not zero) points to, without making it.
  [[nodiscard]] bool has_wall_ahead(const CharacterState<Scalar>& state, double move,
                                    const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                    MoveResult<Scalar>& tried) const noexcept {
    const auto reach = static_cast<Scalar>(character.wall_reach);
    const Vec2<Scalar> there{move < 0 ? -reach : reach, 0};
    technique->move(request_of(state, there, there / context.dt, false, context), scratch, tried);
    return touches(tried, move < 0 ? Side::left : Side::right);
  }

  /// After the move has filled `report.move`.
  void end(bool drop, const StepContext<Scalar>& context, Scratch<Scalar>& scratch, CharacterState<Scalar>& state,
           StepReport<Scalar>& report) const noexcept {
    const std::span<const PathPoint<Scalar>> path = report.move.path;
    sensors.observe(path, context.movers, scratch.sensors, report.sensors);
    if (drop) one_way.find_passed(path, context.movers, scratch.one_way, report.dropped_through);
    adopt(character, context.up, report.move, state);
  }
};

template <class Scalar>
TechniqueController<Scalar>::TechniqueController(Controller<Scalar> sweep) : sweep_(std::move(sweep)) {}

template <class Scalar>
TechniqueController<Scalar>::TechniqueController(const Scenery<Scalar>& scenery, const CharacterDef& character,
                                                 std::unique_ptr<const Technique<Scalar>> technique, PieceSearch search)
    : driver_(std::make_shared<const Driver>(scenery, character, std::move(technique), search)) {}

template <class Scalar>
Scratch<Scalar> TechniqueController<Scalar>::make_scratch() const {
  if (sweep_) return sweep_->make_scratch();
  Scratch<Scalar> scratch = driver_->completed(driver_->technique->make_scratch());
  scratch.maker = driver_;
  return scratch;
}

template <class Scalar>
std::size_t TechniqueController<Scalar>::memory_bytes() const noexcept {
  return sweep_ ? 0 : driver_->technique->memory_bytes();
}

template <class Scalar>
StepStatus TechniqueController<Scalar>::step(CharacterState<Scalar>& state, const Input& input,
                                             const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                             StepReport<Scalar>& report) const noexcept {
  if (sweep_) return sweep_->step(state, input, context, scratch, report);
  report.sensors.clear();
  report.dropped_through.clear();
  if (!is_made_by(driver_, scratch.maker) || !driver_->accepts(state, input, context))
    return report.status = StepStatus::invalid_input;
  const CharacterState<Scalar> before = state;
  const bool wall_ahead = asks_for_wall(driver_->character, input, state) &&
                          driver_->has_wall_ahead(state, *input.move, context, scratch, report.move);
  driver_->technique->move(driver_->begin(input, context, wall_ahead, state, report), scratch, report.move);
  report.status = status_of(report.move.status);
  if (is_refused(report.status))
    state = before;
  else
    driver_->end(input.drop, context, scratch, state, report);
  return report.status;
}

template <class Scalar>
TechniqueCrowd<Scalar>::TechniqueCrowd(Crowd<Scalar> sweep) : sweep_(std::move(sweep)) {}

template <class Scalar>
TechniqueCrowd<Scalar>::TechniqueCrowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
                                       std::unique_ptr<const JointTechnique<Scalar>> technique, PieceSearch search)
    : technique_(technique.get()),
      driver_(std::make_shared<const Driver>(scenery, character, std::move(technique), search)) {}

template <class Scalar>
CrowdScratch TechniqueCrowd<Scalar>::make_scratch(std::size_t most_characters) const {
  if (sweep_) return sweep_->make_scratch(most_characters);
  auto memory = std::make_unique<JointMemory<Scalar>>();
  memory->states.resize(most_characters);
  memory->requests.resize(most_characters);
  memory->scratch = driver_->completed(technique_->make_joint_scratch(most_characters));
  return {most_characters, std::move(memory), driver_};
}

/// Writes no state before it is certain that no state is refused.
template <class Scalar>
StepStatus TechniqueCrowd<Scalar>::step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                                        const StepContext<Scalar>& context, CrowdScratch& scratch,
                                        CrowdReport<Scalar>& report) const noexcept {
  if (sweep_) return sweep_->step(states, inputs, context, scratch, report);
  const std::size_t count = states.size();
  if (scratch.most_characters < count || report.members.size() < count || inputs.size() != count ||
      !is_made_by(driver_, scratch.maker))
    return report.status = StepStatus::invalid_input;
  auto& memory = static_cast<JointMemory<Scalar>&>(*scratch.own);
  for (std::size_t i = 0; i < count; ++i) {
    report.members[i] = {};
    report.members[i].island = static_cast<CharacterIndex>(i);
    if (!driver_->accepts(states[i], inputs[i], context)) return report.status = StepStatus::invalid_input;
    memory.states[i] = states[i];
    memory.requests[i] = driver_->begin(inputs[i], context, false, memory.states[i], report.members[i].step);
  }
  if (!technique_->move_together(std::span(memory.requests).first(count), memory.scratch, report))
    return report.status = StepStatus::out_of_range;
  for (std::size_t i = 0; i < count; ++i) {
    StepReport<Scalar>& own = report.members[i].step;
    report.members[i].sort_contacts();
    own.status = status_of(own.move.status);
    driver_->end(inputs[i].drop, context, memory.scratch, memory.states[i], own);
    states[i] = memory.states[i];
  }
  return report.status = StepStatus::moved;
}

template class TechniqueController<float>;
template class TechniqueController<double>;
template class TechniqueCrowd<float>;
template class TechniqueCrowd<double>;

}  // namespace paperproof
