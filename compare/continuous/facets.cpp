#include "continuous/facets.hpp"

#include <algorithm>

namespace paperproof::compare::continuous {
namespace {

using Ring = std::vector<Point>;

Ring ring_of(const std::vector<Vec2d>& points) {
  Ring ring;
  for (const Vec2d& point : points) ring.push_back(point_of(point));
  return ring;
}

/// Reverses a ring unless its inside is on the wanted side of its sides.
Ring turned(Ring ring, bool counter_clockwise) {
  Real area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) area += cross(ring[i], ring[(i + 1) % ring.size()]);
  if ((area > 0) != counter_clockwise) std::ranges::reverse(ring);
  return ring;
}

Ring forth_and_back(Ring chain) {
  for (std::size_t i = chain.size() - 2; i > 0; --i) chain.push_back(chain[i]);
  return chain;
}

/// The facets of one collider, ring by ring.
class Tracing {
 public:
  /// @param mirrored the character's corners, negated, counter-clockwise.
  /// @param least_up least upward component of a walkable normal.
  Tracing(const Ring& mirrored, const Real& least_up, std::vector<Facet>& facets)
      : mirrored_(mirrored), least_up_(least_up), facets_(facets) {}

  void trace(const Ring& ring, MoverIndex mover) {
    mover_ = mover;
    const std::size_t count = ring.size();
    const std::size_t first = facets_.size();
    bool linked = false;
    bool first_is_linked = false;
    for (std::size_t i = 0; i < count; ++i) {
      const Point& here = ring[i];
      const Point& next = ring[(i + 1) % count];
      const Point in = here - ring[(i + count - 1) % count];
      const Point out = next - here;
      const std::size_t end = furthest_right_of(out);
      const bool convex = cross(in, out) >= 0;  // as where a chain's end turns back
      if (i > 0) linked = linked && convex;
      if (convex)
        for (std::size_t k = furthest_right_of(in); k != end; k = (k + 1) % mirrored_.size()) {
          add(here + mirrored_[k], here + mirrored_[(k + 1) % mirrored_.size()], linked);
          linked = true;
        }
      add(here + mirrored_[end], next + mirrored_[end], linked);
      if (i == 0) first_is_linked = convex;
      linked = true;
    }
    if (first_is_linked) link(facets_.size() - 1, first);
  }

 private:
  /// The mirrored character's corner furthest to the right of a direction; of two the earlier.
  std::size_t furthest_right_of(const Point& direction) const {
    const Point right{direction.y(), -direction.x()};
    const Real tie = same() * direction.norm();
    std::size_t best = 0;
    for (std::size_t k = 1; k < mirrored_.size(); ++k)
      if ((mirrored_[k] - mirrored_[best]).dot(right) > tie) best = k;
    const std::size_t before = (best + mirrored_.size() - 1) % mirrored_.size();
    return abs((mirrored_[before] - mirrored_[best]).dot(right)) <= tie ? before : best;
  }

  void add(const Point& begin, const Point& end, bool linked) {
    const Real length = (end - begin).norm();
    const Point along = (end - begin) * (1 / length);
    const Point normal{along.y(), -along.x()};
    facets_.push_back({begin, along, normal, length, normal.y() >= least_up_, mover_});
    if (linked) link(facets_.size() - 2, facets_.size() - 1);
  }

  void link(std::size_t one, std::size_t next) {
    facets_[one].after = next;
    facets_[next].before = one;
  }

  const Ring& mirrored_;
  const Real& least_up_;
  std::vector<Facet>& facets_;
  MoverIndex mover_ = no_mover;
};

/// The climb limit includes itself, by 1e-8 rad, as design §4 has it for the controller.
Real least_up_of(const CharacterDef& character) {
  const Real degree = acos(Real(-1)) / 180;
  return cos(Real(character.max_climb_degrees) * degree + Real("1e-8"));
}

}  // namespace

std::vector<Facet> facets_of(const Scene& scene) {
  std::vector<Vec2d> negated;
  for (const Vec2d& point : scene.character.shape.points()) negated.push_back(-point);
  // Around their middle by angle: the points of a character are the corners of their hull.
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& point : negated) middle += point / static_cast<double>(negated.size());
  std::ranges::sort(negated, [&](const Vec2d& a, const Vec2d& b) {
    return std::atan2(a.y() - middle.y(), a.x() - middle.x()) < std::atan2(b.y() - middle.y(), b.x() - middle.x());
  });
  const Ring mirrored = ring_of(negated);
  const Real least_up = least_up_of(scene.character);
  std::vector<Facet> facets;
  Tracing tracing(mirrored, least_up, facets);
  for (const ColliderDef& collider : scene.scenery.colliders) {
    if (collider.sensor) continue;
    const Ring outer = ring_of(collider.points);
    const bool is_chain = collider.shape == ColliderDef::Shape::chain;
    tracing.trace(is_chain ? forth_and_back(outer) : turned(outer, true), collider.mover);
    for (const std::vector<Vec2d>& hole : collider.holes) tracing.trace(turned(ring_of(hole), false), collider.mover);
  }
  return facets;
}

}  // namespace paperproof::compare::continuous
