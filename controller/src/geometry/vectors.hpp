/// Products and lengths of vectors, with the same bits everywhere.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::geometry {

[[nodiscard, gnu::always_inline]] inline auto dot(const auto& a, const auto& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

[[nodiscard, gnu::always_inline]] inline auto cross(const auto& a, const auto& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

/// Length without overflow or underflow in the squares; only correctly rounded operations, so that its bits are the
/// same everywhere (std::hypot is not).
template <class Vector>
[[nodiscard, gnu::always_inline]] inline auto length_of(const Vector& v) noexcept {
  using Number = typename Vector::Scalar;
  const Number scale = std::max(std::abs(v.x()), std::abs(v.y()));
  if (scale == 0) return Number(0);
  const Number x = v.x() / scale;
  const Number y = v.y() / scale;
  return scale * std::sqrt(x * x + y * y);
}

}  // namespace paperproof::geometry
