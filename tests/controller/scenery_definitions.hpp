/// One-way colliders, whether a scenery is refused, and where a point is.
#pragma once

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <string>

#include "geometry/exact.hpp"
#include "random_polygons.hpp"
#include "support/refusal.hpp"

namespace paperproof::test {

inline ColliderDef one_way(ColliderDef def, const Vec2d& direction) {
  def.one_way = direction;
  return def;
}

inline std::string refusal_of(const SceneryDef& def) {
  return refusal_by<InvalidScenery>([&] { Scenery{def}; }, "accepted");
}

enum class Where { inside, on_the_outline, outside };

inline Where where_is(const Vec2d& point, const Points& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d& from = ring[i];
    const Vec2d& to = ring[(i + 1) % ring.size()];
    const int side = geometry::orientation_sign(from, to, point);
    const bool in_reach = std::min(from.x(), to.x()) <= point.x() && point.x() <= std::max(from.x(), to.x()) &&
                          std::min(from.y(), to.y()) <= point.y() && point.y() <= std::max(from.y(), to.y());
    if (side == 0 && in_reach) return Where::on_the_outline;
    if ((from.y() > point.y()) != (to.y() > point.y()) && (to.y() > from.y()) == (side > 0)) inside = !inside;
  }
  return inside ? Where::inside : Where::outside;
}

}  // namespace paperproof::test
