#include "oracle/exact.hpp"

#include "oracle/depth.hpp"
#include "oracle/impact.hpp"
#include "oracle/world.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

using detail::Passage;
using detail::Way;

struct ExactScenery::Impl {
  Impl(const SceneryDef& scenery, std::vector<Vec2d> points) : world(scenery, std::move(points)) {
    for (const ColliderDef& def : scenery.colliders) parts.push_back(detail::convex_parts(def));
    share_of_distance = smallest_share(world.points());
  }

  /// The best axis of the part that is deepest, or nearest.
  [[nodiscard]] detail::Axis nearest(const Vec2d& position, ColliderIndex collider) const {
    detail::Axis nearest{std::numeric_limits<double>::infinity(), Vec2d::Zero()};
    const Box2<double> at = world.box_of(Way::stay(position));
    for (const detail::ConvexPart& part : parts[collider]) {
      const double distance = (part.box.lower - at.upper).cwiseMax(at.lower - part.box.upper).maxCoeff();
      if (distance > 0 && distance * share_of_distance > nearest.separation) continue;
      const detail::Axis axis = detail::best_axis(part, world.points(), position);
      if (axis.separation < nearest.separation) nearest = axis;
    }
    return nearest;
  }

  /// The octagon overlaps `collider` where it starts.
  [[nodiscard]] ExactImpact at_once(const Vec2d& position, ColliderIndex collider) const {
    const detail::Axis out = nearest(position, collider);
    return {.collider = collider, .fraction = 0, .normal = out.normal, .point = position, .exposed = true};
  }

  /// Along the best axis the separation is at least this share of the distance: no direction is farther than half the
  /// largest turn between two edges of the octagon from the normal of one of them.
  [[nodiscard]] static double smallest_share(std::span<const Vec2d> points) {
    double smallest = 1;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2d& corner = points[(k + 1) % points.size()];
      const Vec2d in = (corner - points[k]).normalized();
      const Vec2d out = (points[(k + 2) % points.size()] - corner).normalized();
      smallest = std::min(smallest, std::sqrt(std::max(0.0, (1 + in.dot(out)) / 2)));  // cosine of half the turn
    }
    return smallest * (1 - 1e-9);
  }

  detail::World world;
  std::vector<std::vector<detail::ConvexPart>> parts;
  double share_of_distance = 0;
};

ExactScenery::ExactScenery(const SceneryDef& scenery, std::vector<Vec2d> points)
    : impl_(std::make_unique<Impl>(scenery, std::move(points))) {}

ExactScenery::~ExactScenery() = default;

std::vector<ColliderIndex> ExactScenery::overlapped(const Vec2d& position) const {
  return Passage(impl_->world, Way::stay(position)).met();
}

bool ExactScenery::overlaps(const Vec2d& position, ColliderIndex collider) const {
  return Passage(impl_->world, Way::stay(position)).meets(collider);
}

std::vector<ColliderIndex> ExactScenery::met(const Vec2d& from, const Vec2d& to) const {
  return Passage(impl_->world, Way::to(from, to)).met();
}

bool ExactScenery::meets(const Vec2d& from, const Vec2d& to, ColliderIndex collider) const {
  return Passage(impl_->world, Way::to(from, to)).meets(collider);
}

std::optional<ExactImpact> ExactScenery::time_of_impact(const Vec2d& position, const Vec2d& displacement,
                                                        ColliderIndex collider) const {
  if (overlaps(position, collider)) return impl_->at_once(position, collider);
  const std::vector<std::uint32_t> edges =
      Passage(impl_->world, Way::by(position, displacement)).entered_edges(collider);
  if (edges.empty()) return std::nullopt;
  return detail::find_impact(impl_->world, position, displacement, collider, edges);
}

std::vector<ExactImpact> ExactScenery::impacts(const Vec2d& position, const Vec2d& displacement) const {
  const std::vector<ColliderIndex> at_once = overlapped(position);
  const Passage passage(impl_->world, Way::by(position, displacement));
  const std::vector<std::uint32_t> edges = passage.entered_edges();
  std::vector<ColliderIndex> colliders = at_once;
  for (const std::uint32_t edge : edges) colliders.push_back(impl_->world.edges()[edge].collider);
  std::sort(colliders.begin(), colliders.end());
  colliders.erase(std::unique(colliders.begin(), colliders.end()), colliders.end());

  std::vector<ExactImpact> all;
  for (const ColliderIndex collider : colliders) {
    if (std::binary_search(at_once.begin(), at_once.end(), collider)) {
      all.push_back(impl_->at_once(position, collider));
      continue;
    }
    const std::span<const std::uint32_t> own = passage.of_collider(edges, collider);
    all.push_back(detail::find_impact(impl_->world, position, displacement, collider, own));
    if (own.size() == 1 || impl_->parts[collider].size() == 1) continue;
    for (const std::uint32_t edge : own) {
      all.push_back(detail::find_impact(impl_->world, position, displacement, collider, std::span(&edge, 1)));
    }
  }
  return all;
}

std::optional<ExactImpact> ExactScenery::first_impact(const Vec2d& position, const Vec2d& displacement) const {
  std::optional<ExactImpact> first;
  for (ExactImpact& impact : impacts(position, displacement)) {
    const bool earlier = !first || impact.fraction < first->fraction ||
                         (impact.fraction == first->fraction && impact.collider != first->collider &&
                          impact.normal.y() > first->normal.y());
    if (earlier) first = std::move(impact);
  }
  return first;
}

double ExactScenery::penetration(const Vec2d& position, ColliderIndex collider) const {
  return overlaps(position, collider) ? -impl_->nearest(position, collider).separation : 0;
}

double ExactScenery::separation(const Vec2d& position, ColliderIndex collider) const {
  return impl_->nearest(position, collider).separation;
}

std::vector<ColliderIndex> ExactScenery::near(const Vec2d& from, const Vec2d& to, double within) const {
  return impl_->world.solid_tree().meeting(impl_->world.box_of(Way::to(from, to)).inflated(within));
}

const SceneryDef& ExactScenery::scenery() const noexcept { return impl_->world.scenery(); }

std::uint64_t ExactScenery::rational_decisions() const noexcept { return impl_->world.exact_decisions(); }

}  // namespace paperproof::compare
