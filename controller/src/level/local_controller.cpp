#include <paperproof/local_controller.hpp>

#include "level/poses.hpp"
#include "level/turn.hpp"
#include "step_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace paperproof {
namespace {

using namespace level;

/// How much wider than needed the box is that is read [m]. Zero: each step reads another one. Large: each change costs
/// more.
constexpr double read_ahead = 1.5;

/// Into so many shorter steps a step is divided at most.
constexpr int most_parts = 32;

/// The share of a part in which everything turns.
constexpr double turning_share = 1.0 / 64;

/// Scenery, and what steps through it.
struct Surroundings {
  Surroundings(const SceneryDef& def, const CharacterDef& character)
      : scenery(def), controller(scenery, character, {.broad_phase = BroadPhaseKind::all_pairs}) {}

  Scenery<double> scenery;
  Controller<double> controller;
  Scratch<double> scratch = controller.make_scratch();
};

/// A mover of some of the colliders that are near, and its number in their scenery.
struct NearMover {
  MoverIndex mover;
  PoseMotion motion;

  [[nodiscard]] double turn() const noexcept { return motion.to.angle - motion.from.angle; }
};

/// A part of a step, as fractions of it, and how what is near moves in it once everything has turned.
struct Part {
  double begin;
  double end;
  std::span<const MoverMotion<double>> motions;

  [[nodiscard]] double turned() const noexcept { return begin + (end - begin) * turning_share; }
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
std::vector<std::vector<Vec2d>> pieces_of(ColliderDef def) {
  def.mover = no_mover;
  const Scenery<double> scenery(SceneryDef{{std::move(def)}});
  std::vector<std::vector<Vec2d>> pieces;
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    const PieceVertices<double> vertices = scenery.vertices_of(piece);
    pieces.emplace_back(vertices.begin(), vertices.end());
  }
  return pieces;
}

/// A collider as it is built into scenery: turned, not moved.
ColliderDef turned_collider(const ColliderDef& def, double angle, MoverIndex mover) {
  ColliderDef result = def;
  result.mover = mover;
  if (angle == 0) return result;
  const auto turn = [angle](std::vector<Vec2d>& points) {
    for (Vec2d& point : points) point = rotated(point, angle);
  };
  turn(result.points);
  for (std::vector<Vec2d>& hole : result.holes) turn(hole);
  return result;
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

/// How bad a status is: that of a step is the worst of its parts.
int rank(MoveStatus status) noexcept {
  constexpr std::array order{MoveStatus::moved, MoveStatus::dropped, MoveStatus::stuck, MoveStatus::crushed};
  return static_cast<int>(std::find(order.begin(), order.end(), status) - order.begin());
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

/// A filter of colliders by their ids, for those of a scenery.
struct FilterOfIds {
  const ColliderFilter* filter = nullptr;
  std::span<const ColliderIndex> ids{};

  [[nodiscard]] ColliderFilter local() const noexcept {
    ColliderFilter result = *filter;
    result.user = this;
    if (filter->is_there != nullptr)
      result.is_there = [](ColliderIndex collider, const void* user) {
        const auto& self = *static_cast<const FilterOfIds*>(user);
        return self.filter->is_there(self.ids[collider], self.filter->user);
      };
    return result;
  }
};

}  // namespace

struct LocalController::Impl {
  explicit Impl(const CharacterDef& def) : character(def) { character.validate(); }

  // What is near, and scenery of it.
  [[nodiscard]] Box2<double> box_needed(const CharacterState<double>& state, const StepContext<double>& context) const;
  [[nodiscard]] bool contains(const MoveResult<double>& move) const;
  void read(const Box2<double>& needed, const Find& find);
  void build(double fraction);
  void place_in_order();
  [[nodiscard]] SceneryDef scenery_def() const;
  [[nodiscard]] const NearCollider& at(ColliderIndex collider) const noexcept { return near[order[collider]]; }
  [[nodiscard]] MoverIndex mover_of(const NearCollider& collider) const noexcept;
  [[nodiscard]] std::span<const MoverMotion<double>> straight_motions();

  // Colliders have indices in the scenery, and ids outside.
  [[nodiscard]] ColliderIndex local_of(ColliderIndex id) const noexcept;
  void to_local(CharacterState<double>& state) const;
  void to_ids(CharacterState<double>& state) const;
  void to_ids(StepReport<double>& report) const;
  [[nodiscard]] StepContext<double> local_context(StepContext<double> context,
                                                  std::span<const MoverMotion<double>> moving);

  template <class Go>
  StepStatus advance(CharacterState<double>& state, const StepContext<double>& context, const Find& find,
                     StepReport<double>& report, const Go& go);
  template <class Go>
  StepStatus step_among_turning(CharacterState<double>& state, const StepContext<double>& context,
                                StepReport<double>& report, const Go& go);
  template <class Go>
  [[nodiscard]] std::optional<StepStatus> step_in_parts(int parts, CharacterState<double>& state,
                                                        const StepContext<double>& context, StepReport<double>& report,
                                                        const Go& go);
  [[nodiscard]] int parts_for(const CharacterState<double>& state, const StepContext<double>& context) const;
  [[nodiscard]] Part turn(double begin, double end, const Vec2d& position);
  [[nodiscard]] Approach approach_of(MoverIndex mover, double fraction, const Vec2d& position) const;
  [[nodiscard]] bool is_proved(const Part& part, const MoveResult<double>& move, const StepContext<double>& context);
  [[nodiscard]] bool blocks(const NearCollider& collider, const StepContext<double>& context) const;
  [[nodiscard]] Pose turned_pose(const NearCollider& collider, const Part& part) const;
  void note_pushes(const Part& part, const StepContext<double>& context);
  void note_begin();
  void note_vertices(const Part& part);
  void append(const StepReport<double>& added, const Part& part, StepReport<double>& report) const;
  StepStatus go_straight_or_stay(CharacterState<double>& state, const StepContext<double>& context,
                                 StepReport<double>& report);
  void go_straight(double begin, const Vec2d& to, const CharacterState<double>& state,
                   const StepContext<double>& context, StepReport<double>& report);
  [[nodiscard]] std::optional<Vec2d> way_out_at_end(CharacterState<double> state, const StepContext<double>& context);
  [[nodiscard]] bool overlaps(const NearCollider& collider, const Pose& pose, const Vec2d& position);
  [[nodiscard]] bool reaches(const NearCollider& collider, const HullWay& way, double begin, double end);
  [[nodiscard]] const std::vector<std::vector<Vec2d>>& pieces(const NearCollider& collider);

  struct KnownPieces {
    ColliderIndex id;
    std::uint64_t version;
    std::vector<std::vector<Vec2d>> pieces;
  };

  CharacterDef character;
  Box2<double> box{Vec2d::Constant(1), Vec2d::Constant(-1)};  ///< That was read.
  std::vector<NearCollider> near;                             ///< In it, by id.
  std::vector<NearCollider> near_before;
  std::vector<NearMover> movers;  ///< Of them.
  bool any_turns = false;
  std::vector<std::size_t> order;  ///< Of the colliders of the scenery, in `near`.
  std::vector<ColliderIndex> ids;  ///< Of these.
  std::vector<ColliderIndex> unusable;
  std::vector<double> angles;  ///< Of the movers in the scenery.
  std::optional<Surroundings> surroundings;
  std::vector<MoverMotion<double>> motions;
  FilterOfIds filter_of_ids;
  ColliderFilter filter;
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
  const double acceleration = character.acceleration + character.air_acceleration.value_or(0) + context.gravity.norm();
  const double reach =
      (character.jump_speed + acceleration * dt) * dt + character.snap + character.step_height + 2 * most_turned;
  const Vec2d goes = state.position + (state.velocity + state.ride.velocity) * dt;
  const Box2<double> way{state.position.cwiseMin(goes), state.position.cwiseMax(goes)};
  const Box2<double>& extent = character.shape.box();
  return Box2<double>{way.lower + extent.lower, way.upper + extent.upper}.inflated(reach);
}

/// Whether everything was read that decides a move. A way out of solids may lead farther.
bool LocalController::Impl::contains(const MoveResult<double>& move) const {
  const double size = (character.shape.box().upper - character.shape.box().lower).maxCoeff() + 2 * most_turned;
  return std::all_of(move.path.begin(), move.path.end(), [&](const PathPoint<double>& corner) {
    return box.contains(Box2<double>{corner.position, corner.position}.inflated(size));
  });
}

void LocalController::Impl::read(const Box2<double>& needed, const Find& find) {
  const Vec2d spare = (box.upper - box.lower) - (needed.upper - needed.lower);
  if (!box.contains(needed) || spare.maxCoeff() > 4 * read_ahead) box = needed.inflated(read_ahead);
  near.swap(near_before);
  near.clear();
  find(box, near);
  const auto by_id = [](const NearCollider& a, const NearCollider& b) { return a.id < b.id; };
  if (!std::is_sorted(near.begin(), near.end(), by_id)) std::sort(near.begin(), near.end(), by_id);
  const auto same_id = [](const NearCollider& a, const NearCollider& b) { return a.id == b.id; };
  near.erase(std::unique(near.begin(), near.end(), same_id), near.end());
  const bool is_same = std::equal(near.begin(), near.end(), near_before.begin(), near_before.end(),
                                  [](const NearCollider& a, const NearCollider& b) {
                                    return a.id == b.id && a.version == b.version && a.mover == b.mover;
                                  });
  movers.clear();
  any_turns = false;
  for (const NearCollider& collider : near) {
    if (collider.mover == no_mover || mover_of(collider) < movers.size()) continue;
    movers.push_back({collider.mover, collider.motion});
    any_turns = any_turns || movers.back().turn() != 0;
  }
  if (!is_same || !surroundings) place_in_order();
}

MoverIndex LocalController::Impl::mover_of(const NearCollider& collider) const noexcept {
  if (collider.mover == no_mover) return no_mover;
  const auto known =
      std::find_if(movers.begin(), movers.end(), [&](const NearMover& mover) { return mover.mover == collider.mover; });
  return static_cast<MoverIndex>(known - movers.begin());
}

/// The order depends on what the colliders are, not on their ids: an edited level gives the bits of one that was built
/// at once.
void LocalController::Impl::place_in_order() {
  surroundings.reset();
  unusable.clear();
  order.resize(near.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::size_t i) {
    const NearCollider& collider = near[i];
    const Box2<double> extent = box_at(collider.def->points, {});
    return std::tuple(collider.mover + 1, extent.lower.x(), extent.lower.y(), extent.upper.x(), extent.upper.y(),
                      collider.def->points.size());
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
}

SceneryDef LocalController::Impl::scenery_def() const {
  SceneryDef def;
  for (const std::size_t i : order) {
    const MoverIndex mover = mover_of(near[i]);
    def.colliders.push_back(turned_collider(*near[i].def, mover == no_mover ? 0 : angles[mover], mover));
  }
  return def;
}

/// Makes scenery of what is near, with the angles at a fraction of the step. Colliders of no extent are left out.
void LocalController::Impl::build(double fraction) {
  std::vector<double> now;
  for (const NearMover& mover : movers) now.push_back(pose_at(mover.motion, fraction).angle);
  if (surroundings && now == angles) return;
  angles = std::move(now);
  for (surroundings.reset(); !surroundings;) {
    try {
      surroundings.emplace(scenery_def(), character);
    } catch (const InvalidScenery& refused) {
      unusable.push_back(at(refused.collider()).id);
      order.erase(order.begin() + refused.collider());
    }
  }
  ids.clear();
  for (const std::size_t i : order) ids.push_back(near[i].id);
}

ColliderIndex LocalController::Impl::local_of(ColliderIndex id) const noexcept {
  const auto found = std::find(ids.begin(), ids.end(), id);
  return found == ids.end() ? no_collider : static_cast<ColliderIndex>(found - ids.begin());
}

/// A collider that is gone carries and crushes no more.
void LocalController::Impl::to_local(CharacterState<double>& state) const {
  if (state.ride.ground != Ride<double>::none) {
    state.ride.ground = local_of(state.ride.ground);
    if (state.ride.ground == no_collider) state.ride = {};
  }
  const Crushers<double> known = state.crushers;
  state.crushers.clear();
  for (Crusher<double> crusher : known) {
    crusher.collider = local_of(crusher.collider);
    if (crusher.collider != no_collider) state.crushers.push_back(crusher);
  }
  state.crushed = state.crushed && !state.crushers.empty();
}

void LocalController::Impl::to_ids(CharacterState<double>& state) const {
  if (state.ride.ground != Ride<double>::none) state.ride.ground = ids[state.ride.ground];
  if (state.ground.collider != no_collider) state.ground.collider = ids[state.ground.collider];
  for (Crusher<double>& crusher : state.crushers) crusher.collider = ids[crusher.collider];
}

void LocalController::Impl::to_ids(StepReport<double>& report) const {
  MoveResult<double>& move = report.move;
  for (Contact<double>& contact : move.contacts) contact.collider = ids[contact.collider];
  for (ColliderIndex& collider : move.crushed) collider = ids[collider];
  for (Crusher<double>& crusher : move.crushers) crusher.collider = ids[crusher.collider];
  if (move.ground.state != GroundState::air) move.ground.collider = ids[move.ground.collider];
  if (move.ride.ground != Ride<double>::none) move.ride.ground = ids[move.ride.ground];
  for (SensorEvent<double>& event : report.sensors) event.sensor = ids[event.sensor];
  for (ColliderIndex& collider : report.dropped_through) collider = ids[collider];
}

StepContext<double> LocalController::Impl::local_context(StepContext<double> context,
                                                         std::span<const MoverMotion<double>> moving) {
  context.movers = moving.first(surroundings->scenery.mover_count());
  if (context.filter == nullptr) return context;
  filter_of_ids = {context.filter, ids};
  filter = filter_of_ids.local();
  context.filter = &filter;
  return context;
}

std::span<const MoverMotion<double>> LocalController::Impl::straight_motions() {
  motions.clear();
  for (const NearMover& mover : movers) motions.push_back({mover.motion.from.position, mover.motion.to.position});
  return motions;
}

template <class Go>
StepStatus LocalController::Impl::advance(CharacterState<double>& state, const StepContext<double>& context,
                                          const Find& find, StepReport<double>& report, const Go& go) {
  const CharacterState<double> before = state;
  Box2<double> needed = box_needed(state, context);
  // Written so that NaN is refused.
  if (!(context.dt > 0 && needed.lower.cwiseAbs().maxCoeff() < 1e8 && needed.upper.cwiseAbs().maxCoeff() < 1e8))
    return report.status = StepStatus::invalid_input;
  for (;;) {
    turned_.clear();
    read(needed, find);
    if (!any_turns) build(1);
    state = before;
    StepStatus status{};
    if (any_turns) {
      status = step_among_turning(state, context, report, go);
    } else {
      to_local(state);
      status = go(surroundings->controller, state, local_context(context, straight_motions()), 1.0,
                  surroundings->scratch, report);
      if (status != StepStatus::invalid_input) to_ids(report);
      to_ids(state);
    }
    if (step_parts::is_refused(status)) {
      state = before;
      return status;
    }
    if (contains(report.move)) return status;
    for (const PathPoint<double>& corner : report.move.path)
      needed = needed.merged(Box2<double>{corner.position, corner.position}.inflated(
          2 * (character.shape.box().upper - character.shape.box().lower).maxCoeff() + 1));
  }
}

/// Into how many shorter steps a step must be divided.
int LocalController::Impl::parts_for(const CharacterState<double>& state, const StepContext<double>& context) const {
  const Box2<double>& extent = character.shape.box();
  const double size = (extent.upper - extent.lower).norm();
  const Box2<double> needed = box_needed(state, context);
  const double reach = (needed.upper - needed.lower).norm();
  double most = 0;
  for (MoverIndex i = 0; i < movers.size(); ++i) {
    const double way = (movers[i].motion.to.position - movers[i].motion.from.position).norm();
    if (movers[i].turn() == 0 || approach_of(i, 0, state.position).distance > reach + way) continue;
    most = std::max(most, std::abs(movers[i].turn()) * size);
  }
  int parts = 1;
  while (parts < most_parts && most > most_turned * parts) parts *= 2;
  return parts;
}

/// Where the nearest of a mover's colliders is nearest to the character.
Approach LocalController::Impl::approach_of(MoverIndex mover, double fraction, const Vec2d& position) const {
  Approach best{std::numeric_limits<double>::infinity(), {0, 1}};
  for (const NearCollider& collider : near) {
    if (mover_of(collider) != mover || collider.def->sensor) continue;
    const std::vector<Vec2d> outline = vertices_at(*collider.def, pose_at(collider.motion, fraction));
    const bool closed = collider.def->shape == ColliderDef::Shape::polygon;
    const Approach here =
        nearest(std::span(outline).first(collider.def->points.size()), closed, character.shape.hull(), position);
    if (here.distance < best.distance) best = here;
  }
  return best;
}

/// Turns everything by its angle in a part of the step, and says how it goes on from there. A mover turns about the
/// corner of the character that will be nearest to it then: what carries the character turns under its foot.
Part LocalController::Impl::turn(double begin, double end, const Vec2d& position) {
  motions.clear();
  for (MoverIndex i = 0; i < movers.size(); ++i) {
    const Pose from = pose_at(movers[i].motion, begin);
    const Pose to = pose_at(movers[i].motion, end);
    const double angle = to.angle - from.angle;
    if (angle == 0) {
      motions.push_back({from.position, to.position});
      continue;
    }
    const Vec2d normal = approach_of(i, begin, position).normal;
    const Vec2d pivot = position + nearest_corner(character.shape.hull(), normal, rotated(normal, angle));
    motions.push_back({pivot - rotated(pivot - from.position, angle), to.position});
  }
  build(end);
  return {begin, end, motions};
}

Pose LocalController::Impl::turned_pose(const NearCollider& collider, const Part& part) const {
  return {part.motions[mover_of(collider)].from, pose_at(collider.motion, part.end).angle};
}

/// Whether a collider can be in the way, and has a proof. @param context of the step, whose filter knows ids.
bool LocalController::Impl::blocks(const NearCollider& collider, const StepContext<double>& context) const {
  const ColliderDef& def = *collider.def;
  if (def.sensor || def.one_way || std::find(ids.begin(), ids.end(), collider.id) == ids.end()) return false;
  const ColliderFilter wanted = context.filter == nullptr ? ColliderFilter{} : *context.filter;
  return collide(wanted, def.filter) && (wanted.is_there == nullptr || wanted.is_there(collider.id, wanted.user));
}

const std::vector<std::vector<Vec2d>>& LocalController::Impl::pieces(const NearCollider& collider) {
  const auto is_it = [&](const KnownPieces& known) {
    return known.id == collider.id && known.version == collider.version;
  };
  const auto known = std::find_if(known_pieces.begin(), known_pieces.end(), is_it);
  if (known != known_pieces.end()) return known->pieces;
  if (known_pieces.size() > 2 * near.size()) known_pieces.clear();
  known_pieces.push_back({collider.id, collider.version, pieces_of(*collider.def)});
  return known_pieces.back().pieces;
}

/// Whether a collider overlaps the character by more than rounding.
bool LocalController::Impl::overlaps(const NearCollider& collider, const Pose& pose, const Vec2d& position) {
  const std::vector<std::vector<Vec2d>>& all = pieces(collider);
  return std::any_of(all.begin(), all.end(), [&](const std::vector<Vec2d>& piece) {
    const std::vector<Vec2d> here = placed(piece, pose);
    return !stay_apart({character.shape.hull(), position, position}, {here, here}, -proved);
  });
}

/// Whether the character stayed clear of everything that turned at the beginning of a part. What overlapped it before,
/// or crushed it, it may leave.
/// @param move in the part; colliders by index.
bool LocalController::Impl::is_proved(const Part& part, const MoveResult<double>& move,
                                      const StepContext<double>& context) {
  std::vector<Vec2d> way;
  for (const PathPoint<double>& corner : move.path)
    if (corner.fraction == 0) way.push_back(corner.position);
  if (way.size() == 1) way.push_back(way[0]);
  const std::span<const Vec2d> hull = character.shape.hull();
  for (ColliderIndex i = 0; i < order.size(); ++i) {
    const NearCollider& collider = at(i);
    if (collider.mover == no_mover || movers[mover_of(collider)].turn() == 0 || !blocks(collider, context)) continue;
    if (std::find(move.crushed.begin(), move.crushed.end(), i) != move.crushed.end()) continue;
    const Pose from = pose_at(collider.motion, part.begin);
    const Pose to = turned_pose(collider, part);
    if (overlaps(collider, from, way[0])) continue;
    const auto legs = static_cast<double>(way.size() - 1);
    for (const std::vector<Vec2d>& piece : pieces(collider)) {
      const PieceWay whole = {placed(piece, from), placed(piece, to)};
      for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {
        PieceWay piece_way = whole;
        for (std::size_t v = 0; v < piece.size(); ++v) {
          piece_way.from[v] = between(whole.from[v], whole.to[v], static_cast<double>(leg) / legs);
          piece_way.to[v] = between(whole.from[v], whole.to[v], static_cast<double>(leg + 1) / legs);
        }
        if (!stay_apart({hull, way[leg], way[leg + 1]}, piece_way, proved)) return false;
      }
    }
  }
  return true;
}

/// Reports what pushed the character when it turned, as contacts at the beginning of a part.
void LocalController::Impl::note_pushes(const Part& part, const StepContext<double>& context) {
  MoveResult<double>& move = of_part->move;
  if (move.path.size() < 2 || move.path[1].fraction > 0) return;
  std::size_t last = 1;
  while (last + 1 < move.path.size() && move.path[last + 1].fraction == 0) ++last;
  std::array<Contact<double>, MoveResult<double>::max_contacts> touched;
  const std::size_t count =
      surroundings->controller.contacts_at(move.path[last].position, Tolerances<double>{}.touch,
                                           local_context(context, part.motions), surroundings->scratch, touched);
  for (std::size_t i = 0; i < count; ++i) {
    const NearCollider& collider = at(touched[i].collider);
    const auto is_known = [&](const Contact<double>& contact) { return contact.collider == touched[i].collider; };
    if (collider.mover == no_mover || movers[mover_of(collider)].turn() == 0) continue;
    if (std::none_of(move.contacts.begin(), move.contacts.end(), is_known))
      move.contacts.push_back(touched[i], more_contacts);
  }
}

/// Where everything that moves is when the step begins.
void LocalController::Impl::note_begin() {
  turned_.clear();
  for (const NearCollider& collider : near)
    if (collider.mover != no_mover)
      turned_.push_back({collider.id, {0}, {vertices_at(*collider.def, collider.motion.from)}});
}

void LocalController::Impl::note_vertices(const Part& part) {
  std::size_t next = 0;
  for (const NearCollider& collider : near) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    way.instants.insert(way.instants.end(), {part.turned(), part.end});
    way.vertices.push_back(vertices_at(*collider.def, turned_pose(collider, part)));
    way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, part.end)));
  }
}

/// Adds a part to the report of the step. @param added names colliders by ids.
void LocalController::Impl::append(const StepReport<double>& added, const Part& part,
                                   StepReport<double>& report) const {
  const MoveResult<double>& from = added.move;
  MoveResult<double>& to = report.move;
  const auto when = [&](double fraction) {
    return fraction < 1 ? part.turned() + (part.end - part.turned()) * fraction : part.end;
  };
  const auto turning = static_cast<std::size_t>(
      std::count_if(from.path.begin(), from.path.end(), [](const PathPoint<double>& p) { return p.fraction == 0; }));
  if (to.path.empty()) to.path.push_back({from.path[0].position, 0}, more_corners);
  if (turning == 1) to.path.push_back({from.path[0].position, part.turned()}, more_corners);
  for (std::size_t i = 1; i < from.path.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(turning - 1);
    const double fraction =
        i < turning ? part.begin + (part.turned() - part.begin) * share : when(from.path[i].fraction);
    to.path.push_back({from.path[i].position, i + 1 == turning ? part.turned() : fraction}, more_corners);
  }
  for (Contact<double> contact : from.contacts) {
    contact.fraction = when(contact.fraction);
    to.contacts.push_back(contact, more_contacts);
  }
  for (const ColliderIndex collider : from.crushed)
    if (std::find(to.crushed.begin(), to.crushed.end(), collider) == to.crushed.end())
      to.crushed.push_back(collider, more_crushed);
  for (SensorEvent<double> event : added.sensors) {
    event.fraction = when(event.fraction);
    report.sensors.push_back(event);
  }
  for (const ColliderIndex collider : added.dropped_through)
    if (std::find(report.dropped_through.begin(), report.dropped_through.end(), collider) ==
        report.dropped_through.end())
      report.dropped_through.push_back(collider);
  if (part.begin == 0) {
    report.requested = added.requested / part.end;
    report.steered = added.steered / part.end;
  }
  if (rank(from.status) > rank(to.status)) to.status = from.status;
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
    if (!status || report.move.crushed.empty()) return status;
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
  note_begin();
  StepContext<double> shorter = context;
  shorter.dt = context.dt / parts;
  for (int i = 0; i < parts; ++i) {
    const Part part = turn(double(i) / parts, double(i + 1) / parts, state.position);
    to_local(state);
    if (state.ride.ground != Ride<double>::none) {
      const MoverIndex mover = mover_of(at(state.ride.ground));
      if (mover != no_mover && movers[mover].turn() != 0) state.ride.place = state.position - part.motions[mover].from;
    }
    for (Crusher<double>& crusher : state.crushers) {
      const NearCollider& collider = at(crusher.collider);
      carry(crusher, pose_at(collider.motion, part.begin), turned_pose(collider, part));
    }
    const StepStatus status = go(surroundings->controller, state, local_context(shorter, part.motions), 1.0 / parts,
                                 surroundings->scratch, *of_part);
    if (step_parts::is_refused(status)) return report.status = status;
    if (!is_proved(part, of_part->move, context)) return std::nullopt;
    note_pushes(part, shorter);
    to_ids(*of_part);
    to_ids(state);
    note_vertices(part);
    append(*of_part, part, report);
    if (report.move.crushed.empty() || i + 1 == parts) continue;
    // It stays where it was crushed until the next step.
    go_straight(part.end, state.position, state, context, report);
    step_parts::adopt(character, context.up, report.move, state);
    break;
  }
  return report.status;
}

/// Whether a collider may reach a character that goes its way within a part of the step.
bool LocalController::Impl::reaches(const NearCollider& collider, const HullWay& way, double begin, double end) {
  const Pose before = pose_at(collider.motion, begin);
  const Pose after = pose_at(collider.motion, end);
  const std::vector<std::vector<Vec2d>>& all = pieces(collider);
  return std::any_of(all.begin(), all.end(), [&](const std::vector<Vec2d>& piece) {
    return !stay_apart(way, {placed(piece, before), placed(piece, after)}, proved);
  });
}

/// The rest of a step, in which the character goes straight to a place, and everything that moves turns evenly. What
/// may reach the character crushes it.
/// @param begin as a fraction of the step; what is before it stands in the report.
void LocalController::Impl::go_straight(double begin, const Vec2d& to, const CharacterState<double>& state,
                                        const StepContext<double>& context, StepReport<double>& report) {
  MoveResult<double>& move = report.move;
  move.position = to;
  move.velocity.setZero();
  move.grounded = false;
  move.ground = {};
  move.ride = {};
  move.crushers.clear();
  if (move.path.empty()) move.path.push_back({state.position, 0});
  move.path.push_back({to, 1}, more_corners);
  if (begin == 0) note_begin();
  std::size_t next = 0;
  for (const NearCollider& collider : near) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    const Pose from = pose_at(collider.motion, begin);
    bool is_reached = false;
    double last = begin;
    for (int part = 1; part <= most_parts; ++part) {
      const double end = part < most_parts ? begin + (1 - begin) * part / most_parts : 1;
      way.instants.push_back(end);
      way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, end)));
      const HullWay leg{character.shape.hull(), between(state.position, to, (last - begin) / (1 - begin)),
                        between(state.position, to, (end - begin) / (1 - begin))};
      is_reached = is_reached || reaches(collider, leg, last, end);
      last = end;
    }
    if (!is_reached || !blocks(collider, context)) continue;
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
  build(1);
  motions.clear();
  for (const NearMover& mover : movers) motions.push_back({mover.motion.to.position, mover.motion.to.position});
  to_local(state);
  state.ride = {};
  const StepStatus status =
      surroundings->controller.move(state, {0, 0}, local_context(context, motions), surroundings->scratch, *of_part);
  if (status != StepStatus::moved) return std::nullopt;
  return of_part->move.position;
}

/// A step for a character that no division of the step brings to a free position. It goes straight to one, if it can;
/// else it stays in place.
StepStatus LocalController::Impl::go_straight_or_stay(CharacterState<double>& state, const StepContext<double>& context,
                                                      StepReport<double>& report) {
  const std::optional<Vec2d> out = way_out_at_end(state, context);
  MoveResult<double>& move = report.move;
  clear(report);
  if (out) go_straight(0, *out, state, context, report);
  if (!out || !move.crushed.empty() || !move.crushers.empty()) {
    clear(report);
    go_straight(0, state.position, state, context, report);
    move.status = move.crushed.empty() ? MoveStatus::stuck : MoveStatus::crushed;
  }
  step_parts::adopt(character, context.up, move, state);
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
  const Box2<double>& extent = impl.character.shape.box();
  impl.turned_.clear();
  impl.read({position + extent.lower, position + extent.upper}, find);
  impl.build(at_end ? 1 : 0);
  impl.motions.clear();
  for (const NearMover& mover : impl.movers) {
    const Vec2d there = (at_end ? mover.motion.to : mover.motion.from).position;
    impl.motions.push_back({there, there});
  }
  const std::optional<std::size_t> count = impl.surroundings->controller.overlaps(
      position, impl.local_context(context, impl.motions), impl.surroundings->scratch, found);
  for (std::size_t i = 0; i < std::min(count.value_or(0), found.size()); ++i) found[i] = impl.ids[found[i]];
  return count;
}

std::span<const TurnedCollider> LocalController::turned() const noexcept { return impl_->turned_; }
std::span<const ColliderIndex> LocalController::unusable() const noexcept { return impl_->unusable; }
const CharacterDef& LocalController::character() const noexcept { return impl_->character; }

}  // namespace paperproof
