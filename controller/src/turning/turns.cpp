#include "step/octagon_sweep.hpp"
#include "turning/turning_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace paperproof::turning {

using geometry::Pose;
using geometry::pose_at;

namespace {

/// The corner of the character that is nearest to a surface once it has turned; the one that is so before, if both are
/// at one height then.
Vec2d nearest_corner(std::span<const Vec2d> hull, const Vec2d& normal_before, const Vec2d& normal_after) {
  const auto nearest_along = [&](const Vec2d& normal) {
    return *std::ranges::min_element(hull,
                                     [&](const Vec2d& a, const Vec2d& b) { return a.dot(normal) < b.dot(normal); });
  };
  const Vec2d before = nearest_along(normal_before);
  const Vec2d after = nearest_along(normal_after);
  return (before - after).dot(normal_after) < Tolerances{}.hit ? before : after;
}

}  // namespace

/// How far a point of the character's size would go with what turns in the step [m].
double TurningStep::longest_turn() const {
  double most = 0;
  for (MoverIndex mover = 0; mover < context_.movers.size(); ++mover)
    if (memory_.turns[mover]) most = std::max(most, std::abs(context_.movers[mover].turn()));
  return most * character().shape.box().size().norm();
}

/// Into how many shorter steps a step must be divided.
int TurningStep::parts_wanted() const {
  const double most = longest_turn();
  int parts = 1;
  while (parts < most_parts && most > Controller::most_turned * parts) parts *= 2;
  return parts;
}

const MovingCollider* TurningStep::find_moving(ColliderIndex collider) const {
  const auto& all = memory_.moving;
  const auto place = std::ranges::lower_bound(all, collider, {}, &MovingCollider::id);
  return place != all.end() && place->id == collider ? &*place : nullptr;
}

/// About what a mover turns in a part: the corner of the character that will be nearest to it then, so that what
/// carries the character turns under its foot; or its own corner, if that is beneath the foot instead.
Vec2d TurningStep::pivot_of(MoverIndex mover, double begin, double angle, const Vec2d& position) const {
  Approach best{std::numeric_limits<double>::infinity(), {0, 1}};
  std::vector<Vec2d> nearest_outline;
  std::vector<Vec2d> outline;
  const Pose pose = pose_at(context_.movers[mover], begin);
  for (const MovingCollider& collider : memory_.moving) {
    if (collider.mover != mover || collider.by_itself || scenery_.collider(collider.id).sensor ||
        !is_there(collider.id))
      continue;
    const PieceRange pieces = scenery_.pieces_of(collider.id);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece) {
      outline.clear();
      geometry::place(scenery_.vertices_of(piece), pose, outline);
      const Approach here = nearest(outline, hull(), position);
      if (!(here.distance < best.distance)) continue;
      best = here;
      nearest_outline.swap(outline);
    }
  }
  const Vec2d corner = position + nearest_corner(hull(), best.normal, geometry::Turn(angle)(best.normal));
  if (nearest_outline.empty()) return corner;
  return nearest_vertex(nearest_outline, corner).value_or(corner);
}

/// Turns everything by its angle in a part of the step, and says how it goes on from there.
Part TurningStep::turn(double begin, double end, const Vec2d& position) {
  std::vector<MoverMotion>& motions = memory_.motions;
  motions.clear();
  for (MoverIndex mover = 0; mover < context_.movers.size(); ++mover) {
    const Pose from = pose_at(context_.movers[mover], begin);
    const Pose to = pose_at(context_.movers[mover], end);
    motions.push_back({from.position, to.position, to.angle, to.angle});
    if (!memory_.turns[mover]) continue;
    const double angle = to.angle - from.angle;
    const Vec2d pivot = pivot_of(mover, begin, angle, position);
    motions.back().from = pivot - geometry::Turn(angle)(Vec2d(pivot - from.position));
  }
  for (const MoverMotion& motion : memory_.motions_apart) {
    const Pose from = pose_at(motion, begin);
    const Pose to = pose_at(motion, end);
    motions.push_back({from.position, to.position, from.angle, to.angle});
  }
  return {begin, end};
}

/// Where a collider is once it has turned.
Pose TurningStep::turned_pose(const MovingCollider& collider, const Part& part) const {
  if (collider.by_itself) return pose_at(collider.motion, part.begin);
  const MoverMotion& motion = memory_.motions[collider.mover];
  return {motion.from, motion.to_angle};
}

/// Whether a collider overlaps the character by more than rounding.
bool TurningStep::overlaps(ColliderIndex collider, const Pose& pose, const Vec2d& position) const {
  return !stays_clear(collider, pose, pose, std::array<PathPoint, 2>{{{position, 0}, {position, 1}}}, -proved);
}

/// Whether a character that goes its way stays clear of a collider whose vertices go straight from one pose to another.
bool TurningStep::stays_clear(ColliderIndex collider, const Pose& from, const Pose& to, std::span<const PathPoint> way,
                              double least) const {
  PieceWay& its = memory_.way;
  const PieceRange pieces = scenery_.pieces_of(collider);
  for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece) {
    its.from.clear();
    its.to.clear();
    geometry::place(scenery_.vertices_of(piece), from, its.from);
    geometry::place(scenery_.vertices_of(piece), to, its.to);
    its.radius = scenery_.pieces()[piece].is_circle() ? scenery_.circle(piece).radius : 0;
    for (std::size_t corner = 1; corner < way.size(); ++corner) {
      its.begin = way[corner - 1].fraction;
      its.end = way[corner].fraction;
      if (!stay_apart({hull(), way[corner - 1].position, way[corner].position}, its, least)) return false;
    }
  }
  return true;
}

/// Finds a way for the character to where it is once everything has turned, and proves that it is clear.
/// @param move in the part; its corners at fraction 0 are that way.
bool TurningStep::find_way(Part& part, const MoveResult& move) {
  const auto later = std::ranges::find_if(move.path, [](const PathPoint& corner) { return corner.fraction > 0; });
  const std::span corners(move.path.begin(), later);
  // Mostly it goes first, and has gone before what pushes it arrives. Evenly it would be late by the square of a turn.
  for (const double arrival : {0.5, 1.0}) {
    part.way.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double share = corners.size() == 1 ? 0 : static_cast<double>(i) / static_cast<double>(corners.size() - 1);
      part.way.push_back({corners[i].position, arrival * share});
    }
    if (part.way.back().fraction < 1) part.way.push_back({part.way.back().position, 1});
    if (is_proved(part, move, false)) return true;
    if (corners.size() == 1) return false;
  }
  // In a corner one wall arrives as another leaves. Then it goes a little farther out of the corner, and comes back.
  const Vec2d end = corners.back().position;
  std::array<Contact, MoveResult::max_contacts> touched;
  Vec2d out = Vec2d::Zero();
  for (const Contact& contact : contacts_at(end, touched)) out += contact.normal;
  out = out.norm() > 1e-3 ? Vec2d(out.normalized()) : Vec2d(Vec2d::Zero());
  const double far = (end - corners.front().position).norm();
  for (const double share : {0.01, 0.1, 1.0}) {
    part.way = {{corners.front().position, 0}, {end + out * (far * share + Tolerances{}.stop), 0.5}, {end, 1}};
    if (is_proved(part, move, true)) return true;
  }
  return false;
}

/// What the character touches once everything has turned.
std::span<const Contact> TurningStep::contacts_at(const Vec2d& position, std::span<Contact> room) {
  const octagon_sweep::Around around{{memory_.motions, memory_.apart}, controller_.filter_of(context_), context_.up};
  return room.first(controller_.sweep_->contacts_at(position, Tolerances{}.touch, around, scratch_, room));
}

/// Whether the character stays clear of everything that turns at the beginning of a part. What overlapped it before,
/// or crushes it, it may leave.
/// @param of_all and of what stands meanwhile; else the sweep has proved that.
bool TurningStep::is_proved(const Part& part, const MoveResult& move, bool of_all) {
  const auto is_clear = [&](ColliderIndex collider, const Pose& from, const Pose& to) {
    if (!blocks(collider)) return true;
    return contains(move.crushed, collider) || overlaps(collider, from, part.way[0].position) ||
           stays_clear(collider, from, to, part.way);
  };
  for (const MovingCollider& collider : memory_.moving) {
    if (!(of_all || (!collider.by_itself && memory_.turns[collider.mover]))) continue;
    if (!is_clear(collider.id, pose_at(collider.motion, part.begin), turned_pose(collider, part))) return false;
  }
  if (!of_all) return true;
  const std::set<ColliderIndex> around = standing(box_at(box_around(part.way, {})));
  return std::ranges::all_of(around, [&](ColliderIndex collider) { return is_clear(collider, {}, {}); });
}

/// The solids that stand in a box, by id.
std::set<ColliderIndex> TurningStep::standing(const Box2& box) const {
  memory_.pieces.clear();
  scenery_.group_of(no_mover).solids.find(box, scenery_.boxes(), memory_.pieces);
  std::set<ColliderIndex> found;
  for (const PieceIndex piece : memory_.pieces) found.insert(scenery_.pieces()[piece].collider);
  return found;
}

/// Of one of so many parts. What turns comes to overlap a character that was free no deeper than it goes.
/// @param push what is left of it [m].
octagon_sweep::Limits TurningStep::limits_of(double push, int parts, const CharacterState& state) const {
  octagon_sweep::Limits limits{push};
  const bool was_free = state.has_last_free && state.last_free == state.position;
  if (was_free) limits.out = push + longest_turn() / parts;
  return limits;
}

/// How far a place goes in a part with a collider that is there at its end [m].
double TurningStep::way_of(const MovingCollider& collider, const Part& part, const Vec2d& place) {
  const Pose from = pose_at(collider.motion, part.begin);
  const Pose to = pose_at(collider.motion, part.end);
  return (place - from.position - geometry::Turn(from.angle - to.angle)(Vec2d(place - to.position))).norm();
}

/// How much farther a character went in a part than it wanted to, and than what it touched [m].
/// @param own how far it wanted to go [m].
double TurningStep::pushed_in(const Part& part, const MoveResult& move, double own) const {
  double way = 0;
  for (const Contact& contact : move.contacts)
    if (const MovingCollider* collider = find_moving(contact.collider))
      way = std::max(way, way_of(*collider, part, contact.point));
  return std::max(0.0, (move.position - move.path.front().position).norm() - own - way);
}

}  // namespace paperproof::turning
