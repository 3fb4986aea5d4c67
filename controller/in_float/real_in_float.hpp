/// What `step/real.hpp` has for the sources in `float`.
#pragma once

#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>

#define PAPERPROOF_REAL in_float

/// Vectors of both kinds in one expression are in `double`.
namespace Eigen {
template <class Operation>
struct ScalarBinaryOpTraits<float, double, Operation> {
  using ReturnType = double;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, float, Operation> {
  using ReturnType = double;
};
}  // namespace Eigen

namespace paperproof::octagon_sweep::in_float {

using Real = float;
inline constexpr const Tolerances& given_tolerances = tolerances_in_float;
/// What comes from outside of the step is in `double`, and so is what leaves it.
struct Vec2 : Vec2f {
  Vec2() = default;
  Vec2(float x, float y) : Vec2f(x, y) {}
  template <class Vector>
  Vec2(const Eigen::MatrixBase<Vector>& v) : Vec2f(v.template cast<float>()) {}
  operator Vec2d() const { return cast<double>(); }
};

}  // namespace paperproof::octagon_sweep::in_float
