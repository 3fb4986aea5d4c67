#include "step/still_solvers.hpp"

namespace paperproof::octagon_sweep {

template SolveStill<float> still_solver<float>(const Variant&) noexcept;

}  // namespace paperproof::octagon_sweep
