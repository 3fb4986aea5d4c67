#include "oracle/hanging.hpp"

#include "oracle/exemptions.hpp"
#include "oracle/legs.hpp"
#include "oracle/stairs.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace paperproof::compare::detail {
namespace {

/// Less of a fall is none [m].
constexpr double least_fall = 1e-9;
/// The share of the possible fall that a step has to fall at least.
constexpr double least_share = 0.5;
/// A slope that is so much steeper than the climb limit is still the limit [rad]: vertices in float are as wrong.
constexpr double climb_margin = 1e-6;
/// Of a product of a normal and a displacement, relative: normals are rounded.
constexpr double normal_rounding = 1e-12;

}  // namespace

bool is_walkable(const Vec2d& normal, const TraceHeader& header, const Vec2d& up) {
  return normal.dot(up) >= std::cos(header.character.max_climb_degrees * std::numbers::pi / 180 + climb_margin);
}

Reach reach_of(const TraceHeader& header) {
  const double own = std::max(exact_reach.contact, allowed(Exempt::hover, header));
  if (own == exact_reach.contact) return exact_reach;
  return {own, 2 * own};
}

HangingJudge::HangingJudge(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step,
                           const WhatTurns& turns, const Vec2d& up, const Wanted* walk)
    : header_(header), scenery_(scenery), step_(step), turns_(turns), up_(up), walk_(walk) {}

bool HangingJudge::HalfPlane::holds(const Vec2d& d) const {
  return normal.dot(d) - bound >= -normal_rounding * (d.norm() + std::abs(bound));
}

/// How far the octagon can be shifted by the unit vector before the obstacle is met [m].
double HangingJudge::HalfPlane::room(const Vec2d& aside) const {
  const double approach = -normal.dot(aside);
  return approach > normal_rounding ? separation / approach : std::numeric_limits<double>::infinity();
}

bool HangingJudge::hangs(const Vec2d& made, const Reach& reach, Bounds bounds) const {
  const Vec2d unsteered = step_.requested - step_.steered * right_of(up_);
  const double least = std::max(least_fall, ulp_at(header_, step_.path.front().position));
  const double asked = -unsteered.dot(up_);
  const double fell = -made.dot(up_);
  if (is_capped(step_, header_) || !(asked > least) || !(fell < least_share * asked)) return false;
  const auto falls_short_of = [&](double fall) { return fall > least && fell < least_share * fall; };
  const std::vector<Nearby> corners = near_corners(unsteered.dot(up_) * up_, reach, bounds);
  Nearby all;
  for (const Nearby& corner : corners) all.add(corner);
  if (all.holds) return false;
  const Vec2d free = nearest_free(unsteered, all.obstacles, reach.opening);
  if (!falls_short_of(std::min(-free.dot(up_), asked))) return false;
  if (step_.movers.empty()) return true;
  return falls_short_of(fall_leg_by_leg(unsteered, corners, reach)) && !is_run_into(reach);
}

bool HangingJudge::has_support(std::size_t corner, double within) const {
  const std::vector<NearPart> parts = detail::parts_near(scenery_, step_, turns_, corner, within);
  const std::vector<ColliderIndex>& dropped = step_.dropped_through;
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    if (std::find(dropped.begin(), dropped.end(), part.collider) != dropped.end()) return false;
    return part.faces.front().separation < 0 ||
           std::any_of(part.faces.begin(), part.faces.end(),
                       [this](const NearFace& face) { return face.normal.dot(up_) > 0; });
  });
}

bool HangingJudge::is_held_at_end(double within) const {
  Vec2d unsteered = step_.requested - step_.steered * right_of(up_);
  // A rise that ends in a wedge is held there by what pulls it down.
  const double dt = length_of(step_, header_);
  if (!(unsteered.dot(up_) < 0)) unsteered = gravity_in(step_, header_) * (dt * dt);
  if (!(unsteered.dot(up_) < 0)) return false;
  std::vector<Obstacle> obstacles;
  for (const NearPart& part : parts_near(step_.path.size() - 1, within)) {
    obstacles.emplace_back();
    for (const NearFace& face : part.faces)
      obstacles.back().push_back({face.normal, 0, face.separation});  // as things are then
  }
  const Vec2d free = nearest_free(unsteered, obstacles, exact_reach.opening);
  return -free.dot(up_) <= std::max(least_fall, ulp_at(header_, step_.path.back().position));
}

void HangingJudge::Nearby::add(const Nearby& other) {
  obstacles.insert(obstacles.end(), other.obstacles.begin(), other.obstacles.end());
  holds = holds || other.holds;
}

/// What the octagon may touch at each corner of its way. Ground holds it where it says that it stands, or cannot fall
/// past: two corners that lie side by side hold nothing.
std::vector<HangingJudge::Nearby> HangingJudge::near_corners(const Vec2d& fall, const Reach& reach,
                                                             Bounds bounds) const {
  std::vector<Nearby> corners(step_.path.size());
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    for (const NearPart& part : parts_near(corner, reach.contact)) {
      const double unsure = bounds == Bounds::safe ? part.unsure : 0;
      Obstacle planes;
      for (const NearFace& face : part.faces)
        planes.push_back({face.normal, face.normal.dot(part.moved) + unsure, face.separation});
      const auto lets_fall = [&](const HalfPlane& plane) {
        return plane.separation >= reach.opening && plane.normal.dot(fall) >= 0;  // however it moves
      };
      const bool falls_past = std::any_of(planes.begin(), planes.end(), lets_fall);
      Nearby& nearby = corners[corner];
      nearby.holds = nearby.holds || part.faces.front().separation < -reach.contact ||
                     (is_ground(corner, part) && (step_.grounded || !falls_past));
      nearby.obstacles.push_back(std::move(planes));
    }
  }
  return corners;
}

/// Among movers an obstacle may touch for a part of the step. Obstacles near the start of a leg, near its end and near
/// both each allow a rate of fall: the leg takes the least of the three. It is no faster than the leg before, because
/// lost momentum is lost for the rest of the step.
double HangingJudge::fall_leg_by_leg(const Vec2d& wanted, const std::vector<Nearby>& corners,
                                     const Reach& reach) const {
  double fall = 0;
  double rate = -wanted.dot(up_);
  for (std::size_t corner = 0; corner + 1 < corners.size(); ++corner) {
    const std::vector<Obstacle>& begin = corners[corner].obstacles;
    const std::vector<Obstacle>& end = corners[corner + 1].obstacles;
    std::vector<Obstacle> both = begin;
    both.insert(both.end(), end.begin(), end.end());
    for (const auto& obstacles : {std::cref(begin), std::cref(end), std::cref(both)})
      rate = std::min(rate, -nearest_free(wanted, obstacles.get(), reach.opening).dot(up_));
    fall += rate * (step_.path[corner + 1].fraction - step_.path[corner].fraction);
  }
  return fall;
}

/// Whether a mover that does not touch the octagon at some corner would run into it, if it stayed there or went on as
/// requested.
bool HangingJudge::is_run_into(const Reach& reach) const {
  return std::any_of(step_.path.begin(), step_.path.end(), [&](const PathPoint& corner) {
    return is_run_into(corner, Vec2d::Zero(), reach) ||
           is_run_into(corner, step_.requested * (1 - corner.fraction), reach);
  });
}

bool HangingJudge::is_run_into(const PathPoint& corner, const Vec2d& way, const Reach& reach) const {
  if (turns_.runs_into && turns_.runs_into(corner, way, reach.contact)) return true;
  const Place there(corner, step_.movers);
  const std::vector<ExactImpact> impacts =
      scenery_.impacts_between(there, Place(corner.position + way, step_.movers, 1));
  return std::any_of(impacts.begin(), impacts.end(), [&](const ExactImpact& impact) {
    const MoverIndex mover = scenery_.scenery().colliders[impact.collider].mover;
    if (mover == no_mover || scenery_.separation(there, impact.collider) <= reach.contact) return false;
    const MoverMotion& motion = step_.movers[mover];
    const double left = (1 - static_cast<double>(impact.fraction)) * (1 - corner.fraction);
    return (motion.to - motion.from).dot(impact.normal) * left > exact_reach.contact;
  });
}

std::vector<NearPart> HangingJudge::parts_near(std::size_t corner, double within) const {
  std::vector<NearPart> parts = scenery_.near_parts(Place(step_.path[corner], step_.movers), within);
  std::erase_if(parts, [&](const NearPart& part) { return !blocks(corner, part, within); });
  if (turns_.near)
    for (NearPart& part : turns_.near(step_.path[corner], within)) parts.push_back(std::move(part));
  return parts;
}

/// A one-way chain blocks where it blocks the shortest way to it, from the corner or from where the leg began that
/// ended there, unless it is passed on purpose.
bool HangingJudge::blocks(std::size_t corner, const NearPart& part, double within) const {
  if (!scenery_.scenery().colliders[part.collider].one_way) return true;
  const std::vector<ColliderIndex>& dropped = step_.dropped_through;
  if (std::find(dropped.begin(), dropped.end(), part.collider) != dropped.end()) return false;
  const Place at(step_.path[corner], step_.movers);
  const Place beyond(at.position - 2 * within * part.faces.front().normal, at.movers, at.fraction);
  if (scenery_.meets(at, beyond, part.collider)) return true;
  // It may have waited here since that leg.
  const MoverIndex mover = scenery_.scenery().colliders[part.collider].mover;
  const auto seen = [&](std::size_t i) {
    return Vec2d(step_.path[i].position - Place(step_.path[i], step_.movers).offset(mover));
  };
  std::size_t before = corner;
  while (before > 0 && seen(before) == seen(corner)) --before;
  return before < corner && scenery_.meets(Place(step_.path[before], step_.movers), beyond, part.collider);
}

bool HangingJudge::is_ground(std::size_t corner, const NearPart& part) const {
  return std::any_of(part.faces.begin(), part.faces.end(),
                     [&](const NearFace& face) { return is_walkable(face.normal, header_, up_); }) ||
         (walk_ != nullptr &&
          is_stair(header_, scenery_, step_, walk_->carried, Place(step_.path[corner], step_.movers), part));
}

/// The displacement nearest to what is wanted that keeps clear of all obstacles: it is that itself, or on the border of
/// one half plane, or where the borders of two cross. Zero where there is none.
Vec2d HangingJudge::nearest_free(const Vec2d& wanted, const std::vector<Obstacle>& obstacles, double opening) {
  std::vector<HalfPlane> borders;
  for (const Obstacle& obstacle : obstacles) {
    for (const HalfPlane& plane : obstacle) {
      const auto same = [&](const HalfPlane& known) {
        return known.normal == plane.normal && known.bound == plane.bound;
      };
      if (std::none_of(borders.begin(), borders.end(), same)) borders.push_back(plane);
    }
  }
  const auto is_free = [&](const Vec2d& d) {
    return std::all_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& obstacle) {
      return std::any_of(obstacle.begin(), obstacle.end(), [&](const HalfPlane& plane) { return plane.holds(d); });
    });
  };
  const auto room = [&](const Vec2d& d, const Vec2d& aside) {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : obstacles) {
      double most = 0;
      for (const HalfPlane& plane : obstacle)
        if (plane.holds(d)) most = std::max(most, plane.room(aside));
      least = std::min(least, most);
    }
    return least;
  };
  const auto is_open = [&](const Vec2d& d) {
    const Vec2d left = Vec2d(-d.y(), d.x()).normalized();
    return d == Vec2d::Zero() || room(d, left) + room(d, -left) >= opening;
  };
  std::optional<Vec2d> nearest;
  const auto look = [&](const Vec2d& d) {
    if (nearest && (d - wanted).squaredNorm() >= (*nearest - wanted).squaredNorm()) return;
    if (is_free(d) && is_open(d)) nearest = d;
  };
  look(wanted);
  for (std::size_t i = 0; i < borders.size() && nearest != wanted; ++i) {
    const HalfPlane& a = borders[i];
    look(wanted - (a.normal.dot(wanted) - a.bound) * a.normal);
    for (std::size_t j = 0; j < i; ++j) {
      const HalfPlane& b = borders[j];
      const double over = cross_of(a.normal, b.normal);
      if (std::abs(over) <= normal_rounding) continue;
      look(Vec2d(a.bound * b.normal.y() - b.bound * a.normal.y(), b.bound * a.normal.x() - a.bound * b.normal.x()) /
           over);
    }
  }
  return nearest.value_or(Vec2d::Zero());
}

}  // namespace paperproof::compare::detail
