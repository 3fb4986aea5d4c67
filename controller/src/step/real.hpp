/// The number that a step computes with. The harness compiles the sources of this folder once more, in `float`, for its
/// studies of rounding: controller/in_float then says first what is defined here.
#pragma once

#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>

#ifndef PAPERPROOF_REAL
#define PAPERPROOF_REAL in_double
namespace paperproof::octagon_sweep::in_double {
using Real = double;
using Vec2 = Vec2d;
inline constexpr Tolerances given_tolerances{};
}  // namespace paperproof::octagon_sweep::in_double
#endif

namespace paperproof::octagon_sweep {
namespace PAPERPROOF_REAL {

/// See `Tolerances`.
struct RealTolerances {
  Real hit = static_cast<Real>(given_tolerances.hit);
  Real stop = static_cast<Real>(given_tolerances.stop);
  Real touch = static_cast<Real>(given_tolerances.touch);
  Real look = static_cast<Real>(given_tolerances.look);
  Real certain = static_cast<Real>(given_tolerances.certain);
  Real restore = static_cast<Real>(given_tolerances.restore);
  Real range = static_cast<Real>(given_tolerances.range);
};
inline constexpr RealTolerances tolerances{};

}  // namespace PAPERPROOF_REAL
using namespace PAPERPROOF_REAL;
}  // namespace paperproof::octagon_sweep
