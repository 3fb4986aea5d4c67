#include "oracle/crush.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// What the controller may keep from a contact on top of what the mover pushes [m].
constexpr double beyond_travel = 1e-6;

/// The ways from one corner to the end of the step.
class Departure {
 public:
  Departure(const ExactScenery& scenery, const ExactScenery& grown_scenery, std::span<const Place> path,
            std::size_t corner, const Meetings& meetings)
      : scenery_(scenery),
        grown_scenery_(grown_scenery),
        from_(path[corner]),
        inside_(scenery.overlapped(from_)),
        near_(grown_scenery.overlapped(from_)) {
    for (const Place& place : path.first(corner + 1)) way_.push_back({place.position, place.fraction});
    for (const auto& [collider, free] : meetings.before) {
      if (free) sides_.emplace_back(collider, *free);
    }
    for (const auto& [collider, first] : meetings.within_step) {
      if (first < corner && !meetings.before.contains(collider)) sides_.emplace_back(collider, path[first]);
    }
  }

  /// Whether a straight uniform motion comes to `there` without meeting a solid. Of what was met before it must not
  /// come out on another side.
  [[nodiscard]] bool reaches(const Place& there) {
    // What was in the way to one place mostly is in the way to the next, too.
    if (last_met_ && scenery_.meets(from_, there, *last_met_)) return false;
    for (const auto& [collider, free] : sides_) {
      if (scenery_.meets(free, there, collider)) return false;
    }
    for (const ColliderIndex collider : scenery_.met(from_, there)) {
      if (std::find(inside_.begin(), inside_.end(), collider) != inside_.end()) continue;
      last_met_ = collider;
      return false;
    }
    return keeps_clear(there);
  }

  /// The whole way of the step, if it goes straight from here.
  [[nodiscard]] std::vector<PathPoint<double>> way_to(const Vec2d& end) const {
    std::vector<PathPoint<double>> way = way_;
    way.push_back({end, 1});
    return way;
  }

 private:
  /// Whether the way comes no nearer than `least_clearance` to what is farther away where it begins: what passes a rim
  /// nearer than that may be stopped there.
  [[nodiscard]] bool keeps_clear(const Place& there) const {
    const std::vector<ColliderIndex> approached = grown_scenery_.met(from_, there);
    return std::all_of(approached.begin(), approached.end(), [this](ColliderIndex collider) {
      return std::find(near_.begin(), near_.end(), collider) != near_.end();
    });
  }

  const ExactScenery& scenery_;
  const ExactScenery& grown_scenery_;
  const Place& from_;
  std::vector<PathPoint<double>> way_;  ///< Up to there.
  std::vector<ColliderIndex> inside_;
  std::vector<ColliderIndex> near_;                     ///< Nearer than `least_clearance`.
  std::vector<std::pair<ColliderIndex, Place>> sides_;  ///< What was met, with the last place free of it.
  std::optional<ColliderIndex> last_met_;
};

}  // namespace

std::vector<Vec2d> grown(std::span<const Vec2d> hull, double by) {
  double twice_area = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2d& next = hull[(k + 1) % hull.size()];
    twice_area += hull[k].x() * next.y() - hull[k].y() * next.x();
  }
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

std::optional<Vec2d> find_room(const ExactScenery& scenery, const ExactScenery& grown_scenery,
                               std::span<const Place> path, std::span<const ColliderIndex> crushed,
                               const Meetings& meetings, const Others& characters) {
  const Place& end = path.back();
  double travel = 0;
  std::vector<Vec2d> others;
  for (const ColliderIndex collider : crushed) {
    const MoverIndex mover = scenery.scenery().colliders[collider].mover;
    if (mover == no_mover) continue;
    travel = std::max(travel, (end.movers[mover].to - end.movers[mover].from).norm());
    // Where it would be if it went along with the mover from some corner on.
    for (const Place& corner : path) others.push_back(corner.position + (end.offset(mover) - corner.offset(mover)));
  }
  for (const Place& corner : path) others.push_back(corner.position);
  // What leaves the way later has been pressed into already, and where the step ends there is no time to go anywhere.
  std::size_t last = path.size();
  for (const ColliderIndex collider : crushed) {
    const auto first = meetings.within_step.find(collider);
    if (first != meetings.within_step.end()) last = std::min(last, first->second);
  }
  std::vector<Departure> departures;
  for (std::size_t corner = 0; corner < path.size() && corner <= last && path[corner].fraction < 1; ++corner) {
    departures.emplace_back(scenery, grown_scenery, path, corner, meetings);
  }
  const auto can_go_there = [&](const Vec2d& position) {
    const Place there(position, end.movers, end.fraction);
    return std::any_of(departures.begin(), departures.end(), [&](Departure& one) {
      return one.reaches(there) && (!characters.left_free || characters.left_free(one.way_to(position)));
    });
  };
  return scenery.find_free(end, travel + beyond_travel, least_clearance, others, can_go_there);
}

}  // namespace paperproof::compare::detail
