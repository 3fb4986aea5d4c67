/// Whether numbers, and what reports hold, are the same to the last bit: NaN and the sign of zero count.
#pragma once

#include <paperproof/crowd.hpp>
#include <paperproof/report.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace paperproof::test {

template <class Scalar>
requires std::is_floating_point_v<Scalar>
bool same_bits(Scalar a, Scalar b) {
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

template <class Scalar>
bool same_bits(const Vec2<Scalar>& a, const Vec2<Scalar>& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y());
}

template <class Scalar>
bool same_bits(const PathPoint<Scalar>& a, const PathPoint<Scalar>& b) {
  return same_bits(a.position, b.position) && same_bits(a.fraction, b.fraction);
}

template <class Scalar>
bool same_bits(const Contact<Scalar>& a, const Contact<Scalar>& b) {
  return a.collider == b.collider && a.side == b.side && same_bits(a.point, b.point) && same_bits(a.normal, b.normal) &&
         same_bits(a.fraction, b.fraction) && same_bits(a.separation, b.separation);
}

template <class Scalar>
bool same_bits(const CrowdContact<Scalar>& a, const CrowdContact<Scalar>& b) {
  return a.other == b.other && a.side == b.side && same_bits(a.normal, b.normal) && same_bits(a.fraction, b.fraction);
}

template <class Scalar>
bool same_bits(const SensorEvent<Scalar>& a, const SensorEvent<Scalar>& b) {
  return a.sensor == b.sensor && a.change == b.change && same_bits(a.fraction, b.fraction);
}

template <class Scalar>
bool same_bits(const MoverMotion<Scalar>& a, const MoverMotion<Scalar>& b) {
  return same_bits(a.from, b.from) && same_bits(a.to, b.to);
}

/// Of two lists, each item.
constexpr auto all_same_bits = [](const auto& a, const auto& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same_bits(x, y); });
};

}  // namespace paperproof::test
