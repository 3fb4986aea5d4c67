/// The table of solvers among scenery that stands still, for the files that compile it for one scalar.
#pragma once

#include "techniques/octagon_sweep/solvers.hpp"
#include "techniques/octagon_sweep/step_start.hpp"
#include "techniques/octagon_sweep/step_sweep.hpp"
#include "techniques/octagon_sweep/step_travel.hpp"

#include <utility>

namespace paperproof::octagon_sweep {

template <Variant variant, class Scalar>
void solve_still(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
                 const Neighbourhood<Scalar>& neighbourhood, const MoveRequest<Scalar>& request,
                 MoveResult<Scalar>& result) noexcept {
  StepSolver<variant, Scalar>{space, settings, neighbourhood, result}.solve(request);
}

/// The bits of an index are the stages: 1 one_way, 2 slopes.
template <std::size_t Lanes, class Scalar, std::size_t... Index>
[[nodiscard]] SolveStill<Scalar> entry(std::size_t index, std::index_sequence<Index...>) noexcept {
  static constexpr std::array<SolveStill<Scalar>, sizeof...(Index)> table{
      solve_still<Variant{.lanes = Lanes, .movers = false, .one_way = (Index & 1U) != 0, .slopes = (Index & 2U) != 0},
                  Scalar>...};
  return table[index];
}

template <class Scalar>
SolveStill<Scalar> still_solver(const Variant& variant) noexcept {
  const std::size_t index = (variant.one_way ? 1U : 0U) + (variant.slopes ? 2U : 0U);
  constexpr auto all = std::make_index_sequence<4>();
  return variant.lanes == 8 ? entry<8, Scalar>(index, all) : entry<12, Scalar>(index, all);
}

}  // namespace paperproof::octagon_sweep
