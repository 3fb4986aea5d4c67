#include "oracle/exact.hpp"

#include "oracle/depth.hpp"
#include "oracle/impact.hpp"
#include "oracle/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace paperproof::compare {

using detail::Passage;
using detail::Way;

struct ExactScenery::Impl {
  Impl(const SceneryDef& scenery, std::vector<Vec2d> points) : world(scenery, std::move(points)) {
    for (const ColliderDef& def : scenery.colliders) parts.push_back(detail::convex_parts(def));
    share_of_distance = smallest_share(world.points());
  }

  [[nodiscard]] detail::FramePlace seen_from(const detail::Group& group, const Place& at) const {
    if (!at.movers.empty() && at.movers.size() != world.mover_count()) {
      throw std::invalid_argument("a place needs the motion of every mover, or of none");
    }
    if (group.mover == no_mover || at.movers.empty()) return {at.position, {}, 0};
    return {at.position, at.movers[group.mover], at.fraction};
  }
  [[nodiscard]] detail::FramePlace seen_from(ColliderIndex collider, const Place& at) const {
    return seen_from(world.group_of(collider), at);
  }
  [[nodiscard]] Passage passage(ColliderIndex collider, const Way& way) const {
    return Passage(world, world.group_of(collider), way);
  }

  /// Calls `visit(group, way)` for every group of solids whose box the way reaches.
  template <class MakeWay, class Visit>
  void for_groups(const MakeWay& make_way, double within, const Visit& visit) const {
    for (const detail::Group& group : world.groups()) {
      if (group.sensor) continue;
      const Way way = make_way(group);
      if (group.box.overlaps(world.box_of(way).inflated(within))) visit(group, way);
    }
  }

  /// The best axis of the part that is deepest, or nearest.
  [[nodiscard]] detail::Axis nearest(const detail::FramePlace& place, ColliderIndex collider) const {
    detail::Axis nearest{std::numeric_limits<double>::infinity(), Vec2d::Zero()};
    const Box2<double> at = world.box_of(Way::stay(place));
    for (const detail::ConvexPart& part : parts[collider]) {
      const double distance = (part.box.lower - at.upper).cwiseMax(at.lower - part.box.upper).maxCoeff();
      if (distance > 0 && distance * share_of_distance > nearest.separation) continue;
      const detail::Axis axis = detail::best_axis(part, world.points(), place);
      if (axis.separation < nearest.separation) nearest = axis;
    }
    return nearest;
  }

  /// The octagon overlaps `collider` where it starts.
  [[nodiscard]] ExactImpact at_once(const Place& from, ColliderIndex collider) const {
    const detail::Axis out = nearest(seen_from(collider, from), collider);
    return {.collider = collider, .fraction = 0, .normal = out.normal, .point = from.position, .exposed = true};
  }

  /// The impacts of one way with the colliders of one group.
  void add_impacts(const detail::Group& group, const Way& way, const std::vector<ColliderIndex>& at_once,
                   std::vector<ExactImpact>& all) const {
    const Passage passage(world, group, way);
    const std::vector<std::uint32_t> edges = passage.entered_edges();
    std::vector<ColliderIndex> colliders;
    for (const std::uint32_t edge : edges) colliders.push_back(world.edges()[edge].collider);
    colliders.erase(std::unique(colliders.begin(), colliders.end()), colliders.end());
    for (const ColliderIndex collider : colliders) {
      if (std::binary_search(at_once.begin(), at_once.end(), collider)) continue;
      const std::span<const std::uint32_t> own = passage.of_collider(edges, collider);
      all.push_back(detail::find_impact(world, way, collider, own));
      if (own.size() == 1 || parts[collider].size() == 1) continue;
      for (const std::uint32_t edge : own) {
        all.push_back(detail::find_impact(world, way, collider, std::span(&edge, 1)));
      }
    }
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

std::vector<ColliderIndex> ExactScenery::overlapped(const Place& at) const { return met(at, at); }

bool ExactScenery::overlaps(const Place& at, ColliderIndex collider) const { return meets(at, at, collider); }

std::vector<ColliderIndex> ExactScenery::met(const Place& from, const Place& to) const {
  std::vector<ColliderIndex> found;
  const auto way_in = [&](const detail::Group& group) {
    return Way::to(impl_->seen_from(group, from), impl_->seen_from(group, to));
  };
  impl_->for_groups(way_in, 0, [&](const detail::Group& group, const Way& way) {
    const std::vector<ColliderIndex> met = Passage(impl_->world, group, way).met();
    found.insert(found.end(), met.begin(), met.end());
  });
  std::sort(found.begin(), found.end());
  return found;
}

bool ExactScenery::meets(const Place& from, const Place& to, ColliderIndex collider) const {
  return impl_->passage(collider, Way::to(impl_->seen_from(collider, from), impl_->seen_from(collider, to)))
      .meets(collider);
}

std::optional<ExactImpact> ExactScenery::time_of_impact(const Place& from, const Vec2d& displacement,
                                                        ColliderIndex collider) const {
  if (overlaps(from, collider)) return impl_->at_once(from, collider);
  const Way way = Way::by(impl_->seen_from(collider, from), displacement);
  const std::vector<std::uint32_t> edges = impl_->passage(collider, way).entered_edges(collider);
  if (edges.empty()) return std::nullopt;
  return detail::find_impact(impl_->world, way, collider, edges);
}

std::vector<ExactImpact> ExactScenery::impacts(const Place& from, const Vec2d& displacement) const {
  const std::vector<ColliderIndex> at_once = overlapped(from);
  std::vector<ExactImpact> all;
  for (const ColliderIndex collider : at_once) all.push_back(impl_->at_once(from, collider));
  const auto way_in = [&](const detail::Group& group) { return Way::by(impl_->seen_from(group, from), displacement); };
  impl_->for_groups(way_in, 0,
                    [&](const detail::Group& group, const Way& way) { impl_->add_impacts(group, way, at_once, all); });
  std::stable_sort(all.begin(), all.end(),
                   [](const ExactImpact& a, const ExactImpact& b) { return a.collider < b.collider; });
  return all;
}

std::optional<ExactImpact> ExactScenery::first_impact(const Place& from, const Vec2d& displacement) const {
  std::optional<ExactImpact> first;
  for (ExactImpact& impact : impacts(from, displacement)) {
    const bool earlier = !first || impact.fraction < first->fraction ||
                         (impact.fraction == first->fraction && impact.collider != first->collider &&
                          impact.normal.y() > first->normal.y());
    if (earlier) first = std::move(impact);
  }
  return first;
}

double ExactScenery::penetration(const Place& at, ColliderIndex collider) const {
  return overlaps(at, collider) ? -separation(at, collider) : 0;
}

double ExactScenery::separation(const Place& at, ColliderIndex collider) const {
  return impl_->nearest(impl_->seen_from(collider, at), collider).separation;
}

std::vector<ColliderIndex> ExactScenery::near(const Place& from, const Place& to, double within) const {
  std::vector<ColliderIndex> found;
  const auto way_in = [&](const detail::Group& group) {
    return Way::to(impl_->seen_from(group, from), impl_->seen_from(group, to));
  };
  impl_->for_groups(way_in, within, [&](const detail::Group& group, const Way& way) {
    const auto met = group.solid_tree.meeting(impl_->world.box_of(way).inflated(within));
    found.insert(found.end(), met.begin(), met.end());
  });
  std::sort(found.begin(), found.end());
  return found;
}

const SceneryDef& ExactScenery::scenery() const noexcept { return impl_->world.scenery(); }

std::uint64_t ExactScenery::rational_decisions() const noexcept { return impl_->world.exact_decisions(); }

}  // namespace paperproof::compare
