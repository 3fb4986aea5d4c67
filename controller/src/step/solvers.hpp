/// The step solvers there are: one per variant, compiled apart from the technique that chooses among them.
#pragma once

#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// One step among scenery that stands still.
template <class Scalar>
using SolveStill = void (*)(const ConfigurationSpace<Scalar>&, const Settings<Scalar>&, const Neighbourhood<Scalar>&,
                            const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;

/// One step among movers. Each of their stages exists.
template <class Scalar>
using SolveMoving = void (*)(const ConfigurationSpace<Scalar>&, const Settings<Scalar>&, const Neighbourhood<Scalar>&,
                             const Surroundings<Scalar>&, const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;

/// @param variant its `lanes` are 8 or 12; `movers` does not matter.
template <class Scalar>
[[nodiscard]] SolveStill<Scalar> still_solver(const Variant& variant) noexcept;

/// @param lanes 8 or 12.
template <class Scalar>
[[nodiscard]] SolveMoving<Scalar> moving_solver(std::size_t lanes) noexcept;

}  // namespace paperproof::octagon_sweep
