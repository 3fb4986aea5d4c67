#include "turning/turning_step.hpp"

#include <algorithm>

namespace paperproof::turning {

using geometry::Pose;
using geometry::pose_at;

namespace {

/// Finds the solids and sensors of a mover, if some of them may come into a box.
void find_pieces(const Scenery& scenery, MoverIndex mover, const MoverMotion& motion, const Box2& box,
                 std::vector<PieceIndex>& found) {
  found.clear();
  const Scenery::Group& group = scenery.group_of(mover);
  for (const PieceGrid* grid : {&group.solids, &group.sensors})
    if (geometry::swept_box(grid->whole(), motion).overlaps(box)) grid->find(grid->whole(), scenery.boxes(), found);
}

}  // namespace

MoverMotion motion_of_centre(const Vec2d& centre, const MoverMotion& mover) noexcept {
  const auto offset = [&](const Pose& pose) {
    return Vec2d(pose.position + geometry::Turn(pose.angle)(centre) - centre);
  };
  return {offset(pose_at(mover, 0)), offset(pose_at(mover, 1)), mover.from_angle, mover.to_angle};
}

CirclesOfQuestion::CirclesOfQuestion(const Scenery& scenery, const Box2& around, StepContext& context, Memory& memory)
    : memory_(memory) {
  if (!step_parts::any_angle(context.movers)) return;
  memory.motions.assign(context.movers.begin(), context.movers.end());
  memory.motions.resize(scenery.mover_count());
  for (MoverMotion& motion : memory.motions) motion.to_angle = motion.from_angle;
  for (MoverIndex mover = 0; mover < scenery.mover_count(); ++mover) {
    const MoverMotion motion = memory.motions[mover];
    if (motion.from_angle == 0) continue;
    find_pieces(scenery, mover, motion, around, memory.pieces);
    for (const PieceIndex piece : memory.pieces) {
      if (!scenery.pieces()[piece].is_circle()) continue;
      memory.circles.push_back(piece);
      memory.motions.push_back(motion_of_centre(scenery.circle(piece).centre, motion));
      memory.motions.back().from_angle = memory.motions.back().to_angle = 0;
    }
  }
  context.movers = memory.motions;
}

TurningStep::TurningStep(const Controller& controller, const StepContext& context, Scratch& scratch, StepReport& report)
    : controller_(controller),
      scenery_(*controller.scenery_),
      context_(context),
      filter_(context.filter == nullptr ? ColliderFilter{} : *context.filter),
      scratch_(scratch),
      memory_(memory_of(scratch)),
      report_(report) {
  context_.movers = context.movers.first(scenery_.mover_count());
  memory_.is_in_part = true;
}

bool TurningStep::is_there(ColliderIndex collider) const { return filter_(scenery_, collider); }

/// Whether a collider can be in the way, and has a proof.
bool TurningStep::blocks(ColliderIndex collider) const {
  const ColliderInfo& info = scenery_.collider(collider);
  return !info.sensor && !info.one_way && is_there(collider);
}

/// Notes what may come into a box during the step. What turns beside it does not count, so that the number of parts
/// depends on the state alone.
void TurningStep::read(const Box2& needed) {
  needed_ = needed;
  any_turns_ = any_sensor_turns_ = false;
  memory_.turns.assign(context_.movers.size(), false);
  memory_.moving.clear();
  memory_.circle_motions.clear();
  memory_.circles.clear();
  for (MoverIndex mover = 0; mover < context_.movers.size(); ++mover) read(mover, needed);
  std::sort(memory_.moving.begin(), memory_.moving.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

void TurningStep::read(MoverIndex mover, const Box2& needed) {
  const MoverMotion& motion = context_.movers[mover];
  find_pieces(scenery_, mover, motion, needed, memory_.pieces);
  std::sort(memory_.pieces.begin(), memory_.pieces.end());  // the pieces of a collider follow each other
  ColliderIndex last = no_collider;
  for (const PieceIndex piece : memory_.pieces) {
    if (!geometry::swept_box(scenery_.box(piece), motion).overlaps(needed)) continue;
    const PieceInfo& info = scenery_.pieces()[piece];
    const bool by_itself = info.is_circle() && motion.has_angle();
    MovingCollider collider{info.collider, mover, motion, by_itself};
    if (by_itself) {
      collider.motion = motion_of_centre(scenery_.circle(piece).centre, motion);
      memory_.circles.push_back(piece);
      memory_.circle_motions.push_back(collider.motion);
      collider.motion.from_angle = collider.motion.to_angle = 0;
    }
    if (info.collider != last) memory_.moving.push_back(collider);
    last = info.collider;
    if (collider.motion.turn() == 0) continue;
    any_sensor_turns_ = any_sensor_turns_ || info.sensor;
    if (!info.sensor && is_there(info.collider)) memory_.turns[mover] = any_turns_ = true;
  }
}

/// A collider that is gone carries and crushes no more.
void TurningStep::forget_gone(CharacterState& state) const {
  if (state.ride.ground != Ride::none && !scenery_.has(state.ride.ground)) state.ride = {};
  const Crushers known = state.crushers;
  if (known.empty()) return;
  state.crushers.clear();
  for (const Crusher& crusher : known)
    if (scenery_.has(crusher.collider)) state.crushers.push_back(crusher);
  state.crushed = state.crushed && !state.crushers.empty();
}

StepStatus TurningStep::go(CharacterState& state, const Wish& wish, double share, std::span<const MoverMotion> motions,
                           StepReport& report) {
  StepContext context = context_;
  context.dt *= share;
  context.movers = motions;
  if (wish.input != nullptr) return controller_.step(state, *wish.input, context, scratch_, report);
  return controller_.move(state, wish.displacement * share, context, scratch_, report);
}

StepStatus TurningStep::step(CharacterState& state, const Wish& wish) {
  const CharacterState before = state;
  Box2 needed = controller_.reach(state, context_);
  for (;;) {  // 27 times at most: `needed` doubles, from 4 * most_turned or more, until it has the whole range
    memory_.turned.clear();
    read(needed);
    forget_gone(state);
    const StepStatus status = any_turns_ ? step_among_turning(state, wish) : step_straight(state, wish);
    if (is_refused(status)) {
      state = before;
      return status;
    }
    const Box2 way = controller_.reach(report_.move);
    if (needed.contains(way)) return status;
    state = before;
    needed = needed.merged(way.inflated((needed.upper - needed.lower).maxCoeff()));
  }
}

/// Where nothing near turns.
StepStatus TurningStep::step_straight(CharacterState& state, const Wish& wish) {
  const Part whole = turn(0, 1, state.position);
  const Vec2d from = state.position;
  const StepStatus status = go(state, wish, 1, whole.motions, report_);
  if (!is_refused(status)) note_turned_sensors(whole, from, report_);
  return status;
}

/// Reports a step that is refused.
StepStatus TurningStep::refuse(MoveStatus why, const CharacterState& state) {
  memory_.turned.clear();
  report_.clear();
  MoveResult& move = report_.move;
  move.status = why;
  move.position = state.position;
  move.velocity = state.velocity;
  move.ride = state.ride;
  move.path.push_back({state.position, 0});
  move.path.push_back({state.position, 1});
  return report_.status = step_parts::status_of(why);
}

StepStatus TurningStep::step_among_turning(CharacterState& state, const Wish& wish) {
  const CharacterState before = state;
  const int usual = parts_wanted();
  std::optional<int> crushing;  // so many parts can be proved, but crush the character
  const auto try_parts = [&](int parts) -> std::optional<StepStatus> {
    state = before;
    const std::optional<StepStatus> status = step_in_parts(parts, state, wish);
    const bool is_inside = before.crushed || before.stuck_steps > 0;  // other divisions would not free it
    if (!status || report_.move.crushed.empty() || is_inside) return status;
    if (!crushing) crushing = parts;
    return std::nullopt;
  };
  for (int parts = usual; parts <= most_parts; parts *= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  for (int parts = usual / 2; parts > 0; parts /= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  state = before;
  const StepStatus status = go_straight_or_stay(state);
  if (!crushing || status == StepStatus::moved) return status;
  state = before;
  return *step_in_parts(*crushing, state, wish);
}

/// What the character rides, and what crushed it, has turned about a pivot.
void TurningStep::begin_part(const Part& part, CharacterState& state) const {
  if (const MovingCollider* ground = find_moving(state.ride.ground);
      ground != nullptr && !ground->by_itself && memory_.turns[ground->mover])
    state.ride.place = state.position - part.motions[ground->mover].from;
  for (Crusher& crusher : state.crushers)
    if (const MovingCollider* collider = find_moving(crusher.collider))
      carry(crusher, middle(), pose_at(collider->motion, part.begin), turned_pose(*collider, part));
}

/// @return nothing if the step cannot be proved; it is not complete then.
std::optional<StepStatus> TurningStep::step_in_parts(int parts, CharacterState& state, const Wish& wish) {
  StepReport& of_part = memory_.of_part;
  report_.clear();
  const CharacterState before = state;
  const double dt = context_.dt / parts;
  note_begin();
  for (int i = 0; i < parts; ++i) {
    Part part = turn(double(i) / parts, double(i + 1) / parts, state.position);
    begin_part(part, state);
    const Vec2d from = state.position;
    const Vec2d carried = state.ride.velocity;
    const StepStatus status = go(state, wish, 1.0 / parts, part.motions, of_part);
    if (status == StepStatus::invalid_input) return report_.status = status;
    if (is_refused(status)) return refuse(of_part.move.status, before);
    if (!find_way(part, of_part.move)) return std::nullopt;
    note_pushes(part);
    limit_speed(part, (of_part.requested / dt + carried).norm(), dt, of_part.move, state);
    note_turned_sensors(part, from, of_part);
    note_vertices(part);
    append(of_part, part);
    if (report_.move.crushed.empty() || i + 1 == parts) continue;
    // It stays where it was crushed until the next step.
    go_straight(part.end, part.end, state.position, state);
    step_parts::adopt(character(), context_.up, report_.move, state);
    break;
  }
  return report_.status;
}

}  // namespace paperproof::turning
