/// Products and lengths of vectors, with the same bits everywhere.
#pragma once

#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::geometry {

template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar dot(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar cross(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

/// Length without overflow or underflow in the squares; only correctly rounded operations, so that its bits are the
/// same everywhere (std::hypot is not).
template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar length_of(const Vec2<Scalar>& v) noexcept {
  const Scalar scale = std::max(std::abs(v.x()), std::abs(v.y()));
  if (scale == 0) return 0;
  const Scalar x = v.x() / scale;
  const Scalar y = v.y() / scale;
  return scale * std::sqrt(x * x + y * y);
}

}  // namespace paperproof::geometry
