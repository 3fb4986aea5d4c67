#include "runs/vertex_ways.hpp"

#include "runs/level_ways.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

void add_turn(const ColliderDef& def, const TurningMotion& motion, VertexWay& way) {
  double radius = 0;
  for (const Vec2d& v : def.points) radius = std::max(radius, v.norm());
  // In the time between two instants a vertex is accelerated by radius × (angle per that time)²: an eighth of it.
  const double angle = motion.angle.to - motion.angle.from;
  const auto chords = static_cast<int>(std::max(1.0, std::ceil(std::abs(angle) * std::sqrt(radius / (8 * most_sag)))));
  for (int k = way.instants.empty() ? 0 : 1; k <= chords; ++k) {
    const double share = static_cast<double>(k) / chords;
    const auto between = [&](const auto& from, const auto& to) {
      auto at = to;
      if (k < chords) at = from + share * (to - from);
      return at;
    };
    way.instants.push_back(between(motion.begin, motion.end));
    way.vertices.push_back(placed_vertices(def, between(motion.offset.from, motion.offset.to),
                                           between(motion.angle.from, motion.angle.to)));
  }
}

void add_ways(const TraceHeader& header, const MoversMotion& motion, std::vector<VertexWay>& ways) {
  std::size_t next = 0;
  for (ColliderIndex i = 0; i < header.scenery.colliders.size() && !header.turning.empty(); ++i) {
    const ColliderDef& def = header.scenery.colliders[i];
    if (def.mover == no_mover || !header.turning[def.mover]) continue;
    if (next == ways.size()) ways.push_back({.collider = i, .instants = {}, .vertices = {}});
    add_turn(def, {motion.offsets[def.mover], motion.angles[def.mover], motion.begin, motion.end}, ways[next++]);
  }
}

}  // namespace paperproof::compare
