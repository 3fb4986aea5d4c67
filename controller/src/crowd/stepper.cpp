#include "crowd/stepper.hpp"

#include "crowd/parts.hpp"
#include "step_parts.hpp"

namespace paperproof::crowd {

using step_parts::touches;

namespace {

/// Nothing but staying at a place.
template <class Scalar>
void report_stay(const Vec2<Scalar>& position, StepReport<Scalar>& report) noexcept {
  clear(report);
  report.move.path.push_back({position, 0});
  report.move.path.push_back({position, 1});
}

}  // namespace

template <class Scalar>
StepStatus Stepper<Scalar>::begin(std::span<const CharacterState<Scalar>> states,
                                  std::span<const Input> inputs) noexcept {
  report_.impacts = 0;
  for (std::size_t i = 0; i < runners_.size(); ++i) {
    Runner<Scalar>& runner = runners_[i];
    runner.state = states[i];
    const DesiredVelocity<Scalar> desired =
        desired_velocity(controller_.character(), gravity_, inputs[i], dt_, runner.state);
    runner.state.velocity = desired.velocity;
    runner.jump_held = runner.state.jump_held;
    runner.jump_pending = runner.state.jump_pending;
    runner.begin = 0;
    runner.impacts = 0;
    runner.halted = runner.no_snap = runner.stands = runner.dropped = runner.stuck = false;
    clear(member(i));
    runner.walks = runner.state.grounded;
    runner.drops = inputs[i].drop;
    runner.held.clear();
    const StepStatus status = move(runner, dt_, true, runner.after, runner.plan);
    if (step_parts::is_refused(status)) return status;
    member(i).step.requested = runner.plan.requested;
    member(i).step.steered = desired.steered * dt_;
    find_box(runner);
  }
  note_overlaps(rules_.space, states, report_);
  return StepStatus::moved;
}

/// The intent is in the velocity already; of the input only whether to drop is left.
template <class Scalar>
StepStatus Stepper<Scalar>::move(const Runner<Scalar>& runner, Scalar duration, bool follow_down,
                                 CharacterState<Scalar>& state, StepReport<Scalar>& report) noexcept {
  state = runner.state;
  state.grounded = runner.walks && follow_down && !runner.no_snap;
  const Input input{.move = std::nullopt, .jump = false, .drop = runner.drops};
  const StepStatus status = controller_.step(state, input, V::Zero(), duration, technique_, report);
  report.move.contacts.keep_own();  // the next of them uses the same scratch
  return status;
}

/// A new way for the rest of the step.
template <class Scalar>
void Stepper<Scalar>::plan(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  const Scalar duration = dt_ * (1 - runner.begin);
  if (!(duration > 0)) return stay(i);
  const bool usable = !step_parts::is_refused(move(runner, duration, true, runner.after, runner.plan));
  const auto& made = member(i).step.move.path;
  if (!usable || made.size() + runner.plan.move.path.size() > made.capacity()) {
    runner.dropped = true;
    return halt(i);
  }
  find_box(runner);
}

template <class Scalar>
void Stepper<Scalar>::stay(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  runner.after = runner.state;
  report_stay(runner.state.position, runner.plan);
  find_box(runner);
}

template <class Scalar>
void Stepper<Scalar>::halt(std::size_t i) noexcept {
  runners_[i].halted = true;
  runners_[i].state.velocity = V::Zero();
  stay(i);
}

template <class Scalar>
void Stepper<Scalar>::find_box(Runner<Scalar>& runner) noexcept {
  runner.box = box_along(rules_.space, runner.plan.move.path);
}

/// Adds a part of the way, up to the fraction `end` of the step, to what was made.
template <class Scalar>
void Stepper<Scalar>::commit(std::size_t i, const StepReport<Scalar>& part, Scalar end) noexcept {
  CrowdMember<Scalar>& made = member(i);
  const Way<Scalar> way{{part.move.path.begin(), part.move.path.size()}, runners_[i].begin, end};
  for (const PathPoint<Scalar>& corner : part.move.path)
    add_corner(made.step.move, {corner.position, way.time_of(corner.fraction)});
  for (Contact<Scalar> contact : part.move.contacts) {
    contact.fraction = way.time_of(contact.fraction);
    add_contact(made.step.move, contact);
  }
  for (SensorEvent<Scalar> event : part.sensors) {
    event.fraction = way.time_of(event.fraction);
    made.step.sensors.push_back(event);
  }
  for (const ColliderIndex chain : part.dropped_through) {
    const auto& known = made.step.dropped_through;
    if (std::find(known.begin(), known.end(), chain) == known.end()) made.step.dropped_through.push_back(chain);
  }
  runners_[i].stuck = part.status == StepStatus::stuck;
  runners_[i].dropped = runners_[i].dropped || part.status == StepStatus::dropped;
}

/// Makes the planned way up to a time: the technique is asked again, with less to go. What it answers is a way with all
/// its guarantees; a point between two corners, rounded, would not be.
template <class Scalar>
void Stepper<Scalar>::go_on_to(std::size_t i, Scalar time) noexcept {
  Runner<Scalar>& runner = runners_[i];
  const Scalar duration = dt_ * (time - runner.begin);
  if (!(duration > 0)) return;
  CharacterState<Scalar> state;
  // The ground is followed at the end of the step only: here it may have been left for a head.
  if (step_parts::is_refused(move(runner, duration, false, state, memory_.part))) {
    runner.dropped = true;
    return;
  }
  commit(i, memory_.part, time);
  const V way = state.position - runner.state.position;
  if (std::max(std::abs(way.x()), std::abs(way.y())) > Tolerances<Scalar>{}.touch) runner.held.clear();
  runner.state = state;
  runner.begin = time;
  // The ground took its weight, which holds it to the ground for the rest as well.
  if (state.grounded) runner.state.velocity += gravity_ * dt_;
}

template <class Scalar>
Meeting<Scalar> Stepper<Scalar>::meeting(std::size_t i, std::size_t j) const noexcept {
  const Runner<Scalar>& first = runners_[i];
  const Runner<Scalar>& second = runners_[j];
  if (!first.box.overlaps(second.box)) return {};
  const auto way_of = [](const Runner<Scalar>& runner) {
    return Way<Scalar>{{runner.plan.move.path.begin(), runner.plan.move.path.size()}, runner.begin, 1};
  };
  return first_meeting(rules_.space, way_of(first), way_of(second), now_, Tolerances<Scalar>{}.hit);
}

/// Every impact halts somebody or counts for somebody who is halted after `most_impacts`; two that are halted do not
/// meet. So it ends.
template <class Scalar>
void Stepper<Scalar>::solve() noexcept {
  const auto when = [this](std::size_t i, std::size_t j) { return meeting(i, j); };
  timetable_.find_all(when);
  while (const std::optional<NextMeeting<Scalar>> next = timetable_.earliest()) {
    const auto& [i, j, meeting] = *next;
    now_ = std::max(now_, meeting.time);
    note_impact(*next, report_);
    const MovesIn moves = who_moves_in(meeting.first_rate, meeting.second_rate, meeting.normal);
    const Scalar first_limit = std::max(Scalar(0), -dot(meeting.second_rate, meeting.normal));
    const Scalar second_limit = std::max(Scalar(0), dot(meeting.first_rate, meeting.normal));
    if (moves.first) respond(i, meeting, meeting.normal, first_limit);
    if (moves.second) respond(j, meeting, -meeting.normal, second_limit);
    if (moves.first) timetable_.find_again(i, when);
    if (moves.second) timetable_.find_again(j, when);
  }
}

/// @param normal from the other towards this one.
/// @param limit how fast it may go towards where the other is [m per step].
template <class Scalar>
void Stepper<Scalar>::respond(std::size_t i, const Meeting<Scalar>& meeting, const V& normal, Scalar limit) noexcept {
  Runner<Scalar>& runner = runners_[i];
  if (++runner.impacts > rules_.most_impacts) {
    runner.dropped = true;
    go_on_to(i, meeting.time);
    return halt(i);
  }
  if (meeting.at_once) {
    // There is no halting within a part that takes no time. Following the ground down is left out instead; a way out
    // at the beginning is not taken.
    if (!(meeting.time > runner.begin) || runner.no_snap) return halt(i);
    runner.no_snap = true;
    return plan(i);
  }
  if (!(meeting.time > runner.begin)) note_touched_scenery(i, meeting.impact);
  go_on_to(i, meeting.time);
  if (normal.y() >= rules_.walkable_cosine) runner.stands = true;
  runner.held.push_back({normal, limit / dt_});
  V& velocity = runner.state.velocity;
  // Scenery turns it into the other: it is between the two.
  if (!(-dot(velocity, normal) > limit / dt_)) return halt_between(i);
  velocity = slowed(velocity, normal, limit / dt_, rules_.walkable_cosine);
  if (is_held(runner)) return halt_between(i);
  plan(i);
}

/// Whether its velocity goes into somebody it touches, by more than rounding.
template <class Scalar>
bool Stepper<Scalar>::is_held(const Runner<Scalar>& runner) const noexcept {
  const V& velocity = runner.state.velocity;
  const Scalar noise = noise_of<Scalar>(velocity, V::Zero());
  return runner.held.overflowed() ||
         std::any_of(runner.held.begin(), runner.held.end(),
                     [&](const HeldBy<Scalar>& other) { return -dot(velocity, other.normal) > other.limit + noise; });
}

/// What holds a fall from two sides is stood on.
template <class Scalar>
void Stepper<Scalar>::halt_between(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  runner.stands = runner.stands || std::any_of(runner.held.begin(), runner.held.end(),
                                               [](const HeldBy<Scalar>& other) { return other.normal.y() > 0; });
  halt(i);
}

/// Of a way that ends where it begins nothing is committed: the scenery that was touched there, and turned it into the
/// other, is a contact all the same.
template <class Scalar>
void Stepper<Scalar>::note_touched_scenery(std::size_t i, Scalar impact) noexcept {
  const Runner<Scalar>& runner = runners_[i];
  const MoveResult<Scalar>& planned = runner.plan.move;
  const Way<Scalar> way{{planned.path.begin(), planned.path.size()}, runner.begin, 1};
  const V& wanted = runner.plan.requested;
  for (Contact<Scalar> contact : planned.contacts) {
    const bool touched = contact.fraction * -dot(wanted, contact.normal) <= Tolerances<Scalar>{}.touch;
    contact.fraction = way.time_of(contact.fraction);
    if (touched && contact.fraction <= impact) add_contact(member(i).step.move, contact);
  }
}

template <class Scalar>
void Stepper<Scalar>::finish(std::span<CharacterState<Scalar>> states) noexcept {
  for (std::size_t i = 0; i < runners_.size(); ++i) {
    commit(i, runners_[i].plan, 1);
    runners_[i].state = runners_[i].after;
    runners_[i].box = box_along(rules_.space, member(i).step.move.path);
  }
  const auto box_of = [this](std::size_t i) -> const Box2<Scalar>& { return runners_[i].box; };
  keep_back_what_is_not_clear<Scalar>(rules_.space, std::span(report_.members).first(runners_.size()), box_of,
                                      [&](std::size_t i) { keep_back(i, states[i]); });
  for (std::size_t i = 0; i < runners_.size(); ++i) hand_out(i, states[i]);
}

template <class Scalar>
void Stepper<Scalar>::keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept {
  CrowdMember<Scalar>& made = member(i);
  made.stayed = true;
  report_stay(start.position, made.step);
  Runner<Scalar>& runner = runners_[i];
  runner.state = start;
  runner.state.velocity = V::Zero();
  runner.stands = false;
  runner.dropped = true;
  runner.box = box_along(rules_.space, made.step.move.path);
}

template <class Scalar>
StepStatus Stepper<Scalar>::status_of(std::size_t i) noexcept {
  if (runners_[i].stuck) return StepStatus::stuck;
  return runners_[i].dropped ? StepStatus::dropped : StepStatus::moved;
}

template <class Scalar>
void Stepper<Scalar>::hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept {
  Runner<Scalar>& runner = runners_[i];
  StepReport<Scalar>& report = member(i).step;
  CharacterState<Scalar> next = runner.state;
  next.jump_held = runner.jump_held;
  next.jump_pending = runner.jump_pending;
  if (runner.stands) {
    next.grounded = true;
    next.jumping = false;
  }
  next.wall_left = touches(report.move, Side::left);
  next.wall_right = touches(report.move, Side::right);
  report.status = status_of(i);
  const int stuck_steps = runner.stuck ? std::min(state.stuck_steps + 1, 255) : 0;
  next.stuck_steps = static_cast<std::uint8_t>(stuck_steps);
  report.move.status = runner.stuck ? MoveStatus::stuck : runner.dropped ? MoveStatus::dropped : MoveStatus::moved;
  report.move.position = next.position;
  report.move.velocity = next.velocity;
  report.move.grounded = next.grounded;
  state = next;
}

template class Stepper<float>;
template class Stepper<double>;

}  // namespace paperproof::crowd
