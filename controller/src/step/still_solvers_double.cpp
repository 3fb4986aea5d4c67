#include "step/still_solvers.hpp"

namespace paperproof::octagon_sweep {

template SolveStill<double> still_solver<double>(const Variant&) noexcept;

}  // namespace paperproof::octagon_sweep
