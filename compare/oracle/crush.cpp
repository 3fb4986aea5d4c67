#include "oracle/crush.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
namespace {

/// Half of the narrowest opening that is asked for [m].
constexpr double least_clearance = 1e-7;
/// What the controller may keep from a contact on top of what the mover pushes [m].
constexpr double beyond_travel = 1e-6;

/// Whether a straight uniform motion from a corner of the way comes to `end` without meeting a solid. Of what is
/// overlapped already at the corner it must not come out on another side.
bool reaches(const ExactScenery& scenery, const Place& corner, const Place& end,
             const std::map<ColliderIndex, Place>& free_of) {
  const std::vector<ColliderIndex> inside = scenery.overlapped(corner);
  const std::vector<ColliderIndex> met = scenery.met(corner, end);
  return std::all_of(met.begin(), met.end(), [&](ColliderIndex collider) {
    if (!std::binary_search(inside.begin(), inside.end(), collider)) return false;
    const auto free = free_of.find(collider);
    return free == free_of.end() || !scenery.meets(free->second, end, collider);
  });
}

}  // namespace

std::optional<Vec2d> find_room(const ExactScenery& scenery, std::span<const Place> path,
                               std::span<const ColliderIndex> crushed, const std::map<ColliderIndex, Place>& free_of) {
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
    return std::any_of(path.begin(), path.end(),
                       [&](const Place& corner) { return reaches(scenery, corner, there, free_of); });
  };
  return scenery.find_free(end, travel + beyond_travel, least_clearance, others, can_go_there);
}

}  // namespace paperproof::compare::detail
