#include <paperproof/local_controller.hpp>

#include "level/near_scenery.hpp"
#include "level/turn.hpp"
#include "step_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace paperproof {
namespace {

using namespace level;

/// Into so many shorter steps a step is divided at most.
constexpr int most_parts = 32;

/// The share of a part in which everything turns. So short that a character which waits meanwhile is not 1 um behind.
constexpr double turning_share = 0x1p-20;

/// A part of a step, as fractions of it, and how what is near moves in it once everything has turned.
struct StepPart {
  double begin;
  double end;
  std::span<const MoverMotion<double>> motions;
  /// Of the character while everything turns, in shares of this time.
  std::vector<PathPoint<double>> way{};

  [[nodiscard]] double turned() const noexcept { return begin + (end - begin) * turning_share; }
};

/// A collider, and where it is nearest to the character.
struct NearestOutline {
  Approach approach;
  std::vector<Vec2d> outline;
  bool closed;
};

/// Nothing nearer is proved to be apart [m]. Zero: rounding hides an overlap. Large: a character that is squeezed
/// between surfaces is crushed.
constexpr double proved = 1e-9;

/// All points of a collider in a pose: see `TurnedCollider`.
std::vector<Vec2d> vertices_at(const ColliderDef& def, const Pose& pose) {
  std::vector<Vec2d> vertices;
  const auto add = [&](const std::vector<Vec2d>& points) {
    for (const Vec2d& point : points) vertices.push_back(placed(point, pose));
  };
  add(def.points);
  for (const std::vector<Vec2d>& hole : def.holes) add(hole);
  return vertices;
}

/// The convex pieces of a collider, where its pose is zero.
std::vector<ConvexPiece> pieces_of(ColliderDef def) {
  def.mover = no_mover;
  const double radius = def.radius;
  const Scenery<double> scenery(SceneryDef{{std::move(def)}});
  std::vector<ConvexPiece> pieces;
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    const PieceVertices<double> vertices = scenery.vertices_of(piece);
    pieces.push_back({{vertices.begin(), vertices.end()}, radius});
  }
  return pieces;
}

Vec2d between(const Vec2d& from, const Vec2d& to, double share) { return from + (to - from) * share; }

/// The corner of the character that is nearest to a surface once it has turned; the one that is so before, if both are
/// at one height then.
Vec2d nearest_corner(std::span<const Vec2d> hull, const Vec2d& normal_before, const Vec2d& normal_after) {
  const auto nearest_along = [&](const Vec2d& normal) {
    return *std::min_element(hull.begin(), hull.end(),
                             [&](const Vec2d& a, const Vec2d& b) { return a.dot(normal) < b.dot(normal); });
  };
  const Vec2d before = nearest_along(normal_before);
  const Vec2d after = nearest_along(normal_after);
  return (before - after).dot(normal_after) < Tolerances<double>{}.hit ? before : after;
}

/// The place from which the character came goes along with what crushed it.
void carry(Crusher<double>& crusher, const Pose& from, const Pose& to) {
  const Vec2d came_from = crusher.last_free + crusher.displacement;
  const Vec2d there = to.position + rotated(Vec2d(came_from - from.position), to.angle - from.angle);
  crusher.displacement = there - crusher.last_free;
}

/// How bad a status is: that of a step is the worst of its parts; but a step is stuck only if it ends so.
int rank(MoveStatus status) noexcept {
  constexpr std::array order{MoveStatus::moved, MoveStatus::dropped, MoveStatus::stuck, MoveStatus::crushed};
  return static_cast<int>(std::find(order.begin(), order.end(), status) - order.begin());
}

/// Of what can be looked for. Written so that NaN is not.
bool is_in_range(const Box2<double>& box) noexcept {
  constexpr double range = 1e8;
  return box.lower.x() > -range && box.lower.y() > -range && box.upper.x() < range && box.upper.y() < range;
}

SensorEvent<double> sensor_event(ColliderIndex sensor, bool enters, double fraction) {
  using Change = SensorEvent<double>::Change;
  return {sensor, enters ? Change::enter : Change::exit, fraction};
}

/// Before the first part.
void clear(StepReport<double>& report) {
  report.status = StepStatus::moved;
  report.requested.setZero();
  report.steered = 0;
  report.move.clear();
  report.sensors.clear();
  report.dropped_through.clear();
}

}  // namespace

struct LocalController::Impl {
  explicit Impl(const CharacterDef& def) : scenery(def) { def.validate(); }

  [[nodiscard]] const CharacterDef& character() const noexcept { return scenery.character(); }
  [[nodiscard]] std::span<const Vec2d> hull() const noexcept { return character().shape.hull(); }

  [[nodiscard]] Box2<double> box_needed(const CharacterState<double>& state, const StepContext<double>& context) const;
  [[nodiscard]] bool stays_in(const Box2<double>& box, const MoveResult<double>& move) const;
  StepStatus refuse(const CharacterState<double>& state, StepReport<double>& report);
  StepStatus stay(MoveStatus why, const CharacterState<double>& state, StepReport<double>& report);

  template <class Go>
  StepStatus advance(CharacterState<double>& state, const StepContext<double>& context, const Find& find,
                     StepReport<double>& report, const Go& go);
  template <class Go>
  StepStatus step_straight(CharacterState<double>& state, const StepContext<double>& context,
                           StepReport<double>& report, const Go& go);
  template <class Go>
  StepStatus step_among_turning(CharacterState<double>& state, const StepContext<double>& context,
                                StepReport<double>& report, const Go& go);
  template <class Go>
  [[nodiscard]] std::optional<StepStatus> step_in_parts(int parts, CharacterState<double>& state,
                                                        const StepContext<double>& context, StepReport<double>& report,
                                                        const Go& go);

  // Among what turns.
  [[nodiscard]] int parts_for(const CharacterState<double>& state, const StepContext<double>& context) const;
  [[nodiscard]] StepPart turn(double begin, double end, const Vec2d& position, const ColliderFilter* filter);
  [[nodiscard]] NearestOutline nearest_of(MoverIndex mover, double fraction, const Vec2d& position,
                                          const ColliderFilter* filter) const;
  [[nodiscard]] Vec2d pivot_of(MoverIndex mover, double begin, double angle, const Vec2d& position,
                               const ColliderFilter* filter) const;
  [[nodiscard]] bool find_way(StepPart& part, const MoveResult<double>& move, const StepContext<double>& context);
  void limit_speed(const StepPart& part, double wanted, double dt, MoveResult<double>& move,
                   CharacterState<double>& state) const;
  [[nodiscard]] Vec2d out_of_corner(const Vec2d& position, const StepContext<double>& context, const StepPart& part);
  [[nodiscard]] bool is_proved(const StepPart& part, const MoveResult<double>& move, const StepContext<double>& context,
                               bool of_all);
  [[nodiscard]] bool blocks(const NearCollider& collider, const StepContext<double>& context) const;
  [[nodiscard]] Pose turned_pose(const NearCollider& collider, const StepPart& part) const;
  void note_pushes(const StepPart& part, const StepContext<double>& context);
  void note_turned_sensors(const StepPart& part, const Vec2d& position, const ColliderFilter* filter,
                           StepReport<double>& report);
  void note_begin();
  void note_vertices(const StepPart& part);
  void append(const StepReport<double>& added, const StepPart& part, StepReport<double>& report) const;
  StepStatus go_straight_or_stay(CharacterState<double>& state, const StepContext<double>& context,
                                 StepReport<double>& report);
  template <class PlaceAt>
  void note_stays(const NearCollider& sensor, double begin, std::span<const double> ends, const PlaceAt& place_at,
                  StepReport<double>& report);
  void go_straight(double begin, double departure, const Vec2d& to, const CharacterState<double>& state,
                   const StepContext<double>& context, StepReport<double>& report);
  [[nodiscard]] std::optional<Vec2d> way_out_at_end(CharacterState<double> state, const StepContext<double>& context);
  [[nodiscard]] bool overlaps(const NearCollider& collider, const Pose& pose, const Vec2d& position);
  [[nodiscard]] bool reaches(const NearCollider& collider, const HullWay& way, double begin, double end);
  [[nodiscard]] const std::vector<ConvexPiece>& pieces(const NearCollider& collider);

  struct KnownPieces {
    ColliderIndex id;
    std::uint64_t version;
    std::vector<ConvexPiece> pieces;
  };

  NearScenery scenery;
  std::vector<MoverMotion<double>> motions;
  std::vector<TurnedCollider> turned_;
  std::unique_ptr<StepReport<double>> of_part = std::make_unique<StepReport<double>>();
  ReportMemory<PathPoint<double>> more_corners{most_parts * MoveResult<double>::max_corners};
  ReportMemory<Contact<double>> more_contacts{most_parts * MoveResult<double>::max_contacts};
  ReportMemory<ColliderIndex> more_crushed{most_parts * MoveResult<double>::max_crushed};
  std::vector<KnownPieces> known_pieces;
};

/// Everything that the step can reach, but a way out of solids.
Box2<double> LocalController::Impl::box_needed(const CharacterState<double>& state,
                                               const StepContext<double>& context) const {
  const double dt = context.dt;
  const double acceleration =
      character().acceleration + character().air_acceleration.value_or(0) + context.gravity.norm();
  const double reach = (character().jump_speed + acceleration * dt) * dt + character().snap + character().step_height +
                       character().wall_reach + 2 * most_turned;
  const Vec2d goes = state.position + (state.velocity + state.ride.velocity) * dt;
  const Box2<double> way{state.position.cwiseMin(goes), state.position.cwiseMax(goes)};
  const Box2<double>& extent = character().shape.box();
  return Box2<double>{way.lower + extent.lower, way.upper + extent.upper}.inflated(reach);
}

/// Whether everything that decides a move is in a box. A way out of solids may lead farther.
bool LocalController::Impl::stays_in(const Box2<double>& box, const MoveResult<double>& move) const {
  const Box2<double>& extent = character().shape.box();
  return std::all_of(move.path.begin(), move.path.end(), [&](const PathPoint<double>& corner) {
    const Box2<double> there{corner.position + extent.lower, corner.position + extent.upper};
    return box.contains(there.inflated(most_turned));
  });
}

template <class Go>
StepStatus LocalController::Impl::advance(CharacterState<double>& state, const StepContext<double>& context,
                                          const Find& find, StepReport<double>& report, const Go& go) {
  const CharacterState<double> before = state;
  Box2<double> needed = box_needed(state, context);
  if (!(context.dt > 0 && is_in_range(needed))) return report.status = StepStatus::invalid_input;
  for (;;) {
    turned_.clear();
    scenery.read(needed, context, find);
    state = before;
    const StepStatus status = scenery.any_turns() ? step_among_turning(state, context, report, go)
                                                  : step_straight(state, context, report, go);
    if (is_refused(status)) {
      state = before;
      return status;
    }
    if (stays_in(needed, report.move)) return status;
    const double size = (character().shape.box().upper - character().shape.box().lower).maxCoeff();
    for (const PathPoint<double>& corner : report.move.path)
      needed = needed.merged(Box2<double>{corner.position, corner.position}.inflated(2 * size + 1));
  }
}

/// Where nothing near turns.
template <class Go>
StepStatus LocalController::Impl::step_straight(CharacterState<double>& state, const StepContext<double>& context,
                                                StepReport<double>& report, const Go& go) {
  if (!scenery.build(1)) return refuse(state, report);
  motions.clear();
  for (const NearMover& mover : scenery.movers())
    motions.push_back({mover.motion.from.position, mover.motion.to.position});
  const Vec2d from = state.position;
  scenery.to_local(state);
  const StepStatus status =
      go(scenery.controller(), state, scenery.context(context, motions), 1.0, scenery.scratch(), report);
  if (status == StepStatus::invalid_input) return status;
  scenery.to_ids(report);
  if (is_refused(status)) return status;
  scenery.to_ids(state);
  note_turned_sensors({0, 1, motions}, from, context.filter, report);
  return status;
}

/// A collider cannot be turned as it should.
StepStatus LocalController::Impl::refuse(const CharacterState<double>& state, StepReport<double>& report) {
  report.move.refusal =
      "a collider near the character crosses itself when it is turned: two of its corners are so near "
      "to each other that rounding swaps them";
  return stay(MoveStatus::refused, state, report);
}

/// Reports a step that is refused.
StepStatus LocalController::Impl::stay(MoveStatus why, const CharacterState<double>& state,
                                       StepReport<double>& report) {
  const auto words = report.move.refusal;
  turned_.clear();
  clear(report);
  report.move.refusal = words;
  report.move.status = why;
  report.move.position = state.position;
  report.move.velocity = state.velocity;
  report.move.ride = state.ride;
  report.move.path.push_back({state.position, 0});
  report.move.path.push_back({state.position, 1});
  return report.status = step_parts::status_of(why);
}

/// Into how many shorter steps a step must be divided.
int LocalController::Impl::parts_for(const CharacterState<double>& state, const StepContext<double>& context) const {
  const Box2<double>& extent = character().shape.box();
  const double size = (extent.upper - extent.lower).norm();
  const Box2<double> needed = box_needed(state, context);
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
bool LocalController::Impl::blocks(const NearCollider& collider, const StepContext<double>& context) const {
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
bool LocalController::Impl::find_way(StepPart& part, const MoveResult<double>& move,
                                     const StepContext<double>& context) {
  std::vector<Vec2d> corners;
  for (const PathPoint<double>& corner : move.path)
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
    part.way = {{corners.front(), 0}, {end + out * (far * share + Tolerances<double>{}.stop), 0.5}, {end, 1}};
    if (is_proved(part, move, context, true)) return true;
  }
  return false;
}

/// Unit, away from everything that is touched once everything has turned; or zero.
Vec2d LocalController::Impl::out_of_corner(const Vec2d& position, const StepContext<double>& context,
                                           const StepPart& part) {
  std::array<Contact<double>, MoveResult<double>::max_contacts> touched;
  const std::size_t count = scenery.controller().contacts_at(
      position, Tolerances<double>{}.touch, scenery.context(context, part.motions), scenery.scratch(), touched);
  Vec2d out = Vec2d::Zero();
  for (std::size_t i = 0; i < count; ++i) out += touched[i].normal;
  return out.norm() > 1e-3 ? Vec2d(out.normalized()) : Vec2d(Vec2d::Zero());
}

/// Whether the character stays clear of everything that turns at the beginning of a part. What overlapped it before,
/// or crushes it, it may leave.
/// @param of_all and of what stands meanwhile; else the sweep has proved that.
bool LocalController::Impl::is_proved(const StepPart& part, const MoveResult<double>& move,
                                      const StepContext<double>& context, bool of_all) {
  for (ColliderIndex i = 0; i < scenery.size(); ++i) {
    const NearCollider& collider = scenery.at(i);
    if (!(of_all || scenery.turns(collider)) || !blocks(collider, context)) continue;
    if (std::find(move.crushed.begin(), move.crushed.end(), i) != move.crushed.end()) continue;
    const Pose from = pose_at(collider.motion, part.begin);
    const Pose to = collider.mover == no_mover ? from : turned_pose(collider, part);
    if (overlaps(collider, from, part.way[0].position)) continue;
    for (const ConvexPiece& piece : pieces(collider)) {
      const PieceWay whole = {placed(piece.vertices, from), placed(piece.vertices, to), piece.radius};
      for (std::size_t leg = 0; leg + 1 < part.way.size(); ++leg) {
        const PathPoint<double>& begin = part.way[leg];
        const PathPoint<double>& end = part.way[leg + 1];
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
void LocalController::Impl::limit_speed(const StepPart& part, double wanted, double dt, MoveResult<double>& move,
                                        CharacterState<double>& state) const {
  double most = wanted;
  bool is_pushed = false;
  for (const Contact<double>& contact : move.contacts) {
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

/// Reports what pushed the character when it turned, as contacts at the beginning of a part.
void LocalController::Impl::note_pushes(const StepPart& part, const StepContext<double>& context) {
  MoveResult<double>& move = of_part->move;
  if (move.path.size() < 2 || move.path[1].fraction > 0) return;
  std::size_t last = 1;
  while (last + 1 < move.path.size() && move.path[last + 1].fraction == 0) ++last;
  std::array<Contact<double>, MoveResult<double>::max_contacts> touched;
  const std::size_t count =
      scenery.controller().contacts_at(move.path[last].position, Tolerances<double>{}.touch,
                                       scenery.context(context, part.motions), scenery.scratch(), touched);
  for (std::size_t i = 0; i < count; ++i) {
    const NearCollider& collider = scenery.at(touched[i].collider);
    const auto is_known = [&](const Contact<double>& contact) { return contact.collider == touched[i].collider; };
    if (!scenery.turns(collider)) continue;
    if (std::none_of(move.contacts.begin(), move.contacts.end(), is_known))
      move.contacts.push_back(touched[i], more_contacts);
  }
}

/// Reports the sensors that came over the character, or left it, as they turned at the beginning of a part. The sweep
/// sees how they go on.
/// @param position where the part begins. @param report of the part, by ids.
void LocalController::Impl::note_turned_sensors(const StepPart& part, const Vec2d& position,
                                                const ColliderFilter* filter, StepReport<double>& report) {
  if (!scenery.any_sensor_turns()) return;
  const auto later = report.sensors;
  report.sensors.clear();
  for (const NearCollider& collider : scenery.colliders()) {
    const bool turns = collider.mover != no_mover && collider.motion.from.angle != collider.motion.to.angle;
    if (!collider.def->sensor || !turns || !scenery.is_in_scenery(collider.id) || !is_there(collider, filter)) continue;
    const bool before = overlaps(collider, pose_at(collider.motion, part.begin), position);
    const bool after = overlaps(collider, turned_pose(collider, part), position);
    if (before != after) report.sensors.push_back(sensor_event(collider.id, after, 0));
  }
  for (const SensorEvent<double>& event : later) report.sensors.push_back(event);
  report.sensors.note_overflow(later.overflowed());
}

/// Where everything that moves is when the step begins.
void LocalController::Impl::note_begin() {
  turned_.clear();
  for (const NearCollider& collider : scenery.colliders())
    if (collider.mover != no_mover)
      turned_.push_back({collider.id, {0}, {vertices_at(*collider.def, collider.motion.from)}});
}

void LocalController::Impl::note_vertices(const StepPart& part) {
  std::size_t next = 0;
  for (const NearCollider& collider : scenery.colliders()) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    way.instants.insert(way.instants.end(), {part.turned(), part.end});
    way.vertices.push_back(vertices_at(*collider.def, turned_pose(collider, part)));
    way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, part.end)));
  }
}

/// Adds a part to the report of the step. @param added names colliders by ids.
void LocalController::Impl::append(const StepReport<double>& added, const StepPart& part,
                                   StepReport<double>& report) const {
  const MoveResult<double>& from = added.move;
  MoveResult<double>& to = report.move;
  const auto when = [&](double fraction) {
    return fraction < 1 ? part.turned() + (part.end - part.turned()) * fraction : part.end;
  };
  for (const PathPoint<double>& corner : part.way) {
    const double fraction = part.begin + (part.turned() - part.begin) * corner.fraction;
    if (corner.fraction > 0 || to.path.empty())
      to.path.push_back({corner.position, corner.fraction < 1 ? fraction : part.turned()}, more_corners);
  }
  for (const PathPoint<double>& corner : from.path)
    if (corner.fraction > 0) to.path.push_back({corner.position, when(corner.fraction)}, more_corners);
  for (Contact<double> contact : from.contacts) {
    contact.fraction = when(contact.fraction);
    const auto is_it = [&](const Contact<double>& other) {
      return other.collider == contact.collider && other.normal == contact.normal;
    };
    if (std::none_of(to.contacts.begin(), to.contacts.end(), is_it)) to.contacts.push_back(contact, more_contacts);
  }
  for (const ColliderIndex collider : from.crushed)
    if (std::find(to.crushed.begin(), to.crushed.end(), collider) == to.crushed.end())
      to.crushed.push_back(collider, more_crushed);
  for (SensorEvent<double> event : added.sensors) {
    event.fraction = when(event.fraction);
    report.sensors.push_back(event);
  }
  report.sensors.note_overflow(added.sensors.overflowed());
  for (const ColliderIndex collider : added.dropped_through)
    if (std::find(report.dropped_through.begin(), report.dropped_through.end(), collider) ==
        report.dropped_through.end())
      report.dropped_through.push_back(collider);
  report.dropped_through.note_overflow(added.dropped_through.overflowed());
  if (part.begin == 0) {
    report.requested = added.requested / part.end;
    report.steered = added.steered / part.end;
  }
  const bool was_freed = to.status == MoveStatus::stuck && from.status != MoveStatus::crushed;
  if (was_freed || rank(from.status) > rank(to.status)) to.status = from.status;
  report.status = step_parts::status_of(to.status);
  to.position = from.position;
  to.velocity = from.velocity;
  to.technique_memory = from.technique_memory;
  to.grounded = from.grounded;
  to.ground = from.ground;
  to.ride = from.ride;
  to.crushers = from.crushers;
}

template <class Go>
StepStatus LocalController::Impl::step_among_turning(CharacterState<double>& state, const StepContext<double>& context,
                                                     StepReport<double>& report, const Go& go) {
  const CharacterState<double> before = state;
  const int usual = parts_for(state, context);
  std::optional<int> crushing;  // so many parts can be proved, but crush the character
  const auto try_parts = [&](int parts) -> std::optional<StepStatus> {
    state = before;
    const std::optional<StepStatus> status = step_in_parts(parts, state, context, report, go);
    const bool is_inside = before.crushed || before.stuck_steps > 0;  // other divisions would not free it
    if (!status || report.move.crushed.empty() || is_inside) return status;
    if (!crushing) crushing = parts;
    return std::nullopt;
  };
  for (int parts = usual; parts <= most_parts; parts *= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  for (int parts = usual / 2; parts > 0; parts /= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  state = before;
  const StepStatus status = go_straight_or_stay(state, context, report);
  if (!crushing || status == StepStatus::moved) return status;
  state = before;
  return *step_in_parts(*crushing, state, context, report, go);
}

/// @return nothing if the step cannot be proved; it is not complete then.
template <class Go>
std::optional<StepStatus> LocalController::Impl::step_in_parts(int parts, CharacterState<double>& state,
                                                               const StepContext<double>& context,
                                                               StepReport<double>& report, const Go& go) {
  clear(report);
  const CharacterState<double> before = state;
  StepContext<double> shorter = context;
  shorter.dt = context.dt / parts;
  for (int i = 0; i < parts; ++i) {
    if (!scenery.build(double(i + 1) / parts)) return refuse(before, report);
    if (i == 0) note_begin();
    StepPart part = turn(double(i) / parts, double(i + 1) / parts, state.position, context.filter);
    scenery.to_local(state);
    if (state.ride.ground != Ride<double>::none) {
      const MoverIndex mover = scenery.at(state.ride.ground).mover;
      if (mover != no_mover && scenery.movers()[mover].turn() != 0)
        state.ride.place = state.position - part.motions[mover].from;
    }
    for (Crusher<double>& crusher : state.crushers) {
      const NearCollider& collider = scenery.at(crusher.collider);
      if (collider.mover != no_mover) carry(crusher, pose_at(collider.motion, part.begin), turned_pose(collider, part));
    }
    const Vec2d from = state.position;
    const Vec2d carried = state.ride.velocity;
    const StepStatus status = go(scenery.controller(), state, scenery.context(shorter, part.motions), 1.0 / parts,
                                 scenery.scratch(), *of_part);
    if (status == StepStatus::invalid_input) return report.status = status;
    if (is_refused(status)) return stay(of_part->move.status, before, report);
    if (!find_way(part, of_part->move, context)) return std::nullopt;
    note_pushes(part, shorter);
    limit_speed(part, (of_part->requested / shorter.dt + carried).norm(), shorter.dt, of_part->move, state);
    scenery.to_ids(*of_part);
    scenery.to_ids(state);
    note_turned_sensors(part, from, context.filter, *of_part);
    note_vertices(part);
    append(*of_part, part, report);
    if (report.move.crushed.empty() || i + 1 == parts) continue;
    // It stays where it was crushed until the next step.
    go_straight(part.end, part.end, state.position, state, context, report);
    step_parts::adopt(character(), context.up, report.move, state);
    break;
  }
  return report.status;
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

/// Reports that the character enters and leaves a sensor, as far as instants of the step show it.
/// @param ends the instants. @param place_at of the character, at one of them.
template <class PlaceAt>
void LocalController::Impl::note_stays(const NearCollider& sensor, double begin, std::span<const double> ends,
                                       const PlaceAt& place_at, StepReport<double>& report) {
  const auto is_inside = [&](double when) { return overlaps(sensor, pose_at(sensor.motion, when), place_at(when)); };
  bool inside = is_inside(begin);
  for (const double end : ends) {
    if (is_inside(end) == inside) continue;
    inside = !inside;
    report.sensors.push_back(sensor_event(sensor.id, inside, end));
  }
}

/// The rest of a step, in which the character stays, then goes straight to a place, and everything that moves turns
/// evenly. What may reach the character crushes it.
/// @param begin as a fraction of the step; what is before it stands in the report.
/// @param departure when the character leaves for the place.
void LocalController::Impl::go_straight(double begin, double departure, const Vec2d& to,
                                        const CharacterState<double>& state, const StepContext<double>& context,
                                        StepReport<double>& report) {
  MoveResult<double>& move = report.move;
  move.position = to;
  move.velocity.setZero();
  move.grounded = false;
  move.ground = {};
  move.ride = {};
  move.crushers.clear();
  if (move.path.empty()) move.path.push_back({state.position, 0});
  if (departure > begin) move.path.push_back({state.position, departure}, more_corners);
  move.path.push_back({to, 1}, more_corners);
  if (begin == 0) note_begin();
  std::vector<double> ends;
  for (int part = 1; part < most_parts; ++part) ends.push_back(begin + (1 - begin) * part / most_parts);
  if (departure > begin) ends.push_back(departure);
  ends.push_back(1);
  const auto place_at = [&](double fraction) {
    return fraction < 1 ? between(state.position, to, std::max(0.0, fraction - departure) / (1 - departure)) : to;
  };
  for (const NearCollider& collider : scenery.colliders())
    if (collider.def->sensor && scenery.is_in_scenery(collider.id) && is_there(collider, context.filter))
      note_stays(collider, begin, ends, place_at, report);
  std::stable_sort(report.sensors.begin(), report.sensors.end(),
                   [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
  std::size_t next = 0;
  for (const NearCollider& collider : scenery.colliders()) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    const Pose from = pose_at(collider.motion, begin);
    const bool in_way = blocks(collider, context);
    bool is_reached = false;
    double last = begin;
    for (const double end : ends) {
      way.instants.push_back(end);
      way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, end)));
      is_reached = is_reached || (in_way && reaches(collider, {hull(), place_at(last), place_at(end)}, last, end));
      last = end;
    }
    if (!is_reached) continue;
    const auto known = std::find_if(state.crushers.begin(), state.crushers.end(),
                                    [&](const Crusher<double>& crusher) { return crusher.collider == collider.id; });
    Crusher<double> crusher{collider.id, state.position};
    if (known != state.crushers.end()) crusher = *known;
    carry(crusher, from, collider.motion.to);
    const bool is_named = std::find(move.crushed.begin(), move.crushed.end(), collider.id) != move.crushed.end();
    if (!is_named && !overlaps(collider, from, state.position)) move.crushed.push_back(collider.id, more_crushed);
    if (overlaps(collider, collider.motion.to, to)) move.crushers.push_back(crusher);
  }
}

/// Where a character that stays in place would leave what overlaps it at the end of the step.
std::optional<Vec2d> LocalController::Impl::way_out_at_end(CharacterState<double> state,
                                                           const StepContext<double>& context) {
  if (!scenery.build(1)) return std::nullopt;
  motions.clear();
  for (const NearMover& mover : scenery.movers())
    motions.push_back({mover.motion.to.position, mover.motion.to.position});
  scenery.to_local(state);
  state.ride = {};
  for (Crusher<double>& crusher : state.crushers) {
    const NearCollider& collider = scenery.at(crusher.collider);
    carry(crusher, collider.motion.from, collider.motion.to);
  }
  const StepStatus status =
      scenery.controller().move(state, {0, 0}, scenery.context(context, motions), scenery.scratch(), *of_part);
  if (status != StepStatus::moved) return std::nullopt;
  return of_part->move.position;
}

/// A step for a character that no division of the step brings to a free position. It goes straight to one, if it can,
/// in the course of the step or at its end; else it stays in place.
StepStatus LocalController::Impl::go_straight_or_stay(CharacterState<double>& state, const StepContext<double>& context,
                                                      StepReport<double>& report) {
  const std::optional<Vec2d> out = way_out_at_end(state, context);
  MoveResult<double>& move = report.move;
  const auto goes_out = [&](double departure) {
    clear(report);
    go_straight(0, departure, *out, state, context, report);
    return move.crushed.empty() && move.crushers.empty();
  };
  if (!out || !(goes_out(0) || goes_out(1 - turning_share))) {
    clear(report);
    go_straight(0, 0, state.position, state, context, report);
    move.status = move.crushed.empty() ? MoveStatus::stuck : MoveStatus::crushed;
  }
  step_parts::adopt(character(), context.up, move, state);
  return report.status = step_parts::status_of(move.status);
}

LocalController::LocalController(const CharacterDef& character) : impl_(std::make_unique<Impl>(character)) {}
LocalController::~LocalController() = default;
LocalController::LocalController(LocalController&&) noexcept = default;
LocalController& LocalController::operator=(LocalController&&) noexcept = default;

StepStatus LocalController::step(CharacterState<double>& state, const Input& input, const StepContext<double>& context,
                                 const Find& find, StepReport<double>& report) {
  return impl_->advance(state, context, find, report,
                        [&](const Controller<double>& controller, CharacterState<double>& of, const auto& here,
                            double /*share*/, Scratch<double>& scratch,
                            StepReport<double>& result) { return controller.step(of, input, here, scratch, result); });
}

StepStatus LocalController::move(CharacterState<double>& state, const Vec2d& displacement,
                                 const StepContext<double>& context, const Find& find, StepReport<double>& report) {
  return impl_->advance(state, context, find, report,
                        [&](const Controller<double>& controller, CharacterState<double>& of, const auto& here,
                            double share, Scratch<double>& scratch, StepReport<double>& result) {
                          return controller.move(of, displacement * share, here, scratch, result);
                        });
}

std::optional<std::size_t> LocalController::overlaps(const Vec2d& position, const StepContext<double>& context,
                                                     const Find& find, bool at_end, std::span<ColliderIndex> found) {
  Impl& impl = *impl_;
  const Box2<double>& extent = impl.character().shape.box();
  if (!is_in_range({position, position})) return std::nullopt;
  impl.turned_.clear();
  impl.scenery.read({position + extent.lower, position + extent.upper}, context, find);
  if (!impl.scenery.build(at_end ? 1 : 0)) return std::nullopt;
  impl.motions.clear();
  for (const NearMover& mover : impl.scenery.movers()) {
    const Vec2d there = (at_end ? mover.motion.to : mover.motion.from).position;
    impl.motions.push_back({there, there});
  }
  const std::optional<std::size_t> count = impl.scenery.controller().overlaps(
      position, impl.scenery.context(context, impl.motions), impl.scenery.scratch(), found);
  impl.scenery.to_ids(found.first(std::min(count.value_or(0), found.size())));
  return count;
}

std::span<const TurnedCollider> LocalController::turned() const noexcept { return impl_->turned_; }
const Box2<double>& LocalController::reach() const noexcept { return impl_->scenery.reach(); }
void LocalController::set_reach(const Box2<double>& box) noexcept { impl_->scenery.set_reach(box); }
std::span<const ColliderIndex> LocalController::unusable() const noexcept { return impl_->scenery.unusable(); }
const CharacterDef& LocalController::character() const noexcept { return impl_->character(); }

}  // namespace paperproof
