#include "crowd/stepper_impacts.hpp"
#include "step_parts.hpp"

namespace paperproof::crowd {
namespace {

template <class Scalar>
SceneryDef with_places_for_company(const Scenery<Scalar>& scene, const CharacterShape& shape) {
  SceneryDef def = scene.as_run();
  ColliderDef place{.points = {shape.hull().begin(), shape.hull().end()}, .carries = false};
  for (std::size_t k = 0; k < most_company; ++k) {
    place.mover = static_cast<MoverIndex>(scene.mover_count() + k);
    def.colliders.push_back(place);
  }
  return def;
}

}  // namespace

template <class Scalar>
Surrounded<Scalar>::Surrounded(const Scenery<Scalar>& scene, const CharacterShape& shape)
    : scenery(with_places_for_company(scene, shape)),
      first_companion(static_cast<ColliderIndex>(scene.collider_count())) {}

template <class Scalar>
Stepper<Scalar>::Stepper(const Controller<Scalar>& controller, const Surrounded<Scalar>& surrounded,
                         const CrowdRules<Scalar>& rules, WalkerMemory<Scalar>& memory, Scratch<Scalar>& scratch,
                         CrowdReport<Scalar>& report, std::size_t count, const Vec2<Scalar>& gravity, Scalar dt,
                         std::span<const MoverMotion<Scalar>> movers) noexcept
    : controller_(controller),
      sweep_(*rules.sweep),
      surrounded_(surrounded),
      space_(rules.space),
      walkable_cosine_(rules.walkable_cosine),
      most_changes_(rules.most_impacts),
      memory_(memory),
      scratch_(scratch),
      report_(report),
      walkers_(std::span(memory.walkers).first(count)),
      timetable_(std::span(memory.rows).first(count)),
      gravity_(gravity),
      dt_(dt),
      movers_(movers) {}

template <class Scalar>
StepStatus Stepper<Scalar>::begin(std::span<const CharacterState<Scalar>> states,
                                  std::span<const Input> inputs) noexcept {
  report_.impacts = 0;
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    if (!step_parts::finite(states[i], inputs[i], gravity_, dt_, movers_)) return StepStatus::invalid_input;
    Walker<Scalar>& walker = walkers_[i];
    CharacterState<Scalar>& state = walker.now.state;
    state = states[i];
    remember(states[i].crushers, state);
    // A carried character steers, jumps and falls relative to its carrier.
    if (state.ride.ground != Ride<Scalar>::none) state.velocity -= state.ride.velocity;
    walker.now.time = 0;
    const DesiredVelocity<Scalar> desired = desired_velocity(controller_.character(), gravity_, inputs[i], dt_, state);
    walker.now.own = desired.velocity;
    walker.now.steered = desired.steered;
    walker.start = walker.now;
    walker.company.clear();
    walker.changes = 0;
    walker.stays = walker.no_snap = walker.dropped = false;
    walker.walks = state.grounded;
    walker.drops = inputs[i].drop;
    clear(member(i));
    member(i).step.requested = walker.now.own * dt_;
    member(i).step.steered = desired.steered * dt_;
    walker.end = walker.now;
    if (!ask(i, 1, walker.plan, walker.end)) {
      if (!walker.plan.path.overflowed()) return StepStatus::out_of_range;
      stay(i);
    }
    walker.is_stuck = walker.plan.status == MoveStatus::stuck;
    walker.box = box_along(space_, walker.plan.path);
  }
  note_overlaps(space_, states, report_);
  return StepStatus::moved;
}

/// Whether a way of the whole step meets nobody on theirs.
template <class Scalar>
bool Stepper<Scalar>::is_clear(std::size_t i, const MoveResult<Scalar>& way) noexcept {
  for (std::size_t j = 0; j < walkers_.size(); ++j) {
    if (j == i) continue;
    FixedVector<PathPoint<Scalar>, 2 * MoveResult<Scalar>::max_corners> whole;
    for (const PathPoint<Scalar>& corner : member(j).step.move.path) whole.push_back(corner);
    for (const PathPoint<Scalar>& corner : walkers_[j].plan.path) whole.push_back(corner);
    const Way<Scalar> theirs{{whole.begin(), whole.size()}, 0, 1};
    const bool meets = i < j ? first_meeting(space_, way_of(way), theirs, Scalar(0), Tolerances<Scalar>{}.hit).meets
                             : first_meeting(space_, theirs, way_of(way), Scalar(0), Tolerances<Scalar>{}.hit).meets;
    if (meets) return false;
  }
  return true;
}

/// How far the movers go that crush it [m]; zero where none does, or where it began that way.
template <class Scalar>
Scalar Stepper<Scalar>::reach_of_crush(std::size_t i) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  if (walker.start.state.crushed) return 0;
  Scalar reach = 0;
  const auto look_at = [&](const MoveResult<Scalar>& way) {
    for (const ColliderIndex collider : way.crushed) {
      if (is_companion(collider)) continue;
      const MoverMotion<Scalar>& motion = movers_[surrounded_.scenery.collider(collider).mover];
      reach = std::max(reach, (motion.to - motion.from).cwiseAbs().maxCoeff());
    }
  };
  look_at(member(i).step.move);
  look_at(walker.plan);
  return reach;
}

/// Whether it stood on others alone, and where the step ends nobody is under it: who gives way to somebody knows the
/// way that was planned then, and that one may go on later.
template <class Scalar>
bool Stepper<Scalar>::lost_its_ground(std::size_t i) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  if (!walker.end.state.grounded) return false;
  const MoveResult<Scalar>& made = member(i).step.move;
  const auto holds = [](const auto& touch) { return touch.normal.y() > 0; };
  bool stood_on_another = std::any_of(member(i).met.begin(), member(i).met.end(), holds);
  for (const Contact<Scalar>& contact : walker.plan.contacts.empty() ? made.contacts : walker.plan.contacts) {
    if (!holds(contact)) continue;
    if (!is_companion(contact.collider)) return false;
    stood_on_another = true;
  }
  return stood_on_another && !is_on_another(i);
}

/// Where the step ends: it touches somebody who is under it, and not beside it.
template <class Scalar>
bool Stepper<Scalar>::is_on_another(std::size_t i) const noexcept {
  const V& at = walkers_[i].end.state.position;
  const Scalar width = space_.box().upper.x() - space_.box().lower.x();
  return std::any_of(walkers_.begin(), walkers_.end(), [&](const Walker<Scalar>& other) {
    const V& there = other.end.state.position;
    return there.y() < at.y() && std::abs(there.x() - at.x()) < width &&
           space_.separation(at, there) <= Tolerances<Scalar>{}.touch;
  });
}

/// How far it wanted to fall; zero where it did so at least by half, or stands [m].
template <class Scalar>
Scalar Stepper<Scalar>::missed_fall(std::size_t i) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  const bool stands = walker.end.state.grounded && !lost_its_ground(i);
  const bool held = stands || walker.end.state.crushed || walker.start.state.crushed;
  if (held || walker.start.state.ride.ground != Ride<Scalar>::none) return 0;
  const Scalar wanted = -walker.start.own.y() * dt_;
  const Scalar made = walker.start.state.position.y() - walker.end.state.position.y();
  return wanted > 0 && made < wanted / 2 ? wanted : Scalar(0);
}

/// Asks for a way of the whole step beside all the others, into `memory_.way`. False where something crushes it on that
/// way, or it meets somebody.
/// @param course of the others: straight from where they began to where they end, or as it is now.
/// @param end becomes the moment in which the way ends.
template <class Scalar>
bool Stepper<Scalar>::goes_free(std::size_t i, Course course, Moment<Scalar>& end) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  MoveResult<Scalar>& way = memory_.way;
  end = walker.start;
  if (course == Course::straight) {
    set_motions(walker.company, 0, 1);
    controller_.technique().move(request_at(walker, walker.start, 1), scratch_, memory_.part);
    way.clear();
    append(memory_.part, 0, 1, way);
    pass_on(memory_.part, 1, end);
    if (way.status == MoveStatus::out_of_range || way.path.overflowed()) return false;
  } else if (!ask(i, 1, way, end)) {
    return false;
  }
  return way.crushed.empty() && is_clear(i, way);
}

/// What crushes a character between two impacts may have left it room over the whole step. What held its fall may have
/// gone on after that. So the technique is asked once more, now that the ways of the others are known.
/// @return whether it has another way now.
template <class Scalar>
bool Stepper<Scalar>::seek_room(std::size_t i) noexcept {
  const Scalar crush = reach_of_crush(i);
  Walker<Scalar>& walker = walkers_[i];
  const Scalar reach = std::max(crush, missed_fall(i));
  if (reach == 0) return false;
  const Company company = walker.company;
  walker.company.clear();
  for (std::size_t j = 0; j < walkers_.size(); ++j)
    if (j != i && walkers_[j].box.overlaps(walker.box.inflated(reach)))
      walker.company.push_back(static_cast<CharacterIndex>(j));
  Moment<Scalar> end = walker.start;
  const bool found =
      (crush > 0 && goes_free(i, Course::straight, end)) ||
      (goes_free(i, Course::real, end) && (crush > 0 || end.state.position.y() < walker.end.state.position.y()));
  if (!found) {
    walker.company = company;
    return false;
  }
  member(i).step.move.clear();
  walker.now = walker.start;
  walker.end = end;
  walker.plan = memory_.way;
  walker.stays = walker.dropped = false;
  walker.box = box_along(space_, walker.plan.path);
  return true;
}

template <class Scalar>
void Stepper<Scalar>::finish(std::span<CharacterState<Scalar>> states) noexcept {
  // Where one falls on, others may that it held.
  bool changed = true;
  for (int round = 0; changed && round < most_changes_; ++round) {
    changed = false;
    for (std::size_t i = 0; i < walkers_.size(); ++i) changed = seek_room(i) || changed;
  }
  for (std::size_t i = 0; i < walkers_.size(); ++i)
    if (lost_its_ground(i)) walkers_[i].plan.grounded = walkers_[i].end.state.grounded = false;
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    make(i, walkers_[i].plan);
    walkers_[i].box = box_along(space_, member(i).step.move.path);
  }
  const auto box_of = [this](std::size_t i) -> const Box2<Scalar>& { return walkers_[i].box; };
  keep_back_what_is_not_clear<Scalar>(space_, std::span(report_.members).first(walkers_.size()), box_of,
                                      [&](std::size_t i) { keep_back(i, states[i]); });
  for (std::size_t i = 0; i < walkers_.size(); ++i) hand_out(i, states[i]);
}

template <class Scalar>
void Stepper<Scalar>::keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept {
  CrowdMember<Scalar>& made = member(i);
  Walker<Scalar>& walker = walkers_[i];
  made.stayed = true;
  made.step.move.clear();
  walker.dropped = true;
  walker.now.time = 0;
  const CharacterState<Scalar> flags = walker.now.state;
  walker.now.state = start;
  walker.now.state.jump_held = flags.jump_held;
  walker.now.state.jump_pending = flags.jump_pending;
  ask_to_stay(i);
  make(i, walker.plan);
  walker.box = box_along(space_, made.step.move.path);
}

template <class Scalar>
void Stepper<Scalar>::hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  StepReport<Scalar>& report = member(i).step;
  MoveResult<Scalar>& move = report.move;
  sort_by_time(member(i).met);
  if (!move.crushed.empty())
    move.status = MoveStatus::crushed;
  else if (!walker.end.state.crushers.empty())
    move.status = MoveStatus::stuck;  // a mover is still on it, even if the last part met another character alone
  else if (move.status != MoveStatus::stuck || !walker.is_stuck)  // inside another character alone is not stuck
    move.status = walker.dropped || move.status == MoveStatus::stuck ? MoveStatus::dropped : MoveStatus::moved;
  set_motions({}, 0, 1);
  move.crushers = walker.end.state.crushers;
  Input input;
  input.drop = walker.drops;
  controller_.end_together(input, memory_.motions, scratch_, walker.end.state, report);
  state = walker.end.state;
}

template struct Surrounded<float>;
template struct Surrounded<double>;
template class Stepper<float>;
template class Stepper<double>;

}  // namespace paperproof::crowd
