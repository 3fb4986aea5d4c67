/// The technique of the controller: the whole octagon is swept, so that nothing slips between two of its points.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/plan.hpp>
#include <paperproof/technique.hpp>
#include <paperproof/tolerances.hpp>

#include <memory>

namespace paperproof {

/// Choices for `octagon_sweep`. `make_plan` chooses the broad phase and the stages for a scenery.
struct SweepDef {
  BroadPhaseKind broad_phase = BroadPhaseKind::tree;
  Stages stages{};
  int iterations = 12;  ///< Impacts per step before the rest of the displacement is dropped; from 1 to 60.
};

/// Builds it for one scenery and one character. `scenery` must outlive it.
/// @throws std::invalid_argument for iterations out of range, or stages that leave out what the scenery needs;
/// InvalidCharacter for an impossible character.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_octagon_sweep(const SweepDef& def, const Scenery<Scalar>& scenery,
                                                                    const CharacterDef& character);

}  // namespace paperproof
