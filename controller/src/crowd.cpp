#include <paperproof/crowd.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "crowd/stepper.hpp"

namespace paperproof {
namespace {

template <class Scalar>
const Scenery<Scalar>& checked(const Scenery<Scalar>& scenery, const TechniqueDef& technique) {
  const std::vector<ColliderDef>& colliders = scenery.as_run().colliders;
  if (technique.kind != TechniqueKind::octagon_sweep)
    throw std::invalid_argument("a crowd moves by octagon_sweep: no other technique keeps what it promises");
  const auto moves = [](const ColliderDef& collider) { return collider.mover != no_mover; };
  if (std::any_of(colliders.begin(), colliders.end(), moves))
    throw std::invalid_argument("a crowd needs scenery that does not move: there are movers");
  const auto carries = [](const ColliderDef& collider) { return collider.surface_speed != 0; };
  if (std::any_of(colliders.begin(), colliders.end(), carries))
    throw std::invalid_argument("a crowd needs scenery that does not move: there is a conveyor");
  return scenery;
}

/// All that `Controller::step` does not look at in the form it is called here.
template <class Scalar>
bool usable(const Stages& stages, std::span<const CharacterState<Scalar>> states, std::span<const Input> inputs,
            const Vec2<Scalar>& gravity, Scalar dt) noexcept {
  const auto steers = [&](const Input& input) {
    return std::isfinite(input.move.value_or(0)) && (stages.jump || !input.jump);
  };
  const auto walks = [](const CharacterState<Scalar>& state) {
    return state.ride.ground == Ride<Scalar>::none && std::isfinite(state.velocity.x()) &&
           std::isfinite(state.velocity.y());
  };
  return std::isfinite(dt) && dt > 0 && std::isfinite(gravity.x()) && std::isfinite(gravity.y()) &&
         (stages.gravity || (gravity.x() == 0 && gravity.y() == 0)) && inputs.size() == states.size() &&
         std::all_of(inputs.begin(), inputs.end(), steers) && std::all_of(states.begin(), states.end(), walks);
}

}  // namespace

template <class Scalar>
struct Crowd<Scalar>::Rules : crowd::CrowdRules<Scalar> {};

template <class Scalar>
Crowd<Scalar>::Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const TechniqueDef& technique)
    : controller_(checked(scenery, technique), character, technique) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  rules_ = std::make_unique<const Rules>(
      Rules{{crowd::PairSpace<Scalar>(character.shape), static_cast<Scalar>(std::cos(limit)),
             technique.sweep_iterations, technique.stages}});
}

template <class Scalar>
Crowd<Scalar>::~Crowd() = default;
template <class Scalar>
Crowd<Scalar>::Crowd(Crowd&&) noexcept = default;
template <class Scalar>
Crowd<Scalar>& Crowd<Scalar>::operator=(Crowd&&) noexcept = default;

template <class Scalar>
CrowdScratch Crowd<Scalar>::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<crowd::Memory<Scalar>>();
  memory->runners.resize(most_characters);
  memory->rows.resize(most_characters);
  memory->technique = controller_.make_scratch();
  return {most_characters, std::move(memory)};
}

template <class Scalar>
StepStatus Crowd<Scalar>::step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                               const Vec2<Scalar>& gravity, Scalar dt, CrowdScratch& scratch,
                               CrowdReport<Scalar>& report) const noexcept {
  const bool room = scratch.most_characters >= states.size() && report.members.size() >= states.size();
  if (!room || !usable<Scalar>(rules_->stages, states, inputs, gravity, dt))
    return report.status = StepStatus::invalid_input;
  auto& memory = static_cast<crowd::Memory<Scalar>&>(*scratch.own);
  crowd::Stepper<Scalar> stepper(controller_, *rules_, memory, report, states.size(), gravity, dt);
  report.status = stepper.begin(states, inputs);
  if (report.status != StepStatus::moved) return report.status;
  stepper.solve();
  stepper.finish(states);
  return report.status;
}

template class Crowd<float>;
template class Crowd<double>;

}  // namespace paperproof
