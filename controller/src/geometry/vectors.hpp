/// Products and lengths of vectors, with the same bits everywhere.
#pragma once

#include "inlining.hpp"

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::geometry {

[[nodiscard]] PAPERPROOF_INLINE auto dot(const auto& a, const auto& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

[[nodiscard]] PAPERPROOF_INLINE auto cross(const auto& a, const auto& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

/// Length without overflow or underflow in the squares; only correctly rounded operations, so that its bits are the
/// same everywhere (std::hypot is not).
template <class Vector>
[[nodiscard]] PAPERPROOF_INLINE auto length_of(const Vector& v) noexcept {
  using Number = typename Vector::Scalar;
  const Number scale = std::max(std::abs(v.x()), std::abs(v.y()));
  if (scale == 0) return Number(0);
  const Number x = v.x() / scale;
  const Number y = v.y() / scale;
  return scale * std::sqrt(x * x + y * y);
}

}  // namespace paperproof::geometry
