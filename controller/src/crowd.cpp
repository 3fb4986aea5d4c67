#include <paperproof/crowd.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "crowd/among_movers.hpp"
#include "crowd/stepper.hpp"
#include "scenery_facts.hpp"

namespace paperproof {
namespace {

void require_octagon_sweep(const TechniqueDef& technique) {
  if (technique.kind != TechniqueKind::octagon_sweep)
    throw std::invalid_argument("a crowd moves by octagon_sweep: no other technique keeps what it promises");
}

/// With the stages that places for other characters need.
TechniqueDef among_companions(TechniqueDef technique, ColliderIndex first_companion) {
  technique.first_companion = first_companion;
  technique.stages.slopes = true;
  return technique;
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
  std::unique_ptr<const crowd::Surrounded<Scalar>> surrounded;  ///< Null where nothing moves.
};

namespace {

template <class Scalar>
struct CrowdMemory final : OwnMemory {
  crowd::Memory<Scalar> standing;
  crowd::WalkerMemory<Scalar> walking;
  Scratch<Scalar> technique;
};

}  // namespace

template <class Scalar>
std::unique_ptr<const typename Crowd<Scalar>::Rules> Crowd<Scalar>::rules_for(const Scenery<Scalar>& scenery,
                                                                              const CharacterDef& character,
                                                                              const TechniqueDef& technique) {
  require_octagon_sweep(technique);
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  auto rules =
      std::make_unique<Rules>(Rules{{crowd::PairSpace<Scalar>(character.shape), static_cast<Scalar>(std::cos(limit)),
                                     technique.sweep_iterations, technique.stages},
                                    scenery.mover_count(),
                                    nullptr});
  if (scenery.mover_count() > 0 || has_conveyors(scenery))
    rules->surrounded = std::make_unique<const crowd::Surrounded<Scalar>>(scenery, character.shape);
  return rules;
}

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const TechniqueDef& technique)
    : rules_(rules_for(scenery, character, technique)),
      controller_(rules_->surrounded
                      ? Controller<Scalar>(rules_->surrounded->scenery, character,
                                           among_companions(technique, rules_->surrounded->first_companion))
                      : Controller<Scalar>(scenery, character, technique)) {}

template <class Scalar>
Crowd<Scalar>::~Crowd() = default;
template <class Scalar>
Crowd<Scalar>::Crowd(Crowd&&) noexcept = default;
template <class Scalar>
Crowd<Scalar>& Crowd<Scalar>::operator=(Crowd&&) noexcept = default;

template <class Scalar>
CrowdScratch Crowd<Scalar>::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<CrowdMemory<Scalar>>();
  if (rules_->surrounded) {
    memory->walking.walkers.resize(most_characters);
    memory->walking.rows.resize(most_characters);
    memory->walking.motions.resize(rules_->surrounded->scenery.mover_count());
  } else {
    memory->standing.runners.resize(most_characters);
    memory->standing.rows.resize(most_characters);
  }
  memory->technique = controller_.make_scratch();
  return {most_characters, std::move(memory)};
}

template <class Scalar>
StepStatus Crowd<Scalar>::step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                               const Vec2<Scalar>& gravity, Scalar dt, std::span<const MoverMotion<Scalar>> movers,
                               CrowdScratch& scratch, CrowdReport<Scalar>& report) const noexcept {
  const bool room = scratch.most_characters >= states.size() && report.members.size() >= states.size();
  if (!room || movers.size() != rules_->movers ||
      !usable<Scalar>(rules_->stages, rules_->surrounded != nullptr, states, inputs, gravity, dt))
    return report.status = StepStatus::invalid_input;
  auto& memory = static_cast<CrowdMemory<Scalar>&>(*scratch.own);
  const auto run = [&](auto&& stepper) {
    report.status = stepper.begin(states, inputs);
    if (report.status != StepStatus::moved) return report.status;
    stepper.solve();
    stepper.finish(states);
    return report.status;
  };
  if (rules_->surrounded)
    return run(crowd::AmongMovers<Scalar>(controller_, *rules_->surrounded, *rules_, memory.walking, memory.technique,
                                          report, states.size(), gravity, dt, movers));
  return run(crowd::Stepper<Scalar>(controller_, *rules_, memory.standing, memory.technique, report, states.size(),
                                    gravity, dt));
}

template class Crowd<float>;
template class Crowd<double>;

}  // namespace paperproof
