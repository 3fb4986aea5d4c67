#include "collider_lookup.hpp"

#include "float_scenery.hpp"

#include <algorithm>
#include <limits>

namespace paperproof::box2d {
namespace {

b2AABB box_around(const Vec2d& a, const Vec2d& b, double margin) {
  const Vec2d room = Vec2d::Constant(margin);
  b2AABB box;
  box.lowerBound = rounded(Vec2d(a.cwiseMin(b) - room));
  box.upperBound = rounded(Vec2d(a.cwiseMax(b) + room));
  return box;
}

/// What `b2DynamicTree::Query` calls.
template <class Visit>
struct EachProxy {
  const Visit& visit;
  bool QueryCallback(int32 proxy) const {
    visit(static_cast<std::size_t>(proxy));
    return true;
  }
};

}  // namespace

ColliderLookup::ColliderLookup(const SceneryDef& as_run, std::span<const ColliderIndex> names) {
  for (std::size_t i = 0; i < as_run.colliders.size(); ++i) {
    const ColliderDef& collider = as_run.colliders[i];
    if (collider.shape != ColliderDef::Shape::polygon) continue;
    add_ring(collider.points, names[i]);
    for (const std::vector<Vec2d>& hole : collider.holes) add_ring(hole, names[i]);
  }
}

void ColliderLookup::add_ring(const std::vector<Vec2d>& ring, ColliderIndex collider) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Edge edge{ring[i], ring[(i + 1) % ring.size()], collider};
    const auto proxy = static_cast<std::size_t>(tree_.CreateProxy(box_around(edge.a, edge.b, 0), nullptr));
    if (edge_of_proxy_.size() <= proxy) edge_of_proxy_.resize(proxy + 1);
    edge_of_proxy_[proxy] = edges_.size();
    edges_.push_back(edge);
  }
}

std::optional<ColliderIndex> ColliderLookup::nearest(const Vec2d& point, double reach) {
  found_.clear();
  const auto measure = [this, &point](std::size_t proxy) {
    const Edge& edge = edges_[edge_of_proxy_[proxy]];
    found_.push_back({distance_to_segment(point, edge.a, edge.b), edge.collider});
  };
  const EachProxy<decltype(measure)> each{measure};
  tree_.Query(&each, box_around(point, point, reach));

  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : found_) least = std::min(least, candidate.distance);
  // The tree decides in which order candidates come: equals are settled by their index.
  std::optional<ColliderIndex> best;
  for (const auto& [distance, collider] : found_) {
    if (distance <= std::min(least + same_distance, reach) && (!best || collider < *best)) best = collider;
  }
  return best;
}

}  // namespace paperproof::box2d
