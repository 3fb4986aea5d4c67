#include "step/solve.hpp"

#include "step/step_crush.hpp"
#include "step/step_response.hpp"
#include "step/step_ride.hpp"
#include "step/step_solve.hpp"
#include "step/step_stairs.hpp"
#include "step/step_start.hpp"
#include "step/step_sweep.hpp"

namespace paperproof::octagon_sweep {
namespace {

template <std::size_t Lanes, template <class> class Up, class Scalar>
void solve(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
           const Neighbourhood<Scalar>& neighbourhood, MoversInStep<Scalar>& movers, Part part,
           const StepRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  StepSolver<Lanes, Scalar, Up<Scalar>>{space, settings, neighbourhood, movers, request.up, result}.solve(part,
                                                                                                          request);
}

}  // namespace

template <class Scalar>
Solve<Scalar> solver_for(std::size_t lanes, bool is_turned) noexcept {
  if (is_turned) return lanes == 8 ? solve<8, UpFrame, Scalar> : solve<12, UpFrame, Scalar>;
  return lanes == 8 ? solve<8, Upright, Scalar> : solve<12, Upright, Scalar>;
}

template Solve<float> solver_for(std::size_t, bool) noexcept;
template Solve<double> solver_for(std::size_t, bool) noexcept;

}  // namespace paperproof::octagon_sweep
