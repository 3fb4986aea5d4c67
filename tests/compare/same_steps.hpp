/// Whether two steps are the same to the last bit.
#pragma once

#include "records/trace.hpp"

#include <algorithm>
#include <bit>

namespace paperproof::compare {

inline bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool same(const Vec2d& a, const Vec2d& b) { return same(a.x(), b.x()) && same(a.y(), b.y()); }

inline bool same(const Contact<double>& a, const Contact<double>& b) {
  return a.collider == b.collider && a.side == b.side && same(a.point, b.point) && same(a.normal, b.normal) &&
         same(a.fraction, b.fraction) && same(a.separation, b.separation);
}

inline bool same(const CrowdContact<double>& a, const CrowdContact<double>& b) {
  return a.other == b.other && a.side == b.side && same(a.normal, b.normal) && same(a.fraction, b.fraction);
}

inline bool same(const PathPoint<double>& a, const PathPoint<double>& b) {
  return same(a.position, b.position) && same(a.fraction, b.fraction);
}

inline bool same(const SensorEvent<double>& a, const SensorEvent<double>& b) {
  return a.sensor == b.sensor && a.change == b.change && same(a.fraction, b.fraction);
}

inline bool same(const MoverMotion<double>& a, const MoverMotion<double>& b) {
  return same(a.from, b.from) && same(a.to, b.to);
}

template <class Item>
inline bool same(const std::vector<Item>& a, const std::vector<Item>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Item& x, const Item& y) { return same(x, y); });
}

inline bool same_step(const TraceStep& a, const TraceStep& b) {
  return same(a.path, b.path) && same(a.requested, b.requested) && same(a.velocity, b.velocity) &&
         a.grounded == b.grounded && a.jumping == b.jumping && same(a.contacts, b.contacts) && same(a.met, b.met) &&
         a.crushed == b.crushed && a.dropped_through == b.dropped_through && same(a.sensors, b.sensors) &&
         same(a.movers, b.movers) && a.stuck == b.stuck && a.dropped == b.dropped;
}

}  // namespace paperproof::compare
