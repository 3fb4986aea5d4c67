#include "runs/lockstep.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// A contact is held where no more than this is left of the gap [m]; the guarantee bounds a contact's gap by it.
constexpr double held_gap = 1e-6;
/// Box2D's rest gap is a range; what is this near to it counts as being there [m].
constexpr double gap_slack = 1e-3;
/// Normals that enclose a smaller angle (its sine) are pushed out of as one.
constexpr double same_direction = 1e-3;

std::vector<Vec2d> held_normals(Lane& lane, const Place& place) {
  std::vector<Vec2d> normals;
  for (const Contact& contact : lane.record().contacts) {
    if (lane.solids().separation(place, contact.collider) > held_gap) continue;
    const bool known = std::ranges::any_of(normals, [&](const Vec2d& other) {
      return std::abs(other.x() * contact.normal.y() - other.y() * contact.normal.x()) < same_direction &&
             other.dot(contact.normal) > 0;
    });
    if (!known) normals.push_back(contact.normal);
  }
  return normals;
}

/// The displacement that gains `gap` along one normal, or along two at once.
Vec2d out_of(const std::vector<Vec2d>& normals, double gap) {
  if (normals.empty()) return Vec2d::Zero();
  if (normals.size() == 1) return normals[0] * gap;
  const Vec2d& a = normals[0];
  const Vec2d& b = normals[1];
  const double determinant = a.x() * b.y() - a.y() * b.x();
  if (std::abs(determinant) < same_direction) return Vec2d::Zero();  // face to face: no way out of both
  return {gap * (b.y() - a.y()) / determinant, gap * (a.x() - b.x()) / determinant};
}

}  // namespace

TwinStart twin_start(Lane& lane, const StepInput& input) {
  TwinStart start;
  start.pose = lane.contender().pose();
  // Movers are where the last step left them, in the numbers that ran.
  const std::vector<MoverMotion>& ran = lane.record().movers;
  const auto place = [&] {
    return ran.empty() ? Place(start.pose.position, input.movers, 0) : Place(start.pose.position, ran, 1);
  };
  start.shift = out_of(held_normals(lane, place()), box2d::rest_gap);
  start.pose.position += start.shift;
  const ExactScenery& solids = lane.solids();
  for (const ColliderIndex near : solids.near(place(), place(), box2d::rest_gap))
    if (solids.separation(place(), near) < box2d::rest_gap - gap_slack) start.room = false;
  for (const Contact& contact : lane.record().contacts)
    if (start.pose.state.ride && contact.collider == start.pose.state.ride->collider && contact.side == Side::bottom)
      start.pose.ground_normal = contact.normal;
  return start;
}

}  // namespace paperproof::compare
