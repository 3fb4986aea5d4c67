#include "oracle/passing.hpp"

#include "oracle/exemptions.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

constexpr double degrees = 180 / 3.14159265358979323846;
/// So much of the octagon's narrowest width the rim may be at most: a character of a few millimetres that is passed by
/// a paper is half a width deep, which must not be excused.
constexpr double rim_of_width = 0.125;

/// Distances along the line point + s · way at which it crosses the ring.
void add_crossings(const std::vector<Vec2d>& ring, const Vec2d& point, const Vec2d& way, std::vector<double>& found) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d a = ring[i] - point;
    const Vec2d b = ring[(i + 1) % ring.size()] - point;
    const double at_a = cross_of(way, a);
    const double at_b = cross_of(way, b);
    if ((at_a > 0) == (at_b > 0)) continue;
    const Vec2d place = a + at_a / (at_a - at_b) * (b - a);
    found.push_back(place.dot(way));
  }
}

/// Of the solid, from where it was entered against the normal to where that line leaves it.
double thickness_at(const ColliderDef& def, const Vec2d& point, const Vec2d& normal) {
  if (def.shape == ColliderDef::Shape::chain || def.one_way) return 0;
  if (def.shape == ColliderDef::Shape::circle) return 2 * def.radius;
  std::vector<double> crossings;
  const Vec2d way = -normal;
  add_crossings(def.points, point, way, crossings);
  for (const std::vector<Vec2d>& hole : def.holes) add_crossings(hole, point, way, crossings);
  std::ranges::sort(crossings);
  // Pairs of entry and exit; the one that was passed begins at the point, up to rounding.
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i + 1] > 0) return crossings[i + 1] - crossings[i];
  }
  return 0;
}

}  // namespace

Passing describe_passing(const ExactScenery& scenery, const Place& from, const Place& to, ColliderIndex collider) {
  Passing passing{.collider = collider};
  const std::optional<ExactImpact> impact = scenery.impact_between(from, to, collider);
  if (!impact) return passing;
  const ColliderDef& def = scenery.scenery().colliders[collider];
  const Vec2d at_start = from.offset(def.mover);
  const Vec2d at_end = to.offset(def.mover);
  const Vec2d way = (to.position - at_end) - (from.position - at_start);
  const Vec2d offset = at_start + static_cast<double>(impact->fraction) * (at_end - at_start);
  passing.thickness = thickness_at(def, impact->point - offset, impact->normal);
  passing.angle = std::asin(std::min(1.0, std::abs(way.dot(impact->normal)) / way.norm())) * degrees;
  return passing;
}

double narrowest_width(const std::vector<Vec2d>& ring) {
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d edge = ring[(i + 1) % ring.size()] - ring[i];
    double width = 0;
    for (const Vec2d& corner : ring) width = std::max(width, std::abs(cross_of(edge, corner - ring[i])) / edge.norm());
    narrowest = std::min(narrowest, width);
  }
  return narrowest;
}

double rim_of(const TraceHeader& header) {
  return std::min(allowed(Exempt::clipped, header), rim_of_width * narrowest_width(header.points));
}

}  // namespace paperproof::compare::detail
