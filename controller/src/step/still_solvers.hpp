/// The table of solvers among scenery that stands still, for the files that compile it for one scalar.
#pragma once

#include "step/solvers.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"
#include "step/step_travel.hpp"

namespace paperproof::octagon_sweep {

template <Variant variant, class Scalar>
void solve_still(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
                 const Neighbourhood<Scalar>& neighbourhood, const MoveRequest<Scalar>& request,
                 MoveResult<Scalar>& result) noexcept {
  StepSolver<variant, Scalar>{space, settings, neighbourhood, result}.solve(request);
}

/// Either without both stages or with both: what a stage costs that finds nothing to do is 1 %, and each solver takes
/// seconds to compile.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] SolveStill<Scalar> still_solver_with(bool stages) noexcept {
  return stages ? solve_still<Variant{.lanes = Lanes, .movers = false}, Scalar>
                : solve_still<Variant{.lanes = Lanes, .movers = false, .one_way = false, .slopes = false}, Scalar>;
}

template <class Scalar>
SolveStill<Scalar> still_solver(const Variant& variant) noexcept {
  const bool stages = variant.one_way || variant.slopes;
  return variant.lanes == 8 ? still_solver_with<8, Scalar>(stages) : still_solver_with<12, Scalar>(stages);
}

}  // namespace paperproof::octagon_sweep
