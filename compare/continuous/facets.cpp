#include "continuous/facets.hpp"

#include <algorithm>

namespace paperproof::compare::continuous {
namespace {

template <class Real>
using Ring = std::vector<Point<Real>>;

template <class Real>
Ring<Real> ring_of(const std::vector<Vec2d>& points) {
  Ring<Real> ring;
  for (const Vec2d& point : points) ring.push_back({Real(point.x()), Real(point.y())});
  return ring;
}

/// Reverses a ring unless its inside is on the wanted side of its sides.
template <class Real>
Ring<Real> turned(Ring<Real> ring, bool counter_clockwise) {
  Real area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) area += cross(ring[i], ring[(i + 1) % ring.size()]);
  if ((area > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

template <class Real>
Ring<Real> forth_and_back(Ring<Real> chain) {
  for (std::size_t i = chain.size() - 2; i > 0; --i) chain.push_back(chain[i]);
  return chain;
}

/// The facets of one collider, ring by ring.
template <class Real>
class Tracing {
 public:
  /// @param mirrored the character's corners, negated, counter-clockwise.
  /// @param least_up least upward component of a walkable normal.
  Tracing(const Ring<Real>& mirrored, const Real& least_up, std::vector<Facet<Real>>& facets)
      : mirrored_(mirrored), least_up_(least_up), facets_(facets) {}

  void trace(const Ring<Real>& ring, ColliderIndex collider, MoverIndex mover) {
    collider_ = collider;
    mover_ = mover;
    const std::size_t count = ring.size();
    const std::size_t first = facets_.size();
    bool linked = false;
    bool first_is_linked = false;
    for (std::size_t i = 0; i < count; ++i) {
      const Point<Real>& here = ring[i];
      const Point<Real>& next = ring[(i + 1) % count];
      const Point<Real> in = here - ring[(i + count - 1) % count];
      const Point<Real> out = next - here;
      const std::size_t end = furthest_right_of(out);
      const bool convex = turns_left(in, out);
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
  /// A chain's end turns back: that is convex.
  static bool turns_left(const Point<Real>& in, const Point<Real>& out) {
    const Real turn = cross(in, out);
    return turn >= 0;
  }

  /// The mirrored character's corner furthest to the right of a direction; of two the earlier.
  std::size_t furthest_right_of(const Point<Real>& direction) const {
    const Point<Real> right{direction.y, -direction.x};
    const Real tie = same<Real>() * length_of(direction);
    std::size_t best = 0;
    for (std::size_t k = 1; k < mirrored_.size(); ++k)
      if (dot(mirrored_[k] - mirrored_[best], right) > tie) best = k;
    const std::size_t before = (best + mirrored_.size() - 1) % mirrored_.size();
    return abs(dot(mirrored_[before] - mirrored_[best], right)) <= tie ? before : best;
  }

  void add(const Point<Real>& begin, const Point<Real>& end, bool linked) {
    Facet<Real> facet;
    facet.begin = begin;
    facet.length = length_of(end - begin);
    facet.along = (end - begin) * (1 / facet.length);
    facet.normal = {facet.along.y, -facet.along.x};
    facet.walkable = facet.normal.y >= least_up_;
    facet.collider = collider_;
    facet.mover = mover_;
    facets_.push_back(facet);
    if (linked) link(facets_.size() - 2, facets_.size() - 1);
  }

  void link(std::size_t one, std::size_t next) {
    facets_[one].after = next;
    facets_[next].before = one;
  }

  const Ring<Real>& mirrored_;
  const Real& least_up_;
  std::vector<Facet<Real>>& facets_;
  ColliderIndex collider_ = 0;
  MoverIndex mover_ = no_mover;
};

/// The climb limit includes itself, by 1e-8 rad, as design §4 has it for the controller.
template <class Real>
Real least_up_of(const CharacterDef& character) {
  const Real degree = acos(Real(-1)) / 180;
  return cos(Real(character.max_climb_degrees) * degree + Real("1e-8"));
}

}  // namespace

template <class Real>
std::vector<Facet<Real>> facets_of(const Scene& scene) {
  std::vector<Vec2d> negated;
  for (const Vec2d& point : scene.character.shape.points()) negated.push_back(-point);
  // Around their middle by angle: the points of a character are the corners of their hull.
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& point : negated) middle += point / static_cast<double>(negated.size());
  std::sort(negated.begin(), negated.end(), [&](const Vec2d& a, const Vec2d& b) {
    return std::atan2(a.y() - middle.y(), a.x() - middle.x()) < std::atan2(b.y() - middle.y(), b.x() - middle.x());
  });
  const Ring<Real> mirrored = ring_of<Real>(negated);
  const Real least_up = least_up_of<Real>(scene.character);
  std::vector<Facet<Real>> facets;
  Tracing<Real> tracing(mirrored, least_up, facets);
  for (ColliderIndex i = 0; i < scene.scenery.colliders.size(); ++i) {
    const ColliderDef& collider = scene.scenery.colliders[i];
    if (collider.sensor) continue;
    const Ring<Real> outer = ring_of<Real>(collider.points);
    if (collider.shape == ColliderDef::Shape::chain) {
      tracing.trace(forth_and_back(outer), i, collider.mover);
      continue;
    }
    tracing.trace(turned(outer, true), i, collider.mover);
    for (const std::vector<Vec2d>& hole : collider.holes)
      tracing.trace(turned(ring_of<Real>(hole), false), i, collider.mover);
  }
  return facets;
}

template std::vector<Facet<Number<30>>> facets_of(const Scene&);
template std::vector<Facet<Number<50>>> facets_of(const Scene&);
template std::vector<Facet<Number<70>>> facets_of(const Scene&);

}  // namespace paperproof::compare::continuous
