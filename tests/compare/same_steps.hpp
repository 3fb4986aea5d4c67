/// Whether two steps of a trace are the same to the last bit.
#pragma once

#include "records/trace.hpp"
#include "support/same_bits.hpp"

#include <algorithm>

namespace paperproof::compare {

inline bool same_step(const TraceStep& a, const TraceStep& b) {
  using paperproof::test::all_same_bits;
  using paperproof::test::same_bits;
  const auto same_way = [](const VertexWay& x, const VertexWay& y) {
    return x.collider == y.collider && x.instants == y.instants && x.vertices == y.vertices;
  };
  return all_same_bits(a.path, b.path) && same_bits(a.requested, b.requested) && same_bits(a.velocity, b.velocity) &&
         a.grounded == b.grounded && a.jumping == b.jumping && all_same_bits(a.contacts, b.contacts) &&
         all_same_bits(a.met, b.met) && a.crushed == b.crushed && a.dropped_through == b.dropped_through &&
         all_same_bits(a.sensors, b.sensors) && all_same_bits(a.movers, b.movers) && a.stuck == b.stuck &&
         a.dropped == b.dropped && std::ranges::equal(a.vertex_ways, b.vertex_ways, same_way);
}

}  // namespace paperproof::compare
