#include "oracle/turning.hpp"

#include "oracle/contacts.hpp"
#include "oracle/passing.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// Between the bounds of a first touch, in steps.
constexpr double touch_width = 1e-9;
/// So many steps ahead a first touch is looked for: Box2D's skin of 20 mm is passed in them at 0.3 m/s and more.
constexpr double steps_ahead = 4;
/// Instants of a leg at which the depth of a passage is looked at.
constexpr int depth_samples = 256;

bool turns_with(const TraceHeader& header, ColliderIndex collider) {
  const MoverIndex mover = header.scenery.colliders[collider].mover;
  return mover != no_mover && mover < header.turning.size() && header.turning[mover];
}

Vec2d turned(const Vec2d& point, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  return {cosine * point.x() - sine * point.y(), sine * point.x() + cosine * point.y()};
}

/// The wanted displacement without what contacts with the rest take from it.
Vec2d left_to_want(const TraceStep& step, const TraceHeader& header) {
  Vec2d wanted = step.requested;
  for (const Contact<double>& contact : step.contacts)
    if (!turns_with(header, contact.collider)) wanted -= contact.normal * std::min(0.0, wanted.dot(contact.normal));
  return wanted;
}

}  // namespace

TurningJudge::TurningJudge(const TraceHeader& header) : header_(header) {
  for (ColliderIndex i = 0; i < header.scenery.colliders.size(); ++i) {
    const ColliderDef& def = header.scenery.colliders[i];
    if (turns_with(header, i) && !def.sensor) solids_.push_back({i, def.mover, convex_parts(def)});
  }
}

bool TurningJudge::turns(ColliderIndex collider) const { return turns_with(header_, collider); }

SceneryDef TurningJudge::exact_part(const TraceHeader& header) {
  SceneryDef rest = header.scenery;
  for (ColliderIndex i = 0; i < rest.colliders.size(); ++i)
    rest.colliders[i].sensor = rest.colliders[i].sensor || turns_with(header, i);
  return rest;
}

TraceStep TurningJudge::exact_part(const TraceStep& step) const {
  TraceStep rest = step;
  std::erase_if(rest.contacts, [this](const Contact<double>& contact) { return turns(contact.collider); });
  std::erase_if(rest.sensors, [this](const SensorEvent<double>& event) { return turns(event.sensor); });
  return rest;
}

TurningJudge::Pose TurningJudge::pose(const TraceStep& step, const Solid& solid, double fraction) {
  const TurnMotion& turn = step.turns[solid.mover];
  const MoverMotion<double>& motion = step.movers[solid.mover];
  return {motion.from + fraction * (motion.to - motion.from), turn.from + fraction * (turn.to - turn.from)};
}

/// The first touch of all parts, between two poses.
RotationTouch TurningJudge::touch(const Solid& solid, const Pose& from, const Pose& to, const Vec2d& position,
                                  const Vec2d& displacement) const {
  const MovingOctagon octagon{header_.points, position, displacement};
  RotationTouch first;
  for (const ConvexPart& part : solid.parts) {
    const TurningPiece piece{part.points, Vec2d::Zero(), from.angle, to.angle, {from.offset, to.offset}};
    const RotationTouch found = first_touch(octagon, piece, touch_width / steps_ahead);
    const bool earlier = first.kind != RotationTouch::Kind::touches || found.low < first.low;
    if (found.kind == RotationTouch::Kind::touches && earlier) first = found;
  }
  return first;
}

bool TurningJudge::overlaps(const Solid& solid, const Pose& at, const Vec2d& position) const {
  return touch(solid, at, at, position, Vec2d::Zero()).kind == RotationTouch::Kind::touches;
}

Axis TurningJudge::nearest_axis(const Solid& solid, const Pose& at, const Vec2d& position) const {
  Axis nearest{std::numeric_limits<double>::infinity(), Vec2d::Zero()};
  for (ConvexPart part : solid.parts) {
    for (Vec2d& point : part.points) point = turned(point, at.angle) + at.offset;
    const Axis axis = best_axis(part, header_.points, FramePlace{position});
    if (axis.separation < nearest.separation) nearest = axis;
  }
  return nearest;
}

bool TurningJudge::is_near(const TraceStep& step, double within) const {
  return std::any_of(solids_.begin(), solids_.end(), [&](const Solid& solid) {
    return std::any_of(step.path.begin(), step.path.end(), [&](const PathPoint<double>& corner) {
      return nearest_axis(solid, pose(step, solid, corner.fraction), corner.position).separation <= within;
    });
  });
}

void TurningJudge::judge(const TraceStep& step, StepJudgement& judgement) {
  if (step.path.empty()) return;
  std::set<ColliderIndex> touched;
  for (const Solid& solid : solids_) {
    judge_way(solid, step, judgement);
    judge_contacts(solid, step, judgement);
  }
  for (const Contact<double>& contact : step.contacts)
    if (turns(contact.collider)) touched.insert(contact.collider);
  touched_ = std::move(touched);
  std::sort(judgement.end_overlap.begin(), judgement.end_overlap.end());
}

void TurningJudge::judge_way(const Solid& solid, const TraceStep& step, StepJudgement& judgement) const {
  const PathPoint<double>& start = step.path.front();
  const PathPoint<double>& end = step.path.back();
  const bool began_inside = overlaps(solid, pose(step, solid, start.fraction), start.position);
  if (overlaps(solid, pose(step, solid, end.fraction), end.position)) {
    judgement.end_overlap.push_back(solid.collider);
    const double depth = -nearest_axis(solid, pose(step, solid, end.fraction), end.position).separation;
    judgement.max_penetration = std::max(judgement.max_penetration, depth);
    if (!began_inside) judgement.entered.push_back(solid.collider);
    return;
  }
  if (began_inside) return;
  double depth = 0;
  for (std::size_t i = 1; i < step.path.size(); ++i) {
    const PathPoint<double>& a = step.path[i - 1];
    const PathPoint<double>& b = step.path[i];
    const Vec2d way = b.position - a.position;
    if (touch(solid, pose(step, solid, a.fraction), pose(step, solid, b.fraction), a.position, way).kind !=
        RotationTouch::Kind::touches)
      continue;
    for (int k = 0; k <= depth_samples; ++k) {
      const double share = static_cast<double>(k) / depth_samples;
      const Pose at = pose(step, solid, a.fraction + share * (b.fraction - a.fraction));
      depth = std::max(depth, -nearest_axis(solid, at, a.position + share * way).separation);
    }
  }
  if (depth <= 0) return;
  if (const double slop = slop_of(header_); slop > 0 && depth <= slop) {
    judgement.corner_cut.push_back(solid.collider);
    return;
  }
  const double length = (end.position - start.position).norm();
  judgement.tunnelled.push_back(solid.collider);
  judgement.passings.push_back({.collider = solid.collider,
                                .speed = length / length_of(step, header_),
                                .thickness = narrowest_width(solid.parts.front().points),
                                .angle = 90});
}

void TurningJudge::judge_contacts(const Solid& solid, const TraceStep& step, StepJudgement& judgement) {
  const PathPoint<double>& start = step.path.front();
  const Vec2d wanted = left_to_want(step, header_);
  const Pose from = pose(step, solid, 0);
  const RotationTouch ahead = touch(solid, from, pose(step, solid, steps_ahead), start.position, steps_ahead * wanted);
  const bool touches = ahead.kind == RotationTouch::Kind::touches;
  const double when = steps_ahead * (ahead.low + (ahead.high - ahead.low) / 2);
  const bool within = touches && when <= 1;
  if (within) {
    const Vec2d normal = nearest_axis(solid, pose(step, solid, when), start.position + when * wanted).normal;
    judgement.contacts.push_back({.collider = solid.collider,
                                  .side = side_of_normal(normal.x(), normal.y()),
                                  .normal = normal,
                                  .fraction = when});
  }
  for (const Contact<double>& contact : step.contacts) {
    if (contact.collider != solid.collider) continue;
    const Pose to = pose(step, solid, 1);
    const double gap = std::min(nearest_axis(solid, from, start.position).separation,
                                nearest_axis(solid, to, step.path.back().position).separation);
    judgement.max_contact_gap = std::max(judgement.max_contact_gap, gap);
    if (!within && gap <= (header_.path_exact ? contact_reach : box2d_skin))
      judgement.dont_care.push_back(solid.collider);
    if (touches && touched_.count(solid.collider) == 0)
      judgement.turning_toi_error =
          std::max(judgement.turning_toi_error.value_or(0), std::abs(contact.fraction - when));
  }
}

}  // namespace paperproof::compare::detail
