/// What turns near a character: how far it is, how it goes, and what of it a motion meets.
#include "oracle/contacts.hpp"
#include "oracle/crush.hpp"
#include "oracle/turning.hpp"
#include "oracle/turning_room.hpp"
#include "oracle/up.hpp"
#include "oracle/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace paperproof::compare::detail {
namespace {

Vec2d nearest_on(const Vec2d& a, const Vec2d& b, const Vec2d& to) {
  const Vec2d along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? Vec2d(a + std::clamp((to - a).dot(along) / square, 0.0, 1.0) * along) : a;
}

/// The point of a part's outline that is nearest to an octagon's.
Vec2d nearest_point(std::span<const Vec2d> part, std::span<const Vec2d> octagon, const Vec2d& position) {
  Vec2d best = part[0];
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec2d& on_part, const Vec2d& on_octagon) {
    if (const double distance = (on_part - on_octagon).norm(); distance < least) {
      least = distance;
      best = on_part;
    }
  };
  for (std::size_t k = 0; k < octagon.size(); ++k) {
    const Vec2d corner = position + octagon[k];
    const Vec2d next = position + octagon[(k + 1) % octagon.size()];
    for (std::size_t i = 0; i < part.size(); ++i) {
      offer(nearest_on(part[i], part[(i + 1) % part.size()], corner), corner);
      offer(part[i], nearest_on(corner, next, part[i]));
    }
  }
  return best;
}

/// By how much a way turns at most from how it stands when it begins [rad].
double turn_of(const VertexWay& way) {
  double most = 0;
  double turned = 0;
  for (std::size_t k = 1; k < way.vertices.size(); ++k) {
    turned += RigidMotion(way.vertices[k - 1], way.vertices[k]).angle();
    most = std::max(most, std::abs(turned));
  }
  return most;
}

}  // namespace

VertexWay gone_on(const VertexWay& way, int steps) {
  const RigidMotion motion(way.vertices.front(), way.vertices.back());
  VertexWay all = way;
  const std::size_t chords = way.instants.size() - 1;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(steps - 1) * chords; ++k) {
    all.instants.push_back(1 + static_cast<double>((k - 1) / chords) + way.instants[(k - 1) % chords + 1]);
    std::vector<Vec2d> moved;
    for (const Vec2d& v : all.vertices[k]) moved.push_back(motion(v));
    all.vertices.push_back(std::move(moved));
  }
  return all;
}

double TurningJudge::longest_way(const TraceStep& step) const {
  double most = 0;
  for (const Solid& solid : solids_) most = std::max(most, largest_motion(way_of(step, solid.collider)));
  return most;
}

TurningJudge::Standing TurningJudge::standing(const Solid& solid, const Numbers& numbers, const VertexWay& way,
                                              const Vec2d& requested, const PathPoint& corner, double within) const {
  const std::vector<Vec2d> now = vertices_at(way, corner.fraction);
  Standing found{.part = part_at(solid, numbers, now), .turn = way.turn, .requested = requested.norm()};
  const Vec2d nearest = nearest_point(found.part.points, octagon_, corner.position);
  const Vec2d begin = RigidMotion(now, way.vertices.front())(nearest);
  found.moved = RigidMotion(now, way.vertices.back())(nearest) - begin;
  double leaves = 0;
  for (std::size_t k = 0; k < way.instants.size(); ++k) {
    const Vec2d even = begin + way.instants[k] * found.moved;
    leaves = std::max(leaves, (RigidMotion(now, way.vertices[k])(nearest) - even).norm());
  }
  const double reach = std::min(extent_of(found.part.points), extent_of(octagon_) + within);
  const double turn = turn_of(way);
  const double touched = reach + requested.norm();
  found.unsure = turn * (touched + found.moved.norm()) + leaves;
  found.unsure_along = solid.radius > 0 ? found.unsure : turn * (turn * touched + within + found.moved.norm()) + leaves;
  return found;
}

std::optional<NearPart> TurningJudge::near_part(const Solid& solid, const Standing& standing, const Vec2d& position,
                                                double within) const {
  NearPart near{.collider = solid.collider,
                .moved = standing.moved,
                .faces = {},
                .unsure = standing.unsure,
                .unsure_along = standing.unsure_along};
  if (solid.radius > 0) {
    near.rim = standing.turn * (solid.radius + contact_reach);
    const double round = (standing.requested + standing.moved.norm() + std::abs(near.rim)) / solid.radius;
    near.rim_unsure =
        std::abs(near.rim) * std::min(2.0, round) + std::abs(standing.turn) * (standing.moved.norm() + contact_reach);
  }
  for (const Axis& axis : separating_axes(standing.part, octagon_, FramePlace{position}, within))
    near.faces.push_back({axis.separation, axis.normal});
  if (near.faces.empty()) return std::nullopt;
  return near;
}

void TurningJudge::add_near(const Solid& solid, const VertexWay& way, const TraceStep& step, const PathPoint& corner,
                            double within, double share, std::vector<NearPart>& found) const {
  for (const Numbers& numbers : solid.parts) {
    Standing here = standing(solid, numbers, way, step.requested * share, corner, within);
    here.moved /= share;
    here.unsure /= share;
    here.unsure_along /= share;
    if (std::optional<NearPart> part = near_part(solid, here, corner.position, within))
      found.push_back(*std::move(part));
  }
}

std::vector<NearPart> TurningJudge::near(const TraceStep& step, const PathPoint& corner, double within) const {
  std::vector<NearPart> found;
  for (const Solid& solid : solids_) add_near(solid, way_of(step, solid.collider), step, corner, within, 1, found);
  return found;
}

std::vector<NearPart> TurningJudge::near_at_end(const TraceStep& step, double within) const {
  std::vector<NearPart> found;
  for (const Solid& solid : solids_) {
    const VertexWay& way = way_of(step, solid.collider);
    const std::size_t last = way.instants.size() - 1;
    const VertexWay stretch{.collider = way.collider,
                            .instants = {0, 1},
                            .vertices = {way.vertices[last - 1], way.vertices[last]},
                            .turn = way.turn};
    add_near(solid, stretch, step, {step.path.back().position, 1}, within, 1 - way.instants[last - 1], found);
  }
  return found;
}

std::vector<ExactImpact> TurningJudge::impacts_at_end(const TraceStep& step, const Vec2d& displacement) const {
  SceneryDef near;
  std::vector<ColliderIndex> colliders;
  for (const Solid& solid : solids_) {
    const VertexWay& way = way_of(step, solid.collider);
    if (nearest_axis(solid, way, step.path.back()).separation > displacement.norm()) continue;
    near.colliders.push_back(standing_at(header_.scenery.colliders[solid.collider], way, 1));
    colliders.push_back(solid.collider);
  }
  if (colliders.empty()) return {};
  const Vec2d& end = step.path.back().position;
  std::vector<ExactImpact> impacts = ExactScenery(near, octagon_).impacts(end, displacement);
  for (ExactImpact& impact : impacts) impact.collider = colliders[impact.collider];
  return impacts;
}

/// Whether some side of a part that is near at a place faces the part of a motion across up.
bool TurningJudge::is_against(const Solid& solid, const VertexWay& way, const PathPoint& at, const Vec2d& across,
                              double within) const {
  const std::vector<Vec2d> vertices = vertices_at(way, at.fraction);
  return std::ranges::any_of(solid.parts, [&](const Numbers& numbers) {
    const std::vector<Axis> axes =
        separating_axes(part_at(solid, numbers, vertices), octagon_, FramePlace{at.position}, within);
    return std::ranges::any_of(axes, [&](const Axis& axis) { return axis.normal.dot(across) < 0; });
  });
}

TurningJudge::Opposition TurningJudge::opposes(const TraceStep& step, const PathPoint& corner,
                                               const Vec2d& motion) const {
  const std::array<PathPoint, 2> path{{corner, {corner.position + motion, corner.fraction + 1}}};
  const Vec2d up = up_in(step, header_);
  const Vec2d across = motion - motion.dot(up) * up;
  Opposition found = Opposition::none;
  for (const Solid& solid : solids_) {
    const VertexWay& its = way_of(step, solid.collider);
    const VertexWay way = gone_on(its, 2);
    double unsure = 0;
    for (const Numbers& numbers : solid.parts)
      unsure = std::max(unsure, standing(solid, numbers, its, step.requested, corner, motion.norm()).unsure);
    const std::vector<Vec2d> wider = grown(octagon_, unsure);
    for (const Numbers& numbers : solid.parts) {
      const auto opposes_body = [&](std::span<const Vec2d> body, double within) {
        const Meeting met = first_meeting(body, path, way, numbers, Asked::when, solid.radius);
        if (met.kind == Meeting::Kind::apart) return false;
        const double when = std::clamp(met.low, corner.fraction, corner.fraction + 1);
        const PathPoint there{corner.position + (when - corner.fraction) * motion, when};
        return is_against(solid, way, there, across, within + contact_reach);
      };
      if (opposes_body(octagon_, 0)) return Opposition::met;
      if (opposes_body(wider, 2 * unsure)) found = Opposition::unsure;
    }
  }
  return found;
}

bool TurningJudge::runs_into(const TraceStep& step, const PathPoint& corner, const Vec2d& way, double within) const {
  const std::array<PathPoint, 2> path{{corner, {corner.position + way, 1}}};
  if (corner.fraction == 1) return false;
  return std::ranges::any_of(solids_, [&](const Solid& solid) {
    const VertexWay& its = way_of(step, solid.collider);
    return nearest_axis(solid, its, corner).separation > within &&
           meeting(solid, its, path).kind != Meeting::Kind::apart;
  });
}

bool TurningJudge::meets_sensor(const TraceStep& step) const {
  return std::ranges::any_of(sensors_, [&](const Solid& sensor) {
    return meeting(sensor, way_of(step, sensor.collider), step.path).kind != Meeting::Kind::apart;
  });
}

double TurningJudge::carries_otherwise(const TraceStep& step) const {
  double most = 0;
  for (const Solid& solid : solids_) {
    const auto before = went_before_.find(solid.collider);
    if (before == went_before_.end() || nearest(solid, step) > contact_reach) continue;
    const double conveyed =
        std::abs(header_.scenery.colliders[solid.collider].surface_speed) * length_of(step, header_);
    const double bent = solid.radius > 0 ? std::min(2.0, step.requested.norm() / solid.radius) : 0;  // of its normal
    most = std::max(most, (went_.at(solid.collider) - before->second).norm() + conveyed * bent);
  }
  return most;
}

bool TurningJudge::frees_at_end(const TraceStep& step, const std::function<bool(const Vec2d&)>& accept) const {
  return has_way_out_at(header_, step, 1, sides_, accept);
}

bool TurningJudge::left_free(const TraceStep& step, std::span<const PathPoint> way) const {
  const std::vector<Vec2d> wider = grown(octagon_, least_clearance);
  return std::ranges::all_of(solids_, [&](const Solid& solid) {
    const VertexWay& its = way_of(step, solid.collider);
    const auto is_apart = [&](std::span<const Vec2d> body, std::span<const PathPoint> path) {
      return std::ranges::all_of(solid.parts, [&](const Numbers& part) {
        return first_meeting(body, path, its, part, Asked::whether, solid.radius).kind == Meeting::Kind::apart;
      });
    };
    if (!is_apart(octagon_, way.first(1))) return true;
    // Who leaves the way that was travelled must not pass nearer than that to what is farther away there.
    const bool clear = !is_apart(wider, way.subspan(way.size() - 2, 1)) || is_apart(wider, way.last(2));
    return clear && is_apart(octagon_, way) && is_apart(wider, way.last(1));
  });
}

}  // namespace paperproof::compare::detail
