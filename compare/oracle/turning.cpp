#include "oracle/turning.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/passing.hpp"
#include "oracle/turning_room.hpp"
#include "oracle/up.hpp"
#include "oracle/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace paperproof::compare::detail {
namespace {

/// So many steps ahead a first touch is looked for: Box2D's skin of 20 mm is passed in them at 0.3 m/s and more.
constexpr int steps_ahead = 4;
/// What goes a leg in less of the step leaps.
constexpr double leap = 1e-5;
/// Every so many steps, and every step with a contact with what turns, is judged by the second method as well.
constexpr int judged_twice = 8;
/// Instants of a leg at which the depth of a passage is looked at.
constexpr int depth_samples = 256;

bool turns_with(const TraceHeader& header, ColliderIndex collider) {
  const MoverIndex mover = header.scenery.colliders[collider].mover;
  return mover != no_mover && mover < header.turning.size() && header.turning[mover];
}

/// The wanted displacement without what contacts with the rest take from it.
Vec2d left_to_want(const TraceStep& step, const TraceHeader& header) {
  Vec2d wanted = step.requested;
  for (const Contact& contact : step.contacts)
    if (!turns_with(header, contact.collider)) wanted -= contact.normal * std::min(0.0, wanted.dot(contact.normal));
  return wanted;
}

/// The parts of a definition by the numbers of their vertices: points that coincide go the same way.
std::vector<std::vector<std::size_t>> numbered_parts(const ColliderDef& def) {
  std::vector<Vec2d> all = def.points;
  for (const std::vector<Vec2d>& hole : def.holes) all.insert(all.end(), hole.begin(), hole.end());
  std::vector<std::vector<std::size_t>> parts;
  for (const ConvexPart& part : convex_parts(def)) {
    parts.emplace_back();
    for (const Vec2d& point : part.points)
      parts.back().push_back(static_cast<std::size_t>(std::ranges::find(all, point) - all.begin()));
  }
  return parts;
}

}  // namespace

double extent_of(std::span<const Vec2d> points) {
  double most = 0;
  for (const Vec2d& a : points)
    for (const Vec2d& b : points) most = std::max(most, (a - b).norm());
  return most;
}

TurningJudge::TurningJudge(const TraceHeader& header)
    : header_(header), octagon_(header.points), promises_(party_of(header) == Party::promising) {
  if (!contains(header.turning, true)) return;
  octagon_ = normalised(std::move(octagon_));
  for (ColliderIndex i = 0; i < header.scenery.colliders.size(); ++i) {
    const ColliderDef& def = header.scenery.colliders[i];
    if (turns_with(header, i)) (def.sensor ? sensors_ : solids_).push_back({i, numbered_parts(def), def.radius});
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
  std::erase_if(rest.contacts, [this](const Contact& contact) { return turns(contact.collider); });
  std::erase_if(rest.sensors, [this](const SensorEvent& event) { return turns(event.sensor); });
  std::erase_if(rest.crushed, [this](ColliderIndex collider) { return turns(collider); });
  return rest;
}

Meeting TurningJudge::meeting(const Solid& solid, const VertexWay& way, std::span<const PathPoint> path,
                              Asked asked) const {
  Meeting first;
  bool by_second = false;
  for (const Numbers& part : solid.parts) {
    Meeting found = first_meeting(octagon_, path, way, part, asked, solid.radius);
    if (found.kind == Meeting::Kind::undecided) {
      found = second_meeting(octagon_, path, way, part, solid.radius);
      by_second = true;
    }
    const bool better = found.kind == first.kind ? found.low < first.low : found.kind == Meeting::Kind::meets;
    if (found.kind != Meeting::Kind::apart && (first.kind == Meeting::Kind::apart || better)) first = found;
    if (first.kind == Meeting::Kind::meets && asked == Asked::whether) break;
  }
  first.by_second = by_second;
  return first;
}

/// Whether both methods say the same of the way of a step.
bool TurningJudge::methods_agree(const Solid& solid, const TraceStep& step) const {
  const VertexWay& way = way_of(step, solid.collider);
  return std::ranges::all_of(solid.parts, [&](const Numbers& part) {
    const Meeting one = first_meeting(octagon_, step.path, way, part, Asked::whether, solid.radius);
    return one.kind == Meeting::Kind::undecided ||
           one.kind == second_meeting(octagon_, step.path, way, part, solid.radius).kind;
  });
}

bool TurningJudge::overlaps(const Solid& solid, const VertexWay& way, const PathPoint& at) const {
  return meeting(solid, way, {&at, 1}).kind == Meeting::Kind::meets;
}

ConvexPart TurningJudge::part_at(const Solid& solid, const Numbers& numbers, std::span<const Vec2d> vertices) {
  ConvexPart part;
  for (const std::size_t i : numbers) part.points.push_back(vertices[i]);
  part.radius = solid.radius;
  return part;
}

Axis TurningJudge::nearest_axis(const Solid& solid, const VertexWay& way, const PathPoint& at) const {
  const std::vector<Vec2d> vertices = vertices_at(way, at.fraction);
  Axis nearest{std::numeric_limits<double>::infinity(), Vec2d::Zero()};
  for (const Numbers& numbers : solid.parts) {
    const Axis axis = best_axis(part_at(solid, numbers, vertices), octagon_, FramePlace{at.position});
    if (axis.separation < nearest.separation) nearest = axis;
  }
  return nearest;
}

/// Of all faces that are touched at a corner of the way, the normal that is most alike.
Vec2d TurningJudge::nearest_face(const Solid& solid, const TraceStep& step, const Vec2d& normal) const {
  Vec2d most_alike = -normal;
  for (const PathPoint& corner : step.path)
    for (const Numbers& numbers : solid.parts) {
      const ConvexPart part = part_at(solid, numbers, vertices_at(way_of(step, solid.collider), corner.fraction));
      for (const Axis& axis : separating_axes(part, octagon_, FramePlace{corner.position}, contact_reach))
        if (axis.normal.dot(normal) > most_alike.dot(normal)) most_alike = axis.normal;
    }
  return most_alike;
}

double TurningJudge::nearest(const Solid& solid, const TraceStep& step) const {
  double gap = std::numeric_limits<double>::infinity();
  for (const PathPoint& corner : step.path)
    gap = std::min(gap, nearest_axis(solid, way_of(step, solid.collider), corner).separation);
  return gap;
}

std::vector<ColliderIndex> TurningJudge::overlapped(const TraceStep& step) const {
  std::vector<ColliderIndex> found;
  for (const Solid& solid : solids_)
    if (overlaps(solid, way_of(step, solid.collider), step.path.front())) found.push_back(solid.collider);
  return found;
}

std::vector<ColliderIndex> TurningJudge::near_at_begin(const TraceStep& step, double within) const {
  std::vector<ColliderIndex> found;
  for (const Solid& solid : solids_)
    if (nearest_axis(solid, way_of(step, solid.collider), step.path.front()).separation <= within)
      found.push_back(solid.collider);
  return found;
}

bool TurningJudge::is_alone(const TraceStep& step, double within) const {
  Box2 places = Box2::nowhere();
  for (const PathPoint& corner : step.path)
    places = places.with(corner.position).with(corner.position + step.requested);
  const Box2 reach = (places + Box2::around(octagon_)).inflated(within);
  return std::ranges::none_of(solids_, [&](const Solid& solid) {
    const VertexWay& way = way_of(step, solid.collider);
    return std::ranges::any_of(way.vertices, [&](const std::vector<Vec2d>& vertices) {
      return Box2::around(vertices).inflated(solid.radius + longest_way(step)).overlaps(reach);
    });
  });
}

bool TurningJudge::begin(const TraceStep& step) {
  inside_.clear();
  if (!step.path.empty()) inside_ = overlapped(step);
  went_before_ = std::exchange(went_, {});
  for (const Solid& solid : solids_) went_[solid.collider] = carried_along(way_of(step, solid.collider));
  const auto is_left = [&](ColliderIndex collider) { return step.respawn || !contains(inside_, collider); };
  std::erase_if(sides_, [&](const auto& side) { return is_left(side.first); });
  std::erase_if(pressed_, is_left);
  return !inside_.empty();
}

void TurningJudge::judge(const TraceStep& step, const ExactScenery& rest, int parts, StepJudgement& judgement) {
  if (step.path.empty()) return;
  for (auto& [collider, side] : sides_) {
    const VertexWay& way = way_of(step, collider);
    side = RigidMotion(way.vertices.front(), way.vertices.back())(side);
  }
  std::set<ColliderIndex> touched;
  for (const Contact& contact : step.contacts)
    if (turns(contact.collider)) touched.insert(contact.collider);
  for (const Solid& solid : solids_) {
    judge_way(solid, step, rest, judgement);
    judge_contacts(solid, step, parts, judgement);
    if ((!touched.empty() || step.step % judged_twice == 0) && !methods_agree(solid, step))
      judgement.methods_disagree.push_back(solid.collider);
  }
  for (const Solid& solid : solids_)
    if (contains(judgement.end_overlap, solid.collider) && !contains(inside_, solid.collider)) note_side(solid, step);
  touched_ = std::move(touched);
  std::ranges::sort(judgement.end_overlap);
}

/// Where the octagon was last free of what it ends inside of, as that is then.
void TurningJudge::note_side(const Solid& solid, const TraceStep& step) {
  const VertexWay& way = way_of(step, solid.collider);
  const auto last = std::find_if(step.path.rbegin(), step.path.rend(), [&](const PathPoint& corner) {
    return !overlaps(solid, way, corner);
  });  // the first, if no other is
  sides_[solid.collider] = RigidMotion(vertices_at(way, last->fraction), way.vertices.back())(last->position);
}

/// Whether a crush by it is named, or would be by who has a word for it, and what it does to the octagon is a matter of
/// the clause `crush`: there is no room, or it goes, and who promises that clause breaks it.
bool TurningJudge::is_said_as_crush(const Solid& solid, const TraceStep& step, const ExactScenery& rest,
                                    StepJudgement& judgement) const {
  const bool named = contains(step.crushed, solid.collider);
  if (promises_ && !named) return false;
  const VertexWay& its = way_of(step, solid.collider);
  std::optional<Vec2d> room = step.path.front().position;
  if (goes(its)) {
    room = room_beside(header_, rest, step, its, sides_,
                       [&](std::span<const PathPoint> way) { return left_free(step, way); });
  }
  if (room) judgement.room = room;
  if (room && named) judgement.crushed_with_room.push_back(solid.collider);
  if (!room) judgement.crushed.push_back(solid.collider);
  return !room || (named && goes(its) && contains(header_.guarantees, Clause::crush));
}

void TurningJudge::judge_way(const Solid& solid, const TraceStep& step, const ExactScenery& rest,
                             StepJudgement& judgement) {
  const VertexWay& way = way_of(step, solid.collider);
  const bool began_inside = contains(inside_, solid.collider);
  const bool ends_inside = overlaps(solid, way, step.path.back());
  const bool named = contains(step.crushed, solid.collider);
  const bool excused = (named || (ends_inside && !began_inside)) && is_said_as_crush(solid, step, rest, judgement);
  if (ends_inside) {
    if (excused) pressed_.insert(solid.collider);
    judgement.end_overlap.push_back(solid.collider);
    if (pressed_.contains(solid.collider)) {
      judgement.pressed.push_back(solid.collider);
      return;
    }
    judgement.max_penetration =
        std::max(judgement.max_penetration, -nearest_axis(solid, way, step.path.back()).separation);
    if (!began_inside) judgement.entered.push_back(solid.collider);
    return;
  }
  if (began_inside) return;
  const Meeting met = meeting(solid, way, step.path);
  if (met.by_second) judgement.undecided.push_back(solid.collider);
  if (met.kind != Meeting::Kind::meets) return;
  // What is excused may go through the octagon, and not the octagon through it: as it stands where the step ends.
  const std::array<PathPoint, 2> through{{{step.path.front().position, 1}, {step.path.back().position, 1}}};
  if (excused && meeting(solid, way, through).kind != Meeting::Kind::meets) return;
  judge_passage(solid, step, judgement);
}

void TurningJudge::judge_passage(const Solid& solid, const TraceStep& step, StepJudgement& judgement) const {
  if (const double rim = rim_of(header_); rim > 0) {
    if (const double depth = depth_on(solid, step); depth <= rim)
      return judgement.note_clipped(judgement.clipped, solid.collider, depth);
  }
  std::vector<Vec2d> ring;
  for (const std::size_t i : solid.parts.front()) ring.push_back(way_of(step, solid.collider).vertices.front()[i]);
  judgement.tunnelled.push_back(solid.collider);
  judgement.passings.push_back(
      {.collider = solid.collider,
       .speed = (step.path.back().position - step.path.front().position).norm() / length_of(step, header_),
       .thickness = solid.radius > 0 ? 2 * solid.radius : narrowest_width(ring),
       .angle = 90});
}

/// The largest depth on the way, at equal shares of every leg [m].
double TurningJudge::depth_on(const Solid& solid, const TraceStep& step) const {
  double depth = 0;
  for (std::size_t i = 1; i < step.path.size(); ++i) {
    const PathPoint& a = step.path[i - 1];
    const PathPoint& b = step.path[i];
    for (int k = 0; k <= depth_samples; ++k) {
      const double share = static_cast<double>(k) / depth_samples;
      const PathPoint at{a.position + share * (b.position - a.position),
                         a.fraction + share * (b.fraction - a.fraction)};
      depth = std::max(depth, -nearest_axis(solid, way_of(step, solid.collider), at).separation);
    }
  }
  return depth;
}

void TurningJudge::judge_contacts(const Solid& solid, const TraceStep& step, int parts,
                                  StepJudgement& judgement) const {
  std::vector<Contact> reported = step.contacts;
  std::erase_if(reported, [&](const Contact& contact) { return contact.collider != solid.collider; });
  const bool reports = !reported.empty();
  const PathPoint& start = step.path.front();
  const Vec2d wanted = header_.path_exact ? step.requested : left_to_want(step, header_);
  const int ahead = header_.path_exact ? 1 : steps_ahead;
  const VertexWay way = gone_on(way_of(step, solid.collider), ahead);
  const std::array<PathPoint, 2> path{{start, {start.position + ahead * wanted, static_cast<double>(ahead)}}};
  const Meeting met = meeting(solid, way, path, Asked::when);
  const bool touches = met.kind == Meeting::Kind::meets;
  const double when = touches ? met.low + (met.high - met.low) / 2 : 0;
  const bool within = touches && when <= 1;
  const bool told = within && when * parts <= 1;
  const bool first = told && (!judgement.first_impact || when < *judgement.first_impact);
  const double gap = reports || !promises_ ? nearest(solid, step) : 0;
  if (header_.path_exact && reports && gap <= contact_reach) {
    for (const Contact& contact : reported) {
      const Vec2d face = nearest_face(solid, step, contact.normal);
      judgement.contacts.push_back(
          {.collider = solid.collider, .side = contact.side, .normal = face, .fraction = contact.fraction});
      const double error = std::acos(std::clamp(face.dot(contact.normal.normalized()), -1.0, 1.0));
      judgement.normal_error = std::max(judgement.normal_error.value_or(0), error * 180 / std::numbers::pi);
    }
  } else if (header_.path_exact ? first : within) {
    const Vec2d normal = nearest_axis(solid, way, {start.position + when * wanted, when}).normal;
    const Vec2d side = seen(normal, up_in(step, header_));
    judgement.contacts.push_back(
        {.collider = solid.collider, .side = side_of_normal(side.x(), side.y()), .normal = normal, .fraction = when});
  } else if (reports && gap <= box2d_skin && !header_.path_exact) {
    judgement.dont_care.push_back(solid.collider);
  }
  judgement.in_parts = judgement.in_parts || (header_.path_exact && within && !told && !reports);
  if (header_.path_exact && first) {
    judgement.first_impact = when;
    judgement.first_approach.reset();
    judgement.first_impact_comparable = false;
  }
  if (!reports) return;
  judgement.max_contact_gap = std::max(judgement.max_contact_gap, gap);
  if (touched_.contains(solid.collider) || overlaps(solid, way, start)) return;
  std::optional<double> touch;
  if (header_.path_exact)
    touch = touch_going_on(solid, step, reported.front().fraction);
  else if (touches)
    touch = when;
  if (touch)
    judgement.turning_toi_error =
        std::max(judgement.turning_toi_error.value_or(0), std::abs(reported.front().fraction - *touch));
}

/// When the way that was travelled up to a moment touches, if it goes on from there as straight as before; nothing
/// where it did not go, or leapt, just before.
std::optional<double> TurningJudge::touch_going_on(const Solid& solid, const TraceStep& step, double moment) const {
  std::vector<PathPoint> way;
  for (const PathPoint& corner : step.path)
    if (corner.fraction <= moment) way.push_back(corner);
  if (way.size() < 2 || moment == 1) return std::nullopt;
  const PathPoint last = way.back();
  const PathPoint before = way[way.size() - 2];
  if (last.position == before.position || last.fraction - before.fraction < leap) return std::nullopt;
  const Vec2d rate = (last.position - before.position) / (last.fraction - before.fraction);
  way.push_back({last.position + (1 - last.fraction) * rate, 1});
  const Meeting met = meeting(solid, way_of(step, solid.collider), way, Asked::when);
  if (met.kind != Meeting::Kind::meets) return std::nullopt;
  const double touch = met.low + (met.high - met.low) / 2;
  const double gap = nearest_axis(solid, way_of(step, solid.collider), last).separation;
  const bool near = std::abs(touch - moment) * gap <= contact_reach * (touch - last.fraction);
  return near ? moment : touch;
}

}  // namespace paperproof::compare::detail
