#include "oracle/crush.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
namespace {

/// Half of the narrowest opening that is asked for [m].
constexpr double least_clearance = 1e-7;
/// What the controller may keep from a contact on top of what the mover pushes [m].
constexpr double beyond_travel = 1e-6;

/// Whether a straight uniform motion from a corner of the way comes to `there` without meeting a solid. Of what was
/// met before that corner it must not come out on another side.
bool reaches(const ExactScenery& scenery, std::span<const Place> path, std::size_t corner, const Place& there,
             const Meetings& meetings) {
  std::vector<ColliderIndex> known;
  for (const auto& [collider, first] : meetings.within_step) {
    if (first >= corner) continue;
    known.push_back(collider);
    if (!meetings.before.contains(collider) && scenery.meets(path[first], there, collider)) return false;
  }
  for (const auto& [collider, free] : meetings.before) {
    known.push_back(collider);
    if (free && scenery.meets(*free, there, collider)) return false;
  }
  const std::vector<ColliderIndex> met = scenery.met(path[corner], there);
  return std::all_of(met.begin(), met.end(), [&](ColliderIndex collider) {
    return std::find(known.begin(), known.end(), collider) != known.end();
  });
}

}  // namespace

std::optional<Vec2d> find_room(const ExactScenery& scenery, std::span<const Place> path,
                               std::span<const ColliderIndex> crushed, const Meetings& meetings) {
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
  const auto can_go_there = [&](const Vec2d& position) {
    const Place there(position, end.movers, end.fraction);
    for (std::size_t corner = 0; corner < path.size(); ++corner) {
      if (reaches(scenery, path, corner, there, meetings)) return true;
    }
    return false;
  };
  return scenery.find_free(end, travel + beyond_travel, least_clearance, others, can_go_there);
}

}  // namespace paperproof::compare::detail
