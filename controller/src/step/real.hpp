/// The number type of a step. The harness studies rounding with a second build of these sources, in `float`:
/// controller/in_float defines `PAPERPROOF_REAL`, `Real` and `Vec2` first, and then includes them.
#pragma once

#include "geometry/vectors.hpp"

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

using geometry::dot;
using geometry::length_of;

}  // namespace PAPERPROOF_REAL
using namespace PAPERPROOF_REAL;
}  // namespace paperproof::octagon_sweep
