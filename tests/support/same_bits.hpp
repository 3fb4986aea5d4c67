/// Whether numbers, and what reports hold, are the same to the last bit: NaN and the sign of zero count.
#pragma once

#include <paperproof/report.hpp>
#include <paperproof/together.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace paperproof::test {

inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

inline bool same_bits(const Vec2d& a, const Vec2d& b) { return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()); }

inline bool same_bits(const PathPoint& a, const PathPoint& b) {
  return same_bits(a.position, b.position) && same_bits(a.fraction, b.fraction);
}

inline bool same_bits(const Contact& a, const Contact& b) {
  return a.collider == b.collider && a.side == b.side && same_bits(a.point, b.point) && same_bits(a.normal, b.normal) &&
         same_bits(a.fraction, b.fraction) && same_bits(a.separation, b.separation);
}

inline bool same_bits(const CrowdContact& a, const CrowdContact& b) {
  return a.other == b.other && a.side == b.side && same_bits(a.normal, b.normal) && same_bits(a.fraction, b.fraction);
}

inline bool same_bits(const SensorEvent& a, const SensorEvent& b) {
  return a.sensor == b.sensor && a.change == b.change && same_bits(a.fraction, b.fraction);
}

inline bool same_bits(const MoverMotion& a, const MoverMotion& b) {
  return same_bits(a.from, b.from) && same_bits(a.to, b.to);
}

/// Of two lists, each item.
constexpr auto all_same_bits = [](const auto& a, const auto& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same_bits(x, y); });
};

}  // namespace paperproof::test
