#include "turning/turning_step.hpp"

#include <algorithm>

namespace paperproof::turning {

using geometry::Pose;
using geometry::pose_at;

namespace {

/// The motion of a circle's centre, as its offset; with the angles of its mover.
MoverMotion motion_of_centre(const Vec2d& centre, const MoverMotion& mover) {
  const auto offset = [&](const Pose& pose) {
    return Vec2d(pose.position + geometry::Turn(pose.angle)(centre) - centre);
  };
  return {offset(pose_at(mover, 0)), offset(pose_at(mover, 1)), mover.from_angle, mover.to_angle};
}

}  // namespace

TurningStep::TurningStep(const Controller& controller, const StepContext& context, Scratch& scratch, StepReport& report)
    : controller_(controller),
      scenery_(*controller.scenery_),
      context_(context),
      filter_(context.filter == nullptr ? ColliderFilter{} : *context.filter),
      scratch_(scratch),
      memory_(memory_of(scratch)),
      report_(report) {
  context_.movers = context.movers.first(scenery_.mover_count());
  bodies_ = context.movers.subspan(scenery_.mover_count(), memory_.bodies.size());
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
  memory_.turns.assign(context_.movers.size(), false);
  memory_.moving.clear();
  memory_.motions_apart.assign(bodies_.begin(), bodies_.end());
  memory_.apart = memory_.bodies;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (geometry::swept_box(scenery_.box(memory_.apart[i]), bodies_[i]).overlaps(needed))
      memory_.moving.push_back({scenery_.pieces()[memory_.apart[i]].collider, its_character, bodies_[i], true});
  for (MoverIndex mover = 0; mover < context_.movers.size(); ++mover) {
    const MoverMotion& motion = context_.movers[mover];
    const Scenery::Group& group = scenery_.group_of(mover);
    memory_.pieces.clear();
    for (const PieceGrid* grid : {&group.solids, &group.sensors})
      if (geometry::swept_box(grid->whole(), motion).overlaps(needed))
        grid->find(grid->whole(), scenery_.boxes(), memory_.pieces);
    std::ranges::sort(memory_.pieces);  // the pieces of a collider follow each other
    ColliderIndex last = no_collider;
    for (const PieceIndex piece : memory_.pieces) {
      if (!geometry::swept_box(scenery_.box(piece), motion).overlaps(needed)) continue;
      const PieceInfo& info = scenery_.pieces()[piece];
      MovingCollider collider{info.collider, mover, motion, info.is_circle() && motion.has_angle()};
      if (collider.by_itself) {
        const MoverMotion& centre =
            memory_.motions_apart.emplace_back(motion_of_centre(scenery_.circle(piece).centre, motion));
        memory_.apart.push_back(piece);
        collider.motion = {centre.from, centre.to};
      }
      if (info.collider != last) memory_.moving.push_back(collider);
      last = info.collider;
      if (collider.motion.turn() != 0 && !info.sensor && is_there(info.collider)) memory_.turns[mover] = true;
    }
  }
  std::ranges::sort(memory_.moving, {}, &MovingCollider::id);
}

std::span<const MoverMotion> TurningStep::hold_angles(const Box2& around) {
  std::vector<MoverMotion>& motions = memory_.motions;
  motions.assign(context_.movers.begin(), context_.movers.end());
  for (MoverMotion& motion : motions) motion.to_angle = motion.from_angle;
  context_.movers = motions;
  read(around.inflated(Controller::most_turned));
  for (const MoverMotion& motion : memory_.motions_apart) motions.push_back({motion.from, motion.to});
  return motions;
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

StepStatus TurningStep::go(CharacterState& state, const Wish& wish, double share, StepReport& report) {
  StepContext context = context_;
  context.dt *= share;
  context.movers = memory_.motions;
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
    const bool any_turns = std::ranges::find(memory_.turns, true) != memory_.turns.end();
    const StepStatus status = any_turns ? step_among_turning(state, wish) : step_straight(state, wish);
    if (is_refused(status)) {
      state = before;
      return status;
    }
    const Box2 way = controller_.reach(report_.move);
    if (needed.contains(way)) return status;
    state = before;
    needed = needed.merged(way.inflated(needed.size().maxCoeff()));
  }
}

/// Where no solid that is near turns. A sensor may.
StepStatus TurningStep::step_straight(CharacterState& state, const Wish& wish) {
  const Part whole = turn(0, 1, state.position);
  const Vec2d from = state.position;
  const StepStatus status = go(state, wish, 1, report_);
  if (is_refused(status)) return status;
  note_turned_sensors(whole, from, report_);
  if (std::ranges::none_of(memory_.moving, [&](const auto& each) { return is_turning_sensor(each); })) return status;
  note_begin();
  note_vertices(whole.turned(), &whole);
  note_vertices(whole.end);
  return status;
}

/// Reports a step that is refused.
StepStatus TurningStep::refuse(StepStatus why, const CharacterState& state) {
  memory_.turned.clear();
  report_.clear();
  step_parts::refuse(why, state.position, state.velocity, state.ride, report_.move);
  return report_.status = why;
}

/// Tries as many parts as the turn wants, then more of them, then fewer.
StepStatus TurningStep::step_among_turning(CharacterState& state, const Wish& wish) {
  const CharacterState before = state;
  const bool is_inside = before.crushed || before.stuck_steps > 0;  // other divisions would not free it
  const int usual = parts_wanted();
  const auto next = [&](int parts) { return parts < usual ? parts / 2 : parts < most_parts ? 2 * parts : usual / 2; };
  std::optional<int> crushing;  // so many parts can be proved, but crush the character
  for (int parts = usual; parts > 0; parts = next(parts)) {
    const std::optional<StepStatus> status = step_in_parts(parts, state, wish);
    if (status && (is_inside || report_.move.crushed.empty())) return *status;
    if (status && !crushing) crushing = parts;
    state = before;
  }
  const StepStatus status = go_straight_or_stay(state);
  if (!crushing || status == StepStatus::moved) return status;
  state = before;
  return *step_in_parts(*crushing, state, wish);
}

/// What the character rides, and what crushed it, has turned about a pivot.
void TurningStep::begin_part(const Part& part, CharacterState& state) const {
  if (const MovingCollider* ground = find_moving(state.ride.ground);
      ground != nullptr && !ground->by_itself && memory_.turns[ground->mover])
    state.ride.place = state.position - memory_.motions[ground->mover].from;
  for (Crusher& crusher : state.crushers)
    if (const MovingCollider* collider = find_moving(crusher.collider))
      carry(crusher, pose_at(collider->motion, part.begin), turned_pose(*collider, part));
}

StepStatus TurningStep::end(CharacterState& state) {
  step_parts::adopt(character(), context_.up, report_.move, state);
  return report_.status = report_.move.status;
}

/// @return nothing if the step cannot be proved; it is not complete then.
std::optional<StepStatus> TurningStep::step_in_parts(int parts, CharacterState& state, const Wish& wish) {
  StepReport& of_part = memory_.of_part;
  report_.clear();
  const CharacterState before = state;
  double push = Tolerances{}.push;  // what is left of it
  note_begin();
  for (int i = 0; i < parts; ++i) {
    Part part = turn(double(i) / parts, double(i + 1) / parts, state.position);
    begin_part(part, state);
    const Vec2d from = state.position;
    memory_.limits = limits_of(push, parts, state);
    const Vec2d carried = state.ride.velocity * context_.dt / parts;
    const StepStatus status = go(state, wish, 1.0 / parts, of_part);
    if (status == StepStatus::invalid_input) return report_.status = status;
    if (is_refused(status)) return refuse(of_part.move.status, before);
    if (!find_way(part, of_part.move)) return std::nullopt;
    note_pushes(part);
    push = std::max(0.0, push - pushed_in(part, of_part.move, (of_part.requested + carried).norm()));
    note_turned_sensors(part, from, of_part);
    note_vertices(part.turned(), &part);
    note_vertices(part.end);
    append(of_part, part);
    if (report_.move.crushed.empty() || i + 1 == parts) continue;
    // It stays where it was crushed until the next step.
    go_straight(part.end, part.end, state.position, state);
    return end(state);
  }
  return report_.status;
}

}  // namespace paperproof::turning
