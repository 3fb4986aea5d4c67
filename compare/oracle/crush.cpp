#include "oracle/crush.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// The straight ways from one place of the travelled way to the end of the step.
struct Departure {
  const ExactScenery& scenery;
  const ExactScenery& grown_scenery;
  std::span<const Place> way;  ///< To the place where they begin, which is its last.
  std::size_t corner;          ///< The last corner of the travelled way that belongs to it.
  const Meetings& meetings;
  const Place& from = way.back();
  std::vector<ColliderIndex> inside = scenery.overlapped(from);
  std::vector<ColliderIndex> near = grown_scenery.overlapped(from);  ///< Nearer than `least_clearance`.
  using Sides = std::vector<std::pair<ColliderIndex, Place>>;
  Sides sides = met_before();

  /// The colliders that were met before, each with the last place that was free of it.
  [[nodiscard]] Sides met_before() const {
    Sides met;
    for (const auto& [collider, free] : meetings.before)
      if (free) met.emplace_back(collider, *free);
    for (const auto& [collider, first] : meetings.within_step)
      if (first < corner && !meetings.before.contains(collider)) met.emplace_back(collider, way[first]);
    return met;
  }

  /// @param movers that press. A character above a one-way chain may go along with the mover of that chain: such a
  /// chain bounds no place, so that the search alone would not find this one.
  [[nodiscard]] std::optional<Vec2d> room(const Place& end, double reach, std::span<const MoverIndex> movers,
                                          const WhatTurns& turns) const {
    const auto can_go_there = [&](const Vec2d& position) {
      const Place there(position, end.movers, end.fraction);
      return (position - end.position).norm() <= reach && reaches(there) &&
             (!turns.left_free || turns.left_free(way_to(position)));
    };
    for (const MoverIndex mover : movers) {
      const Vec2d along = from.position + end.offset(mover) - from.offset(mover);
      if (grown_scenery.overlapped({along, end.movers, end.fraction}).empty() && can_go_there(along)) return along;
    }
    const WayQuestion question{
        .from = from, .end = end, .may_pass = inside, .sides = sides, .wider = grown_scenery.points()};
    return scenery.find_free(question, reach, least_clearance, can_go_there);
  }

  /// Whether a straight uniform motion comes to `there` without meeting a solid. It must come out of what was met
  /// before on the same side. It keeps `least_clearance` from every solid that is farther away at its start: closer to
  /// a rim it may be stopped.
  [[nodiscard]] bool reaches(const Place& there) const {
    return scenery.meets_only(from, there, inside) && grown_scenery.meets_only(from, there, near) &&
           std::ranges::none_of(sides, [&](const auto& side) { return scenery.meets(side.second, there, side.first); });
  }

  /// The whole way of the step, if it goes straight from here.
  [[nodiscard]] std::vector<PathPoint> way_to(const Vec2d& end) const {
    std::vector<PathPoint> whole;
    for (const Place& place : way) whole.push_back({place.position, place.fraction});
    whole.push_back({end, 1});
    return whole;
  }
};

/// Where on a leg the first of some colliders is touched, as late as that is known to be before; or none.
std::optional<Place> touched_on(const ExactScenery& scenery, const Place& from, const Place& to,
                                std::span<const ColliderIndex> colliders) {
  /// A share of the way that rounding stays below.
  constexpr double earlier = 1e-12;
  double first = 1;
  for (const ColliderIndex collider : colliders) {
    if (const auto impact = scenery.impact_between(from, to, collider))
      first = std::min(first, static_cast<double>(impact->fraction) - earlier);
  }
  if (!(first > 0 && first < 1)) return std::nullopt;
  const Place there(from.position + first * (to.position - from.position), from.movers,
                    from.fraction + first * (to.fraction - from.fraction));
  if (!(there.fraction < 1)) return std::nullopt;
  return scenery.meets_only(from, there, scenery.overlapped(from)) ? std::optional(there) : std::nullopt;
}

}  // namespace

std::vector<Vec2d> grown(std::span<const Vec2d> hull, double by) {
  double twice_area = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) twice_area += cross_of(hull[k], hull[(k + 1) % hull.size()]);
  const auto outward = [&](std::size_t k) -> Vec2d {
    const Vec2d edge = hull[(k + 1) % hull.size()] - hull[k];
    return Vec2d(edge.y(), -edge.x()).normalized() * std::copysign(1.0, twice_area);
  };
  std::vector<Vec2d> corners;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    // Both sides that meet at the corner go out by as much.
    const Vec2d a = outward((k + hull.size() - 1) % hull.size());
    const Vec2d b = outward(k);
    corners.emplace_back(hull[k] + (a + b) * (by / (1 + a.dot(b))));
  }
  return corners;
}

double pushed_by(const TraceStep& step) {
  const auto later = std::ranges::find_if(step.path, [](const PathPoint& corner) { return corner.fraction > 0; });
  if (later == step.path.begin() || later == step.path.end()) return 0;
  return std::max(0.0, (step.path.back().position - std::prev(later)->position).norm() - step.requested.norm());
}

std::optional<Vec2d> find_room(const ExactScenery& scenery, const ExactScenery& grown_scenery,
                               std::span<const Place> path, std::span<const ColliderIndex> crushed,
                               const Meetings& meetings, double pushed, const WhatTurns& turns) {
  const Place& end = path.back();
  double motion = 0;
  std::vector<MoverIndex> movers;
  // What leaves the way later has been pressed into already, and where the step ends there is no time to go anywhere.
  std::size_t last = path.size();
  for (const ColliderIndex collider : crushed) {
    const MoverIndex mover = scenery.scenery().colliders[collider].mover;
    if (mover != no_mover) {
      motion = std::max(motion, (end.movers[mover].to - end.movers[mover].from).norm());
      movers.push_back(mover);
    }
    const auto first = meetings.within_step.find(collider);
    if (first != meetings.within_step.end()) last = std::min(last, first->second);
  }
  const double reach = motion + push_beyond_motion - pushed;
  std::vector<Place> way;
  for (std::size_t corner = 0; corner < path.size() && corner <= last && path[corner].fraction < 1; ++corner) {
    way.push_back(path[corner]);
    if (const auto room = Departure{scenery, grown_scenery, way, corner, meetings}.room(end, reach, movers, turns))
      return room;
  }
  if (way.size() != last + 1 || last + 1 >= path.size()) return std::nullopt;
  const std::optional<Place> touched = touched_on(scenery, path[last], path[last + 1], crushed);
  if (!touched) return std::nullopt;
  way.push_back(*touched);
  return Departure{scenery, grown_scenery, way, last, meetings}.room(end, reach, movers, turns);
}

}  // namespace paperproof::compare::detail
