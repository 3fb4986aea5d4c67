#include "step/solvers.hpp"
#include "step/step_among_movers.hpp"
#include "step/step_crush.hpp"
#include "step/step_ride.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"
#include "step/step_travel.hpp"

namespace paperproof::octagon_sweep {
namespace {

template <std::size_t Lanes, class Scalar>
void solve_moving(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
                  const Neighbourhood<Scalar>& neighbourhood, const Surroundings<Scalar>& surroundings,
                  const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  StepSolver<Variant{.lanes = Lanes}, Scalar>{space, settings, neighbourhood, surroundings, result}.solve(request);
}

}  // namespace

template <class Scalar>
SolveMoving<Scalar> moving_solver(std::size_t lanes) noexcept {
  return lanes == 8 ? solve_moving<8, Scalar> : solve_moving<12, Scalar>;
}

template SolveMoving<float> moving_solver<float>(std::size_t) noexcept;
template SolveMoving<double> moving_solver<double>(std::size_t) noexcept;

}  // namespace paperproof::octagon_sweep
