/// The ways of what moves, as the controller of a level went among them.
#pragma once

#include "records/vertex_way.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace paperproof::compare {

/// Where the vertices of a collider are, in the order of `VertexWay::vertices` [m].
[[nodiscard]] inline std::vector<Vec2d> placed_vertices(const ColliderDef& def, const Vec2d& offset, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  std::vector<Vec2d> placed;
  const auto place = [&](const std::vector<Vec2d>& ring) {
    for (const Vec2d& v : ring)
      placed.emplace_back(offset + Vec2d(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()));
  };
  place(def.points);
  for (const std::vector<Vec2d>& hole : def.holes) place(hole);
  return placed;
}

/// Of every collider that moves. What was not near the character went beside it: where it is at both ends says enough.
/// @param turned as `Controller::turned`, with the indices of the scenery as ids. @param motions by mover.
[[nodiscard]] inline std::vector<VertexWay> ways_in_level(const SceneryDef& scenery,
                                                          std::span<const TurnedCollider> turned,
                                                          std::span<const MoverMotion> motions) {
  std::vector<VertexWay> all;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i) {
    const ColliderDef& def = scenery.colliders[i];
    if (def.mover == no_mover) continue;
    const MoverMotion& motion = motions[def.mover];
    const double turn = motion.turn();
    const auto known =
        std::find_if(turned.begin(), turned.end(), [i](const TurnedCollider& one) { return one.collider == i; });
    if (known != turned.end()) {
      all.push_back({i, known->instants, known->vertices, turn});
      continue;
    }
    const bool is_turned_circle = def.shape == ColliderDef::Shape::circle && motion.has_angle();
    const auto vertices_at = [&](const Vec2d& offset, double angle) {
      std::vector<Vec2d> vertices = placed_vertices(def, offset, angle);
      // The controller moves the centre of a circle by an offset: rounding tells this from the place.
      if (is_turned_circle) vertices[0] = Vec2d(vertices[0] - def.points[0]) + def.points[0];
      return vertices;
    };
    all.push_back(
        {i, {0, 1}, {vertices_at(motion.from, motion.from_angle), vertices_at(motion.to, motion.to_angle)}, turn});
  }
  return all;
}

}  // namespace paperproof::compare
