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

/// Cosine of the angle between normals of one face.
constexpr double same_face = 1 - 1e-9;
/// A leg along a face may come nearer to it by so much of its length, and of a metre.
constexpr double along_face = 1e-9;
constexpr double along_face_in_metres = 1e-13;

/// What is touched at a place of the way, as all stands then.
std::vector<NearPart> touched_at(const SolidsInStep& solids, const PathPoint& at) {
  return solids.at(at.fraction).near_parts(Place(at, solids.step().movers), touched);
}

/// How a way touches the surface of one contact.
struct Touching {
  const SolidsInStep& solids;
  const Contact& contact;

  /// Whether the surface is touched there. A character past its rim does not touch it.
  /// @param turned the normal may differ there: that of a circle turns.
  [[nodiscard]] bool is_at(const PathPoint& at, bool turned) const {
    return detail::any_face(touched_at(solids, at), [&](const NearPart& part, const NearFace& face) {
      return part.collider == contact.collider &&
             ((turned && is_round()) || part.faces.front().separation < 0 ||
              (face.separation <= touched && face.normal.dot(contact.normal) >= same_face));
    });
  }
  /// Whether it is touched there corner to corner: another face of it is as near.
  [[nodiscard]] bool is_beside(const PathPoint& at) const {
    const auto is_it = [&](const NearFace& face) { return face.normal.dot(contact.normal) >= same_face; };
    return !is_round() && std::ranges::any_of(touched_at(solids, at), [&](const NearPart& part) {
      return part.collider == contact.collider && std::ranges::any_of(part.faces, is_it) &&
             std::ranges::any_of(part.faces,
                                 [&](const NearFace& face) { return face.separation >= 0 && !is_it(face); });
    });
  }
  /// Whether a leg between two places where it is touched goes along it, or away.
  [[nodiscard]] bool goes_along(const PathPoint& from, const PathPoint& to) const {
    const Vec2d way = relative(from, to);
    return is_at(from, true) && is_at(to, true) &&
           way.dot(contact.normal) >= -along_face_in_metres - along_face * way.norm();
  }
  [[nodiscard]] bool enters(const PathPoint& from, const PathPoint& to) const {
    return relative(from, to).dot(contact.normal) < -touched;
  }
  /// Whether a leg leads past a rim: against the normal that was touched, and along another face of the same part.
  [[nodiscard]] bool leaves_past_rim(const PathPoint& from, const PathPoint& to) const {
    if (!enters(from, to)) return false;
    const Vec2d way = relative(from, to);
    return detail::any_face(touched_at(solids, from), [&](const NearPart& part, const NearFace& face) {
      return part.collider == contact.collider && face.separation >= 0 && way.dot(face.normal) >= -touched;
    });
  }

 private:
  [[nodiscard]] bool is_round() const {
    return solids.header().scenery.colliders[contact.collider].shape == ColliderDef::Shape::circle;
  }
  /// The displacement of a leg relative to the surface.
  [[nodiscard]] Vec2d relative(const PathPoint& from, const PathPoint& to) const {
    return to.position - from.position -
           (to.fraction - from.fraction) * solids.moved(contact.collider, contact.point, contact.fraction);
  }
};

bool touches_ground(const SolidsInStep& solids, const PathPoint& at) {
  const Vec2d up = up_in(solids.step(), solids.header());
  return std::ranges::any_of(touched_at(solids, at), [&](const NearPart& part) {
    return part.faces.front().separation <= touched && is_walked_on(part.faces.front().normal, solids.header(), up);
  });
}

/// The colliders that are a stair there. Who touches ground stands on that.
std::vector<ColliderIndex> stairs_at(const SolidsInStep& solids, const Vec2d& carried, const PathPoint& at) {
  if (touches_ground(solids, at)) return {};
  const detail::StepView step{solids.header(), solids.at(at.fraction), solids.step()};
  std::vector<ColliderIndex> stairs;
  for (const NearPart& part : touched_at(solids, at))
    if (is_stair(step, carried, Place(at, solids.step().movers), part)) stairs.push_back(part.collider);
  return stairs;
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

bool begins_as_walk(const TraceHeader& header, const TraceStep& step, const Wanted& wanted) {
  const Vec2d up = up_in(step, header);
  const double steepest = std::tan(header.character.max_climb_degrees * std::numbers::pi / 180);
  const Vec2d own = wanted.velocity - wanted.carried / length_of(step, header);
  return wanted.from_ground && !wanted.jumped && own.dot(up) <= std::abs(own.dot(right_of(up))) * steepest;
}

std::vector<Vec2d> sides_of(const TraceHeader& header, const Vec2d& up) {
  if (up.x() == 0 || up.y() == 0) return {};
  std::vector<Vec2d> sides{Vec2d::UnitX(), Vec2d::UnitY()};
  const std::vector<Vec2d>& points = header.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    sides.push_back((points[(i + 1) % points.size()] - points[i]).normalized());
  return sides;
}

std::vector<MetSurface> met_surfaces(const SolidsInStep& solids, std::span<const Contact> contacts,
                                     const Wanted& wanted) {
  const TraceStep& step = solids.step();
  const std::optional<ColliderIndex> ridden = wanted.stays_on();
  bool walks = begins_as_walk(solids.header(), step, wanted);
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
  const std::vector<PathPoint>& path = step.path;
  for (const Contact& touch : contacts) {
    const Touching touching{solids, touch};
    const auto is_touched = [&](const PathPoint& at) { return touching.is_at(at, true); };
    // A contact has the time at which the surface would be touched, and a corner of the path the time at which the
    // motion stops before it. A surface that is grazed would be touched long after the path has turned along it.
    const bool is_anywhere = std::ranges::any_of(path, is_touched);
    const auto off = [&](const PathPoint& at) {
      return is_anywhere && !is_touched(at) ? 2 : std::abs(at.fraction - touch.fraction);
    };
    auto corner = std::ranges::min_element(path, [&](const auto& a, const auto& b) { return off(a) < off(b); });
    while (touch.fraction < 1 && corner != path.begin() && touching.goes_along(*std::prev(corner), *corner)) --corner;
    MetSurface one{.normal = touch.normal, .collider = touch.collider};
    one.walkable = is_walked_on(touch.normal, solids.header(), up);
    one.velocity = imparted(velocity_of(solids, touch), touch.normal, one.walkable || goes_along(touch.collider));
    one.ridden = ridden == touch.collider;
    one.is_side = touch.side == Side::left || touch.side == Side::right;
    one.spread = solids.spread(touch.collider, solids.moved(touch.collider, touch.point, touch.fraction),
                               detail::extent_of(solids.header().points));
    one.met = touch.fraction >= 1 || corner->fraction >= 1 ? touch.fraction : corner->fraction;
    // A contact is reported once, however often the path returns to its surface. A surface that the next leg enters
    // does not stop the character there.
    const auto is_back = [&](const PathPoint& at) {
      return touching.is_at(at, false) && (&at == &path.back() || !touching.enters(at, *(&at + 1)));
    };
    while (corner != path.end()) {
      const bool on_stair = may_stand_on_stairs && !one.walkable && one.normal.dot(up) > 0 &&
                            contains(stairs_at(solids, wanted.carried, *corner), touch.collider);
      one.climbs = touches_ground(solids, *corner);
      one.is_beside = touching.is_beside(*corner);
      const auto leaves = std::find_if_not(corner + 1, path.end(), is_touched);
      one.past_rim = leaves != path.end() && touching.leaves_past_rim(*std::prev(leaves), *leaves);
      one.left = leaves == path.end() ? std::numeric_limits<double>::infinity()
                                      : (one.past_rim ? std::prev(leaves) : leaves)->fraction;
      corner = std::find_if(leaves, path.end(), is_back);
      one.returned = one.returned || corner != path.end();
      surfaces.push_back(one);
      if (on_stair) {
        surfaces.push_back(level(touch.collider));
        surfaces.back().met = one.met;
        surfaces.back().left = one.left;
      }
      if (corner != path.end()) one.met = corner->fraction;
    }
  }
  if (may_stand_on_stairs && step.grounded)
    for (const ColliderIndex collider : stairs_at(solids, wanted.carried, step.path.back())) {
      surfaces.push_back(level(collider));
      surfaces.back().met = 1;
    }
  std::ranges::stable_sort(surfaces, [](const auto& a, const auto& b) { return a.met < b.met; });
  for (MetSurface& one : surfaces) {
    one.climbs = one.climbs && walks;
    walks = walks || one.walkable;
  }
  return surfaces;
}

}  // namespace paperproof::compare
