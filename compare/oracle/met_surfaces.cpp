#include "oracle/met_surfaces.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/stairs.hpp"
#include "oracle/turning.hpp"
#include "oracle/turning_room.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::compare {
namespace {

using detail::RigidMotion;

/// What is held up to this distance is touched [m].
constexpr double touched = detail::guaranteed_touch + detail::touch_rounding;

/// Whether what was touched still is, and there: who has come past a rim is beside it. The normal of a circle turns.
bool is_touched_there(const ExactScenery& solids, const Place& at, const Contact& touch) {
  constexpr double same_face = 1 - 1e-9;
  const bool round = solids.scenery().colliders[touch.collider].shape == ColliderDef::Shape::circle;
  const std::vector<NearPart> parts = solids.near_parts(at, touched);
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    return part.collider == touch.collider &&
           (round || part.faces.front().separation < 0 ||
            std::any_of(part.faces.begin(), part.faces.end(), [&](const NearFace& face) {
              return face.separation <= touched && face.normal.dot(touch.normal) >= same_face;
            }));
  });
}

/// Whether a leg leads along some face of what was touched there, and against the normal that was touched: past a rim.
bool leaves_past_rim(const SolidsInStep& solids, const PathPoint& from, const PathPoint& to, const Contact& touch) {
  const double share = to.fraction - from.fraction;
  const Vec2d way = to.position - from.position - share * solids.moved(touch.collider, touch.point, touch.fraction);
  if (!(way.dot(touch.normal) < -touched)) return false;
  const std::vector<NearPart> parts = solids.at(from.fraction).near_parts(Place(from, solids.step().movers), touched);
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    return part.collider == touch.collider &&
           std::any_of(part.faces.begin(), part.faces.end(),
                       [&](const NearFace& face) { return face.separation >= 0 && way.dot(face.normal) >= -touched; });
  });
}

/// The colliders that are a stair there.
std::vector<ColliderIndex> stairs_at(const SolidsInStep& solids, const PathPoint& at) {
  const ExactScenery& there = solids.at(at.fraction);
  const Place place(at, solids.step().movers);
  std::vector<ColliderIndex> stairs;
  for (const NearPart& part : there.near_parts(place, touched))
    if (detail::is_stair(solids.header(), there, solids.step(), place, part)) stairs.push_back(part.collider);
  return stairs;
}

bool touches_ground(const SolidsInStep& solids, const PathPoint& at) {
  const Vec2d up = up_in(solids.step(), solids.header());
  const std::vector<NearPart> parts = solids.at(at.fraction).near_parts(Place(at, solids.step().movers), touched);
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    return part.faces.front().separation <= touched && is_walked_on(part.faces.front().normal, solids.header(), up);
  });
}

}  // namespace

bool is_walked_on(const Vec2d& normal, const TraceHeader& header, const Vec2d& up) {
  const double climb = header.scalar == "float" ? 1e-5 : 1e-8;
  return normal.dot(up) >= std::cos(header.character.max_climb_degrees * std::numbers::pi / 180 + climb);
}

const ExactScenery& SolidsInStep::at(double fraction) const {
  if (step_.vertex_ways.empty()) return solids_;
  std::unique_ptr<ExactScenery>& there = turned_[fraction];
  if (!there)
    there = std::make_unique<ExactScenery>(detail::standing_at(header_.scenery, step_, fraction), header_.points);
  return *there;
}

double SolidsInStep::gap_on_way(ColliderIndex collider) const {
  double gap = std::numeric_limits<double>::infinity();
  for (const PathPoint& corner : step_.path)
    gap = std::min(gap, at(corner.fraction).separation(Place(corner, step_.movers), collider));
  return gap;
}

Vec2d SolidsInStep::moved(ColliderIndex collider, const Vec2d& point, double fraction) const {
  const MoverIndex mover = header_.scenery.colliders[collider].mover;
  if (mover == no_mover) return Vec2d::Zero();
  const VertexWay* turning = find_way(step_.vertex_ways, collider);
  if (turning == nullptr) return step_.movers[mover].to - step_.movers[mover].from;
  const std::vector<Vec2d> then = detail::vertices_at(*turning, fraction);
  return RigidMotion(then, turning->vertices.back())(point) - RigidMotion(then, turning->vertices.front())(point);
}

double SolidsInStep::spread(ColliderIndex collider, const Vec2d& moved, double apart) const {
  const VertexWay* turning = find_way(step_.vertex_ways, collider);
  if (turning == nullptr) return 0;
  const ColliderDef& def = header_.scenery.colliders[collider];
  if (def.shape == ColliderDef::Shape::circle)
    return std::abs(turning->turn) * (def.radius + detail::contact_reach) / length_of(step_, header_);
  const double angle = std::abs(RigidMotion(turning->vertices.front(), turning->vertices.back()).angle());
  return angle * (moved.norm() + apart) / length_of(step_, header_);
}

std::vector<SolidsInStep::Carrying> SolidsInStep::carrying(ColliderIndex collider, const Vec2d& point,
                                                           double apart) const {
  const double dt = length_of(step_, header_);
  const VertexWay* way = find_way(step_.vertex_ways, collider);
  const Vec2d whole = moved(collider, point, 1) / dt;
  if (way == nullptr) return {{.velocity = whole}};
  if (header_.scenery.colliders[collider].shape == ColliderDef::Shape::circle) {
    const double unknown = spread(collider, whole * dt, apart);
    return {{.velocity = whole, .across = unknown, .along = unknown}};
  }
  const std::size_t last = way->instants.size() - 1;
  const auto since = [&](std::size_t begin) -> Carrying {
    const RigidMotion back(way->vertices[last], way->vertices[begin]);
    const double time = (way->instants[last] - way->instants[begin]) * dt;
    const Vec2d went = point - back(point);
    const double turned = std::abs(back.angle());
    return {.velocity = went / time,
            .across = turned * (went.norm() + apart) / time,
            .along = turned * (went.norm() + turned * apart) / time};
  };
  return {since(0), since(last - 1)};
}

Vec2d conveyed(const ColliderDef& collider, const Vec2d& normal) {
  return collider.surface_speed * Vec2d(normal.y(), -normal.x());
}

Vec2d imparted(const Vec2d& velocity, const Vec2d& normal, bool walkable) {
  return walkable ? velocity : Vec2d(velocity.dot(normal) * normal);
}

Vec2d velocity_of(const SolidsInStep& solids, const Contact& touch) {
  return conveyed(solids.header().scenery.colliders[touch.collider], touch.normal) +
         solids.moved(touch.collider, touch.point, touch.fraction) / length_of(solids.step(), solids.header());
}

bool begins_as_walk(const TraceHeader& header, const TraceStep& step, bool grounded, const Vec2d& wanted) {
  const Vec2d up = up_in(step, header);
  const double steepest = std::tan(header.character.max_climb_degrees * std::numbers::pi / 180);
  return grounded && wanted.dot(up) <= std::abs(wanted.dot(right_of(up))) * steepest;
}

std::vector<MetSurface> met_surfaces(const SolidsInStep& solids, std::span<const Contact> contacts, bool walks,
                                     std::optional<ColliderIndex> ridden) {
  const TraceStep& step = solids.step();
  const Vec2d up = up_in(step, solids.header());
  std::vector<MetSurface> surfaces;
  const std::vector<ColliderDef>& colliders = solids.header().scenery.colliders;
  // Walls and slopes of what is ridden.
  const auto goes_along = [&](ColliderIndex collider) {
    return ridden && colliders[*ridden].mover != no_mover && colliders[collider].mover == colliders[*ridden].mover;
  };
  const auto level = [&](ColliderIndex collider) -> MetSurface {
    const Contact touch{.collider = collider, .point = step.path.back().position, .normal = up};
    return {.normal = up,
            .velocity = velocity_of(solids, touch),
            .collider = collider,
            .walkable = true,
            .ridden = ridden == collider};
  };
  const bool may_stand_on_stairs = walks;
  for (const Contact& touch : contacts) {
    // A contact tells when it would be touched, a corner when the way ends at the gap before it.
    const auto corner = std::min_element(step.path.begin(), step.path.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.fraction - touch.fraction) < std::abs(b.fraction - touch.fraction);
    });
    const auto is_touched = [&](const PathPoint& at) {
      return is_touched_there(solids.at(at.fraction), Place(at, step.movers), touch);
    };
    MetSurface one{.normal = touch.normal, .collider = touch.collider};
    one.walkable = is_walked_on(touch.normal, solids.header(), up);
    one.velocity = imparted(velocity_of(solids, touch), touch.normal, one.walkable || goes_along(touch.collider));
    one.ridden = ridden == touch.collider;
    one.is_side = touch.side == Side::left || touch.side == Side::right;
    one.climbs = walks && touches_ground(solids, *corner);
    one.met = touch.fraction >= 1 || corner->fraction >= 1 ? touch.fraction : corner->fraction;
    const auto leaves = std::find_if_not(corner + 1, step.path.end(), is_touched);
    if (leaves != step.path.end())
      one.left = (leaves_past_rim(solids, *std::prev(leaves), *leaves, touch) ? std::prev(leaves) : leaves)->fraction;
    one.returned = leaves != step.path.end() && is_touched(step.path.back());
    one.spread = solids.spread(touch.collider, solids.moved(touch.collider, touch.point, touch.fraction),
                               detail::extent_of(solids.header().points));
    walks = walks || one.walkable;
    surfaces.push_back(one);
    if (may_stand_on_stairs && !one.walkable && one.normal.dot(up) > 0 &&
        contains(stairs_at(solids, *corner), touch.collider)) {
      MetSurface floor = level(touch.collider);
      floor.met = one.met;
      floor.left = one.left;
      surfaces.push_back(floor);
    }
    if (!one.returned) continue;
    const auto back = std::find_if(leaves, step.path.end(), is_touched);  // it is reported once
    one.met = back->fraction;
    one.left = std::numeric_limits<double>::infinity();
    surfaces.push_back(one);
  }
  if (may_stand_on_stairs && step.grounded)
    for (const ColliderIndex collider : stairs_at(solids, step.path.back())) {
      surfaces.push_back(level(collider));
      surfaces.back().met = 1;
    }
  std::stable_sort(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) { return a.met < b.met; });
  return surfaces;
}

}  // namespace paperproof::compare
