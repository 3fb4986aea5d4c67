#include "agreement/reported.hpp"

#include "oracle/convex_parts.hpp"

#include <algorithm>
#include <limits>

namespace paperproof::test {
namespace {

using compare::Place;

/// A chain that is missed by a micrometre may be named: the character grows by so much, as a share of its size.
constexpr double grown_by = 2e-6;

std::vector<Vec2d> grown(const std::vector<Vec2d>& hull) {
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& corner : hull) middle += corner / static_cast<double>(hull.size());
  std::vector<Vec2d> larger;
  for (const Vec2d& corner : hull) larger.push_back(corner + grown_by * (corner - middle));
  return larger;
}

SceneryDef blocking_both_ways(SceneryDef scenery) {
  for (ColliderDef& collider : scenery.colliders) collider.one_way.reset();
  return scenery;
}

/// How far the lowest of some corners is along a normal.
double lowest_along(const Vec2d& normal, const std::vector<Vec2d>& corners) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2d& corner : corners) lowest = std::min(lowest, normal.dot(corner));
  return lowest;
}

}  // namespace

Reported::Reported(const SceneryDef& scenery, const std::vector<Vec2d>& hull, double rounding)
    : hull_(hull), rounding_(rounding), exact_(scenery, hull), both_ways_(blocking_both_ways(scenery), grown(hull)) {
  for (const ColliderDef& def : scenery.colliders)
    is_one_part_.push_back(compare::detail::convex_parts(def).size() == 1);
}

bool Reported::contact_holds(std::span<const Place> path, const Contact<double>& contact) const {
  const double lowest = lowest_along(contact.normal, hull_);
  return std::any_of(path.begin(), path.end(), [&](const Place& corner) {
    const double along = contact.normal.dot(corner.position - contact.point) + lowest;
    if (!(std::abs(along - contact.separation) <= rounding_)) return false;
    const double exact = exact_.separation(corner, contact.collider);
    // Of several parts another one may be nearer than the one that is met.
    const bool more = is_one_part_[contact.collider] && !(contact.separation <= exact + rounding_);
    return !more && (contact.separation >= 0 || exact <= 0);
  });
}

bool Reported::drops_hold(std::span<const Place> path, std::span<const ColliderIndex> named) const {
  const auto& colliders = exact_.scenery().colliders;
  for (std::size_t k = 0; k < named.size(); ++k) {
    if (k > 0 && named[k] <= named[k - 1]) return false;
    if (!colliders[named[k]].one_way) return false;
    bool passed = false;
    for (std::size_t i = 1; i < path.size() && !passed; ++i) passed = nearly_passes(path[i - 1], path[i], named[k]);
    if (!passed) return false;
  }
  return true;
}

/// Above a segment is where a way begins that is stopped by it: here, one to the middle of it, from a little higher.
bool Reported::nearly_passes(const Place& from, const Place& to, ColliderIndex chain) const {
  if (!both_ways_.meets(from, to, chain)) return false;
  const ColliderDef& def = exact_.scenery().colliders[chain];
  const Vec2d start = from.position - from.offset(def.mover);
  const Vec2d end = to.position - to.offset(def.mover);
  const Vec2d higher = from.position + rounding_ * def.one_way->normalized();
  for (const compare::detail::ConvexPart& segment : compare::detail::convex_parts(def)) {
    const Vec2d middle = (segment.points[1] + segment.points[0]) / 2 + from.offset(def.mover);
    const Place across(middle, from.movers, from.fraction);
    const Vec2d along = segment.points[1] - segment.points[0];
    Vec2d normal = Vec2d(-along.y(), along.x()).normalized();
    if (normal.dot(*def.one_way) < 0) normal = -normal;
    if (!(normal.dot(end - start) <= rounding_)) continue;
    if (exact_.meets(Place(higher, from.movers, from.fraction), across, chain)) return true;
  }
  return false;
}

}  // namespace paperproof::test
