#include "step/solve.hpp"

#include "step/step_among_movers.hpp"
#include "step/step_crush.hpp"
#include "step/step_ride.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"
#include "step/step_travel.hpp"

namespace paperproof::octagon_sweep {
namespace {

template <std::size_t Lanes, class Scalar>
void solve(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
           const Neighbourhood<Scalar>& neighbourhood, Surroundings<Scalar>& surroundings, Part part,
           const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  StepSolver<Lanes, Scalar>{space, settings, neighbourhood, surroundings, result}.solve(part, request);
}

}  // namespace

template <class Scalar>
Solve<Scalar> solver_for(std::size_t lanes) noexcept {
  return lanes == 8 ? solve<8, Scalar> : solve<12, Scalar>;
}

template Solve<float> solver_for(std::size_t) noexcept;
template Solve<double> solver_for(std::size_t) noexcept;

}  // namespace paperproof::octagon_sweep
