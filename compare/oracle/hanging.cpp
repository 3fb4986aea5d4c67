#include "oracle/hanging.hpp"

#include "contains.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/stairs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
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

/// The displacements that stay outside an obstacle, beyond one of its faces: normal · d >= bound.
struct FreeSide {
  Vec2d normal;
  double bound = 0;       ///< [m]
  double separation = 0;  ///< [m]

  [[nodiscard]] bool holds(const Vec2d& d) const {
    return normal.dot(d) - bound >= -normal_rounding * (d.norm() + std::abs(bound));
  }
  /// How far the octagon can be shifted by the unit vector before the obstacle is met [m].
  [[nodiscard]] double room(const Vec2d& aside) const {
    const double approach = -normal.dot(aside);
    return approach > normal_rounding ? separation / approach : std::numeric_limits<double>::infinity();
  }
};
/// One of these has to hold.
using Obstacle = std::vector<FreeSide>;

/// The obstacles near a corner of the way.
struct Nearby {
  std::vector<Obstacle> obstacles;  ///< By how far they go in the whole step.
  bool holds = false;               ///< Something of it is ground, or overlaps the octagon.
};

/// The displacement nearest to what is wanted that keeps clear of all obstacles: it is that itself, or on the border of
/// one half plane, or where the borders of two cross. Zero where there is none.
Vec2d nearest_free(const Vec2d& wanted, const std::vector<Obstacle>& obstacles, double opening) {
  std::vector<FreeSide> borders;
  for (const Obstacle& obstacle : obstacles) {
    for (const FreeSide& plane : obstacle) {
      const auto same = [&](const FreeSide& known) {
        return known.normal == plane.normal && known.bound == plane.bound;
      };
      if (std::ranges::none_of(borders, same)) borders.push_back(plane);
    }
  }
  const auto is_free = [&](const Vec2d& d) {
    return std::ranges::all_of(obstacles, [&](const Obstacle& obstacle) {
      return std::ranges::any_of(obstacle, [&](const FreeSide& plane) { return plane.holds(d); });
    });
  };
  const auto room = [&](const Vec2d& d, const Vec2d& aside) {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : obstacles) {
      double most = 0;
      for (const FreeSide& plane : obstacle)
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
    const FreeSide& a = borders[i];
    look(wanted - (a.normal.dot(wanted) - a.bound) * a.normal);
    for (std::size_t j = 0; j < i; ++j) {
      const FreeSide& b = borders[j];
      const double over = cross_of(a.normal, b.normal);
      if (std::abs(over) <= normal_rounding) continue;
      look(Vec2d(a.bound * b.normal.y() - b.bound * a.normal.y(), b.bound * a.normal.x() - a.bound * b.normal.x()) /
           over);
    }
  }
  return nearest.value_or(Vec2d::Zero());
}

/// The obstacles on the way of a step.
struct Obstacles : StepView {
  Reach reach = exact_reach;
  const Wanted* walk = nullptr;  ///< See `hangs`.

  [[nodiscard]] std::vector<NearPart> parts_near(std::size_t corner, double within) const {
    std::vector<NearPart> parts = scenery.near_parts(place(corner), within);
    std::erase_if(parts, [&](const NearPart& part) { return !blocks(corner, part, within); });
    if (turns.near) std::ranges::move(turns.near(step.path[corner], within), std::back_inserter(parts));
    return parts;
  }

  /// A one-way chain blocks where it blocks the shortest way to it, from the corner or from where the leg began that
  /// ended there, unless it is passed on purpose.
  [[nodiscard]] bool blocks(std::size_t corner, const NearPart& part, double within) const {
    if (!solid(part.collider).one_way) return true;
    if (contains(step.dropped_through, part.collider)) return false;
    const Place at = place(corner);
    const Place beyond(at.position - 2 * within * part.faces.front().normal, at.movers, at.fraction);
    if (scenery.meets(at, beyond, part.collider)) return true;
    // It may have waited here since that leg.
    const MoverIndex mover = solid(part.collider).mover;
    const auto seen = [&](std::size_t i) { return Vec2d(step.path[i].position - place(i).offset(mover)); };
    std::size_t before = corner;
    while (before > 0 && seen(before) == seen(corner)) --before;
    return before < corner && scenery.meets(place(before), beyond, part.collider);
  }

  [[nodiscard]] bool is_ground(std::size_t corner, const NearPart& part) const {
    const auto may_walk = [&](const NearFace& face) { return is_walkable(face.normal, header, up); };
    return std::ranges::any_of(part.faces, may_walk) ||
           (walk != nullptr && is_stair(*this, walk->carried, place(corner), part));
  }

  /// What the octagon may touch at each corner of its way. Ground holds it where it says that it stands, or cannot fall
  /// past: two corners that lie side by side hold nothing.
  [[nodiscard]] std::vector<Nearby> near_corners(const Vec2d& fall, Bounds bounds) const {
    std::vector<Nearby> corners(step.path.size());
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      for (const NearPart& part : parts_near(corner, reach.contact)) {
        const double unsure = bounds == Bounds::safe ? part.unsure : 0;
        Obstacle planes;
        for (const NearFace& face : part.faces)
          planes.push_back({face.normal, face.normal.dot(part.moved) + unsure, face.separation});
        const auto lets_fall = [&](const FreeSide& plane) {
          return plane.separation >= reach.opening && plane.normal.dot(fall) >= 0;  // however it moves
        };
        const bool falls_past = std::ranges::any_of(planes, lets_fall);
        Nearby& nearby = corners[corner];
        nearby.holds = nearby.holds || part.faces.front().separation < -reach.contact ||
                       (is_ground(corner, part) && (step.grounded || !falls_past));
        nearby.obstacles.push_back(std::move(planes));
      }
    }
    return corners;
  }

  /// Among movers an obstacle may touch for a part of the step. Obstacles near the start of a leg, near its end and
  /// near both each allow a rate of fall: the leg takes the least of the three. It is no faster than the leg before,
  /// because lost momentum is lost for the rest of the step.
  [[nodiscard]] double fall_leg_by_leg(const Vec2d& wanted, const std::vector<Nearby>& corners) const {
    double fall = 0;
    double rate = -wanted.dot(up);
    for (std::size_t corner = 0; corner + 1 < corners.size(); ++corner) {
      const std::vector<Obstacle>& begin = corners[corner].obstacles;
      const std::vector<Obstacle>& end = corners[corner + 1].obstacles;
      std::vector<Obstacle> both = begin;
      both.insert(both.end(), end.begin(), end.end());
      for (const auto& obstacles : {std::cref(begin), std::cref(end), std::cref(both)})
        rate = std::min(rate, -nearest_free(wanted, obstacles.get(), reach.opening).dot(up));
      fall += rate * (step.path[corner + 1].fraction - step.path[corner].fraction);
    }
    return fall;
  }

  /// Whether a mover that does not touch the octagon at a corner would run into it, if it went on so.
  [[nodiscard]] bool is_run_into(const PathPoint& corner, const Vec2d& way) const {
    if (turns.runs_into && turns.runs_into(corner, way, reach.contact)) return true;
    const Place there(corner, step.movers);
    const Place beyond(corner.position + way, step.movers, 1);
    return std::ranges::any_of(scenery.impacts_between(there, beyond), [&](const ExactImpact& impact) {
      const double left = (1 - static_cast<double>(impact.fraction)) * (1 - corner.fraction);
      return moved(impact.collider).dot(impact.normal) * left > exact_reach.contact &&
             scenery.separation(there, impact.collider) > reach.contact;
    });
  }
};

}  // namespace

bool is_walkable(const Vec2d& normal, const TraceHeader& header, const Vec2d& up) {
  return normal.dot(up) >= std::cos(header.character.max_climb_degrees * std::numbers::pi / 180 + climb_margin);
}

Reach reach_of(const TraceHeader& header) {
  const double own = std::max(exact_reach.contact, allowed(Exempt::hover, header));
  if (own == exact_reach.contact) return exact_reach;
  return {own, 2 * own};
}

bool hangs(const StepView& at, const Wanted* walk, const Vec2d& made, const Reach& reach, Bounds bounds) {
  const Obstacles obstacles{at, reach, walk};
  const TraceStep& step = at.step;
  const Vec2d unsteered = at.unsteered();
  const double least = std::max(least_fall, ulp_at(at.header, step.path.front().position));
  const double asked = -unsteered.dot(at.up);
  const double fell = -made.dot(at.up);
  if (is_capped(step, at.header) || !(asked > least) || !(fell < least_share * asked)) return false;
  const auto falls_short_of = [&](double fall) { return fall > least && fell < least_share * fall; };
  const std::vector<Nearby> corners = obstacles.near_corners(unsteered.dot(at.up) * at.up, bounds);
  if (std::ranges::any_of(corners, &Nearby::holds)) return false;
  std::vector<Obstacle> all;
  for (const Nearby& corner : corners) all.insert(all.end(), corner.obstacles.begin(), corner.obstacles.end());
  const Vec2d free = nearest_free(unsteered, all, reach.opening);
  if (!falls_short_of(std::min(-free.dot(at.up), asked))) return false;
  if (step.movers.empty()) return true;
  return falls_short_of(obstacles.fall_leg_by_leg(unsteered, corners)) &&
         std::ranges::none_of(step.path, [&](const PathPoint& corner) {
           return obstacles.is_run_into(corner, Vec2d::Zero()) ||
                  obstacles.is_run_into(corner, step.requested * (1 - corner.fraction));
         });
}

bool has_support(const StepView& at, std::size_t corner, double within) {
  return std::ranges::any_of(at.near(corner, within), [&](const NearPart& part) {
    const auto looks_up = [&](const NearFace& face) { return face.normal.dot(at.up) > 0; };
    return !contains(at.step.dropped_through, part.collider) &&
           (part.faces.front().separation < 0 || std::ranges::any_of(part.faces, looks_up));
  });
}

bool is_held_at_end(const StepView& at, double within) {
  Vec2d unsteered = at.unsteered();
  // A rise that ends in a wedge is held there by what pulls it down.
  if (!(unsteered.dot(at.up) < 0)) unsteered = gravity_in(at.step, at.header) * (at.dt * at.dt);
  if (!(unsteered.dot(at.up) < 0)) return false;
  std::vector<Obstacle> obstacles;
  for (const NearPart& part : Obstacles{at}.parts_near(at.step.path.size() - 1, within)) {
    obstacles.emplace_back();
    for (const NearFace& face : part.faces)
      obstacles.back().push_back({face.normal, 0, face.separation});  // as things are then
  }
  const Vec2d free = nearest_free(unsteered, obstacles, exact_reach.opening);
  return -free.dot(at.up) <= std::max(least_fall, ulp_at(at.header, at.step.path.back().position));
}

}  // namespace paperproof::compare::detail
