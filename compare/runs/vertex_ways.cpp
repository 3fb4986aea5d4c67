#include "runs/vertex_ways.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// Where the vertices of a collider are, in the order of `VertexWay::vertices` [m].
std::vector<Vec2d> placed_vertices(const ColliderDef& def, const Vec2d& offset, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  std::vector<Vec2d> placed;
  const auto place = [&](const std::vector<Vec2d>& ring) {
    for (const Vec2d& v : ring)
      placed.emplace_back(offset + Vec2d(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()));
  };
  place(def.points);
  std::ranges::for_each(def.holes, place);
  return placed;
}

}  // namespace

void add_turn(const ColliderDef& def, const MoverMotion& motion, const PartOfStep& part, VertexWay& way) {
  double radius = 0;
  for (const Vec2d& v : def.points) radius = std::max(radius, v.norm());
  // In the time between two instants a vertex is accelerated by radius × (angle per that time)²: an eighth of it.
  const auto chords =
      static_cast<int>(std::max(1.0, std::ceil(std::abs(motion.turn()) * std::sqrt(radius / (8 * most_sag)))));
  for (int k = way.instants.empty() ? 0 : 1; k <= chords; ++k) {
    const double share = static_cast<double>(k) / chords;
    const auto between = [&](const auto& from, const auto& to) {
      auto at = to;
      if (k < chords) at = from + share * (to - from);
      return at;
    };
    way.instants.push_back(between(part.begin, part.end));
    way.vertices.push_back(
        placed_vertices(def, between(motion.from, motion.to), between(motion.from_angle, motion.to_angle)));
  }
}

void add_ways(const TraceHeader& header, std::span<const MoverMotion> movers, const PartOfStep& part,
              std::vector<VertexWay>& ways) {
  std::size_t next = 0;
  for (ColliderIndex i = 0; i < header.scenery.colliders.size() && !header.turning.empty(); ++i) {
    const ColliderDef& def = header.scenery.colliders[i];
    if (def.mover == no_mover || !header.turning[def.mover]) continue;
    if (next == ways.size()) ways.push_back({.collider = i, .instants = {}, .vertices = {}});
    add_turn(def, movers[def.mover], part, ways[next++]);
  }
}

std::vector<VertexWay> ways_in_level(const SceneryDef& scenery, std::span<const TurnedCollider> turned,
                                     std::span<const MoverMotion> motions) {
  std::vector<VertexWay> all;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i) {
    const ColliderDef& def = scenery.colliders[i];
    if (def.mover == no_mover) continue;
    const MoverMotion& motion = motions[def.mover];
    const auto known = std::ranges::find(turned, i, &TurnedCollider::collider);
    if (known != turned.end()) {
      all.push_back({i, known->instants, known->vertices, motion.turn()});
      continue;
    }
    const bool is_turned_circle = def.shape == ColliderDef::Shape::circle && motion.has_angle();
    const auto vertices_at = [&](const Vec2d& offset, double angle) {
      std::vector<Vec2d> vertices = placed_vertices(def, offset, angle);
      // The controller moves the centre of a circle by an offset: rounding tells this from the place.
      if (is_turned_circle) vertices[0] = Vec2d(vertices[0] - def.points[0]) + def.points[0];
      return vertices;
    };
    all.push_back({i,
                   {0, 1},
                   {vertices_at(motion.from, motion.from_angle), vertices_at(motion.to, motion.to_angle)},
                   motion.turn()});
  }
  return all;
}

}  // namespace paperproof::compare
