/// One step of the octagon sweep, compiled apart from the technique that asks for it.
#pragma once

#include "step/octagon_sweep.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <class Scalar>
using Solve = void (*)(const ConfigurationSpace<Scalar>&, const Settings<Scalar>&, const Neighbourhood<Scalar>&,
                       MoversInStep<Scalar>&, Part, const StepRequest<Scalar>&, MoveResult<Scalar>&) noexcept;

/// @param lanes of the configuration space: 8 or 12. @param is_turned whether the character's up is not (0, 1).
template <class Scalar>
[[nodiscard]] Solve<Scalar> solver_for(std::size_t lanes, bool is_turned) noexcept;

extern template Solve<float> solver_for(std::size_t, bool) noexcept;
extern template Solve<double> solver_for(std::size_t, bool) noexcept;

}  // namespace paperproof::octagon_sweep
