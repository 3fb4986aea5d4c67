#include "level/local_controller_impl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace paperproof {

using namespace level;

namespace {

/// Nothing nearer is proved to be apart [m]. Zero: rounding hides an overlap. Large: a character that is squeezed
/// between surfaces is crushed.
constexpr double proved = 1e-9;

/// The convex pieces of a collider, where its pose is zero.
std::vector<ConvexPiece> pieces_of(ColliderDef def) {
  def.mover = no_mover;
  const double radius = def.radius;
  const Scenery scenery(SceneryDef{{std::move(def)}});
  std::vector<ConvexPiece> pieces;
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    const PieceVertices vertices = scenery.vertices_of(piece);
    pieces.push_back({{vertices.begin(), vertices.end()}, radius});
  }
  return pieces;
}

/// The corner of the character that is nearest to a surface once it has turned; the one that is so before, if both are
/// at one height then.
Vec2d nearest_corner(std::span<const Vec2d> hull, const Vec2d& normal_before, const Vec2d& normal_after) {
  const auto nearest_along = [&](const Vec2d& normal) {
    return *std::min_element(hull.begin(), hull.end(),
                             [&](const Vec2d& a, const Vec2d& b) { return a.dot(normal) < b.dot(normal); });
  };
  const Vec2d before = nearest_along(normal_before);
  const Vec2d after = nearest_along(normal_after);
  return (before - after).dot(normal_after) < Tolerances{}.hit ? before : after;
}

}  // namespace

/// Into how many shorter steps a step must be divided.
int LocalController::Impl::parts_for(const CharacterState& state, const StepContext& context) const {
  const Box2& extent = character().shape.box();
  const double size = (extent.upper - extent.lower).norm();
  const Box2 needed = box_needed(state, context);
  const double reach = (needed.upper - needed.lower).norm();
  double most = 0;
  for (MoverIndex i = 0; i < scenery.movers().size(); ++i) {
    const double way = (scenery.movers()[i].motion.to.position - scenery.movers()[i].motion.from.position).norm();
    if (scenery.movers()[i].turn() == 0 ||
        nearest_of(i, 0, state.position, context.filter).approach.distance > reach + way)
      continue;
    most = std::max(most, std::abs(scenery.movers()[i].turn()) * size);
  }
  int parts = 1;
  while (parts < most_parts && most > most_turned * parts) parts *= 2;
  return parts;
}

/// The nearest of a mover's colliders, and where it is nearest to the character.
NearestOutline LocalController::Impl::nearest_of(MoverIndex mover, double fraction, const Vec2d& position,
                                                 const ColliderFilter* filter) const {
  NearestOutline best{{std::numeric_limits<double>::infinity(), {0, 1}}, {}, false};
  for (const NearCollider& collider : scenery.colliders()) {
    if (collider.mover != mover || collider.def->sensor || !is_there(collider, filter)) continue;
    std::vector<Vec2d> outline = vertices_at(*collider.def, pose_at(collider.motion, fraction));
    outline.resize(collider.def->points.size());
    const bool closed = collider.def->shape == ColliderDef::Shape::polygon;
    const Approach here = nearest(outline, closed, hull(), position);
    if (here.distance < best.approach.distance) best = {here, std::move(outline), closed};
  }
  return best;
}

/// About what a mover turns in a part: the corner of the character that will be nearest to it then, so that what
/// carries the character turns under its foot; or its own corner, if that is beneath the foot instead.
Vec2d LocalController::Impl::pivot_of(MoverIndex mover, double begin, double angle, const Vec2d& position,
                                      const ColliderFilter* filter) const {
  const NearestOutline near = nearest_of(mover, begin, position, filter);
  const Vec2d corner = position + nearest_corner(hull(), near.approach.normal, rotated(near.approach.normal, angle));
  if (near.outline.empty()) return corner;
  return nearest_vertex(near.outline, near.closed, corner).value_or(corner);
}

/// Turns everything by its angle in a part of the step, and says how it goes on from there.
StepPart LocalController::Impl::turn(double begin, double end, const Vec2d& position, const ColliderFilter* filter) {
  motions.clear();
  for (MoverIndex i = 0; i < scenery.movers().size(); ++i) {
    const Pose from = pose_at(scenery.movers()[i].motion, begin);
    const Pose to = pose_at(scenery.movers()[i].motion, end);
    const double angle = to.angle - from.angle;
    if (!scenery.movers()[i].turns) {
      motions.push_back({from.position, to.position});
      continue;
    }
    const Vec2d pivot = pivot_of(i, begin, angle, position, filter);
    motions.push_back({pivot - rotated(pivot - from.position, angle), to.position});
  }
  return {begin, end, motions};
}

Pose LocalController::Impl::turned_pose(const NearCollider& collider, const StepPart& part) const {
  return {part.motions[collider.mover].from, pose_at(collider.motion, part.end).angle};
}

/// Whether a collider can be in the way, and has a proof. @param context of the step, whose filter knows ids.
bool LocalController::Impl::blocks(const NearCollider& collider, const StepContext& context) const {
  return !collider.def->sensor && !collider.def->one_way && scenery.is_in_scenery(collider.id) &&
         is_there(collider, context.filter);
}

const std::vector<ConvexPiece>& LocalController::Impl::pieces(const NearCollider& collider) {
  const auto is_it = [&](const KnownPieces& known) {
    return known.id == collider.id && known.version == collider.version;
  };
  const auto known = std::find_if(known_pieces.begin(), known_pieces.end(), is_it);
  if (known != known_pieces.end()) return known->pieces;
  if (known_pieces.size() > 2 * scenery.colliders().size()) known_pieces.clear();
  known_pieces.push_back({collider.id, collider.version, pieces_of(*collider.def)});
  return known_pieces.back().pieces;
}

/// Whether a collider overlaps the character by more than rounding.
bool LocalController::Impl::overlaps(const NearCollider& collider, const Pose& pose, const Vec2d& position) {
  const std::vector<ConvexPiece>& all = pieces(collider);
  return std::any_of(all.begin(), all.end(), [&](const ConvexPiece& piece) {
    const std::vector<Vec2d> here = placed(piece.vertices, pose);
    return !stay_apart({hull(), position, position}, {here, here, piece.radius}, -proved);
  });
}

/// Finds a way for the character to where it is once everything has turned, and proves that it is clear.
/// @param move in the part; its corners at fraction 0 are that way. Colliders by index.
bool LocalController::Impl::find_way(StepPart& part, const MoveResult& move, const StepContext& context) {
  std::vector<Vec2d> corners;
  for (const PathPoint& corner : move.path)
    if (corner.fraction == 0) corners.push_back(corner.position);
  // Mostly it goes first, and has gone before what pushes it arrives. Evenly it would be late by the square of a turn.
  for (const double arrival : {0.5, 1.0}) {
    part.way.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double share = corners.size() == 1 ? 0 : static_cast<double>(i) / static_cast<double>(corners.size() - 1);
      part.way.push_back({corners[i], arrival * share});
    }
    if (part.way.back().fraction < 1) part.way.push_back({part.way.back().position, 1});
    if (is_proved(part, move, context, false)) return true;
    if (corners.size() == 1) return false;
  }
  // In a corner one wall arrives as another leaves. Then it goes a little farther out of the corner, and comes back.
  const Vec2d& end = corners.back();
  const Vec2d out = out_of_corner(end, context, part);
  const double far = (end - corners.front()).norm();
  for (const double share : {0.01, 0.1, 1.0}) {
    part.way = {{corners.front(), 0}, {end + out * (far * share + Tolerances{}.stop), 0.5}, {end, 1}};
    if (is_proved(part, move, context, true)) return true;
  }
  return false;
}

/// Unit, away from everything that is touched once everything has turned; or zero.
Vec2d LocalController::Impl::out_of_corner(const Vec2d& position, const StepContext& context, const StepPart& part) {
  std::array<Contact, MoveResult::max_contacts> touched;
  const std::size_t count = scenery.controller().contacts_at(
      position, Tolerances{}.touch, scenery.context(context, part.motions), scenery.scratch(), touched);
  Vec2d out = Vec2d::Zero();
  for (std::size_t i = 0; i < count; ++i) out += touched[i].normal;
  return out.norm() > 1e-3 ? Vec2d(out.normalized()) : Vec2d(Vec2d::Zero());
}

/// Whether the character stays clear of everything that turns at the beginning of a part. What overlapped it before,
/// or crushes it, it may leave.
/// @param of_all and of what stands meanwhile; else the sweep has proved that.
bool LocalController::Impl::is_proved(const StepPart& part, const MoveResult& move, const StepContext& context,
                                      bool of_all) {
  for (const NearCollider& collider : scenery.colliders()) {
    if (!(of_all || scenery.turns(collider)) || !blocks(collider, context)) continue;
    const ColliderIndex local = scenery.local_of(collider.id);
    if (std::find(move.crushed.begin(), move.crushed.end(), local) != move.crushed.end()) continue;
    const Pose from = pose_at(collider.motion, part.begin);
    const Pose to = collider.mover == no_mover ? from : turned_pose(collider, part);
    if (overlaps(collider, from, part.way[0].position)) continue;
    for (const ConvexPiece& piece : pieces(collider)) {
      const PieceWay whole = {placed(piece.vertices, from), placed(piece.vertices, to), piece.radius};
      for (std::size_t leg = 0; leg + 1 < part.way.size(); ++leg) {
        const PathPoint& begin = part.way[leg];
        const PathPoint& end = part.way[leg + 1];
        PieceWay piece_way = whole;
        for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
          piece_way.from[v] = between(whole.from[v], whole.to[v], begin.fraction);
          piece_way.to[v] = between(whole.from[v], whole.to[v], end.fraction);
        }
        if (!stay_apart({hull(), begin.position, end.position}, piece_way, proved)) return false;
      }
    }
  }
  return true;
}

/// What pushes a character leaves it no faster than it goes itself: between surfaces that close like a wedge it would
/// leave at any speed.
/// @param move in the part, colliders by index. @param wanted speed [m/s].
void LocalController::Impl::limit_speed(const StepPart& part, double wanted, double dt, MoveResult& move,
                                        CharacterState& state) const {
  double most = wanted;
  bool is_pushed = false;
  for (const Contact& contact : move.contacts) {
    const NearCollider& collider = scenery.at(contact.collider);
    if (collider.mover == no_mover) continue;
    const Pose from = pose_at(collider.motion, part.begin);
    const Pose to = pose_at(collider.motion, part.end);
    const Vec2d before = from.position + rotated(Vec2d(contact.point - to.position), from.angle - to.angle);
    most = std::max(most, (contact.point - before).norm() / dt);
    is_pushed = true;
  }
  const double speed = state.velocity.norm();
  if (!is_pushed || !(speed > most)) return;
  state.velocity *= most / speed;
  move.velocity = state.velocity;
}

/// Whether a collider may reach a character that goes its way within a part of the step.
bool LocalController::Impl::reaches(const NearCollider& collider, const HullWay& way, double begin, double end) {
  const Pose before = pose_at(collider.motion, begin);
  const Pose after = pose_at(collider.motion, end);
  const std::vector<ConvexPiece>& all = pieces(collider);
  return std::any_of(all.begin(), all.end(), [&](const ConvexPiece& piece) {
    return !stay_apart(way, {placed(piece.vertices, before), placed(piece.vertices, after), piece.radius}, proved);
  });
}

}  // namespace paperproof
