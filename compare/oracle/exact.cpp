#include "oracle/exact.hpp"

#include "contains.hpp"
#include "oracle/depth.hpp"
#include "oracle/impact.hpp"
#include "oracle/sensor.hpp"
#include "oracle/up.hpp"
#include "oracle/way_out.hpp"
#include "oracle/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

namespace paperproof::compare {

using detail::Passage;
using detail::Way;

struct ExactScenery::Impl {
  Impl(const SceneryDef& scenery, std::vector<Vec2d> points) : world(scenery, std::move(points)) {
    for (const ColliderDef& def : scenery.colliders) {
      parts.push_back(detail::convex_parts(def));
      for (const detail::ConvexPart& part : parts.back())
        if (part.radius > 0) outlines.emplace(&part, detail::with_corners(part));
    }
    share_of_distance = smallest_share(world.points());
  }

  [[nodiscard]] detail::FramePlace seen_from(const detail::Group& group, const Place& at) const {
    if (!at.movers.empty() && at.movers.size() < world.mover_count()) {
      throw std::invalid_argument("a place needs the motion of every mover");
    }
    if (group.mover == no_mover || at.movers.empty()) return {at.position, {}, at.fraction};
    return {at.position, at.movers[group.mover], at.fraction};
  }
  [[nodiscard]] detail::FramePlace seen_from(ColliderIndex collider, const Place& at) const {
    return seen_from(world.group_of(collider), at);
  }
  [[nodiscard]] Way way_between(const detail::Group& group, const Place& from, const Place& to) const {
    return Way::to(seen_from(group, from), seen_from(group, to));
  }

  /// Calls `visit(group, way)` for every group of solids whose box the way reaches.
  template <class Visit>
  void for_groups(const detail::WayIn& way_in, const Visit& visit) const {
    for (const detail::Group& group : world.groups()) {
      if (group.sensor) continue;
      const Way way = way_in(group);
      if (group.box.overlaps(world.box_of(way))) visit(group, way);
    }
  }

  /// The best axis of the part that is deepest, or nearest.
  [[nodiscard]] detail::Axis nearest(const detail::FramePlace& place, ColliderIndex collider) const {
    detail::Axis nearest{std::numeric_limits<double>::infinity(), Vec2d::Zero()};
    const Box2 at = world.box_of(Way::stay(place));
    for (const detail::ConvexPart& part : parts[collider]) {
      const double distance = (part.box.lower - at.upper).cwiseMax(at.lower - part.box.upper).maxCoeff();
      if (distance > 0 && distance * share_of_distance > nearest.separation) continue;
      const detail::Axis axis = detail::best_axis(part, world.points(), place);
      if (axis.separation < nearest.separation) nearest = axis;
    }
    return nearest;
  }

  /// What a way out or a free place is looked for with: of a disc a polygon around it.
  [[nodiscard]] const detail::ConvexPart* outline(const detail::ConvexPart& part) const {
    return part.radius > 0 ? &outlines.at(&part) : &part;
  }

  /// The first touch with a disc that is met on the way, and not overlapped where it begins: as late as doubles know
  /// that it is not met before.
  [[nodiscard]] ExactImpact impact_with_disc(const detail::WayIn& way_in, ColliderIndex disc) const {
    const detail::Group& group = world.group_of(disc);
    const Way way = way_in(group);
    const Passage passage(world, group, way);
    const double touch = detail::last_before([&](double until) { return passage.meets_disc(disc, until); });
    detail::FramePlace there = way.from;
    there.position += touch * way.rounded_displacement();
    const Vec2d normal = detail::best_axis(parts[disc].front(), world.points(), there).normal;
    const ColliderDef& def = world.scenery().colliders[disc];
    return {.collider = disc,
            .fraction = touch,
            .normal = normal,
            .point = def.points.front() + def.radius * normal + way.offset_after(touch),
            .exposed = true};
  }

  /// The octagon overlaps `collider` where it starts.
  [[nodiscard]] ExactImpact at_once(const Place& from, ColliderIndex collider) const {
    const detail::Axis out = nearest(seen_from(collider, from), collider);
    return {.collider = collider, .fraction = 0, .normal = out.normal, .point = from.position, .exposed = true};
  }

  [[nodiscard]] std::optional<ExactImpact> find_impact(const detail::WayIn& way_in, ColliderIndex collider) const {
    const detail::Group& group = world.group_of(collider);
    if (world.solids()[collider].kind == detail::Kind::disc) {
      if (!Passage(world, group, way_in(group)).meets(collider)) return std::nullopt;
      return impact_with_disc(way_in, collider);
    }
    const std::vector<std::uint32_t> edges = Passage(world, group, way_in(group)).entered_edges(collider);
    if (edges.empty()) return std::nullopt;
    return detail::find_impact(world, way_in, collider, edges);
  }
  [[nodiscard]] detail::WayIn moving_by(const Place& from, const Vec2d& displacement) const {
    return [=, this](const detail::Group& group) { return Way::by(seen_from(group, from), displacement); };
  }
  [[nodiscard]] detail::WayIn moving_to(const Place& from, const Place& to) const {
    return [=, this](const detail::Group& group) { return way_between(group, from, to); };
  }

  [[nodiscard]] std::vector<ExactImpact> all_impacts(const Place& from, const std::vector<ColliderIndex>& at_start,
                                                     const detail::WayIn& way_in) const {
    std::vector<ExactImpact> all;
    for (const ColliderIndex collider : at_start) all.push_back(at_once(from, collider));
    for_groups(way_in, [&](const detail::Group& group, const Way& way) {
      add_impacts(Passage(world, group, way), way_in, at_start, all);
    });
    std::ranges::stable_sort(all, {}, &ExactImpact::collider);
    return all;
  }

  /// The impacts of one way with the colliders of one group.
  void add_impacts(const Passage& passage, const detail::WayIn& way_in, const std::vector<ColliderIndex>& at_start,
                   std::vector<ExactImpact>& all) const {
    for (const ColliderIndex disc : passage.met_discs())
      if (!std::ranges::binary_search(at_start, disc)) all.push_back(impact_with_disc(way_in, disc));
    const std::vector<std::uint32_t> edges = passage.entered_edges();
    std::vector<ColliderIndex> colliders;
    for (const std::uint32_t edge : edges) colliders.push_back(world.edges()[edge].collider);
    colliders.erase(std::unique(colliders.begin(), colliders.end()), colliders.end());
    for (const ColliderIndex collider : colliders) {
      if (std::ranges::binary_search(at_start, collider)) continue;
      const std::span<const std::uint32_t> own = passage.of_collider(edges, collider);
      all.push_back(detail::find_impact(world, way_in, collider, own));
      if (own.size() == 1 || parts[collider].size() == 1) continue;
      for (const std::uint32_t edge : own) {
        all.push_back(detail::find_impact(world, way_in, collider, std::span(&edge, 1)));
      }
    }
  }

  /// Whether a position keeps at least `clearance` from a barrier, at the moment when the ways end.
  [[nodiscard]] bool keeps_clear(const detail::Barrier& barrier, const Vec2d& position, double clearance) const {
    // Boxes that are this far apart [m] leave any clearance along the best axis, unless a corner is sharper than 0.01°.
    const double surely_clear = 1e4 * clearance;
    detail::FramePlace place = barrier.end;
    place.position = position;
    const Box2 around = world.points_box() + place.rounded();
    if (!barrier.part->box.overlaps(around.inflated(surely_clear))) return true;
    return detail::best_axis(*barrier.exact, world.points(), place).separation >= clearance;
  }

  [[nodiscard]] bool is_free(std::span<const detail::Barrier> barriers, const Vec2d& end, double clearance) const {
    return std::ranges::all_of(barriers, [&](const detail::Barrier& barrier) {
      return !barrier.bars_ends || keeps_clear(barrier, end, clearance);
    });
  }

  /// Everything that may bar a straight way of the question that is no longer than `reach`.
  [[nodiscard]] std::vector<detail::Barrier> barriers(const WayQuestion& question, double reach) const {
    std::vector<detail::Barrier> all;
    const Place ends(question.from.position, question.end.movers, question.end.fraction);
    for (const detail::Group& group : world.groups()) {
      if (group.sensor) continue;
      const detail::FramePlace from = seen_from(group, question.from);
      const detail::FramePlace end = seen_from(group, ends);
      const Box2 within = world.box_of(Way::to(from, end)).inflated(reach);
      for (const ColliderIndex collider : group.solid_tree.meeting(within)) {
        const bool one_way = world.solids()[collider].kind == detail::Kind::one_way;
        for (const detail::ConvexPart& part : parts[collider]) {
          if (!part.box.overlaps(within)) continue;
          detail::Barrier barrier{outline(part), &part, end, !one_way, {}, {}};
          if (one_way ? starts_above(part, from, collider) : !contains(question.may_pass, collider)) {
            barrier.from = from;
            const bool near = question.wider.empty() || detail::best_axis(part, question.wider, from).separation < 0;
            barrier.shape = near ? std::span<const Vec2d>(world.points()) : question.wider;
          }
          if (barrier.from || barrier.bars_ends) all.push_back(barrier);
        }
      }
    }
    for (const auto& [collider, free] : question.sides) {
      const detail::FramePlace end = seen_from(collider, ends);
      for (const detail::ConvexPart& part : parts[collider])
        all.push_back({outline(part), &part, end, false, seen_from(collider, free), world.points()});
    }
    return all;
  }

  /// Whether a segment of a one-way chain may block: the octagon is on the side of its normal, but for rounding.
  [[nodiscard]] bool starts_above(const detail::ConvexPart& segment, const detail::FramePlace& place,
                                  ColliderIndex collider) const {
    constexpr double rounding = 1e-8;
    const Vec2d along = (segment.points[1] - segment.points[0]).normalized();
    const Vec2d& up = *world.scenery().colliders[collider].one_way;
    const Vec2d normal = Vec2d(-along.y(), along.x()) * (cross_of(along, up) > 0 ? 1 : -1);
    const Vec2d seen = place.rounded() - segment.points[0];
    return std::ranges::all_of(world.points(),
                               [&](const Vec2d& corner) { return normal.dot(Vec2d(seen + corner)) >= -rounding; });
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
  std::map<const detail::ConvexPart*, detail::ConvexPart> outlines;  ///< Of discs.
  double share_of_distance = 0;
};

Vec2d Place::offset(MoverIndex mover) const {
  if (mover == no_mover || movers.empty()) return Vec2d::Zero();
  return detail::FramePlace{position, movers[mover], fraction}.offset();
}

ExactScenery::ExactScenery(const SceneryDef& scenery, std::vector<Vec2d> points)
    : impl_(std::make_unique<Impl>(scenery, std::move(points))) {}

ExactScenery::~ExactScenery() = default;

std::vector<ColliderIndex> ExactScenery::overlapped(const Place& at) const { return met(at, at); }

bool ExactScenery::overlaps(const Place& at, ColliderIndex collider) const { return meets(at, at, collider); }

std::vector<ColliderIndex> ExactScenery::met(const Place& from, const Place& to) const {
  std::vector<ColliderIndex> found;
  impl_->for_groups(impl_->moving_to(from, to), [&](const detail::Group& group, const Way& way) {
    const std::vector<ColliderIndex> met = Passage(impl_->world, group, way).met();
    found.insert(found.end(), met.begin(), met.end());
  });
  std::ranges::sort(found);
  return found;
}

bool ExactScenery::meets(const Place& from, const Place& to, ColliderIndex collider) const {
  const detail::Group& group = impl_->world.group_of(collider);
  return Passage(impl_->world, group, impl_->way_between(group, from, to)).meets(collider);
}

bool ExactScenery::meets_only(const Place& from, const Place& to, std::span<const ColliderIndex> colliders) const {
  return std::ranges::includes(colliders, met(from, to));
}

std::optional<ExactImpact> ExactScenery::time_of_impact(const Place& from, const Vec2d& displacement,
                                                        ColliderIndex collider) const {
  if (overlaps(from, collider)) return impl_->at_once(from, collider);
  return impl_->find_impact(impl_->moving_by(from, displacement), collider);
}

std::optional<ExactImpact> ExactScenery::impact_between(const Place& from, const Place& to,
                                                        ColliderIndex collider) const {
  if (overlaps(from, collider)) return impl_->at_once(from, collider);
  return impl_->find_impact(impl_->moving_to(from, to), collider);
}

std::vector<ExactImpact> ExactScenery::impacts(const Place& from, const Vec2d& displacement) const {
  return impl_->all_impacts(from, overlapped(from), impl_->moving_by(from, displacement));
}

std::vector<ExactImpact> ExactScenery::impacts_between(const Place& from, const Place& to) const {
  return impl_->all_impacts(from, overlapped(from), impl_->moving_to(from, to));
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
  const Place early(to.position, from.movers, from.fraction);
  const Place late(from.position, to.movers, to.fraction);
  for (const detail::Group& group : impl_->world.groups()) {
    if (group.sensor) continue;
    Box2 box = impl_->world.box_of(impl_->way_between(group, from, to));
    if (group.mover != no_mover) box = box.merged(impl_->world.box_of(impl_->way_between(group, early, late)));
    const std::vector<ColliderIndex> near = group.solid_tree.meeting(box.inflated(within));
    found.insert(found.end(), near.begin(), near.end());
  }
  std::ranges::sort(found);
  return found;
}

std::vector<NearPart> ExactScenery::near_parts(const Place& at, double within) const {
  std::vector<NearPart> found;
  const double distance = within / impl_->share_of_distance;
  for (const ColliderIndex collider : near(at, at, distance)) {
    const detail::FramePlace place = impl_->seen_from(collider, at);
    const Box2 around = impl_->world.box_of(Way::stay(place)).inflated(distance);
    for (const detail::ConvexPart& part : impl_->parts[collider]) {
      if (!part.box.overlaps(around)) continue;
      NearPart near{.collider = collider, .moved = place.mover.to - place.mover.from, .faces = {}};
      for (const detail::Axis& axis : detail::separating_axes(part, impl_->world.points(), place, within)) {
        near.faces.push_back({axis.separation, axis.normal});
      }
      if (!near.faces.empty()) found.push_back(std::move(near));
    }
  }
  return found;
}

std::vector<ExactSensorEvent> ExactScenery::sensor_events(std::span<const Place> path) const {
  std::vector<ExactSensorEvent> events;
  for (const detail::Group& group : impl_->world.groups()) {
    if (!group.sensor) continue;
    std::vector<detail::FramePlace> places;
    for (const Place& place : path) places.push_back(impl_->seen_from(group, place));
    for (const ColliderIndex sensor : group.colliders) {
      detail::add_sensor_events(impl_->world, sensor, impl_->parts[sensor], places, events);
    }
  }
  std::ranges::stable_sort(events, {},
                           [](const ExactSensorEvent& event) { return std::tie(event.fraction, event.sensor); });
  return events;
}

std::optional<Vec2d> ExactScenery::find_free(const WayQuestion& question, double reach, double clearance,
                                             const std::function<bool(const Vec2d&)>& accept) const {
  /// So much more clearance the search keeps, so that a place still has all of it after rounding.
  constexpr double margin = 1.005;
  /// The same for the edges of shadows [m].
  constexpr double beside = 1e-9;
  const std::vector<detail::Barrier> barriers = impl_->barriers(question, reach + 2 * clearance);
  const detail::EndSearch search{.reach = reach, .clearance = margin * clearance, .beside = beside};
  for (const Vec2d& way : detail::ends_of_ways(barriers, impl_->world.points(), search)) {
    const Vec2d position = question.from.position + way;
    if (impl_->is_free(barriers, position, clearance) && accept(position)) return position;
  }
  return std::nullopt;
}

std::optional<Vec2d> ExactScenery::way_out(const Place& at, double reach) const {
  /// What the end keeps [m], and what it is looked for with: twice that, for the rounding.
  constexpr double clearance = 1e-7;
  /// How far to the sides of its end the way must be open, too [m]; for the rounding it is looked for with half more.
  constexpr double beside = 1e-6;
  const std::vector<ColliderIndex> inside = overlapped(at);
  if (inside.empty()) return std::nullopt;
  const auto open = [&](const Vec2d& end) { return meets_only(at, Place(end, at.movers, at.fraction), inside); };
  const Vec2d size = impl_->world.points_box().size();
  double farthest = 0;
  for (const ColliderIndex collider : inside) {
    const Vec2d seen = impl_->seen_from(collider, at).rounded();
    const Box2& box = impl_->world.solids()[collider].box;
    farthest = std::max(farthest, (box.upper - seen).cwiseMax(seen - box.lower).norm());
  }
  const double whole = std::min(reach, farthest + size.norm());
  for (double radius = std::min(whole, size.maxCoeff());; radius = std::min(whole, 2 * radius)) {
    const std::vector<detail::Barrier> barriers =
        impl_->barriers({.from = at, .end = at, .may_pass = inside}, radius + 2 * clearance);
    const detail::EndSearch search{
        .reach = radius, .clearance = 2 * clearance, .beside = 1.5 * beside, .from_inside_only = true};
    for (const Vec2d& out : detail::ends_of_ways(barriers, impl_->world.points(), search)) {
      const Vec2d end = at.position + out;
      const Vec2d way = (end - at.position).normalized();
      const Vec2d aside = Vec2d(-way.y(), way.x()) * beside;
      if (impl_->is_free(barriers, end, clearance) && open(end) && open(end + aside) && open(end - aside)) return end;
    }
    if (!(radius < whole)) return std::nullopt;
  }
}

const SceneryDef& ExactScenery::scenery() const noexcept { return impl_->world.scenery(); }

std::span<const Vec2d> ExactScenery::points() const noexcept { return impl_->world.points(); }

std::uint64_t ExactScenery::rational_decisions() const noexcept { return impl_->world.exact_decisions(); }

}  // namespace paperproof::compare
