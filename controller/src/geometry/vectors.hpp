/// Products and lengths of vectors, with the same bits everywhere.
#pragma once

#include "inlining.hpp"

#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::geometry {

[[nodiscard]] PAPERPROOF_INLINE auto dot(const auto& a, const auto& b) { return a.x() * b.x() + a.y() * b.y(); }

[[nodiscard]] PAPERPROOF_INLINE auto cross(const auto& a, const auto& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Length without overflow or underflow in the squares; only correctly rounded operations, so that its bits are the
/// same everywhere (std::hypot is not).
template <class Vector>
[[nodiscard]] PAPERPROOF_INLINE auto length_of(const Vector& v) {
  using Number = typename Vector::Scalar;
  const Number scale = std::max(std::abs(v.x()), std::abs(v.y()));
  if (scale == 0) return Number(0);
  const Number x = v.x() / scale;
  const Number y = v.y() / scale;
  return scale * std::sqrt(x * x + y * y);
}

/// The unit normal on the left of an edge.
[[nodiscard]] inline Vec2d normal_of(const Vec2d& edge) {
  return Vec2d{-edge.y(), edge.x()} / std::sqrt(dot(edge, edge));
}

/// Whether a position or an offset is one that a level may have [m]. Written so that NaN is out of range.
[[nodiscard]] inline bool in_range(const Vec2d& at) {
  return std::abs(at.x()) <= Tolerances{}.range && std::abs(at.y()) <= Tolerances{}.range;
}

/// The least n·q of some points.
[[nodiscard]] inline double least_along(const auto& points, const Vec2d& n) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& q : points) least = std::min(least, n.x() * q.x() + n.y() * q.y());
  return least;
}

}  // namespace paperproof::geometry
